"""What files of the platform repository may say; docs/reference/platform-data.md explains it.

These are the keys of `platform.toml` and `mcus/NAME.toml` (those of boards are in `board_models`, which reads them), and checks
of how a board's file calls its core and its pins.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence

from robosmi.base.data_tables import DataTable
from robosmi.errors import did_you_mean
from robosmi.metamodels import platform
from robosmi.transformations.knowledge.api_data import PlatformSettings

_MISSPELT = 0.84
"""A core as similar as that to a known one is a misspelt one; arduboy:avr is not (0.82 to arduino:avr)."""
_MOST_NUMBER = 254
"""Cores have numbers of one byte, whose greatest value is no pin."""

TARGET = (
    "by_board", "any_board", "generator", "toolchain", "structure", "language", "suffix", "module_suffix", "project_file",
    "libraries",
)  # fmt: skip
"""Keys of the table `[target]`."""
OF_TARGETS = (
    "name", "title", "language", "charSigned", "losesLevel", "hasCogs", "intBits", "longBits", "pointerBits", "doubleBits",
    "architecture", "core", "core_name", "include", "pin_functions", "standard_headers", "own_headers", "board_keys",
    "board_architectures", "pin_literals", "target", "widths", "wider_names", "cores", "architectures",
)  # fmt: skip
"""Keys in the `platform.toml` of a target platform."""
OF_ARCHITECTURES = ("losesLevel", "charSigned", "intBits", "longBits", "pointerBits", "doubleBits", "widths", "wider_names")
"""Keys of a table `[architectures.NAME]` of a target platform."""
OF_SOURCES = tuple(PlatformSettings.__annotations__)
"""Keys in the `platform.toml` of a source platform; a platform may be both."""
OF_MICROCONTROLLERS = (
    "name", "title", "architecture", "ports", "flash_bytes", "ram_bytes", "signature", "pin_ma", "total_ma", "timers",
    "buses", "takes", "shared_channels", "pin_volts",
)  # fmt: skip
"""Keys of `mcus/NAME.toml`."""
OF_CORES = ("index_url", "platformio", "platformio_settings", "numbers_by_port")
"""Keys of a table `[cores.NAME]` of a target platform."""
TAKES = ("functions", "libraries", "parts", "timers", "pins", "buses", "when", "ram_bytes")
"""Keys of an entry `[[takes]]` of a microcontroller."""


def check_complete(table: DataTable, lacking: Sequence[str | None]) -> None:
    """Refuse a board's `numbers` (PlatformDataError) in which pins are missing.

    Args:
        table: the mapping.
        lacking: the labels of these pins.
    """
    if lacking:
        raise table.error(
            f"numbers.{lacking[0]}",
            f"is missing: programs would take the number in the label of {', '.join(map(str, lacking))}",
            f"add the number of each pin, such as {lacking[0]} = 0, from pins_arduino.h or variant_NAME.cpp of the variant",
        )


def check_numbers(
    table: DataTable, pins: Iterable[platform.Pin], said: Mapping[str, Mapping[str, int]], by_port: re.Pattern[str] | None
) -> None:
    """Refuse numbers with which programs would use another pin than they name.

    Args:
        table: the mapping.
        pins: those of the board.
        said: its tables `numbers` and `interrupts`, by key.
        by_port: a regular expression for a port, whose group is the core's number of a pin there; None where ports do not tell.

    Raises:
        PlatformDataError: a number is none of a pin, two pins have it, or the core calls another port so.
    """
    ports = {pin.label: str(pin.port) for pin in pins}
    for key, numbers in said.items():
        bearers: dict[int, str] = {}
        for label, number in numbers.items():
            if not 0 <= number <= _MOST_NUMBER:
                raise table.error(f"{key}.{label}", f"is {number}, but cores have numbers from 0 to {_MOST_NUMBER}")
            if by_port and (of_port := by_port.fullmatch(ports[label])) and int(of_port[1]) != number:
                problem = f"is {number}, but the pin is at {ports[label]}, which is {of_port[1]} in this core"
                raise table.error(f"{key}.{label}", problem, f"write {label} = {of_port[1]}, or correct the port of {label}")
            if number in bearers:
                raise table.error(
                    f"{key}.{label}",
                    f"is {number}, which is also that of {bearers[number]}: programs would use one pin for both",
                    "correct one of them: pins_arduino.h or variant_NAME.cpp of the variant has both",
                )
            bearers[number] = label


def check_core(table: DataTable, settings: DataTable, architecture: str) -> bool:
    """Refuse a core that looks like a misspelt one, or is for other processors.

    Args:
        table: the mapping, whose `fqbn` begins with the core.
        settings: those of the platform.
        architecture: of the board's microcontroller.

    Returns:
        Whether the board has a processor as the platform's usual core is for.

    Raises:
        PlatformDataError: the core is wrong.
    """
    name, own = ":".join(table.text("fqbn", "").split(":")[:2]), settings.text("core_name", "")
    is_usual = architecture == settings.text("architecture", "")
    known = [*settings.table("cores", needed=False).values, own]
    if name in known and (is_usual or name == own) and architecture not in name.split(":"):
        raise table.error("fqbn", f"names the core '{name}', which is not for '{architecture}', the architecture of 'mcu'")
    if name not in known:
        similar = did_you_mean(name, [core for core in known if architecture in core.split(":")], _MISSPELT)
        if similar:
            raise table.error("fqbn", f"names '{name}', an unknown core{similar}")
    return is_usual
