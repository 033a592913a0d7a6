"""The text of a template while it is rendered: how EGL prints values, and which elements each piece comes from.

EGL's `[%= %]` indents the further lines of a value to the column of its first line and drops trailing empty lines; so does `{{
}}` here. Jinja yields a text in pieces; `Dynamic` and `Chop` are pieces with additional meaning. The elements that a template
accesses between two pieces are the sources of the second one.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from robosmi.query.values import as_string

if TYPE_CHECKING:
    from robosmi.query.values import Answer


class Dynamic(str):
    """A value of several lines, which is indented where it is printed."""

    __slots__ = ()

    def __str__(self) -> str:  # Jinja calls str() on every value; the class must outlive that
        return self


class Raw(str):
    """A value that is printed as it is."""

    __slots__ = ()

    def __str__(self) -> str:
        return self


class Chop(str):
    """An empty text among the pieces of an output: when the pieces are joined, `taken` characters are removed from the end of
    what was printed before it (EGL's `out.chop`)."""

    __slots__ = ("taken",)
    taken: int

    def __str__(self) -> str:
        return self


def chop(count: int) -> Chop:
    """A piece that takes the last characters away (EGL `out.chop(n)`)."""
    piece = Chop("")
    piece.taken = count
    return piece


def printed(value: Answer) -> Any:
    """A value as `{{ }}` prints it: as EOL writes it, nothing for None; a text of several lines is marked as such.

    >>> printed(None), printed(True), printed(1.0)
    ('', 'true', '1.0')
    """
    if value.__class__ is not str:
        if isinstance(value, str):
            return value
        value = as_string(value)
    return Dynamic(value) if "\n" in value else value


def indented(text: str, line: str) -> str:
    """A value of several lines as it stands behind the beginning of a line.

    Args:
        text: the value; empty lines at its end are dropped.
        line: what stands on the line before it; its blanks are repeated, other characters become blanks.

    >>> indented("a\\nb\\n", "\\tx ")
    'a\\n\\t  b'
    """
    margin = "".join(c if c.isspace() else " " for c in line)
    return text.rstrip("\n").replace("\n", "\n" + margin)


class Buffer:
    """Pieces of a text, joined as EGL's output buffer joins them.

    Attributes:
        parts: what was printed, in pieces.
    """

    __slots__ = ("parts",)

    def __init__(self) -> None:
        self.parts: list[str] = []

    def special(self, piece: str) -> str:
        """What a piece that is no plain text prints here."""
        if isinstance(piece, Dynamic):
            return indented(piece, self.last_line())
        if isinstance(piece, Chop):
            self._chop(piece.taken)
        return str.__str__(piece)

    def last_line(self) -> str:
        """The text after the last line break."""
        found: list[str] = []
        for part in reversed(self.parts):
            _, line_break, after = part.rpartition("\n")
            found.append(after)
            if line_break:
                break
        return "".join(reversed(found))

    def line(self) -> int:
        """The number of the last line, from 1 (EGL `out.getCurrentLineNumber()`)."""
        return 1 + sum(part.count("\n") for part in self.parts)

    def _chop(self, count: int) -> None:
        for place in range(len(self.parts) - 1, -1, -1):
            length = len(self.parts[place])
            self.parts[place] = self.parts[place][: max(length - count, 0)]
            count -= length
            if count <= 0:
                break


def joined(pieces: Iterable[str]) -> str:
    """The text of the pieces of a macro or block (Jinja's `concat`)."""
    found = list(pieces)
    if all(piece.__class__ is str for piece in found):
        return "".join(found)
    buffer = Buffer()
    for piece in found:
        buffer.parts.append(piece if piece.__class__ is str else buffer.special(piece))
    return "".join(buffer.parts)


def outdented(text: str, indenters: Iterable[str] = ("\t", "    ")) -> str:
    """The text with one level less on each line that has one (EGL `-%]`)."""
    levels = tuple(indenters)
    lines = text.split("\n")
    return "\n".join(next((line[len(level) :] for level in levels if line.startswith(level)), line) for line in lines)


class TextPart(Struct, frozen=True):
    """A part of a template that states the sources of its lines (`out.part`).

    Attributes:
        piece: the number of pieces of the text before it.
        name: its name.
        elements: the elements that its lines come from.
        step: step of a method, or "".
    """

    piece: int
    name: str
    elements: tuple[Any, ...]
    step: str


class Text(str):
    """A generated text that knows the elements it comes from; otherwise an ordinary text.

    Attributes:
        regions: the ids of its regions, in order.
        named: the parts that its template named, in order; each reaches to the next.
    """

    __slots__ = ("_marks", "_parts", "_seen", "named", "regions")
    _parts: list[str]
    _seen: list[Any]
    _marks: list[int]
    regions: list[str]
    named: list[TextPart]

    @property
    def lines_of_parts(self) -> list[tuple[int, int, TextPart]]:
        """First and last line (from 0) of each named part that has text."""
        found: list[tuple[int, int, TextPart]] = []
        line = sum(piece.count("\n") for piece in self._parts[: self.named[0].piece]) if self.named else 0
        stops = [part.piece for part in self.named[1:]] + [len(self._parts)]
        for part, stop in zip(self.named, stops, strict=True):
            text = "".join(self._parts[part.piece : stop])
            if text:
                found.append((line, line + text.count("\n", 0, len(text) - 1), part))
            line += text.count("\n")
        return found

    @property
    def sources(self) -> list[tuple[int, int, tuple[Any, ...]]]:
        """The sources of the text, in order: (offset of the first character, offset after the last one, elements)."""
        found: list[tuple[int, int, tuple[Any, ...]]] = []
        offset = part = first = 0
        for place, last in zip(self._marks[::2], self._marks[1::2], strict=True):
            offset += sum(len(text) for text in self._parts[part:place])
            elements = {id(element): element for element in self._seen[first:last]}
            found.append((offset, offset + len(self._parts[place]), tuple(elements.values())))
            part, first = place, last
        return found


def text_of(
    text: str,
    parts: list[str] | None = None,
    seen: list[Any] | None = None,
    marks: list[int] | None = None,
    regions: list[str] | None = None,
    named: list[TextPart] | None = None,
) -> Text:
    """A `Text`.

    Args:
        text: the text.
        parts: its pieces.
        seen: the elements that were looked at while it was made.
        marks: in pairs, the index of a piece, and how many of these elements had been looked at when it was made.
        regions: the ids of its regions.
        named: the parts that its template named.
    """
    made = Text(text)
    made._parts, made._seen, made._marks, made.regions = parts or [], seen or [], marks or [], regions or []
    made.named = named or []
    return made
