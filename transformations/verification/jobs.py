"""From a compiled program and a board to a job for an engine: the port behind each pin, and the microcontroller's timers.

The board is an element of `platform.ecore`; what else simulators have to know is in `platform_repo/simulation`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from robosmi import resources
from robosmi.base.data_tables import DataTable
from robosmi.errors import PlatformDataError, UsageError
from robosmi.metamodels import platform
from robosmi.project import read_data
from robosmi.transformations.knowledge.board_models import check_keys
from robosmi.verify.simulation import DeviceUse, Job

_DATA = ("simulation/avr.toml", "simulation/rp2040.toml", "simulation/api.toml")
_JUDGED, _API = ("api", "port_pattern", "timers"), ("flags", "usb_console")
"""The keys of a microcontroller in `api.toml`, and those of its table `api`."""
_ANALOG = re.compile(r"A(\d+)")
_PORT = r"P([A-Z]\d)"
"""A port, and what engines call it; data may say otherwise (`ports`)."""


def _facts() -> Mapping[str, tuple[Path, Mapping[str, Any]]]:
    """Microcontroller -> the file that describes it, and what it says; of several files a user's counts."""
    places = [*resources.folders("platform_repo")][::-1]
    return _read(tuple(path for place in places for name in _DATA if (path := place / name).is_file()))


@cache
def _read(paths: tuple[Path, ...]) -> Mapping[str, tuple[Path, Mapping[str, Any]]]:
    tables = [DataTable(path, read_data(path)) for path in paths]
    for table in tables:
        if table.path.name == "api.toml":
            for mcu in table.values:
                _check_judged(table.table(mcu))
    return {mcu: (table.path, table.table(mcu).values) for table in tables for mcu in table.values}


def _check_judged(table: DataTable) -> None:
    """Refuse an unknown key of a microcontroller in `api.toml`, and name all keys that are missing.

    Raises:
        PlatformDataError: there are such keys.
    """
    api = table.table("api", needed=False)
    check_keys(table, _JUDGED)
    check_keys(api, _API)
    missing = [key for key in _JUDGED if key not in table.values] + [f"api.{key}" for key in _API if key not in api.values]
    if missing:
        raise table.error(
            missing[0], f"is missing, in all: {', '.join(missing)}", "add them: docs/how-to/add-a-board.md has an example"
        )


def shows_console(mcu: str) -> bool:
    """Whether simulators of a microcontroller show what a program prints."""
    return mcu not in _facts() or bool(_facts()[mcu][1].get("console", True))


def store_bytes(mcu: str) -> int:
    """The size of a microcontroller's own EEPROM; 0 if it has none that simulators show."""
    return int(_facts()[mcu][1].get("eeprom_bytes", 0)) if mcu in _facts() else 0


def api_facts(mcu: str) -> DataTable | None:
    """What the model of the Arduino API has to know of a microcontroller; None if its programs are not judged there."""
    if mcu not in _facts():
        return None
    path, values = _facts()[mcu]
    return DataTable(path, values).table("api") if "api" in values else None


def pins_and_inputs(board: platform.Board, pattern: str = ".+") -> tuple[list[platform.Pin], list[platform.Pin]]:
    """The pins of a board whose ports match, and those of them that measure voltages; engines number them in this order."""
    pins = [pin for pin in board.pins if re.fullmatch(pattern, str(pin.port))]
    return pins, [pin for pin in pins if "analog_in" in pin.abilities]


def job(
    elf: Path, hex_file: Path | None, board: platform.Board, horizon_us: float, devices: Sequence[DeviceUse] = (),
    brief: Sequence[str] = (),
) -> Job:  # fmt: skip
    """The job of running a program on a board.

    Args:
        elf, hex_file: the program, in both formats; None where the board's core makes no Intel HEX.
        board: the board.
        horizon_us: how long to simulate, in microseconds.
        devices: the devices that are connected.
        brief: the pins of which only the first change to each level is wanted.

    Raises:
        UsageError: the board's microcontroller is not described.
        PlatformDataError: its description lacks a key.
    """
    mcu = board.microcontroller.name if board.microcontroller is not None else ""
    known = _facts()
    if mcu not in known:
        raise UsageError(f"no simulator data for the microcontroller '{mcu}'", fix=f"use one of: {', '.join(sorted(known))}")
    path, facts = known[mcu]
    try:
        timers = facts["timers"]
        channels = facts["analog"] if "api" not in facts else ()
    except KeyError as error:
        raise PlatformDataError(f"'{mcu}' in {path} lacks {error}", fix="add it") from None
    pattern = re.compile(str(facts.get("port_pattern", _PORT)))
    pins = {str(pin.label): found[1] for pin in board.pins if (found := pattern.fullmatch(str(pin.port)))}
    numbers = {str(pin.label): number for pin in board.pins if pin.label in pins and (number := _input(pin)) is not None}
    analog = {label: channels[number] for label, number in numbers.items() if number < len(channels)}
    if "api" in facts:
        analog = {str(pin.label): number for number, pin in enumerate(pins_and_inputs(board)[1])}
    supply = round(board.volts * 1000)
    return Job(
        str(elf),
        str(hex_file or elf),
        mcu,
        board.clockHertz,
        supply,
        pins,
        analog,
        timers,
        horizon_us,
        tuple(devices),
        tuple(brief),
        store_bytes=store_bytes(mcu),
    )


def _input(pin: platform.Pin) -> int | None:
    """The number of the analogue input that a pin is, or None."""
    if "analog_in" not in pin.abilities:
        return None
    return next((int(found[1]) for name in (pin.label, *pin.aliases) if (found := _ANALOG.fullmatch(str(name)))), None)
