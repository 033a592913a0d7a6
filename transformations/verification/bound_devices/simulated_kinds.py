"""What is known of each kind of simulated device: `platform_repo/simulation/devices.toml`, which explains each key."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import TypedDict, cast

from robosmi import resources
from robosmi.base.data_text import Json, as_table
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, did_you_mean
from robosmi.project import read_data

FILE = "simulation/devices.toml"
"""In the platform repository."""


class Split(TypedDict):
    """The kind of device that replaces one whose pin is two pins on the target, and its names of these."""

    kind: str
    pins: list[str]


class SimulatedKind(TypedDict, total=False):
    """One kind of device."""

    takes: dict[str, list[str]]
    rest: dict[str, Json]
    rest_of: dict[str, dict[str, Json]]
    values: dict[str, list[Json]]
    hold_ms: int
    motor: str
    limits: dict[str, list[Json]]
    units: dict[str, str]
    ends: dict[str, list[Json]]
    jitter: dict[str, float]
    keys: list[str]
    jitter_percent: float
    jitter_least: float
    finest: float
    near_percent: float
    off_least: float
    off_percent: float
    anywhere: dict[str, tuple[float, float]]
    fixed: dict[str, Json]
    driven: bool
    driven_as_output: bool
    happens: bool
    pauses: str
    rests_in: str
    rests_within: float
    rounded_to: float
    shown: list[str]
    split: Split
    takes_text: bool
    tells: list[str]
    tells_as: str
    tells_at: str
    tells_barely: str
    tells_slowly: str
    tells_text: str


def device_facts() -> Mapping[str, SimulatedKind]:
    """What is known of devices by kind: what they show at rest and in generated scenarios, and what they tell.

    Raises:
        PlatformDataError: the file has a key that no device has.
    """
    return _read(resources.find("platform_repo", FILE))


@cache
def _read(path: Path) -> Mapping[str, SimulatedKind]:
    kinds = read_data(path)
    for kind, facts in kinds.items():
        known = SimulatedKind.__annotations__
        for key in as_table(facts):
            if key not in known:
                raise PlatformDataError(
                    f"unknown key '{kind}.{key}'{did_you_mean(key, known)}", location=Location(str(path)),
                    fix=f"use one of: {', '.join(sorted(known))}",
                )  # fmt: skip
    return cast("Mapping[str, SimulatedKind]", kinds)
