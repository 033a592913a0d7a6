"""A Wokwi `diagram.json` as records: its parts and connections with their lines, and entries that are neither.

The format is that of https://docs.wokwi.com/diagram-format. The two outer layers of the JSON are scanned here, so that each
part and each connection has its line; each of them is parsed by Python's json. `reader` decides what parts are and which of
their pins exist. A file that is no diagram is refused with a `SourceError`.
"""

from __future__ import annotations

import hashlib
import json
import re
from bisect import bisect_right
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from msgspec import Struct

from robosmi.base.data_text import Json, json_at
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, TooLargeError
from robosmi.transformations.t2m.drawing_file import drawing_bytes

MOST_PARTS = 20_000
"""Parts, and connections, of a diagram; the largest public one has under a thousand."""

_FIX = "open the project in Wokwi and copy its diagram.json again"
_TELLING = re.compile(r'"(?:parts|connections)"\s*:\s*\[')
_EDITOR = re.compile(r'"editor"\s*:\s*"wokwi"|"type"\s*:\s*"(?:wokwi|board|chip)-|"\$serialMonitor:')
_SPACE = re.compile(r"[ \t\r\n]*")


class _Entry(NamedTuple):
    """An entry of a list, with its place in the text."""

    value: Json
    place: int


class DiagramPart(Struct, frozen=True):
    """A part: its id, its type (`wokwi-led`), its attributes as texts, its line in the file."""

    identity: str
    kind: str
    attributes: dict[str, str]
    line: int


class Connection(Struct, frozen=True):
    """A connection: its number, the two ends as they are written (`uno:13`), the wire's colour, its line in the file."""

    number: int
    ends: tuple[str, str]
    color: str
    line: int


class Diagram:
    """What a file held.

    Attributes:
        path: as given.
        digest: SHA-256 of the file's bytes, hexadecimal.
        version: of the format, as text.
        parts: in the file's order; ids may stand twice.
        connections: in the file's order.
        left_out: cause and line of each entry that is no part or no connection.
    """

    def __init__(self, path: str, digest: str) -> None:
        self.path = path
        self.digest = digest
        self.version = ""
        self.parts: list[DiagramPart] = []
        self.connections: list[Connection] = []
        self.left_out: list[tuple[str, int]] = []


def recognises(head: bytes) -> bool:
    """Whether a file that begins so is a Wokwi diagram: an object with parts or connections, and a word of Wokwi's in it.

    Args:
        head: the first bytes of the file.
    """
    text = head.decode("utf-8-sig", "replace").lstrip()
    return text.startswith("{") and _TELLING.search(text) is not None and _EDITOR.search(text) is not None


def read_diagram(path: Path) -> Diagram:
    """The records of a `diagram.json`.

    Raises:
        SourceError: the file is missing, not readable, no JSON, no diagram, or has too many parts.
    """
    data = drawing_bytes(path, "diagram", "the diagram.json in it", _FIX)
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise SourceError(f"it is not UTF-8: {error.reason}", location=Location(str(path)), fix="save it as UTF-8") from error
    return _Reading(path, text).diagram(hashlib.sha256(data).hexdigest())


class _Reading:
    """Scans one text from its beginning."""

    def __init__(self, path: Path, text: str) -> None:
        self.path = path
        self.text = text
        self.breaks = [found.start() for found in re.finditer("\n", text)]

    def diagram(self, digest: str) -> Diagram:
        made = Diagram(str(self.path), digest)
        seen: dict[str, int] = {}
        for key, value, entries, start in self._members():
            if key in seen and key in ("parts", "connections"):
                raise self._error(
                    f"'{key}' occurs twice, in lines {seen[key]} and {self._line(start)}", start, "keep one of them"
                )
            seen[key] = self._line(start)
            if key == "version":
                made.version = _text(value)
            elif key == "parts":
                self._parts(made, self._listed(key, entries, start))
            elif key == "connections":
                self._connections(made, self._listed(key, entries, start))
        if "parts" not in seen:
            raise self._error("it is not a Wokwi diagram: it has no list of parts", 0, _FIX)
        return made

    def _parts(self, made: Diagram, entries: list[_Entry]) -> None:
        for number, (entry, place) in enumerate(entries, 1):
            line = self._line(place)
            if not isinstance(entry, dict):
                made.left_out.append((f"entry {number} of the parts is not a part", line))
                continue
            identity, kind = _text(entry.get("id")), _text(entry.get("type"))
            if not kind:
                made.left_out.append((f"the part '{identity or number}' has no type", line))
                continue
            attributes = entry.get("attrs")
            listed = attributes.items() if isinstance(attributes, dict) else ()
            made.parts.append(DiagramPart(identity, kind, {_text(key): _text(value) for key, value in listed}, line))

    def _connections(self, made: Diagram, entries: list[_Entry]) -> None:
        for number, (entry, place) in enumerate(entries, 1):
            line = self._line(place)
            if not (
                isinstance(entry, list)
                and len(entry) > 1
                and isinstance(one := entry[0], str)
                and isinstance(other := entry[1], str)
            ):
                made.left_out.append((f"entry {number} of the connections is not a connection", line))
                continue
            third = entry[2] if len(entry) > 2 else ""
            color = _text(third) if isinstance(third, str) else ""
            made.connections.append(Connection(number, (_text(one), _text(other)), color, line))

    # ---- JSON

    def _members(self) -> Iterator[tuple[str, Json, list[_Entry] | None, int]]:
        """Key, value, entries and the value's place of each member of the outermost object; entries of the two lists alone."""
        place = self._expect("{", self._skip(0))
        if self._at("}", place):
            return
        while True:
            key, place = self._value(place)
            if not isinstance(key, str):
                raise self._error("the name of a member is not a text", place, _FIX)
            start = self._skip(self._expect(":", place))
            if key in ("parts", "connections") and self._at("[", start):
                items, end = self._items(start)
                yield key, None, items, start
            else:
                value, end = self._value(start)
                yield key, value, None, start
            end = self._skip(end)
            if self._at("}", end):
                self._end(end + 1)
                return
            place = self._expect(",", end)

    def _items(self, start: int) -> tuple[list[_Entry], int]:
        """The items of a list with their places, and the offset after the list."""
        items: list[_Entry] = []
        place = self._skip(start + 1)
        if self._at("]", place):
            return items, place + 1
        while True:
            value, end = self._value(place)
            items.append(_Entry(value, place))
            if len(items) > MOST_PARTS:
                cause = f"it has more than {MOST_PARTS:,} parts or connections"
                raise TooLargeError(cause, location=self._location(place), fix="check that it is the diagram you meant")
            end = self._skip(end)
            if self._at("]", end):
                return items, end + 1
            place = self._skip(self._expect(",", end))

    def _listed(self, key: str, entries: list[_Entry] | None, start: int) -> list[_Entry]:
        if entries is None:
            raise self._error(f"'{key}' is not a list", start, _FIX)
        return entries

    def _value(self, place: int) -> tuple[Json, int]:
        place = self._skip(place)
        try:
            return json_at(self.text, place)
        except json.JSONDecodeError as error:
            raise self._error(f"not valid JSON: {error.msg}", min(error.pos, len(self.text)), _FIX) from error
        except ValueError as error:
            raise self._error(f"not valid JSON: {error}", place, _FIX) from error

    def _skip(self, place: int) -> int:
        found = _SPACE.match(self.text, place)
        return found.end() if found is not None else place

    def _at(self, letter: str, place: int) -> bool:
        return self.text.startswith(letter, self._skip(place))

    def _expect(self, letter: str, place: int) -> int:
        place = self._skip(place)
        if not self.text.startswith(letter, place):
            found = f"'{self.text[place]}'" if place < len(self.text) else "the end of the file"
            raise self._error(f"not valid JSON: '{letter}' is expected, but there is {found}", place, _FIX)
        return self._skip(place + 1)

    def _end(self, place: int) -> None:
        if self.text[place:].strip():
            raise self._error("not valid JSON: there is text after its end", self._skip(place), _FIX)

    def _line(self, place: int) -> int:
        return bisect_right(self.breaks, place - 1) + 1

    def _error(self, cause: str, place: int, fix: str) -> SourceError:
        return SourceError(cause, location=self._location(place), fix=fix)

    def _location(self, place: int) -> Location:
        line = self._line(place)
        column = place - (self.breaks[line - 2] if line > 1 else -1)
        return Location(str(self.path), line, column)


def _text(value: object) -> str:
    """A text or number as text; empty for all else.

    An unpaired surrogate, which JSON can express (`\\ud800`) and no file can contain, becomes the replacement character.
    """
    if isinstance(value, bool):
        return str(value).lower()
    text = str(value) if isinstance(value, str | int | float) else ""
    try:
        text.encode()
    except UnicodeEncodeError:
        return text.encode("utf-16", "surrogatepass").decode("utf-16", "replace")
    return text
