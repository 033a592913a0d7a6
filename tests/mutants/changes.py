"""The ways in which a module can be changed: each is a small fault at one place of its text."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass

_FLIPPED = {
    ast.Lt: "<=", ast.LtE: "<", ast.Gt: ">=", ast.GtE: ">", ast.Eq: "!=", ast.NotEq: "==", ast.In: "not in", ast.NotIn: "in",
    ast.Is: "is not", ast.IsNot: "is",
}  # fmt: skip
_NO_TESTS = ("TYPE_CHECKING", "__name__ == '__main__'")
_SKIPPED = ("annotation", "returns", "decorator_list")


@dataclass(frozen=True)
class Change:
    """A change of a module's text.

    Attributes:
        kind: what kind of fault it is.
        line: the line where it begins, from 1.
        start, end: the offsets of what it replaces, in bytes.
        new: what stands there instead.
    """

    kind: str
    line: int
    start: int
    end: int
    new: str

    def applied(self, text: bytes) -> bytes:
        """The changed text."""
        return text[: self.start] + self.new.encode() + text[self.end :]

    def shown(self, text: bytes) -> str:
        """The change as `old -> new`, on one line."""
        return " ".join(f"{text[self.start : self.end].decode()} -> {self.new}".split())


def changes(text: bytes) -> list[Change]:
    """All changes of a module.

    Annotations, decorators, options of classes and texts stay as they are, and f-strings, too, whose parts have no exact place in
    the tree of Python 3.11.
    """
    return list(_Module(text).found(ast.parse(text)))


class _Module:
    def __init__(self, text: bytes) -> None:
        self.text = text
        self.starts = [0]
        for line in text.splitlines(keepends=True):
            self.starts.append(self.starts[-1] + len(line))

    def found(self, node: ast.AST) -> Iterator[Change]:
        """The changes of a node and of all within it."""
        if isinstance(node, ast.JoinedStr) or (isinstance(node, ast.If) and ast.unparse(node.test) in _NO_TESTS):
            return
        yield from self.here(node)
        for name, value in ast.iter_fields(node):
            if name in _SKIPPED or (isinstance(node, ast.ClassDef) and name == "keywords"):
                continue
            for child in value if isinstance(value, list) else [value]:
                if isinstance(child, ast.AST):
                    yield from self.found(child)

    def here(self, node: ast.AST) -> Iterator[Change]:
        """The changes of a node itself."""
        match node:
            case ast.Compare(left=left, ops=[op], comparators=[right]) if type(op) in _FLIPPED:
                yield self.put("comparison", node, f"({self.of(left)}) {_FLIPPED[type(op)]} ({self.of(right)})")
            case ast.Constant(value=bool() as value):
                yield self.put("constant", node, str(not value))
            case ast.Constant(value=int() as number):
                yield self.put("boundary", node, f"({number + 1})")
                yield self.put("boundary", node, f"({number - 1})")
            case ast.Constant(value=float() as real):
                yield self.put("constant", node, f"({real * 2 + 1})")
            case ast.BoolOp(op=op, values=values):
                word = " or " if isinstance(op, ast.And) else " and "
                yield self.put("connective", node, f"({word.join(f'({self.of(each)})' for each in values)})")
            case ast.Return(value=ast.expr() as value) if not (isinstance(value, ast.Constant) and value.value is None):
                yield self.put("returned value", node, "return None")
            case ast.Expr(value=value) if not isinstance(value, (ast.Constant, ast.Yield, ast.YieldFrom, ast.Await)):
                yield self.put("statement", node, "pass")
            case ast.AugAssign() | ast.Delete() | ast.Raise():
                yield self.put("statement", node, "pass")
        if isinstance(node, (ast.If, ast.While, ast.IfExp)):
            yield self.put("condition", node.test, f"(not ({self.of(node.test)}))")
        elif isinstance(node, ast.comprehension):
            for test in node.ifs:
                yield self.put("condition", test, f"(not ({self.of(test)}))")

    def place(self, node: ast.AST) -> tuple[int, int]:
        """The offsets of a node."""
        assert isinstance(node, (ast.expr, ast.stmt))
        assert node.end_lineno is not None
        assert node.end_col_offset is not None
        return self.starts[node.lineno - 1] + node.col_offset, self.starts[node.end_lineno - 1] + node.end_col_offset

    def of(self, node: ast.expr) -> str:
        """The text of an expression."""
        start, end = self.place(node)
        return self.text[start:end].decode()

    def put(self, kind: str, node: ast.expr | ast.stmt, new: str) -> Change:
        """A change that puts a text in a node's place."""
        return Change(kind, node.lineno, *self.place(node), new)
