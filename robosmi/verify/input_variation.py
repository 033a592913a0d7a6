"""Slightly varied inputs: the same devices, with the times and values of their signals changed a little.

A result that depends on such a variation proves nothing about two programs whose steps take different times. Which variations
matter is up to the caller; here devices are distinguished only by their settings: a signal is a list of points [milliseconds,
value].
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from typing import Any

from robosmi.typed import replaced
from robosmi.verify.simulation import DeviceUse


def vary_inputs(
    devices: Sequence[DeviceUse], seed: int, instant_ms: float = 0.0, value_part: float = 0.0, together: bool = True
) -> list[DeviceUse]:
    """The devices with the signals' points moved.

    Args:
        devices: what is connected.
        seed: which of the differences.
        instant_ms: by how much at most a point comes earlier or later. What begins at 0 stays there, and the order of a signal's
            points stays as it is.
        value_part: by which part of it at most a number is larger or smaller; 0 and 1, which may be levels, stay.
        together: whether points of one instant stay together, on whatever device they are.
    """
    noise = random.Random(seed)
    moved: dict[float, float] = {}

    def instant(at_ms: float) -> float:
        if at_ms <= 0:
            return at_ms
        if not together:
            return at_ms + noise.uniform(-instant_ms, instant_ms)
        return moved.setdefault(at_ms, at_ms + noise.uniform(-instant_ms, instant_ms))

    def varied(value: Any) -> Any:
        if isinstance(value, bool) or not isinstance(value, int | float) or value in (0, 1):
            return value
        return value * (1 + noise.uniform(-value_part, value_part))

    def signal(points: Sequence[Sequence[Any]]) -> list[list[Any]]:
        result: list[list[Any]] = []
        for at_ms, value in points:
            earliest = result[-1][0] if result else 0.0
            result.append([max(earliest, instant(at_ms)), varied(value)])
        return result

    def settings(given: Mapping[str, Any]) -> dict[str, Any]:
        return {name: signal(value) if _is_signal(value) else value for name, value in given.items()}

    return [replaced(use, settings=settings(use.settings)) for use in devices]


def _is_signal(value: Any) -> bool:
    """Whether a setting is a list of points, at least one."""
    return (
        isinstance(value, list | tuple)
        and len(value) > 0
        and all(isinstance(each, list | tuple) and len(each) == 2 and isinstance(each[0], int | float) for each in value)
    )
