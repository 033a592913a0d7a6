"""Bare microcontrollers in drawings: which board a chip stands for, its pins told by the names of their ports (PB5 is D13).

A board's file says under `drawn_chips` which chips it stands for and how many pins they have; its pins bear their ports. A chip
of another kind is no board of ours. Boards that are drawn as boards are the business of `drawn_boards`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path

from msgspec import Struct

from robosmi.base.data_tables import DataTable
from robosmi.transformations.knowledge.board_models import drawing_files, only_draws, table_of, text_of
from robosmi.transformations.knowledge.drawn_boards import DrawnBoard

_PORT = re.compile(r"(?<![A-Z0-9])(P[A-L][0-7]|ADC[67])(?![0-9])", re.IGNORECASE)
_CHIP = re.compile(r"(?<![A-Z])(?:AT)?((?:MEGA|TINY)[0-9]+[A-Z0-9]*)", re.IGNORECASE)
_PACKAGE = re.compile(r"(?:TQFP|QFN|QFP|MLF|PDIP|DIP|SOIC|SMD|SMT)[0-9]*$")
_REMARK = re.compile(r"\([^()]*\)")


class DrawnChip(Struct, frozen=True):
    """A bare microcontroller as a board.

    Attributes:
        board: the board whose pins it has.
        chip: its name, as it was found in the drawing.
        clock: the clock that programs for the board expect, in hertz; what the drawing says may differ.
    """

    board: DrawnBoard
    chip: str
    clock: int


def chip_named(texts: Iterable[str]) -> str:
    """The name of the microcontroller that texts have (`ATMEGA328P`; `MEGA8` is `ATMEGA8`); the first text that has one decides.

    Args:
        texts: what the drawing says of a part, what counts most first: its value goes before its symbol.
    """
    found = next((found[1].upper() for text in texts if (found := _CHIP.search(text)) is not None), "")
    return f"AT{_PACKAGE.sub('', found)}" if found else ""


def drawn_chip(texts: Iterable[str], connectors: Mapping[str, str], project: Path | None = None) -> DrawnChip | None:
    """The board that a bare microcontroller stands for, or None: it is none that a board stands for.

    Args:
        texts: what the drawing says of the part, what counts most first: its value goes before its symbol.
        connectors: connector -> its name, with that of its port somewhere in it (`PB5`, `(PCINT5/SCK)PB5`).
        project: the project folder, whose own data goes first; the current folder if None.

    Raises:
        PlatformDataError: an entry is damaged.
    """
    chip = chip_named(texts)
    if not chip:
        return None
    for path in drawing_files(project):
        if "drawn_chips" not in text_of(path) or only_draws(path):
            continue
        table = table_of(path)
        for entry in table.tables("drawn_chips", needed=False):
            least, most = entry.number("least_pins"), entry.number("most_pins")
            if chip in (named.upper() for named in entry.texts("chips")) and least <= len(connectors) <= most:
                board = DrawnBoard(path.stem, table.text("title", path.stem), _pins(table, connectors))
                return DrawnChip(board, chip, table.number("f_cpu"))
    return None


def port_of(name: str) -> str:
    """The port that the name of a microcontroller's pin has in it (`PB5`), or an empty text.

    What stands in brackets counts only where no port is outside of them: in `(PD0/MISO)PB3`, PD0 is a line of the programmer.
    """
    found = _PORT.search(_REMARK.sub(" ", name)) or _PORT.search(name)
    return found[1].upper() if found is not None else ""


def _pins(table: DataTable, connectors: Mapping[str, str]) -> dict[str, str]:
    labels = {pin.text("port", ""): pin.text("label") for pin in table.tables("pins")}
    found = ((connector, labels.get(port_of(name), "")) for connector, name in connectors.items())
    return {connector: label for connector, label in found if label}
