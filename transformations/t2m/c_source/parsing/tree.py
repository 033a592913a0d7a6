"""libclang's tree as plain Python: a `Node` per cursor of the file, with its kind, byte offsets and children.

One visit in C with one callback per cursor; locations are compared as numbers, not queried one by one. Cursors of headers and
of the prelude are left out. The macro expansions in the file and the ranges that the preprocessor skipped are collected too.
The builders know what the kinds mean.
"""

from __future__ import annotations

import os
from typing import Protocol, TypeVar

from robosmi.transformations.t2m.c_source.parsing import clang, cursor_kinds
from robosmi.transformations.t2m.c_source.parsing.clang import INCLUSION, MACRO_DEFINITION, MACRO_EXPANSION, Cursor
from robosmi.transformations.t2m.c_source.parsing.cursor_kinds import INIT_LIST_EXPR, STRING_LITERAL
from robosmi.transformations.t2m.c_source.parsing.error_recovery import Scratch

MACRO_ID = 1 << 31
MAX_TREE_DEPTH = 700
MOST_CURSORS, BYTES_PER_CURSOR = 45_000, 3
"""Cursors of one file, those of macros counted each time and elements of initialisers left out; and what a longer file may have.

Programs that people write have one for four bytes or more; 10,000 calls have 40,000.
"""
_TEXT = 2
"""What a text counts beside its conversion to a pointer: as the element of a table it costs as much as three expressions."""
FUNCTION, VARIABLE, TYPEDEF, STRUCT, UNION, CLASS, ENUM = (
    cursor_kinds.FUNCTION_DECL,
    cursor_kinds.VAR_DECL,
    cursor_kinds.TYPEDEF_DECL,
    cursor_kinds.STRUCT_DECL,
    cursor_kinds.UNION_DECL,
    cursor_kinds.CLASS_DECL,
    cursor_kinds.ENUM_DECL,
)
_NOT_READ = frozenset((MACRO_DEFINITION, INCLUSION))
_TAGGED = frozenset((STRUCT, UNION, CLASS, ENUM))
_OWN = {FUNCTION: "function", VARIABLE: "variable", TYPEDEF: "type"}


LEAF: list[Node] = []
"""The shared empty list of children of all leaves; never changed."""


class Node:
    """A cursor of the file.

    Attributes:
        kind: CXCursorKind.
        start, end: byte offsets in the file; of a macro's expansion where the text has it.
        from_macro: it begins in the expansion of a macro.
        raw: the cursor's bytes.
        cursor: the cursor itself.
        children: in the parser's order.

    A large program has millions of them, so the cursor is kept as its bytes (a third of the memory), and leaves share one list.
    """

    __slots__ = ("children", "end", "from_macro", "kind", "raw", "start")

    def __init__(self, kind: int, start: int, end: int, from_macro: bool, raw: bytes) -> None:
        self.kind = kind
        self.start = start
        self.end = end
        self.from_macro = from_macro
        self.raw = raw
        self.children: list[Node] = LEAF

    @property
    def cursor(self) -> Cursor:
        """The cursor."""
        return Cursor.from_buffer_copy(self.raw)

    def __repr__(self) -> str:
        return f"<Node {self.kind} {self.start}..{self.end}{' macro' if self.from_macro else ''} {len(self.children)} children>"


class TooDense(Exception):
    """A file has more declarations, statements and expressions than its size allows.

    Attributes:
        offset: where they become too many.
        most: how many its size allows.
    """

    def __init__(self, offset: int, most: int) -> None:
        super().__init__(offset, most)
        self.offset, self.most = offset, most


class _WithCursor(Protocol):
    @property
    def raw(self) -> bytes: ...


_Node = TypeVar("_Node", bound=_WithCursor)


def leave_to(stack: list[_Node], raw: bytes) -> None:
    """Take the nodes behind a parent from a stack; none if the parent is not there, as that of a lambda's captures.

    Args:
        stack: the nodes from the top to where a visit is.
        raw: the bytes of the parent's cursor.
    """
    for depth in range(len(stack) - 1, 0, -1):
        if stack[depth - 1].raw == raw:
            del stack[depth:]
            return


class Expansion:
    """A use of a macro in the file: its name and range, with the arguments if it has any."""

    __slots__ = ("cursor", "end", "name", "start")

    def __init__(self, name: str, start: int, end: int, cursor: Cursor) -> None:
        self.name, self.start, self.end, self.cursor = name, start, end, cursor


class TreeReader:
    """Reads the tree of one translation unit.

    Args:
        unit: the handle of the translation unit.
        path: path of the main file, as it was parsed.
        scratch: the text that was parsed; all offsets that come out of here are those of the file itself.
    """

    def __init__(self, unit: int, path: str, scratch: Scratch) -> None:
        lib = clang.library()
        self.unit = unit
        self.length = len(scratch.data)
        self._back = scratch.source_offset if scratch.edits else None
        self.file: int | None = lib.getFile(unit, os.fsencode(path))
        self.base: int = lib.getLocationForOffset(unit, self.file, 0).int_data
        self.expansions: list[Expansion] = []
        self.cut: list[tuple[int, int]] = []
        self._extent = lib.getCursorExtent
        self._root = lib.getTranslationUnitCursor(unit)

    def offset(self, location: clang.SourceLocation) -> int:
        """The byte offset of a location in the main file, -1 for any other location."""
        raw = location.int_data
        if raw < MACRO_ID:
            found = raw - self.base if 0 <= raw - self.base <= self.length else -1
        else:
            file, offset = clang.file_offset(location)
            found = offset if file == self.file else -1
        return found if self._back is None or found < 0 else self._back(found)

    def extent(self, cursor: Cursor) -> tuple[int, int, bool]:
        """Start and end offsets, and whether the start lies in a macro's expansion; -1 outside the main file."""
        extent = self._extent(cursor)
        begin, end, base = extent.begin, extent.end, self.base
        start = begin - base
        if begin < MACRO_ID:
            if not 0 <= start <= self.length or not begin:
                start = -1
        else:
            start = self._slow(extent, begin)
        if end < MACRO_ID:
            stop = end - base
            if not 0 <= stop <= self.length:
                stop = -1
        else:  # the place behind a macro's token has no file place, the one before has
            stop = self._slow(extent, end - 1)
            if stop >= 0:
                stop += 1
        if self._back is not None:
            start = self._back(start) if start >= 0 else start
            stop = self._back(stop) if stop >= 0 else stop
        return start, stop if stop >= start else start, begin >= MACRO_ID

    def is_implicit(self, function: Cursor) -> bool:
        """Whether libclang made up the declaration of an undeclared function at its first call.

        Such a declaration has no text; that of a compiler's built-in function is the name alone.
        """
        extent = self._extent(function)
        named = len(clang.library().text(clang.library().getCursorSpelling(function)).encode())
        return extent.begin == 0 or extent.end - extent.begin == named

    def _slow(self, extent: clang.SourceRange, raw: int) -> int:
        location = clang.SourceLocation()
        location.ptr_data = extent.ptr_data
        location.int_data = raw
        file, offset = clang.file_offset(location)
        return offset if file == self.file else -1

    def own_names(self) -> dict[str, str]:
        """Names that the file declares at its top level: `function`, `variable` or `type`."""
        lib = clang.library()
        found: dict[str, str] = {}

        def visitor(cursor: Cursor, parent: Cursor, data: int | None) -> int:
            what = _OWN.get(cursor.kind)
            if what and self.offset(lib.getCursorLocation(cursor)) >= 0:
                found[lib.text(lib.getCursorSpelling(cursor))] = what
            return 1

        clang.visit(self._root, visitor)
        return found

    def read(self) -> list[Node]:
        """The nodes of the file's top level with all below them; fills `expansions` and `cut`.

        Raises:
            TooDense: the file has more cursors than its size allows.
        """
        top: list[Node] = []
        types: set[int | None] = set()
        extent, expansion, place = self.extent, self._expansion, self._extent
        last = self.base + self.length

        def visitor(cursor: Cursor, parent: Cursor, data: int | None) -> int:
            kind = cursor.kind
            if kind in _NOT_READ:  # most cursors by far
                return 1
            begin = place(cursor).begin
            if begin > last and begin < MACRO_ID:  # in a header
                return 1
            if kind == MACRO_EXPANSION:
                expansion(cursor)
                return 1
            start, end, macro = extent(cursor)
            if start >= 0:
                top.append(Node(kind, start, end, macro, bytes(cursor)))
            return 1

        clang.visit(self._root, visitor)
        self._read_below(top, types)
        return top

    def subtree(self, cursor: Cursor) -> Node:
        """The node of a cursor that the tree lacks, with all below it."""
        top = Node(cursor.kind, *self.extent(cursor), bytes(cursor))
        self._read_below([top], set())
        return top

    def _read_below(self, tops: list[Node], types: set[int | None]) -> None:
        """Add all that is below the nodes of the top level; the types are those whose parts were read."""
        place, extent, cut = self._extent, self.extent, self.cut
        first, last = self.base, (self.base + self.length if self._back is None else -1)
        stack: list[Node] = []
        left = most = max(MOST_CURSORS, self.length // BYTES_PER_CURSOR)

        def visitor(cursor: Cursor, parent: Cursor, data: int | None) -> int:
            nonlocal left
            try:
                raw = bytes(parent)
                if stack[-1].raw != raw:
                    leave_to(stack, raw)
                owner = stack[-1]
                if owner.kind != INIT_LIST_EXPR:
                    left -= _TEXT if cursor.kind == STRING_LITERAL else 1
                    if left < 0:
                        raise TooDense(owner.start, most)
                found = place(cursor)
                start, end = found.begin, found.end
                if first <= start <= end <= last:
                    start, end, macro = start - first, end - first, False
                else:
                    start, end, macro = extent(cursor)
                    if start < 0:  # recovered by the parser, or from an included table
                        start = end = owner.start
                kind = cursor.kind
                node = Node(kind, start, end, macro, bytes(cursor))
                if owner.children is LEAF:
                    owner.children = [node]
                else:
                    owner.children.append(node)
                if len(stack) > MAX_TREE_DEPTH:
                    cut.append((start, end))
                    return 1
                if kind in _TAGGED and not self._enters(kind, cursor, types):
                    return 1
                stack.append(node)
            except BaseException as error:
                failed.append(error)
                return 0
            return 2

        below = clang.VISITOR(visitor)
        visit = clang.library().visitChildren
        with clang.raising() as failed:
            for node in tops:
                cursor = node.cursor
                if self._enters(node.kind, cursor, types) and not failed:
                    stack[:] = [node]
                    visit(cursor, below, None)

    @staticmethod
    def _enters(kind: int, cursor: Cursor, types: set[int | None]) -> bool:
        """Whether to read a cursor's children; libclang repeats a type below each declarator, doubling at each level."""
        if kind not in _TAGGED:
            return True
        name = cursor.data[0]
        known = name in types
        types.add(name)
        return not known

    def _expansion(self, cursor: Cursor) -> None:
        start, end, macro = self.extent(cursor)
        if start >= 0 and not macro:
            lib = clang.library()
            self.expansions.append(Expansion(lib.text(lib.getCursorSpelling(cursor)), start, end, cursor))

    def skipped(self) -> list[tuple[int, int]]:
        """Ranges that conditional directives left out, in text order."""
        lib = clang.library()
        ranges = lib.getSkippedRanges(self.unit, self.file)
        found = []
        if ranges:
            content = ranges.contents
            for i in range(content.count):
                one = content.ranges[i]
                start, end = one.begin - self.base, one.end - self.base
                if 0 <= start <= end <= self.length:
                    found.append((start, end) if self._back is None else (self._back(start), self._back(end)))
            lib.disposeSourceRangeList(ranges)
        return sorted(found)
