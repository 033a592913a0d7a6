"""The inputs of motor drivers, from `parts/motor_drivers.toml` of the platform repository, whose head explains the keys."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import lru_cache
from pathlib import Path

from msgspec import Struct

from robosmi import resources
from robosmi.base.data_tables import DataTable
from robosmi.project import read_data
from robosmi.transformations.knowledge.wildcards import Wildcards

FILE = "parts/motor_drivers.toml"
MOTOR_DRIVER = "motor driver"
"""The kind of these parts, as `parts/electrical.toml` calls it."""
_BLANKS = re.compile(r"[\s_-]+")


class DriverChannel(Struct, frozen=True):
    """The inputs of one motor: the names of the connectors for PWM and for the two directions."""

    pwm: Wildcards
    first: Wildcards
    second: Wildcards
    needs_pwm: bool


class DriverInputs(Struct, frozen=True):
    """The inputs of one kind of motor driver.

    Attributes:
        channels: one for each motor.
        jumper: whether the PWM input may be held high on the part itself.
        awake: names of the inputs that are high while the driver works.
        sleeps: whether it sleeps while such an input is connected to nothing.
        only: a part of this kind has a connector with one of these names; empty if any part with these channels is of this kind.
    """

    channels: tuple[DriverChannel, ...]
    jumper: bool
    awake: Wildcards
    sleeps: bool
    only: Wildcards


def driver_inputs(connectors: Iterable[str]) -> DriverInputs | None:
    """The inputs of a motor driver with connectors of these names; None if it is of no known kind.

    Raises:
        PlatformDataError: the table is damaged.
    """
    path = resources.find("platform_repo", FILE)
    words = {plain_name(name) for name in connectors}
    return next((known for known in _known(path, path.stat().st_mtime_ns) if _is_of(known, words)), None)


def plain_name(connector: str) -> str:
    """The name of a connector as the table writes it: in lower case, without blanks, underscores and hyphens."""
    return _BLANKS.sub("", connector.lower())


def _is_of(known: DriverInputs, words: set[str]) -> bool:
    marked = known.only == _ANY or any(word in known.only for word in words)
    return marked and any(any(w in c.first for w in words) or any(w in c.second for w in words) for c in known.channels)


_ANY = Wildcards.of(())


@lru_cache(maxsize=2)
def _known(path: Path, _: int) -> tuple[DriverInputs, ...]:
    return tuple(
        DriverInputs(
            tuple(
                DriverChannel(
                    Wildcards.of(channel.texts("pwm", ())),
                    Wildcards.of(channel.texts("first")),
                    Wildcards.of(channel.texts("second")),
                    bool(channel.texts("pwm", ())),
                )
                for channel in driver.tables("channels")
            ),
            driver.flag("jumper", False),
            Wildcards.of(driver.texts("awake", ())),
            driver.flag("sleeps", False),
            Wildcards.of(driver.texts("only", ())),
        )
        for driver in DataTable(path, read_data(path)).tables("driver")
    )
