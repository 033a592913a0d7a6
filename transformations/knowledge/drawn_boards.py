"""Recognises boards in drawings: which board a catalogue part of a drawing tool is, and what its connector labels mean.

A board's file states this under `drawn_as`; a file of the same name that is found earlier may add another tool. Labels such as
"D9 PWM", "~9" and "IO9" (all D9) are normalised for boards without a file. The boards themselves are read by `board_models`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cache
from pathlib import Path

from msgspec import Struct

from robosmi.base.data_tables import DataTable
from robosmi.errors import did_you_mean
from robosmi.transformations.knowledge.board_models import board_file, check_drawn, drawing_files, only_draws, table_of, text_of

PIN_TABLE = "pin table"
"""The "drawing tool" of pin tables, which name a board by its short name and its connectors by their labels."""


class DrawnBoard(Struct, frozen=True):
    """How a board is drawn: its short name, its title, the pin label of each connector that is a pin, and names.

    `names` has those of further connectors (`GND`, `RUN`), where the tool's names do not say what they carry.
    """

    name: str
    title: str
    pins: Mapping[str, str]
    names: Mapping[str, str] = {}


def drawn_board(part_id: str, tool: str, project: Path | None = None) -> DrawnBoard | None:
    """The board that a part of a drawing tool's catalogue stands for, or None.

    Args:
        part_id: identity of the part (for Fritzing the module id); letter case and blanks do not count.
        tool: the drawing tool, lower case.
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: an entry is damaged.
    """
    if not (wanted := _plain(part_id)):
        return None
    for path in drawing_files(project):
        if tool == PIN_TABLE:
            if path.stem == part_id and not only_draws(path):
                table = table_of(path)
                labels = [pin.text("label") for pin in table.tables("pins")]
                return DrawnBoard(path.stem, table.text("title", path.stem), {label: label for label in labels})
            continue
        if wanted not in _plain(text_of(path)):  # parsing is a hundred times as long
            continue
        table = table_of(path)
        check_drawn(table)
        for drawn in table.tables("drawn_as", needed=False):
            if drawn.text("tool") == tool and wanted in (_plain(each) for each in drawn.texts("modules")):
                board = _with_pins(path, table, project)
                return DrawnBoard(path.stem, board.text("title", path.stem), _connectors(drawn, board), _other_names(drawn))
    return None


@cache
def _plain(text: str) -> str:
    """A name in normal form for comparison, since persons who describe a board copy it by hand."""
    return "".join(text.split()).lower()


def _with_pins(path: Path, table: DataTable, project: Path | None) -> DataTable:
    """The table with the pins of the board that a file describes: its own, or that of the board's main file."""
    if not only_draws(path):
        return table
    if (hardware := board_file(path.stem, project)) is None:
        raise table.error("drawn_as", f"is of the board '{path.stem}', but no other file has this board's pins")
    return table_of(hardware)


def _connectors(drawn: DataTable, board: DataTable) -> dict[str, str]:
    """Connector -> label of its pin."""
    labels = [pin.text("label") for pin in board.tables("pins")]
    table = drawn.table("connectors")
    found: dict[str, str] = {}
    for label in table.values:
        if label not in labels:
            raise table.error(label, f"is not a pin of this board{did_you_mean(label, labels)}")
        for connector in table.texts(label):
            if connector in found:
                raise table.error(label, f"has {connector}, which is already {found[connector]}")
            found[connector] = label
    return found


def _other_names(drawn: DataTable) -> dict[str, str]:
    """Connector -> name of what it is, for connectors that are no pins."""
    table = drawn.table("names", needed=False)
    return {connector: name for name in table.values for connector in table.texts(name)}


_NOT_PINS = re.compile(
    r"(?i)(icsp.*|isp\d*|jtag.*|jp\d.*|boot\d*|id_s[cd]"
    r"|[+]?\d+(\.\d+)?v\d*|[+]?5 v|3v|[+]?\d+v\d|v?3[.]3( v)?|\d\.\d|v(in|cc|dd|bus|bat|batt|ss|usb|[+-])\d*|v|batt?|raw|ext_vdd"
    r"|usb_?(vin|vcc)|usb ?[+-]|usb[-_ ]?(dp|dm)|av(cc|dd)|[adp]?gnd.*|g|ground|[+-]"
    r"|aref.*|io[ _]?ref|.*reset(?s:.*)|n?rst\d*|run|en|chip_en|global_en|n/?c|n\.c\.?|nc\d*|reserved|unused|no name yet)"
)
_DIGITAL = re.compile(r"(?i)(?:io|d|~|pin)?~?(\d{1,2})(?:[(~].*|rx\d*|tx\d*|pwm)?")
_ANALOG = re.compile(r"(?i)(?:a|ad|adc|analog)(\d{1,2})(?:[(].*)?")
_BEFORE = re.compile(r"(?i)pin|digital|analog|io|pwm|reset wt11|~")
_GPIO = re.compile(r"(?i)g(?:pio|ipo)[ _]?(\d{1,3})")
_SILK = re.compile(r"(?i)(?:([ad]) ?)(\d{1,2})(?=$|[ /_(~]|[rt]x|pwm)(?![ _]?gnd)|(\d{1,2})(?=$|/)")
_SERIAL = {"rx-i": "D0", "rxi": "D0", "rx": "D0", "tx-o": "D1", "txo": "D1", "tx": "D1"}


def normalised_label(name: str, numbered: bool = True) -> str:
    """The pin label that a connector's name stands for, or an empty text if it is no signal.

    Args:
        name: the name in the drawing ("D10 PWM/SS", "AD4/SDA", "~9").
        numbered: whether all pins bear numbers, so that RX and TX are D0 and D1; otherwise what is printed on the board is taken
            as it is, but for numbered pins (`A0/D14` is A0, `GPIO 17` is GPIO17).
    """
    text = " ".join(name.split())
    if not text or _NOT_PINS.fullmatch(text):
        return ""
    if not numbered:
        if gpio := _GPIO.fullmatch(text):
            return f"GPIO{int(gpio[1])}"
        silk = _SILK.match(text)
        return f"{(silk[1] or 'D').upper()}{silk[2] or silk[3]}" if silk else text
    analog_first = False
    for word in re.split(r"[ /_]", text):
        if digital := _DIGITAL.fullmatch(word):
            return f"{'A' if analog_first else 'D'}{int(digital[1])}"
        if analog := _ANALOG.fullmatch(word):
            return f"A{int(analog[1])}"
        if not _BEFORE.fullmatch(word) and word.upper() not in _BUS_WORDS:
            break
        analog_first = analog_first or word.lower() == "analog"
    return _SERIAL.get(text.lower(), "")


_BUS_WORDS = frozenset({"RX", "TX", "SDA", "SCL", "MOSI", "MISO", "SCK", "SS", "INT", "LED"})
