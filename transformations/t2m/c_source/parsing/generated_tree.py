"""The cursors of a generated program's own files as plain Python: a node per cursor with its kind and children.

Unlike `tree`, it has the own headers too, and no offsets: places are asked of the few cursors that a message is about.
"""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.transformations.t2m.c_source.parsing import clang, cursor_kinds
from robosmi.transformations.t2m.c_source.parsing.clang import Cursor
from robosmi.transformations.t2m.c_source.parsing.generated_program import SKETCH, GeneratedProgram
from robosmi.transformations.t2m.c_source.parsing.tree import leave_to

MAX_DEPTH = 700
"""Nesting up to which cursors are read; what is deeper is missing, so its calls are counted as not seen."""
_LEAF: list[GeneratedNode] = []


class GeneratedNode:
    """A cursor of a generated program.

    Attributes:
        kind: CXCursorKind.
        cursor: the cursor.
        children: the cursors below, in the parser's order.
    """

    __slots__ = ("_raw", "children", "kind")

    def __init__(self, kind: int, raw: bytes) -> None:
        self.kind, self._raw = kind, raw
        self.children = _LEAF

    @property
    def cursor(self) -> Cursor:
        """The cursor."""
        return Cursor.from_buffer_copy(self._raw)

    @property
    def raw(self) -> bytes:
        """The cursor's bytes."""
        return self._raw

    @property
    def expressions(self) -> list[GeneratedNode]:
        """The children that are expressions."""
        return [child for child in self.children if child.kind in cursor_kinds.EXPRESSIONS]

    def below(self) -> Iterator[GeneratedNode]:
        """This node and all below it, each before what is below it."""
        waiting = [self]
        while waiting:
            node = waiting.pop()
            yield node
            waiting.extend(reversed(node.children))


def own_nodes(program: GeneratedProgram, unit: int) -> list[GeneratedNode]:
    """The nodes of the declarations at the top level of a unit that stand in the program's own files, with all below."""
    own: dict[int | None, bool] = {}
    tops: list[GeneratedNode] = []
    library = clang.library()

    def top(cursor: Cursor, parent: Cursor, data: int | None) -> int:
        file, _ = clang.file_offset(library.getCursorLocation(cursor))
        if file not in own:
            name = clang.file_name(file)
            own[file] = name.startswith(SKETCH) and name != f"{SKETCH}/{program.adapters}"
        if own[file]:
            tops.append(GeneratedNode(cursor.kind, bytes(cursor)))
        return 1

    clang.visit(library.getTranslationUnitCursor(unit), top)
    stack: list[GeneratedNode] = []

    def visitor(cursor: Cursor, parent: Cursor, data: int | None) -> int:
        raw = bytes(parent)
        if stack[-1].raw != raw:
            leave_to(stack, raw)
        node = GeneratedNode(cursor.kind, bytes(cursor))
        owner = stack[-1]
        if owner.children is _LEAF:
            owner.children = [node]
        else:
            owner.children.append(node)
        if len(stack) > MAX_DEPTH:
            return 1
        stack.append(node)
        return 2

    for node in tops:
        stack[:] = [node]
        clang.visit(node.cursor, visitor)
    return tops
