"""Evaluates integers in pieces of a program's text: literals, and macros that stand for constant expressions.

The text of a macro is expanded first (`expansion`), so that nested, pasted and passed text is what the compiler sees. Types are
not known here: numbers have unlimited width, and casts to integer types are ignored.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable

from robosmi.transformations.queries.macros.expansion import MacroTexts

_NUMBER = re.compile(r"\b(0[xX][0-9a-fA-F]+|0[bB][01]+|0[0-7]*|[1-9][0-9]*)[uUlL]*\b")
_CAST = re.compile(r"\(\s*(?:(?:unsigned|signed|const|char|short|int|long|u?int(?:8|16|32)_t)\s*)+\)")
_MOST_BITS = 128


def macro_number(name: str, texts: MacroTexts, known: Callable[[str], int | None]) -> int | None:
    """The integer that an object-like macro stands for; None where its text is no constant integer expression.

    Args:
        name: of the macro.
        texts: what macros stand for.
        known: the value of a name that is no macro, such as an enumerator; None where it has none.
    """
    expanded = texts.expanded(name)
    if expanded is None or "#" in expanded:
        return None
    text = _NUMBER.sub(lambda m: str(c_integer(m[1])), _CAST.sub(" ", expanded))
    try:
        return _evaluate(ast.parse(text.strip(), mode="eval").body, known)
    except (SyntaxError, ValueError, RecursionError):
        return None


def _evaluate(node: ast.expr, known: Callable[[str], int | None]) -> int | None:
    if isinstance(node, ast.Constant):
        return node.value if isinstance(node.value, int) else None
    if isinstance(node, ast.Name):
        return known(node.id)
    if isinstance(node, ast.UnaryOp):
        value = _evaluate(node.operand, known)
        change = _CHANGES.get(node.op.__class__)
        return None if value is None or change is None else change(value)
    if isinstance(node, ast.BinOp):
        left, right = _evaluate(node.left, known), _evaluate(node.right, known)
        operator = _BINARY.get(node.op.__class__)
        return None if left is None or right is None or operator is None else calculate(operator, left, right)
    return None


_CHANGES: dict[type, Callable[[int], int]] = {ast.USub: lambda v: -v, ast.UAdd: lambda v: v, ast.Invert: lambda v: ~v}
_BINARY: dict[type, str] = {
    ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Mod: "%",
    ast.LShift: "<<", ast.RShift: ">>", ast.BitAnd: "&", ast.BitOr: "|", ast.BitXor: "^",
}  # fmt: skip


def calculate(operator: str, a: int, b: int) -> int | None:
    """A binary operator of C on two integers; None where it has no value, or one that no type of C holds by far."""
    if max(a.bit_length(), b.bit_length()) > _MOST_BITS:
        return None
    if operator in ("/", "%"):
        if b == 0:
            return None
        quotient = abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)
        return quotient if operator == "/" else a - b * quotient
    if operator in ("<<", ">>"):
        return None if not 0 <= b < 64 else a << b if operator == "<<" else a >> b
    operation = _OPERATIONS.get(operator)
    return None if operation is None else int(operation(a, b))


_OPERATIONS: dict[str, Callable[[int, int], int]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "&": lambda a, b: a & b,
    "|": lambda a, b: a | b,
    "^": lambda a, b: a ^ b,
    "<": lambda a, b: a < b,
    ">": lambda a, b: a > b,
    "<=": lambda a, b: a <= b,
    ">=": lambda a, b: a >= b,
    "==": lambda a, b: a == b,
    "!=": lambda a, b: a != b,
}


def c_integer(text: str) -> int:
    """The value of an integer literal of C without its suffix."""
    lower = text.lower()
    if lower.startswith(("0x", "0b")):
        return int(lower[2:], 16 if lower[1] == "x" else 2)
    return int(lower, 8 if lower.startswith("0") and len(lower) > 1 else 10)
