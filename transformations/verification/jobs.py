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
from robosmi.errors import PlatformDataError, UsageError
from robosmi.metamodels import platform
from robosmi.project import read_data
from robosmi.verify.simulation import DeviceUse, Job

_DATA = "simulation/avr.toml"
_ANALOG = re.compile(r"A(\d+)")
_PORT = re.compile(r"P([A-Z]\d)")


@cache
def _facts() -> tuple[Path, Mapping[str, Any]]:
    path = resources.find("platform_repo", _DATA)
    return path, read_data(path)


def shows_console(mcu: str) -> bool:
    """Whether simulators of a microcontroller show what a program prints."""
    return bool(_facts()[1].get(mcu, {}).get("console", True))


def job(
    elf: Path, hex_file: Path, board: platform.Board, horizon_us: float, devices: Sequence[DeviceUse] = (),
    brief: Sequence[str] = (),
) -> Job:  # fmt: skip
    """The job of running a program on a board.

    Args:
        elf, hex_file: the program, in both formats.
        board: the board.
        horizon_us: how long to simulate, in microseconds.
        devices: the devices that are connected.
        brief: the pins of which only the first change to each level is wanted.

    Raises:
        UsageError: the board's microcontroller is not described.
        PlatformDataError: its description lacks a key.
    """
    mcu = board.microcontroller.name if board.microcontroller is not None else ""
    path, known = _facts()
    if mcu not in known:
        raise UsageError(f"no simulator data for the microcontroller '{mcu}'", fix=f"use one of: {', '.join(sorted(known))}")
    try:
        channels, timers = known[mcu]["analog"], known[mcu]["timers"]
    except KeyError as error:
        raise PlatformDataError(f"'{mcu}' in {path} lacks {error}", fix="add it") from None
    pins = {pin.label: found[1] for pin in board.pins if (found := _PORT.fullmatch(pin.port))}
    numbers = {label: int(found[1]) for label in pins if (found := _ANALOG.fullmatch(label))}
    analog = {label: channels[number] for label, number in numbers.items() if number < len(channels)}
    supply = round(board.volts * 1000)
    return Job(
        str(elf), str(hex_file), mcu, board.clockHertz, supply, pins, analog, timers, horizon_us, tuple(devices), tuple(brief)
    )
