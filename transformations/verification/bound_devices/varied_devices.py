"""The devices of a varied run of the source: their signals a little earlier or later, their values a little off."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from typing import Any

from msgspec.structs import replace

from robosmi.transformations.verification.bound_devices.simulated_kinds import device_facts
from robosmi.verify.simulation import DeviceUse

MOVED_MS = 20.0
"""Greatest time by which inputs are moved, in milliseconds: the longest time between two reads of a polling program."""


def moved_devices(devices: Sequence[DeviceUse], chance: random.Random, by_ms: float | None = None) -> list[DeviceUse]:
    """Devices whose signals change a little earlier or later, and whose values are a little different.

    Args:
        devices: the devices.
        chance: the random generator.
        by_ms: time in milliseconds by which all signals are late; None to move each change by another time.
    """
    facts = device_facts()
    made = []
    for use in devices:
        percent = float(facts.get(use.kind, {}).get("jitter_percent", 0))
        smallest = float(facts.get(use.kind, {}).get("jitter_least", 0))
        settings = {
            name: [_moved(point, chance, percent, smallest, by_ms) for point in value] if _is_signal(value) else value
            for name, value in use.settings.items()
        }
        for name, value in settings.items():
            if _is_signal(value):
                settings[name] = sorted(value, key=lambda point: float(point[0]))
        for name, usual in facts.get(use.kind, {}).get("jitter", {}).items():
            settings[name] = usual * (1 + chance.uniform(-percent, percent) / 100)
        made.append(replace(use, settings=settings))
    return put_down_anywhere(made, chance)


def late_devices(devices: Sequence[DeviceUse], by_ms: Mapping[float, float]) -> list[DeviceUse]:
    """Devices whose changes at some times come later, or earlier where the number is negative; all in milliseconds."""
    chance = random.Random(0)
    return [
        replace(
            use,
            settings={
                name: [_moved(point, chance, 0.0, 0.0, by_ms.get(float(point[0]), 0.0)) for point in value]
                if _is_signal(value)
                else value
                for name, value in use.settings.items()
            },
        )
        for use in devices
    ]


def put_down_anywhere(devices: Sequence[DeviceUse], chance: random.Random) -> list[DeviceUse]:
    """Devices whose exact initial position is unknown, at another position.

    The time that a closed loop needs to reach a place depends on it: each varied run is one more sample of that.
    """
    facts = device_facts()
    return [
        replace(
            use,
            settings={
                **use.settings,
                **{name: chance.uniform(*ends) for name, ends in facts.get(use.kind, {}).get("anywhere", {}).items()},
            },
        )
        for use in devices
    ]


def _is_signal(value: Any) -> bool:
    return isinstance(value, list) and all(isinstance(point, list) and len(point) == 2 for point in value)


def _moved(point: list[Any], chance: random.Random, percent: float, least: float, by_ms: float | None) -> list[Any]:
    at_ms, value = point
    later_ms = chance.uniform(-MOVED_MS, MOVED_MS) if by_ms is None else by_ms
    at_ms = max(0.0, at_ms + later_ms) if at_ms else at_ms
    if percent and isinstance(value, (int, float)):
        off = chance.uniform(-1, 1)
        value = value + off * max(abs(value) * percent / 100, min(least, abs(value)))
    return [at_ms, value]
