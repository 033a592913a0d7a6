"""Small KiCad schematics for tests: symbols, wires and labels as text."""

from __future__ import annotations

from pathlib import Path

UNO = [*(f"D{n}" for n in range(14)), "A0", "A1", "GND"]
TWO = ["1", "2"]


def symbol(name: str, pins: list[str], power: str = "", kind: str = "passive") -> str:
    """A symbol of a library: pins one below the other, ten millimetres apart."""
    listed = "".join(f'(pin {kind} line (at 0 {-10 * n} 0) (name "{p}") (number "{n + 1}"))' for n, p in enumerate(pins))
    return f'(symbol "{name}" {power} (symbol "{name.partition(":")[2]}_1_1" {listed}))'


def placed(kind: str, reference: str, x: int, y: int, value: str = "", unit: int = 1, more: str = "") -> str:
    """A symbol on a sheet; its first pin is at its place."""
    known = f'(property "Reference" "{reference}") (property "Value" "{value or kind.partition(":")[2]}")'
    return f'(symbol (lib_id "{kind}") (at {x} {y} 0) {more} (unit {unit}) (uuid "{reference}-{x}-{y}") {known})'


def wire(x1: int, y1: int, x2: int, y2: int) -> str:
    """A wire."""
    return f"(wire (pts (xy {x1} {y1}) (xy {x2} {y2})))"


def bus(x1: int, y1: int, x2: int, y2: int) -> str:
    """A line of a bus."""
    return f"(bus (pts (xy {x1} {y1}) (xy {x2} {y2})))"


def entry(x: int, y: int) -> str:
    """Where a wire that begins two millimetres to the right and below goes into a bus at a place."""
    return f"(bus_entry (at {x} {y}) (size 2 2))"


def label(text: str, x: int, y: int, kind: str = "label") -> str:
    """A label."""
    return f'({kind} "{text}" (at {x} {y} 0))'


def below(name: str, file: str, *pins: tuple[str, int, int]) -> str:
    """A sheet's symbol."""
    listed = " ".join(f'(pin "{pin}" input (at {x} {y} 0))' for pin, x, y in pins)
    return f'(sheet (at 0 0) (uuid "{name}-id") (property "Sheetname" "{name}") (property "Sheetfile" "{file}") {listed})'


LIBRARY = [
    symbol("MCU_Module:Arduino_UNO_R3", UNO), symbol("Device:LED", TWO), symbol("Connector:Conn_01x04", ["1", "2", "3", "4"]),
    symbol("power:GND", ["GND"], "(power)", "power_in"), symbol("power:+5V", ["+5V"], "(power)", "power_in"),
]  # fmt: skip


def schematic(path: Path, *entries: str, library: list[str] | None = None) -> Path:
    """A schematic on disk, an entry to a line."""
    lines = [
        f'(kicad_sch (version 20230121) (uuid "{path.stem}")',
        f"(lib_symbols {' '.join(library or LIBRARY)})",
        *entries,
        ")",
    ]
    path.write_text("\n".join(lines) + "\n")
    return path


def uno(reference: str = "A1", x: int = 100, y: int = 0) -> str:
    """An Arduino Uno: D0 at its place, D1 ten millimetres below, ..."""
    return placed("MCU_Module:Arduino_UNO_R3", reference, x, y)


def led(reference: str, x: int, y: int) -> str:
    """A light emitting diode."""
    return placed("Device:LED", reference, x, y)
