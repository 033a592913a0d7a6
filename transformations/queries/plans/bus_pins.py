"""Which pins the buses of a sketch take on its own board and on the other one: no text names them, and their wires move, too."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from msgspec import Struct

from robosmi.metamodels import ccode, migration, platform
from robosmi.query import all_of_kind
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.queries.plans.retained_pins import retains_platform

USB = "USB"
"""What stands for the pins of a serial port that is the board's USB."""


class BusPin(Struct, frozen=True):
    """A signal of a bus.

    Attributes:
        bus: the object by which programs use it.
        signal: such as `SDA`.
        old: label of its pin on the source board, or `USB`.
        new: the same on the target; empty where the board has no such bus, or it is not known.
    """

    bus: str
    signal: str
    old: str
    new: str


def bus_pins(plan: migration.MigrationPlan) -> list[BusPin]:
    """The pins of the buses that a program uses whose platform stays; none for any other."""
    if not retains_platform(plan) or plan.source is None or plan.program is None or plan.board is None:
        return []
    old = next((each.board for each in plan.source.boardMappings if each.board is not None), None)
    if old is None:
        return []
    units = list(plan.program.units)
    headers = {str(include.header) for unit in units for include in unit.includes}
    names = {str(each.name) for unit in units for each in all_of_kind(unit, ccode.NameReference)}
    settings = ApiIndex.load(str(plan.source.name)).settings.get("ports", {})
    here, there = (taken_by_buses(board, settings, headers, names) for board in (old, plan.board))
    return [BusPin(bus, signal, label, there.get((bus, signal), "")) for (bus, signal), label in here.items() if label != USB]


def has_usb_console(board: platform.Board, settings: Mapping[str, Any]) -> bool:
    """Whether the console of a platform's programs takes no pins of a board: it is USB, or the programmer's line.

    Args:
        board: the board.
        settings: what the platform knows of pins; without serial ports, nothing is known.
    """
    serials = list(settings.get("serials", ()))[:1]
    return USB in taken_by_buses(board, settings, (), serials).values()


def taken_by_buses(
    board: platform.Board, settings: Mapping[str, Any], headers: Collection[str], names: Collection[str]
) -> dict[tuple[str, str], str]:
    """Bus and signal -> label of the pin on a board, for the buses of a program.

    Args:
        board: the board.
        settings: what the platform knows of pins.
        headers: the headers that the program includes.
        names: the names that it uses.
    """
    labels = {str(name): str(pin.label) for pin in board.pins for name in (pin.label, *pin.aliases)}
    found = {
        (str(bus), str(signal)): labels[signal]
        for header, (bus, *signals) in settings.get("buses", {}).items()
        if header in headers
        for signal in signals
        if signal in labels
    }
    own = settings.get("serial_ports", {}).get(str(board.name), {})
    # where USB takes the pins RX and TX they are those of Serial, else Serial is USB, and they are those of Serial1
    bridged = any(str(pin.label) == labels.get("RX") and pin.reserved for pin in board.pins)
    for port in sorted(name for name in names if name in settings.get("serials", ())):
        number = port.removeprefix("Serial")
        pins = own.get(port) or [labels.get(f"{way}{number}", "") for way in ("RX", "TX")]
        if not number:
            pins = [labels["RX"], labels["TX"]] if bridged else [USB, USB]
        elif number == "1" and not any(pins) and not bridged:
            pins = [labels.get("RX", ""), labels.get("TX", "")]
        found |= {(port, way): label for way, label in zip(("RX", "TX"), pins, strict=True) if label}
    return found
