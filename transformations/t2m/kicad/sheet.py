"""One sheet of a KiCad schematic as records, whatever its file format: wires, labels, symbols, sheets below it.

Positions are integers in the format's own finest step, so that equal positions compare equal. `nets` decides what is one net.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from msgspec import Struct

from robosmi.transformations.t2m.drawing import free_identity

MOST_SYMBOLS = 50_000
"""Symbols of a drawing; the largest public schematic has a few thousand."""

_NO_NUMBER = ("", "~")
"""How files write the number of a pin without a number."""

LOCAL, GLOBAL, UPWARD = "local", "global", "upward"
"""Kinds of labels: of the sheet, of the whole drawing, and hierarchical ones, joined with a pin of the sheet's symbol above."""


class Point(NamedTuple):
    """A position on a sheet."""

    x: int
    y: int


class Wire(NamedTuple):
    """A straight wire between two positions."""

    start: Point
    end: Point


class LibraryPin(Struct, frozen=True):
    """A pin of a symbol: number, name, electrical type, place, unit and body style that it is of (0: all), whether hidden."""

    number: str
    name: str
    kind: str
    at: Point
    unit: int = 0
    style: int = 0
    hidden: bool = False


class LibrarySymbol(Struct, frozen=True):
    """A symbol of a library: id with the library's name, whether it only names a net (`local`: of its sheet), pins."""

    identity: str
    power: bool = False
    description: str = ""
    keywords: str = ""
    pins: tuple[LibraryPin, ...] = ()
    local: bool = False

    def connectors(self, style: int) -> list[tuple[str, LibraryPin]]:
        """The pins of a body style, each with the identity of its connector.

        That is its number, which pins of several units may share. Each pin without a number is a connector by itself, called by
        its name, with a counter if several have that name.
        """
        shown = [pin for pin in self.pins if pin.style in (0, style)]
        taken = {pin.number for pin in shown}
        found: list[tuple[str, LibraryPin]] = []
        for pin in shown:
            identity = pin.number
            if identity in _NO_NUMBER:
                identity = free_identity(pin.name or "pin", 0, taken)
                taken.add(identity)
            found.append((identity, pin))
        return found


class SheetSymbol(Struct, frozen=True):
    """A symbol on a sheet.

    Attributes:
        uuid: KiCad's own id.
        identity: id of its library symbol, with the library's name.
        library: the key of that symbol among those in the file.
        at: its position.
        matrix: maps positions in the symbol to positions relative to `at`: x' = a x + b y, y' = c x + d y.
        unit: which unit of the part it is.
        style: which body style.
        properties: `Reference`, `Value` and others.
        references: path of sheets -> reference there.
        units: path of sheets -> unit there.
        line: in its file.
    """

    uuid: str
    identity: str
    library: str
    at: Point
    matrix: tuple[int, int, int, int]
    unit: int
    style: int
    properties: Mapping[str, str]
    references: Mapping[str, str]
    units: Mapping[str, int]
    line: int


class Label(Struct, frozen=True):
    """A label: its scope, text and position."""

    kind: str
    text: str
    at: Point


class SubSheet(Struct, frozen=True):
    """A sheet symbol, which represents a sheet below: its id, name, file, pins as labels, line."""

    uuid: str
    name: str
    file: str
    pins: tuple[Label, ...]
    line: int


class Sheet:
    """What a file of one sheet held.

    Attributes:
        file: its name for messages.
        uuid: of the sheet's file.
        version: of the file's form, as text.
        by_value: whether a symbol of a supply names its net by its value and not by its pin.
        buses: the lines of buses.
        entries: where wires go into a bus: the ends of each.
        aliases: names for several members of buses.
        instances: path with the symbol's id -> reference and unit, of files that keep them together.
    """

    def __init__(self, file: str, version: str = "", by_value: bool = True) -> None:
        self.file = file
        self.uuid = ""
        self.version = version
        self.by_value = by_value
        self.wires: list[Wire] = []
        self.junctions: list[Point] = []
        self.buses: list[Wire] = []
        self.entries: list[Wire] = []
        self.aliases: dict[str, list[str]] = {}
        self.labels: list[Label] = []
        self.symbols: list[SheetSymbol] = []
        self.sheets: list[SubSheet] = []
        self.library: dict[str, LibrarySymbol] = {}
        self.instances: dict[str, tuple[str, int]] = {}


_ESCAPED = {
    "{slash}": "/", "{backslash}": "\\", "{lt}": "<", "{gt}": ">", "{colon}": ":", "{dblquote}": '"', "{space}": " ",
    "{brace}": "{",
}  # fmt: skip
"""KiCad's escape sequences for characters in names that are special in its lists."""


def net_name(text: str) -> str:
    """The name of a net or a label as the user has written it: without the sheets that a netlist puts before it.

    >>> net_name("/Motors/PWM{slash}A"), net_name("Net-(A1-SDA/A4)")
    ('PWM/A', 'Net-(A1-SDA/A4)')
    """
    name = text.rpartition("/")[2] if text.startswith("/") else text
    for written, letter in _ESCAPED.items():
        name = name.replace(written, letter)
    return name


def of_library(family: str, name: str) -> tuple[str, str]:
    """Library and name of a symbol as it was called before KiCad rescued it into a library of the project.

    >>> of_library("robot-rescue", "R-Device"), of_library("", "R-RESCUE-robot"), of_library("Device", "R")
    (('Device', 'R'), ('', 'R'), ('Device', 'R'))
    """
    short, rescued, _ = name.partition("-RESCUE-")
    if rescued:
        return ("", short) if family.lower().endswith("-rescue") else (family, short)
    if family.lower().endswith("-rescue") and "-" in name:
        short, _, library = name.rpartition("-")
        return library, short
    return family, name


def placed_at(symbol: SheetSymbol, pin: LibraryPin) -> Point:
    """The position of a symbol's pin on the sheet."""
    a, b, c, d = symbol.matrix
    return Point(symbol.at.x + a * pin.at.x + b * pin.at.y, symbol.at.y + c * pin.at.x + d * pin.at.y)
