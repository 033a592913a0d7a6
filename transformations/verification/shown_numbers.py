"""The numbers that an input of a program shows: which ones, how finely, and beside a border."""

from __future__ import annotations

from robosmi.transformations.verification.scenario_goals import beside
from robosmi.transformations.verification.scenario_inputs import ScenarioInput
from robosmi.transformations.verification.simulated_kinds import device_facts
from robosmi.transformations.verification.turning_points import Fineness

_PART = 0.001
"""A border is found to this part of itself."""


def numbers_of(each: ScenarioInput) -> list[float]:
    """The numbers among the values of an input, in ascending order."""
    return sorted({float(value) for value in each.values if isinstance(value, (int, float)) and not isinstance(value, bool)})


def is_whole(each: ScenarioInput) -> bool:
    """Whether an input shows whole numbers, which both boards read alike."""
    return "whole number" in device_facts().get(each.device, {}).get("takes", {}).get(each.setting, ())


def showable(each: ScenarioInput, number: float) -> float:
    """The number that an input shows in place of another one."""
    return round(number) if is_whole(each) else number


def fineness(each: ScenarioInput) -> Fineness:
    """How finely borders are sought among the numbers of an input."""
    smallest = float(device_facts().get(each.device, {}).get("finest", 1.0))
    return Fineness(smallest, smallest, _PART)


def both_sides(each: ScenarioInput, low: float, high: float) -> tuple[float, float]:
    """The numbers to show at both sides of a border that lies between two others."""
    if is_whole(each):
        return round(low), round(high)
    below, above = beside(high, device_facts().get(each.device, {}), each.near)
    return round(below, 1), round(above, 1)
