"""From a compiled program and a board to a job for an engine: which port is behind each pin, and the microcontroller's timers.

What simulators need to know of microcontrollers is data: `platform_repo/simulation`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from robosmi import resources
from robosmi.errors import PlatformDataError, UsageError
from robosmi.project import read_data
from robosmi.verify.simulation import DeviceUse, Job

_DATA = "simulation/avr.toml"
_ANALOG = re.compile(r"A(\d+)")


@cache
def _facts() -> tuple[Path, Mapping[str, Any]]:
    path = resources.find("platform_repo", _DATA)
    return path, read_data(path)


def simulated_microcontrollers() -> list[str]:
    """The microcontrollers that engines are told enough about."""
    return sorted(_facts()[1])


def job(
    elf: Path,
    hex_file: Path,
    mcu: str,
    clock_hz: int,
    pins: Mapping[str, int],
    horizon_us: float,
    devices: Sequence[DeviceUse] = (),
    supply_volts: float = 5.0,
) -> Job:
    """The job of running a program on a board.

    Args:
        elf, hex_file: the program, in both forms.
        mcu: the board's microcontroller.
        clock_hz: its clock.
        pins: label of each pin -> the number that programs give it.
        horizon_us: how long to run.
        devices: what is connected.
        supply_volts: the board's supply.

    Raises:
        UsageError: nothing is known of the microcontroller.
        PlatformDataError: what is known of it is damaged.
    """
    path, known = _facts()
    if mcu not in known:
        raise UsageError(
            f"no simulator is told enough about the microcontroller '{mcu}'", fix=f"use one of: {', '.join(sorted(known))}"
        )
    try:
        ports, channels, timers = (known[mcu][key] for key in ("ports", "analog", "timers"))
    except KeyError as error:
        raise PlatformDataError(f"'{mcu}' in {path} lacks {error}", fix="add it") from None
    places = {label: ports[number] for label, number in pins.items() if number < len(ports)}
    numbers = {label: int(found[1]) for label in pins if (found := _ANALOG.fullmatch(label))}
    analog = {label: channels[number] for label, number in numbers.items() if number < len(channels)}
    return Job(
        str(elf), str(hex_file), mcu, clock_hz, round(supply_volts * 1000), places, analog, timers, horizon_us, tuple(devices)
    )
