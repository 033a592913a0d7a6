"""Names of what a generated program declares, the same in all of its files, and places of its expressions."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from robosmi.transformations.t2m.c_source.parsing import clang, cursor_kinds as kinds
from robosmi.transformations.t2m.c_source.parsing.clang import Cursor
from robosmi.transformations.t2m.c_source.parsing.generated_program import SKETCH, GeneratedProgram
from robosmi.transformations.t2m.c_source.parsing.generated_tree import GeneratedNode

FUNCTIONS = frozenset((kinds.FUNCTION_DECL, kinds.CXX_METHOD, kinds.CONSTRUCTOR, kinds.CONVERSION_FUNCTION))
SCOPES = frozenset((*FUNCTIONS, kinds.FUNCTION_TEMPLATE, kinds.DESTRUCTOR))
RECORDS = frozenset((kinds.CLASS_DECL, kinds.STRUCT_DECL, kinds.UNION_DECL, kinds.CLASS_TEMPLATE, kinds.NAMESPACE))
CASTS = frozenset((
    kinds.CSTYLE_CAST_EXPR, kinds.CXX_STATIC_CAST_EXPR, kinds.CXX_REINTERPRET_CAST_EXPR, kinds.CXX_CONST_CAST_EXPR,
    kinds.CXX_FUNCTIONAL_CAST_EXPR, kinds.CXX_DYNAMIC_CAST_EXPR,
))  # fmt: skip
STEPS = frozenset((1, 2, 3, 4))
"""CXUnaryOperatorKind of ++ and --."""
ADDRESS, DEREFERENCE, PLUS, MINUS = 5, 6, 7, 8
ADD, SUBTRACT, ASSIGN, COMMA = 6, 7, 22, 33
POINTERS = frozenset((101, 103, 104, 112, 113, 114, 115, 116))
"""CXTypeKind of pointers, references, arrays."""
REFERENCES = frozenset((103, 104))
"""CXTypeKind of references."""
_NAME = re.compile(rb"[A-Za-z_]\w*")
_EXTERNAL = 4
"""CXLinkage of names that other files see."""
EXTERN = 2
"""CX_StorageClass of `extern`."""

Key = tuple[object, ...]
"""A variable, a member, a parameter, an enumerator, or the result of a function."""


class Origin(NamedTuple):
    """The origin of a value: a pin (`what` is empty), or what else it is."""

    what: str
    place: tuple[str, int, int]
    text: str = ""


class GeneratedNames:
    """Names and places in a generated program.

    Args:
        program: the program.
    """

    def __init__(self, program: GeneratedProgram) -> None:
        self.program, self.library = program, clang.library()
        self._names: dict[int | None, str] = {}
        self._parameters: dict[int | None, Key] = {}

    def key(self, cursor: Cursor) -> Key:
        """The key of a variable, a member, a parameter or an enumerator."""
        if cursor.kind == kinds.PARM_DECL:
            known = self._parameters.get(cursor.data[0])
            return known if known is not None else ("parameter", self.unique_name(cursor), -1)
        if cursor.kind == kinds.FIELD_DECL:
            return ("member", self.unique_name(cursor))
        if cursor.kind == kinds.ENUM_CONSTANT_DECL:
            return ("enumerator", self.unique_name(cursor))
        external = self.library.getCursorLinkage(cursor) == _EXTERNAL
        if external and self.library.getCursorSemanticParent(cursor).kind not in RECORDS:
            return ("variable", self.spelling(cursor))
        return ("variable", self.unique_name(cursor))

    def unique_name(self, cursor: Cursor) -> str:
        """A name of a declaration that is the same in all files; of a function made of a template that of the template."""
        at = cursor.data[0]
        known = self._names.get(at)
        if known is None:
            if cursor.kind in FUNCTIONS:
                cursor = clang.written_template(cursor)
            first = self.library.getCanonicalCursor(cursor)
            known = self.library.text(self.library.getCursorUSR(first)) or f"at {first.data[0]}"
            self._names[at] = known
        return known

    def spelling(self, cursor: Cursor) -> str:
        """The name of a declaration."""
        return self.library.text(self.library.getCursorSpelling(cursor))

    def origin(self, what: str, node: GeneratedNode, text: str = "") -> Origin:
        """The origin of a value, with its place; all uses of one macro are one place."""
        location = self.library.getCursorLocation(node.cursor)
        file, offset = clang.file_offset(location)
        name = clang.file_name(file)
        data = self.program.texts.get(name, b"")
        made = _NAME.match(data, offset) if node.kind in (kinds.INTEGER_LITERAL, kinds.DECL_REF_EXPR) else None
        if made is not None and what == "" and made[0] != text.encode():
            return Origin(what, (made[0].decode(), 0, 0), text)
        return Origin(what, (name.removeprefix(f"{SKETCH}/"), data.count(b"\n", 0, offset) + 1, offset), text)

    def text(self, node: GeneratedNode) -> str:
        """The text of an expression, without white space around it."""
        extent = self.library.getCursorExtent(node.cursor)
        places = []
        for raw in (extent.begin, extent.end):
            location = clang.SourceLocation()
            location.ptr_data, location.int_data = extent.ptr_data, raw
            places.append(clang.file_offset(location))
        (file, start), (_, end) = places
        return self.program.texts.get(clang.file_name(file), b"")[start:end].decode("utf-8", "replace").strip()

    def targets(self, node: GeneratedNode) -> list[Key]:
        """What an expression on the left of an assignment may write."""
        node = plain(node)
        kind, inner = node.kind, node.expressions
        if kind in (kinds.DECL_REF_EXPR, kinds.MEMBER_REF_EXPR):
            found = self.library.getCursorReferenced(node.cursor)
            known = found.kind in (kinds.VAR_DECL, kinds.PARM_DECL, kinds.FIELD_DECL)
            return [self.key(found)] if known else []
        if kind == kinds.ARRAY_SUBSCRIPT_EXPR:
            return [key for each in self.arrays(inner) for key in self.targets(each)]
        if kind == kinds.UNARY_OPERATOR or kind in CASTS:
            return self.targets(inner[-1]) if inner else []
        if kind == kinds.CONDITIONAL_OPERATOR:
            return [key for each in inner[1:] for key in self.targets(each)]
        if kind == kinds.BINARY_OPERATOR:
            return [key for each in self.arrays(inner) for key in self.targets(each)]
        return []

    def arrays(self, nodes: Sequence[GeneratedNode]) -> list[GeneratedNode]:
        """The nodes that are arrays or pointers, of an index or of a sum."""
        library = self.library
        found = [n for n in nodes if library.getCanonicalType(library.getCursorType(unwrapped(n).cursor)).kind in POINTERS]
        return found or list(nodes[:1])


def plain(node: GeneratedNode) -> GeneratedNode:
    """An expression without parentheses, casts, and what the parser adds around it."""
    while node.kind in (kinds.PAREN_EXPR, kinds.UNEXPOSED_EXPR) or node.kind in CASTS:
        inner = node.expressions
        if len(inner) != 1:
            return node
        node = inner[0]
    return node


def unwrapped(node: GeneratedNode) -> GeneratedNode:
    """An expression without what the parser adds around it, such as the conversion of an array to a pointer."""
    while node.kind in (kinds.PAREN_EXPR, kinds.UNEXPOSED_EXPR) and len(node.expressions) == 1:
        node = node.expressions[0]
    return node
