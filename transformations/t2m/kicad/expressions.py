"""KiCad's s-expressions: the lists of a file with their lines.

The two outer layers are scanned here, so that each list has its line and what is not needed is not parsed; each requested list
is parsed by `sexpdata`. Nesting is bounded before that. The readers of each format interpret the lists.
"""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections.abc import Iterator
from itertools import islice
from typing import Protocol, TypeAlias, TypeGuard

import sexpdata
from msgspec import Struct

from robosmi.diagnostics import Location
from robosmi.errors import SourceError


class Named(Protocol):
    """A name, which stands without quotes (`sexpdata.Symbol`)."""

    def value(self) -> str:
        """The name as text."""
        ...


SExpression: TypeAlias = "Listed | Named | str | int | float | bool | None"
"""A list, a name, a text or a number."""

Listed: TypeAlias = "list[SExpression]"
"""A list with what is in it."""

MOST_LEVELS = 100
"""Lists inside lists; KiCad writes about a dozen."""

MOST_LISTS = 5_000_000
"""Lists of one file; the largest public schematic has under 200,000."""

_FARTHEST = 1e9
"""Greatest coordinate in millimetres; no sheet is that wide."""

FIX = "open it in KiCad and save it again"
_LOOKS = frozenset(("effects", "stroke", "fill", "polyline", "rectangle", "circle", "arc", "bezier", "text", "justify"))
"""Lists that only describe appearance; they are most of a file, and are not parsed."""

_TOKEN = re.compile(r'"(?:[^"\\]|\\.)*+"|[()]|"', re.DOTALL)
_LISP = re.compile(r"[\[\]'\\]")
"""Characters that are special in Lisp, and so to `sexpdata`, but not in KiCad: other brackets, other quotes."""
_NAME = re.compile(r'"(?:[^"\\]|\\.)*+"|(?<![^\s()"])[^\s()"\[\]\'\\]*+[\[\]\'\\][^\s()"]*+', re.DOTALL)
"""Matches a quoted text, or an unquoted name that contains such characters."""
_HEAD = re.compile(r'\(\s*("(?:[^"\\]|\\.)*+"|[^\s()"]*)', re.DOTALL)


class Expression(Struct, frozen=True):
    """A list of the text: its first word, its start and end."""

    head: str
    start: int
    end: int


class Expressions:
    """The text of a file, which is one list.

    Args:
        text: the text.
        path: the file, for messages.

    Raises:
        SourceError: brackets or quotes do not close, or lists are too deep or too many.
    """

    def __init__(self, text: str, path: str) -> None:
        self.text, self.path = text, path
        self.breaks = [found.start() for found in re.finditer("\n", text)]
        self._members: dict[int, list[Expression]] = {}
        self._looks: list[tuple[int, int]] = []
        self.root = self._gone_through()

    def _gone_through(self) -> Expression:
        text = self.text
        open_lists: list[int] = []
        root: Expression | None = None
        count = 0
        for found in _TOKEN.finditer(text):
            token = found[0]
            if token == "(":
                if root is not None:
                    raise self.error("there is text after its end", found.start())
                open_lists.append(found.start())
                count += 1
                if len(open_lists) > MOST_LEVELS or count > MOST_LISTS:
                    most = f"{MOST_LEVELS} lists inside lists" if len(open_lists) > MOST_LEVELS else f"{MOST_LISTS:,} lists"
                    raise self.error(f"it has more than {most}", found.start())
            elif token == ")":
                if not open_lists:
                    raise self.error("a ')' has no '('", found.start())
                start = open_lists.pop()
                listed = Expression(self._head(start), start, found.end())
                if listed.head in _LOOKS and len(open_lists) > 1:
                    while self._looks and self._looks[-1][0] > start:
                        self._looks.pop()
                    self._looks.append((start, found.end()))
                elif open_lists:
                    if len(open_lists) <= 3:
                        self._members.setdefault(open_lists[-1], []).append(listed)
                else:
                    root = listed
            elif token == '"':
                raise self.error("a text in quotes has no end", found.start())
        if open_lists:
            raise self.error("the file ends before its lists do: a ')' is missing for this '('", open_lists[-1])
        if root is None:
            raise self.error("it has no list in brackets", 0)
        return root

    def members(self, listed: Expression) -> Iterator[Expression]:
        """The lists directly within a list of the two outer layers, in the file's order."""
        return iter(self._members.get(listed.start, ()))

    def parsed(self, listed: Expression) -> Listed:
        """Parse a list to Python lists, names, texts and numbers.

        Raises:
            SourceError: it is damaged.
        """
        try:
            found = sexpdata.loads(self._without_looks(listed), nil="", true="", line_comment="\0")
        except (ValueError, AssertionError, AttributeError, sexpdata.ExpectClosingBracket, sexpdata.ExpectNothing) as error:
            raise self.error(f"it cannot be read: {error}", listed.start) from error
        if not isinstance(found, list):
            raise self.error("it is not a list", listed.start)
        return found

    def _without_looks(self, listed: Expression) -> str:
        """The text of a list without the lists that only describe appearance."""
        pieces, place = [], listed.start
        first = bisect_left(self._looks, (listed.start, 0))
        for start, end in islice(self._looks, first, None):
            if start >= listed.end:
                break
            pieces.append(self.text[place:start])
            place = end
        text = "".join((*pieces, self.text[place : listed.end]))
        return _NAME.sub(_quoted, text) if _LISP.search(text) is not None else text

    def line(self, place: int) -> int:
        """The line of an offset."""
        return bisect_right(self.breaks, place - 1) + 1

    def error(self, cause: str, place: int) -> SourceError:
        """The error for a fault at an offset."""
        return SourceError(f"not a valid file of KiCad: {cause}", location=Location(self.path, self.line(place)), fix=FIX)

    def _head(self, start: int) -> str:
        found = _HEAD.match(self.text, start)
        return found[1].strip('"') if found is not None else ""


def _quoted(found: re.Match[str]) -> str:
    """A name in quotes, so that special characters lose their meaning; a quoted text unchanged."""
    return found[0] if found[0].startswith('"') else '"' + found[0].replace("\\", "\\\\") + '"'


def word(value: SExpression) -> str:
    """The text of a name, a text or a number; empty for a list."""
    if isinstance(value, sexpdata.Symbol):
        return str(value.value())
    if isinstance(value, bool) or value is None or isinstance(value, list):
        return ""
    return str(value)


def head(value: SExpression) -> str:
    """The first word of a list; empty for anything else."""
    return word(value[0]) if isinstance(value, list) and value else ""


def is_listed(value: SExpression, name: str) -> TypeGuard[Listed]:
    """Whether a value is a list whose first word is `name`."""
    return head(value) == name and isinstance(value, list)


def child(found: Listed, name: str) -> Listed | None:
    """The first list within `found` whose first word is `name`."""
    return next((entry for entry in found if is_listed(entry, name)), None)


def children(found: Listed, name: str) -> Iterator[Listed]:
    """The lists within `found` whose first word is `name`."""
    return (entry for entry in found if is_listed(entry, name))


def text_of(found: Listed, name: str) -> str:
    """The second word of the first list within `found` whose first word is `name`; empty if there is none."""
    entry = child(found, name)
    return word(entry[1]) if entry is not None and len(entry) > 1 else ""


def numbers(found: Listed, name: str, count: int) -> tuple[float, ...]:
    """The numbers in the first list within `found` whose first word is `name`; missing ones after the first two are zero.

    Raises:
        ValueError: the list is missing or contains anything else: a misread position would join wires.
    """
    values = (child(found, name) or [name])[1 : count + 1]
    if len(values) < min(2, count):
        raise ValueError(f"'{name}' is followed by {len(values)} of 2 numbers")
    return tuple([*(coordinate(value) for value in values), *[0.0] * count][:count])


def coordinate(value: SExpression) -> float:
    """A coordinate in a drawing.

    Raises:
        ValueError: it is no number, or greater than any sheet.
    """
    if isinstance(value, bool) or not isinstance(value, int | float) or not abs(value) < _FARTHEST:
        raise ValueError(f"'{value if isinstance(value, int | float) else word(value)}' is not a coordinate")
    return float(value)
