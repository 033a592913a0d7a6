"""Checks that the ports which a board's file gives its pins exist on its microcontroller (key `ports` of that file)."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from robosmi.data_text import line_of_value
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError
from robosmi.metamodels import platform
from robosmi.verify.tables import DataTable


def check_ports(pins: Iterable[platform.Pin], text: str, board: DataTable, chip: DataTable) -> None:
    """Refuse a port that the microcontroller has not; where its file says nothing of ports, none is looked at.

    Args:
        pins: those of the board.
        text: the text of the board's file, for the line.
        board: the table of that file.
        chip: the table of the microcontroller's file, whose `ports` is a regular expression for the name of a port.

    Raises:
        PlatformDataError: a pin has such a port, or the expression is none.
    """
    if "ports" not in chip.values:
        return
    known = chip.pattern("ports")
    for pin in pins:
        if pin.port and known.fullmatch(str(pin.port)) is None:
            raise PlatformDataError(
                f"the port of '{pin.label}' is '{pin.port}', which is no pin of the microcontroller '{chip.path.stem}'",
                location=Location(str(board.path), line_of_value(text, str(pin.port))),
                fix=f"write a port that it has ({re.sub(r'[|]', ', ', known.pattern)}), or name the microcontroller of the board",
            )


def check_names(pins: Sequence[platform.Pin], board: DataTable) -> None:
    """Refuse a label, port or output of a timer that two pins have, and an alias that is another pin's name.

    Args:
        pins: of the board.
        board: the board's file.

    Raises:
        PlatformDataError: two pins have the same.
    """
    labels, ports = [str(pin.label) for pin in pins], [str(pin.port) for pin in pins if pin.port]
    for values in (labels, ports, [f"{pin.timer} channel {pin.channel}" for pin in pins if pin.timer]):
        if twice := {value for value in values if values.count(value) > 1}:
            raise board.error("pins", f"has {', '.join(sorted(twice))} twice")
    for pin in pins:
        others = [other for other in pins if other is not pin]
        for alias in pin.aliases:
            if (other := next((each for each in others if alias in (each.label, *each.aliases)), None)) is not None:
                raise board.error("pins", f"gives '{pin.label}' the alias '{alias}', which is a name of '{other.label}'")
