"""The text of a source unit with the plan's changes applied: this is how retained code is carried over.

The text is copied, not printed anew from the model, so that comments, layout and conditional code survive. Offsets are bytes of
the original; a change is applied wherever its range is copied. The plan decides which changes there are.
"""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Iterator, Sequence

from msgspec import Struct

from robosmi.metamodels import ccode, migration
from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.queries.block_braces import ends_in_brace
from robosmi.transformations.queries.text_changes import decision_of, effective

HEADERS = (".h", ".hh", ".hpp")
ADAPTERS_FILE = "adapters.h"
"""The file of a made program that has the adapters and placeholders it uses."""


INCLUDED = (*HEADERS, ".c", ".cc", ".cpp")
"""Endings of the files that a program's `#include` may name as its own: people include `.c` files, too."""


def is_header(unit: ccode.SourceUnit) -> bool:
    """Whether a unit is a header of the program: by its file name, or because another unit includes it."""
    return unit.path.lower().endswith(HEADERS) or _is_included(unit)


def _is_included(unit: ccode.SourceUnit) -> bool:
    """Whether another unit of the program includes this one, and it defines no main."""
    others = [u for u in unit.program.units if u is not unit] if unit.program is not None else []
    name = unit.path.rpartition("/")[2]
    includes = (i for u in others for i in u.includes)
    if not any(i.resolvedPath == unit.path or (_file_name(i) == name and meant_unit(i) is unit) for i in includes):
        return False
    return not any(isinstance(d, ccode.Function) and d.name == "main" and d.definition for d in unit.declarations)


def meant_unit(include: ccode.Include) -> ccode.SourceUnit | None:
    """The program's file that an include refers to (`FilesByName.meant`)."""
    unit = include.eContainer()
    return FilesByName(unit.program if isinstance(unit, ccode.SourceUnit) else None).meant(include)


class FilesByName:
    """The files of a program by their paths and names.

    Args:
        program: the program, or None for no files.
    """

    def __init__(self, program: ccode.Program | None) -> None:
        units = [(str(unit.path), unit) for unit in reversed(program.units)] if program is not None else []  # the first counts
        self._by_path = dict(units)
        self._by_name = {path.rpartition("/")[2]: unit for path, unit in units}

    def meant(self, include: ccode.Include) -> ccode.SourceUnit | None:
        """The file that an include refers to: the resolved one, else the first with the same file name.

        Several folders may have files of one name, so the file name alone counts only if the include was not resolved.
        """
        return self._by_path.get(str(include.resolvedPath)) or self._by_name.get(_file_name(include))


def _file_name(include: ccode.Include) -> str:
    return str(include.header.replace("\\", "/").rpartition("/")[2])


def header_file(name: str) -> str:
    """The name of a program's own header in a sketch, where each `.c` file would be compiled by itself."""
    return name if name.lower().endswith(HEADERS) else f"{name.replace('.', '_')}.h"


class Piece(Struct, frozen=True):
    """A run of whole lines of copied text.

    Attributes:
        text: with changes applied.
        start, end: byte offsets of the original.
        elements: the top elements in it.
        changes: the changes applied in it.
    """

    text: str
    start: int
    end: int
    elements: tuple[ccode.Located, ...]
    changes: tuple[migration.TextChange, ...]


def codec_of(unit: ccode.SourceUnit) -> str:
    """The codec of a unit's stored bytes; a text in UTF-16 is stored in UTF-8."""
    return "utf-8" if not unit.encoding or unit.encoding in _UNICODE else str(unit.encoding)


class SourceText:
    """A unit's bytes and the changes of them that take effect.

    Args:
        unit: the unit.
        data: its bytes, as they were read.
        changes: the plan's changes; those of other units are left out.
    """

    def __init__(self, unit: ccode.SourceUnit, data: bytes, changes: Iterable[migration.TextChange]) -> None:
        self.unit = unit
        self.data = data
        given = [c for c in changes if c.unit is unit]
        self.changes = effective(given)
        self._placed = _placed(self.changes)
        self._starts = [start for start, *_ in self._placed]
        self._encoding = codec_of(unit)
        self._bytes = [] if self._encoding == "utf-8" else _bytes_of_literals(data)
        self._given = sorted(enumerate(given), key=lambda pair: pair[1].startOffset)
        self._comments: list[ccode.Comment] = sorted(unit.comments, key=lambda comment: comment.startOffset)
        self._comment_starts = [comment.startOffset for comment in self._comments]

    def copied(self, copy: migration.TextCopy, without: migration.Decision) -> str:
        """The text of a copy: its range with the changes that are not a decision's own, and with those of the copy."""
        start, end = copy.startOffset, copy.endOffset
        first = bisect_left(self._given, start, key=lambda pair: pair[1].startOffset)
        last = bisect_right(self._given, end, key=lambda pair: pair[1].startOffset)
        others = [c for _, c in sorted(self._given[first:last], key=lambda pair: pair[0]) if decision_of(c) is not without]
        return self._applied(_placed(effective([*copy.changes, *(c for c in others if c.endOffset <= end)])), start, end)[0]

    def line_start(self, offset: int) -> int:
        """Offset of the first byte of the line."""
        return self.data.rfind(b"\n", 0, offset) + 1

    def line_end(self, offset: int) -> int:
        """The offset after the line feed that ends the line, or the end of the text."""
        found = self.data.find(b"\n", offset)
        return len(self.data) if found < 0 else found + 1

    def statement_end(self, statement: ccode.Located) -> int:
        """Offset behind a statement with its semicolon."""
        if self.data[statement.endOffset - 2 : statement.endOffset].endswith((b";", b"}", b"%>")):
            return int(statement.endOffset)
        if isinstance(statement, (ccode.Block, ccode.If, ccode.Switch, ccode.Loop)) and ends_in_brace(statement):
            return int(statement.endOffset)
        found = self.data.find(b";", statement.endOffset)
        return found + 1 if found >= 0 else int(statement.endOffset)

    def blank(self, start: int, end: int) -> bool:
        """Whether the range holds white space only."""
        return not self.data[start:end].strip()

    def slice(self, start: int, end: int) -> tuple[str, tuple[migration.TextChange, ...]]:
        """The text of a range with changes applied, line ends as line feeds, and the changes that took part."""
        within = self._placed[bisect_left(self._starts, start) : bisect_right(self._starts, end)]
        return self._applied(within, start, end)

    def _applied(
        self, changes: Iterable[tuple[int, int, str, migration.TextChange]], start: int, end: int
    ) -> tuple[str, tuple[migration.TextChange, ...]]:
        parts: list[str] = []
        applied: list[migration.TextChange] = []
        position = start
        for begins, ends, new, change in changes:
            if ends > end:
                continue
            inserted = begins == ends == end
            if inserted and start < end < len(self.data) and self.data[end - 1 : end] == b"\n":
                continue  # an insertion at a border of lines belongs to the line that it begins
            parts += [self._decode(position, begins), new]
            position = ends
            applied.append(change)
        parts.append(self._decode(position, end))
        return "".join(parts), tuple(applied)

    def comments_in(self, start: int, end: int) -> list[ccode.Comment]:
        """The comments that begin in a range."""
        return self._comments[bisect_left(self._comment_starts, start) : bisect_left(self._comment_starts, end)]

    def _decode(self, start: int, end: int) -> str:
        parts, position = [], start
        for place in self._bytes[bisect_left(self._bytes, start) : bisect_left(self._bytes, end)]:
            parts += [self.data[position:place].decode(self._encoding, errors="replace"), f"\\{self.data[place]:03o}"]
            position = place + 1
        text = "".join([*parts, self.data[position:end].decode(self._encoding, errors="replace")])
        return text.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n")

    def pieces(self, start: int, end: int, elements: Iterable[ccode.Located]) -> Iterator[Piece]:
        """Cut a range at the line ends after its elements, so that each piece belongs to certain elements.

        Args:
            start, end: the range.
            elements: elements in it that must be in separate pieces, in any order.
        """
        position = start
        waiting: list[ccode.Located] = []
        begun = [(at, element) for element in elements if start <= (at := int(element.startOffset)) < end]
        begun.sort(key=lambda pair: pair[0])
        followed = [at for at, _ in begun[1:]]
        for index, (at, element) in enumerate(begun):
            waiting.append(element)
            cut = min(self.line_end(max(element.endOffset - 1, at)), end)
            if index < len(followed) and followed[index] < cut:
                continue
            yield self._piece(position, cut, waiting)
            position, waiting = cut, []
        if position < end:
            yield self._piece(position, end, waiting)

    def _piece(self, start: int, end: int, elements: list[ccode.Located]) -> Piece:
        text, applied = self.slice(start, end)
        return Piece(text, start, end, tuple(elements), applied)


_UNICODE = frozenset({"utf-8", "UTF-8", "UTF-16"})
"""Encodings of a unit whose bytes are those of UTF-8 here."""


def _bytes_of_literals(data: bytes) -> list[int]:
    """The places of bytes beyond ASCII in strings and characters: the program sends these bytes, so they become escapes.

    A copy in UTF-8 would have two bytes for each. Those of comments and names are letters.
    """
    found: list[int] = []
    pending = [(0, token) for token in tokens(data)]
    for shift, (kind, start, end, text) in pending:
        if kind == "directive" and not shift:
            rest = data[start + 1 : end]
            if not re.match(rb"\s*(?:include|error|warning|pragma)\b", rest):
                pending += [(start + 1, token) for token in tokens(rest)]
        elif kind in ("string", "char") and not text.isascii():
            found += [place for place in range(shift + start, shift + end) if data[place] > 0x7F]
    return sorted(found)


def _placed(changes: Iterable[migration.TextChange]) -> list[tuple[int, int, str, migration.TextChange]]:
    """Each change as (start, end, replacement, change)."""
    return [(change.startOffset, change.endOffset, change.replacement, change) for change in changes]


_LABEL = re.compile(r"\s*(?!default\b)[A-Za-z_]\w*\s*:(?!:)")


def reindent(texts: Sequence[str], continued: bool = False) -> list[str]:
    """Replace the common indentation of texts that are put together by two blanks.

    Directives and continuation lines (after a backslash) are left as they are, since blanks in them may matter. Labels are
    indented less than what they label, so they do not count for the common indentation.

    Args:
        texts: the texts in their order.
        continued: whether the first one continues a line before it, which ends in a backslash.
    """
    shown = [list(_lines(text, continued and not number)) for number, text in enumerate(texts)]
    lines = [line.expandtabs(4) for text in shown for line, kept in text if line.strip() and not kept]
    counted = [line for line in lines if not _LABEL.match(line)] or lines
    common = min((len(line) - len(line.lstrip(" ")) for line in counted), default=0)
    return ["".join(line if kept else _reindented(line, common) for line, kept in text) for text in shown]


_LINES = re.compile(r"[^\n]*\n|[^\n]+")  # a form feed ends no line of C, nor does what else Python's splitlines knows


def _lines(text: str, continued: bool = False) -> Iterator[tuple[str, bool]]:
    """The lines of a text, each with whether it has to stay as it is; `continued` if the first one continues a line."""
    directive = False
    for line in _LINES.findall(text):
        if not continued:
            directive = line.lstrip().startswith("#")
        yield line, directive or continued
        continued = line.rstrip("\r\n").endswith("\\")


def _reindented(line: str, common: int) -> str:
    if not line.strip():
        return line.lstrip(" \t")
    rest = line.lstrip(" \t")
    spread = line[: len(line) - len(rest)].expandtabs(4)  # a tab further on may stand in a text
    return "  " + spread[common:] + rest


_WORD = re.compile(rb"[A-Za-z_]\w*")


def words_of(texts: Iterable[bytes]) -> set[str]:
    """All that looks like a name in texts of a program, comments, strings and suffixes of numbers too."""
    return {word.decode("ascii", errors="replace") for text in texts for word in _WORD.findall(text)}
