"""A `.kicad_sch` (KiCad 6 and on) as a `Sheet`."""

from __future__ import annotations

import re
from collections.abc import Callable

from robosmi.diagnostics import Location
from robosmi.errors import SourceError, TooLargeError
from robosmi.transformations.t2m.kicad.expressions import (
    FIX,
    Expression,
    Expressions,
    Listed,
    SExpression,
    child,
    children,
    coordinate,
    head,
    numbers,
    text_of,
    word,
)
from robosmi.transformations.t2m.kicad.sheet import (
    GLOBAL,
    LOCAL,
    MOST_SYMBOLS,
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

_STEPS = 10_000
"""Steps per millimetre: KiCad stores ten-thousandths."""

_VALUES = 20_220_914
"""The file version from which on a power symbol names its net by its value."""

_UNIT = re.compile(r"_([0-9]{1,9})_([0-9]{1,9})$")
_LABELS = {"label": LOCAL, "global_label": GLOBAL, "hierarchical_label": UPWARD}
_TURNS = {0: (1, 0, 0, 1), 90: (0, 1, -1, 0), 180: (-1, 0, 0, -1), 270: (0, -1, 1, 0)}


def read_modern(text: str, path: str) -> Sheet:
    """The records of a `.kicad_sch`.

    Raises:
        SourceError: it is damaged, or no schematic.
    """
    return _Modern(Expressions(text, path)).sheet


class _Modern:
    """Reads one file."""

    def __init__(self, listed: Expressions) -> None:
        self.listed = listed
        if listed.root.head != "kicad_sch":
            cause = f"it is not a KiCad schematic: it begins with '{listed.root.head}'"
            raise SourceError(cause, location=Location(listed.path, 1), fix="give the .kicad_sch file")
        self.sheet = Sheet(listed.path)
        readers: dict[str, Callable[[Listed, int], None]] = {
            "wire": self._wire, "bus": self._bus, "bus_entry": self._entry, "bus_alias": self._alias,
            "junction": self._junction, "symbol": self._symbol, "sheet": self._sheet,
            "symbol_instances": self._instances, "uuid": self._uuid, "version": self._version,
            **dict.fromkeys(_LABELS, self._label),
        }  # fmt: skip
        entries = [*listed.members(listed.root)]
        if sum(entry.head == "symbol" for entry in entries) > MOST_SYMBOLS:
            fix = "check that it is the drawing you meant"
            raise TooLargeError(f"it has more than {MOST_SYMBOLS:,} symbols", location=Location(listed.path, 1), fix=fix)
        for entry in entries:
            try:
                if entry.head == "lib_symbols":
                    self._library(entry)
                elif (reader := readers.get(entry.head)) is not None:
                    reader(listed.parsed(entry), listed.line(entry.start))
            except ValueError as error:
                place = Location(listed.path, listed.line(entry.start))
                raise SourceError(f"the entry '{entry.head}' is damaged: {error}", location=place, fix=FIX) from None

    def _uuid(self, found: Listed, line: int) -> None:
        self.sheet.uuid = word(found[1]) if len(found) > 1 else ""

    def _version(self, found: Listed, line: int) -> None:
        self.sheet.version = word(found[1]) if len(found) > 1 else ""
        self.sheet.by_value = self.sheet.version.isdigit() and int(self.sheet.version) >= _VALUES

    def _wire(self, found: Listed, line: int) -> None:
        self.sheet.wires += _lines(found)

    def _bus(self, found: Listed, line: int) -> None:
        self.sheet.buses += _lines(found)

    def _entry(self, found: Listed, line: int) -> None:
        (x, y), (width, height) = numbers(found, "at", 2), numbers(found, "size", 2)
        self.sheet.entries.append(Wire(_point(x, y), _point(x + width, y + height)))

    def _alias(self, found: Listed, line: int) -> None:
        if len(found) > 1:
            self.sheet.aliases[word(found[1])] = [word(member) for member in (child(found, "members") or [])[1:]]

    def _junction(self, found: Listed, line: int) -> None:
        self.sheet.junctions.append(_at(found))

    def _label(self, found: Listed, line: int) -> None:
        self.sheet.labels.append(Label(_LABELS[head(found)], word(found[1]) if len(found) > 1 else "", _at(found)))

    def _symbol(self, found: Listed, line: int) -> None:
        identity = text_of(found, "lib_id")
        angle = round(numbers(found, "at", 3)[2]) % 360
        references, units = {}, {}
        for project in children(child(found, "instances") or [], "project"):
            for path in children(project, "path"):
                where = word(path[1]) if len(path) > 1 else ""
                references[where] = text_of(path, "reference")
                units[where] = _whole(text_of(path, "unit"))
        self.sheet.symbols.append(
            SheetSymbol(
                uuid=text_of(found, "uuid"), identity=identity, library=text_of(found, "lib_name") or identity, at=_at(found),
                matrix=_matrix(angle, text_of(found, "mirror")), unit=_whole(text_of(found, "unit")),
                style=_whole(text_of(found, "convert") or text_of(found, "body_style")), properties=_properties(found),
                references=references, units=units, line=line,
            )
        )  # fmt: skip

    def _sheet(self, found: Listed, line: int) -> None:
        named = {key.replace(" ", "").lower(): value for key, value in _properties(found).items()}
        pins = tuple(Label(UPWARD, word(pin[1]), _at(pin)) for pin in children(found, "pin") if len(pin) > 1)
        name, file = named.get("sheetname", ""), named.get("sheetfile", "")
        self.sheet.sheets.append(SubSheet(text_of(found, "uuid"), name, file, pins, line))

    def _instances(self, found: Listed, line: int) -> None:
        for path in children(found, "path"):
            self.sheet.instances[word(path[1])] = (text_of(path, "reference"), _whole(text_of(path, "unit")))

    def _library(self, entry: Expression) -> None:
        raw = {}
        for symbol in self.listed.members(entry):
            if symbol.head == "symbol":
                found = self.listed.parsed(symbol)
                raw[word(found[1]) if len(found) > 1 else ""] = found
        for name, found in raw.items():
            base = raw.get(text_of(found, "extends")) or raw.get(f"{name.partition(':')[0]}:{text_of(found, 'extends')}")
            properties = _properties(found)
            self.sheet.library[name] = LibrarySymbol(
                identity=name,
                power=(power := child(found, "power")) is not None,
                local=power is not None and "local" in (word(each) for each in power[1:]),
                description=properties.get("Description", "") or properties.get("ki_description", ""),
                keywords=properties.get("ki_keywords", ""),
                pins=tuple(_pins(found) or (_pins(base) if base is not None else [])),
            )


def _lines(found: Listed) -> list[Wire]:
    """The line of a wire or bus; empty unless it has two ends."""
    ends = [_point(entry[1], entry[2]) for entry in children(child(found, "pts") or [], "xy") if len(entry) > 2]
    return [Wire(ends[0], ends[1])] if len(ends) == 2 else []


def _pins(found: Listed) -> list[LibraryPin]:
    pins = []
    for part in children(found, "symbol"):
        numbered = _UNIT.search(word(part[1]) if len(part) > 1 else "")
        unit, style = (int(numbered[1]), int(numbered[2])) if numbered is not None else (0, 0)
        for pin in children(part, "pin"):
            hide = child(pin, "hide")
            hidden = any(word(entry) == "hide" for entry in pin) or (hide is not None and word(hide[-1]) != "no")
            name = text_of(pin, "name")
            x, y = numbers(pin, "at", 2)
            pins.append(
                LibraryPin(
                    text_of(pin, "number"), "" if name == "~" else name, word(pin[1]) if len(pin) > 1 else "",
                    _point(x, -y), unit, style, hidden,
                )
            )  # fmt: skip
    return pins


def _matrix(angle: int, mirror: str) -> tuple[int, int, int, int]:
    """The matrix of a rotation (counterclockwise, y grows downwards) followed by a mirroring at an axis."""
    a, b, c, d = _TURNS.get(angle, _TURNS[0])
    if mirror == "x":
        return a, b, -c, -d
    if mirror == "y":
        return -a, -b, c, d
    return a, b, c, d


def _properties(found: Listed) -> dict[str, str]:
    return {word(entry[1]): word(entry[2]) for entry in children(found, "property") if len(entry) > 2}


def _at(found: Listed) -> Point:
    x, y = numbers(found, "at", 2)
    return _point(x, y)


def _point(x: SExpression, y: SExpression) -> Point:
    return Point(round(coordinate(x) * _STEPS), round(coordinate(y) * _STEPS))


def _whole(text: str) -> int:
    return int(text) if text.isdigit() and len(text) < 9 else 1
