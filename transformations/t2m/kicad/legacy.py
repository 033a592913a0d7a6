"""An EESchema `.sch` (KiCad 5 and before) as a `Sheet`: a text of lines, a fixed number for each kind of entry.

The file contains no symbols: these are in libraries beside it (`-cache.lib`, `.lib`; `library_of`). Coordinates are in
thousandths of an inch.
"""

from __future__ import annotations

import re
import shlex
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path

from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.transformations.t2m.companions import DrawingFolder
from robosmi.transformations.t2m.kicad.expressions import FIX
from robosmi.transformations.t2m.kicad.sheet import (
    GLOBAL,
    LOCAL,
    UPWARD,
    Label,
    LibraryPin,
    LibrarySymbol,
    Point,
    Sheet,
    SheetSymbol,
    SubSheet,
    Wire,
)

HEAD = "EESchema Schematic File Version"
_LABELS = {"Label": LOCAL, "GLabel": GLOBAL, "HLabel": UPWARD}
_LINES: dict[str, Callable[[Sheet], list[Wire]]] = {
    "Wire Wire Line": lambda sheet: sheet.wires,
    "Wire Bus Line": lambda sheet: sheet.buses,
    "Entry Bus Bus": lambda sheet: sheet.buses,
    "Entry Wire Line": lambda sheet: sheet.entries,
}
_FIELD = re.compile(r'F ?([0-9]{1,9}) "((?:[^"\\]|\\.)*)"')
_SHEET_PIN = re.compile(r'F ?([0-9]{1,9}) "((?:[^"\\]|\\.)*)" [IOBTU] [RLTB] (-?[0-9]{1,9}) (-?[0-9]{1,9})')
_REFERENCE = re.compile(r'AR Path="([^"]*)" Ref="([^"]*)"(?:\s+Part="([0-9]{1,9})")?')
_NAMED = {"0": "Reference", "1": "Value", "2": "Footprint", "3": "Datasheet"}
_NUMBER = re.compile(r"-?[0-9]{1,9}")
_UPRIGHT = (1, 0, 0, 1)

_HEAD = "EESchema-LIBRARY"
_KINDS = {"W": "power_in", "w": "power_out"}


def read_legacy(text: str, path: str) -> Sheet:
    """The records of an EESchema `.sch`.

    Raises:
        SourceError: it is damaged, or cut off.
    """
    return _Legacy(text, path).sheet


class _Legacy:
    """Reads one file."""

    def __init__(self, text: str, path: str) -> None:
        self.path = path
        self.lines = text.splitlines()
        if not self.lines or not self.lines[0].startswith(HEAD):
            raise SourceError("it is not an EESchema schematic", location=Location(path, 1), fix="give the .sch file")
        self.sheet = Sheet(path, version=self.lines[0].removeprefix(HEAD).strip(), by_value=False)
        self.place = 1
        while self.place < len(self.lines):
            line = self.lines[self.place]
            if line.startswith("$EndSCHEMATC"):
                return
            self._entry(line)
            self.place += 1
        raise self._error("the file ends before its '$EndSCHEMATC'", len(self.lines))

    def _entry(self, line: str) -> None:
        words = line.split()
        lines = _LINES.get(" ".join(words[:3]))
        if line.startswith("$Comp"):
            self._symbol([*self._block("$EndComp")])
        elif line.startswith("$Sheet"):
            self._sheet([*self._block("$EndSheet")])
        elif lines is not None:
            x1, y1, x2, y2 = self._numbers(self._next(), 4)
            lines(self.sheet).append(Wire(Point(x1, y1), Point(x2, y2)))
        elif words[:1] == ["Connection"]:
            x, y = self._numbers(" ".join(words[2:]), 2)
            self.sheet.junctions.append(Point(x, y))
        elif words[:1] == ["Text"] and len(words) > 3:
            x, y = self._numbers(" ".join(words[2:4]), 2)
            text = self._next().strip()
            if words[1] in _LABELS:
                self.sheet.labels.append(Label(_LABELS[words[1]], text, Point(x, y)))

    def _next(self) -> str:
        self.place += 1
        if self.place >= len(self.lines):
            raise self._error("the file ends within an entry", len(self.lines))
        return self.lines[self.place]

    def _block(self, end: str) -> Iterator[tuple[int, str]]:
        start = self.place
        while not (line := self._next()).startswith(end):
            if line.startswith(("$Comp", "$Sheet", "$EndSCHEMATC")):
                raise self._error(f"an entry has no '{end}'", start + 1)
            yield self.place + 1, line

    def _symbol(self, lines: list[tuple[int, str]]) -> None:
        identity, stamp, unit, style, at, matrix = "", "", 1, 1, Point(0, 0), _UPRIGHT
        properties: dict[str, str] = {}
        references: dict[str, str] = {}
        units: dict[str, int] = {}
        first = lines[0][0] if lines else self.place
        for number, line in lines:
            words = line.split()
            if line.startswith("L ") and len(words) > 1:
                identity = words[1]
                properties["Reference"] = words[2] if len(words) > 2 else ""
            elif line.startswith("U ") and len(words) > 2:
                (unit, style), stamp = self._numbers(line[2:], 2, number), words[3] if len(words) > 3 else ""
            elif line.startswith("P "):
                at = Point(*self._numbers(line[2:], 2, number))
            elif (found := _REFERENCE.match(line)) is not None:
                path = found[1].rpartition("/")[0]
                references[path], units[path] = found[2], int(found[3] or unit)
            elif (found := _FIELD.match(line)) is not None:
                named = _NAMED.get(found[1]) or (shlex_last(line) if int(found[1]) > 3 else found[1])
                properties[named] = found[2].replace('\\"', '"')
            elif line[:1] in "\t " and len(words) == 4:
                x1, y1, x2, y2 = self._numbers(line, 4, number)
                matrix = (x1, -y1, x2, -y2)
        if not identity:
            raise self._error("a symbol has no line with its name", first)
        reference = properties.get("Reference", "")
        properties["Reference"] = reference
        self.sheet.symbols.append(
            SheetSymbol(stamp, identity, identity, at, matrix, unit, style, properties, references, units, first)
        )  # fmt: skip

    def _sheet(self, lines: list[tuple[int, str]]) -> None:
        stamp, name, file, pins = "", "", "", []
        for _, line in lines:
            if line.startswith("U "):
                stamp = line[2:].strip()
            elif (pin := _SHEET_PIN.match(line)) is not None and int(pin[1]) > 1:
                pins.append(Label(UPWARD, pin[2], Point(int(pin[3]), int(pin[4]))))
            elif (found := _FIELD.match(line)) is not None:
                name, file = (found[2], file) if found[1] == "0" else (name, found[2]) if found[1] == "1" else (name, file)
        self.sheet.sheets.append(SubSheet(stamp, name, file, tuple(pins), lines[0][0] if lines else self.place))

    def _numbers(self, text: str, count: int, line: int = 0) -> tuple[int, ...]:
        words = text.split()[:count]
        if len(words) < count or not all(_NUMBER.fullmatch(word) for word in words):
            raise self._error(f"expected {count} numbers, found '{text.strip()[:40]}'", line or self.place + 1)
        return tuple(int(word) for word in words)

    def _error(self, cause: str, line: int) -> SourceError:
        return SourceError(f"not a valid EESchema file: {cause}", location=Location(self.path, line), fix=FIX)


def shlex_last(line: str) -> str:
    """The last quoted text of a line, which names a field that the user added."""
    try:
        return shlex.split(line)[-1]
    except ValueError:
        return "field"


def library_of(folder: DrawingFolder, identities: Iterable[str]) -> dict[str, LibrarySymbol]:
    """The library symbols that a schematic uses, by the names that it uses for them.

    KiCad's own cache (`NAME-cache.lib`) is read first, then what was rescued (`NAME-rescue.lib`), then libraries of the names
    that stand before the symbols' (`LIBRARY.lib`), each where it lies beside the schematic.

    Args:
        folder: the folder of the schematic.
        identities: what the schematic calls its symbols.
    """
    wanted = list(dict.fromkeys(identities))
    stem = folder.path.stem
    others = list(dict.fromkeys(f"{identity.partition(':')[0]}.lib" for identity in wanted if ":" in identity))
    caches = list(dict.fromkeys((f"{stem}-cache.lib", *_caches(folder.path.parent), f"{stem}-rescue.lib", f"{stem}.lib")))
    found: dict[str, LibrarySymbol] = {}
    for name in (*caches, *others):
        missing = [identity for identity in wanted if identity not in found]
        data = folder.read(name) if missing else None
        if data is not None:
            listed = _parsed(data.decode("utf-8", "replace"))
            found.update({i: symbol for i in missing if (symbol := _named(listed, i)) is not None})
    return found


def _caches(folder: Path) -> list[str]:
    """Caches of other schematics in the folder: the symbols of a sub-sheet are in the cache of the top schematic."""
    try:
        return sorted(path.name for path in folder.glob("*-cache.lib"))
    except OSError:
        return []


def _parsed(text: str) -> dict[str, LibrarySymbol]:
    """The symbols of a library, by name and by alias; other entries are skipped."""
    found: dict[str, LibrarySymbol] = {}
    if not text.startswith(_HEAD):
        return found
    name, power = "", False
    aliases: list[str] = []
    pins: list[LibraryPin] = []
    for line in text.splitlines():
        words = line.split()
        if words[:1] == ["DEF"] and len(words) > 1:
            name, power, aliases, pins = words[1].lstrip("~"), len(words) > 9 and words[9] == "P", [], []
        elif words[:1] == ["ALIAS"]:
            aliases = words[1:]
        elif words[:1] == ["X"] and (pin := _pin(words)) is not None:
            pins.append(pin)
        elif words[:1] == ["ENDDEF"] and name:
            for one in (name, *aliases):
                found[one] = LibrarySymbol(one, power, pins=tuple(pins))
            name = ""
    return found


def _pin(words: list[str]) -> LibraryPin | None:
    """X name number x y length orientation size size unit style kind [shape]."""
    if len(words) < 12:
        return None
    try:
        x, y, unit, style = (int(words[index]) for index in (3, 4, 9, 10))
    except ValueError:
        return None
    hidden = len(words) > 12 and words[12].startswith("N")
    name = "" if words[1] == "~" else words[1]
    return LibraryPin(words[2], name, _KINDS.get(words[11], "other"), Point(x, -y), unit, style, hidden)


def _named(listed: Mapping[str, LibrarySymbol], identity: str) -> LibrarySymbol | None:
    short = identity.partition(":")[2] or identity
    return next((listed[name] for name in (identity.replace(":", "_"), identity, short) if name in listed), None)
