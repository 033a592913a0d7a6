"""Target boards: `arduino/boards/<name>.toml` of the platform repository as `platform.Board`, and which board a part is.

Also the normalisation of the labels that drawings give to a board's connectors ("D9 PWM", "~9" and "IO9" are D9), for boards
that have no entry. The toolchain's keys of the same files are read elsewhere; this module looks at pins and at how the board
is drawn.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from robosmi import inputs
from robosmi.data_text import toml_of
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, UsageError, did_you_mean
from robosmi.metamodels import platform
from robosmi.resources import folders

PIN_TABLE = "pin table"
"""The "drawing tool" of pin tables, in which a board is called by its short name and its connectors by their labels."""


@dataclass(frozen=True, slots=True)
class DrawnBoard:
    """How a board is drawn: its short name, its title, and the pin label of each connector that is a pin."""

    name: str
    title: str
    pins: Mapping[str, str]


def board_names(project: Path | None = None) -> list[str]:
    """The short names of all boards, sorted."""
    return sorted({path.stem for path in _files(project)})


def load_board(name: str, project: Path | None = None) -> platform.Board:
    """A new model of a board with its pins, in the order of their numbers.

    Args:
        name: short name (`uno`).
        project: the project folder; the current folder if None.

    Raises:
        UsageError: no board has that name.
        PlatformDataError: the entry is damaged.
    """
    for path in _files(project):
        if path.stem == name:
            return _board(_table(str(path), path.stat().st_mtime_ns), str(path))
    known = board_names(project)
    raise UsageError(f"no board is called '{name}'{did_you_mean(name, known)}", fix=f"use one of: {', '.join(known)}")


def drawn_board(part_id: str, tool: str, project: Path | None = None) -> DrawnBoard | None:
    """The board that a part of a drawing tool's catalogue stands for, or None.

    Args:
        part_id: identity of the part (for Fritzing the module id).
        tool: the drawing tool, lower case.
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: an entry is damaged.
    """
    for path in _files(project):
        changed = path.stat().st_mtime_ns
        if tool == PIN_TABLE:
            if path.stem == part_id:
                table = _table(str(path), changed)
                labels = [pin["label"] for pin in table.get("pins", ())]
                return DrawnBoard(path.stem, table.get("title", path.stem), {label: label for label in labels})
            continue
        if f'"{part_id}"' not in _text(str(path), changed):  # parsing is a hundred times as long
            continue
        table = _table(str(path), changed)
        for drawn in table.get("drawn_as", ()):
            if drawn.get("tool") == tool and part_id in drawn.get("modules", ()):
                pins = {connector: label for label, connectors in drawn.get("connectors", {}).items() for connector in connectors}
                return DrawnBoard(path.stem, table.get("title", path.stem), pins)
    return None


def pin_literal(label: str) -> str:
    """How an Arduino program writes the pin of that label: `9` for D9, else the label itself (`A0`)."""
    return label[1:] if re.fullmatch(r"D\d+", label) else label


_NOT_PINS = re.compile(
    r"(?i)(icsp.*|isp\d*|jtag.*|jp\d.*|boot\d*|id_s[cd]"
    r"|[+]?\d+(\.\d+)?v\d*|[+]?5 v|3v|[+]?\d+v\d|v?3[.]3( v)?|\d\.\d|v(in|cc|dd|bus|bat|batt|ss|usb|[+-])\d*|v|batt?|raw|ext_vdd"
    r"|usb_?(vin|vcc)|usb ?[+-]|usb[-_ ]?(dp|dm)|av(cc|dd)|[adp]?gnd.*|g|ground|[+-]"
    r"|aref.*|io[ _]?ref|.*reset.*\d*|n?rst\d*|run|en|chip_en|global_en|n/?c|n\.c\.?|nc\d*|reserved|unused|no name yet)"
)
_DIGITAL = re.compile(r"(?i)(?:io|d|~|pin)?~?(\d{1,2})(?:[(~].*|rx\d*|tx\d*|pwm)?")
_ANALOG = re.compile(r"(?i)(?:a|ad|adc|analog)(\d{1,2})(?:[(].*)?")
_BEFORE = re.compile(r"(?i)pin|digital|analog|io|pwm|reset wt11|~")
_GPIO = re.compile(r"(?i)g(?:pio|ipo)[ _]?(\d{1,3})")
_SILK = re.compile(r"(?i)(?:([ad]) ?)(\d{1,2})(?=$|[ /_(~]|[rt]x|pwm)(?![ _]?gnd)|(\d{1,2})(?=$|/)")
_SERIAL = {"rx-i": "D0", "rxi": "D0", "rx": "D0", "tx-o": "D1", "txo": "D1", "tx": "D1"}


def normalised_label(name: str, arduino: bool = True) -> str:
    """The pin label that a connector's name stands for, or an empty text if it is no signal.

    Args:
        name: the name in the drawing ("D10 PWM/SS", "AD4/SDA", "~9").
        arduino: whether RX and TX are D0 and D1; otherwise what is printed on the board is taken as it is, but for numbered
            pins (`A0/D14` is A0, `GPIO 17` is GPIO17).
    """
    text = " ".join(name.split())
    if not text or _NOT_PINS.fullmatch(text):
        return ""
    if not arduino:
        if gpio := _GPIO.fullmatch(text):
            return f"GPIO{int(gpio[1])}"
        silk = _SILK.match(text)
        return f"{(silk[1] or 'D').upper()}{silk[2] or silk[3]}" if silk else text
    for word in re.split(r"[ /_]", text):
        if digital := _DIGITAL.fullmatch(word):
            return f"D{int(digital[1])}"
        if analog := _ANALOG.fullmatch(word):
            return f"A{int(analog[1])}"
        if not _BEFORE.fullmatch(word) and word.upper() not in _BUS_WORDS:
            break
    return _SERIAL.get(text.lower(), "")


_BUS_WORDS = frozenset({"RX", "TX", "SDA", "SCL", "MOSI", "MISO", "SCK", "SS", "INT", "LED"})


def _files(project: Path | None) -> Iterator[Path]:
    for folder in folders("platform_repo", project):
        for platform_folder in sorted(entry.path for entry in os.scandir(folder) if entry.is_dir()):
            if os.path.isdir(place := f"{platform_folder}/boards"):
                yield from _listed(place, os.stat(place).st_mtime_ns)


@cache
def _listed(folder: str, changed: int) -> tuple[Path, ...]:  # `changed` keys the cache: a file more or less is noticed
    return tuple(sorted(Path(folder).glob("*.toml")))


def _board(table: Mapping[str, Any], path: str) -> platform.Board:
    try:
        pins = [
            platform.Pin(
                label=pin["label"],
                literal=pin.get("literal") or pin_literal(pin["label"]),
                aliases=list(pin.get("aliases", ())),
                abilities=list(pin.get("abilities", ())),
                timer=pin.get("timer", ""),
                reserved=pin.get("reserved", ""),
            )
            for pin in table["pins"]
        ]
        return platform.Board(
            name=table["name"],
            title=table.get("title", table["name"]),
            fqbn=table.get("fqbn", ""),
            mcu=table.get("mcu", ""),
            flashBytes=table.get("flash_bytes", 0),
            ramBytes=table.get("ram_bytes", 0),
            volts=float(table.get("volts", 0.0)),
            pins=pins,
        )
    except (KeyError, TypeError, ValueError) as error:
        raise PlatformDataError(
            f"the board is damaged: {error!r}", location=Location(path), fix="compare it with another board"
        ) from error


@cache
def _text(path: str, changed: int) -> str:
    try:
        return inputs.read_text(path, inputs.SETTINGS)
    except (OSError, UnicodeDecodeError) as error:
        raise PlatformDataError(f"cannot be read: {error}", location=Location(path), fix="mend or remove the file") from error


@cache
def _table(path: str, changed: int) -> dict[str, Any]:
    try:
        return toml_of(_text(path, changed))
    except ValueError as error:
        raise PlatformDataError(f"not valid TOML: {error}", location=Location(path), fix="mend the file") from error
