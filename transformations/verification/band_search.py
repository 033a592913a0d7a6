"""The stages of a search for scenarios in which it matters what an input has shown before.

Borders part the values of an input into bands. A program with a hysteresis leaves a band at another value than the one at which
it enters it, and one that keeps a state may do something else for each band that it comes from.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence

from robosmi.transformations.verification.original_side import Place
from robosmi.transformations.verification.scenario_goals import BESIDE
from robosmi.transformations.verification.scenario_inputs import LONGEST_MS, ScenarioInput, Signals
from robosmi.transformations.verification.scenario_trials import Trials
from robosmi.transformations.verification.shown_numbers import both_sides, fineness, numbers_of, showable
from robosmi.transformations.verification.turning_points import Look, Turn, turning_points

_MOST_BANDS = 5
_TURNS = 5
"""So often an input goes from its first band to its last one: a program may count lines that it crosses."""
_LOOKS = 12
_MOST_BORDERS = 2


def try_bands(trials: Trials, each: ScenarioInput, borders: Sequence[float], step_ms: float) -> None:
    """Seek borders that lie elsewhere after the least or the greatest value, and go from each band to each other one.

    Args:
        trials: the search.
        each: an input that shows numbers.
        borders: where the source goes another way if the input shows one value throughout.
        step_ms: for how long one value is shown, so that the program has seen it.
    """
    numbers = numbers_of(each)
    bands = _bands(numbers[0], numbers[-1], [both_sides(each, border, border) for border in sorted(borders)])
    if len(bands) < 2:
        return
    for before in (numbers[-1], numbers[0]):

        def look(value: float, before: float = before) -> Look | None:
            return trials.look(_in_steps(each, (before, value), step_ms), 2 * step_ms)

        turns = [(turn.low, turn.high) for low, high in bands for turn in _turns_inside(low, high, each, look)]
        turns += [(border, border) for border in sorted(borders) if _keeps_state(trials, each, before, border, step_ms)]
        for turn in turns:
            low, high = both_sides(each, *turn)
            if not low < high or before in (low, high):
                continue  # at an end of what the input shows
            near, far = (low, high) if before < turn[1] else (high, low)
            goal: Place = (BESIDE, each.name, each.setting, round(turn[1]), round(before))
            _try_steps(trials, each, (before, near, far, near, before), step_ms, goal)
    middles = [(low + high) / 2 for low, high in bands]
    if len(bands) > 2:
        walk = [middles[number] for number in _all_ways(len(middles[:_MOST_BANDS]))]
        _try_steps(trials, each, walk, step_ms, (BESIDE, each.name, each.setting, "bands"))
    _try_steps(trials, each, (middles[0], middles[-1]) * _TURNS, step_ms)


def _keeps_state(trials: Trials, each: ScenarioInput, before: float, border: float, step_ms: float) -> bool:
    """Whether another value before the one beside a border leaves the program in another state."""
    for value in both_sides(each, border, border):
        after = trials.left_in(_in_steps(each, (before, value), step_ms), 2 * step_ms)
        alone = trials.left_in(_in_steps(each, (value, value), step_ms), 2 * step_ms)
        if after is not None and alone is not None and after != alone:
            return True
    return False


def _turns_inside(low: float, high: float, each: ScenarioInput, look: Callable[[float], Look | None]) -> list[Turn]:
    return turning_points((low, (low + high) / 2, high), look, fineness(each), _LOOKS, _MOST_BORDERS)


def _bands(least: float, greatest: float, borders: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """The least and the greatest value of each band between borders, whose sides are given."""
    lows = [least, *(high for _, high in borders)]
    highs = [*(low for low, _ in borders), greatest]
    return [(low, high) for low, high in zip(lows, highs, strict=True) if low < high]


def _try_steps(trials: Trials, each: ScenarioInput, values: Sequence[float], step_ms: float, *goals: Place) -> None:
    """Try values one after the other, each for longer if the source differs from itself."""

    def attempts() -> Iterator[tuple[Signals, float]]:
        for step in (step_ms, 2 * step_ms):
            shown = values[: int(LONGEST_MS / step)]
            yield _in_steps(each, shown, step), 1000 * math.ceil(len(shown) * step / 1000)

    trials.try_until_steady(attempts(), frozenset(goals))


def _in_steps(each: ScenarioInput, values: Sequence[float], step_ms: float) -> Signals:
    """Signals of an input that shows values one after the other."""
    return {each.name: {each.setting: tuple((number * step_ms, showable(each, value)) for number, value in enumerate(values))}}


def _all_ways(count: int) -> Iterator[int]:
    """Numbers below `count` in an order in which each one follows each other one: 0 1 0 2 0, then 1 2 1 .. without 0."""
    for first in range(count):
        yield first
        for other in range(first + 1, count):
            yield other
            yield first
