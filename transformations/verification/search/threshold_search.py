"""The stages of a search for scenarios that seek borders: values, numbers and durations at which the source goes another way.

Faults that move a border show beside it and nowhere else. Short runs of the source show whether there is one, of which
hundreds take a second (`branch_thresholds`); only what is found there becomes a scenario.

Borders part the values of an input into bands. What the input has shown before may matter: a program with a hysteresis leaves a
band at another value than the one at which it enters it, and one that keeps a state may do something else for each band that it
comes from. So each band is entered from each other one.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence

from msgspec.structs import replace

from robosmi.base.data_text import Json
from robosmi.transformations.verification.bound_devices.simulated_kinds import device_facts
from robosmi.transformations.verification.original_side import Place
from robosmi.transformations.verification.search.branch_thresholds import Fineness, Look, Turn, branch_thresholds
from robosmi.transformations.verification.search.scenario_goals import BESIDE, near_threshold
from robosmi.transformations.verification.search.scenario_inputs import (
    FIRST_TEXT_MS,
    LONGEST_MS,
    ScenarioInput,
    Signals,
    constant,
    in_turn,
    is_steady,
    press,
    pressed_twice,
    series_points,
)
from robosmi.transformations.verification.search.scenario_trials import Trials

_SURE_BACKGROUNDS, _MOST_BACKGROUNDS = 4, 8
_NUMBERS_SHARE = 0.5
"""Share of the effort after which no more numbers are typed."""
_NUMBERS = (-40_000.0, -300.0, -1.0, 0.0, 1.0, 4.0, 50.0, 1_200.0, 70_000.0)
"""Those that are typed to find out at which others a program goes another way."""
_TENTH = 0.1
_HELD_MS = (60.0, 250.0, 700.0, 1_500.0, 3_000.0, 5_000.0)
"""For so long a button is held to find out whether a program tells durations apart, and for so long it is let go between two
presses."""
_LATEST_MS = 6_000.0
"""Not later a button is pressed."""
_AFTER_MS = 1_500.0
"""So long it is looked what a program does behind a press."""
_EFFORT_S = 5.0
"""Seconds of a usual machine that durations may take, and the values of an input before what comes last of it is left out."""
_DURATION = Fineness(1.0, 4.0, 0.004)
_MOVED_MS = 45.0
"""So far beside a border a button is held at least: both of its edges may come 20 ms earlier or later."""
_FURTHER = (0.01, 0.1, 0.25)
"""Parts of the duration beside it, the next one where the source differs from itself."""
InputSignals = Callable[[ScenarioInput, float, float], Signals]
_LOOKS, _MOST_BORDERS = 24, 4
_MOST_LOOKS = 60
"""So often at most one input is looked at beyond the values that it has."""


def try_numbers(trials: Trials, each: ScenarioInput, numbers: Sequence[tuple[str, int]]) -> None:
    """Let an input give the numbers around each one at which the source takes another way.

    If the source takes the same ways after several texts in front of a number, as if it ignores them, the first text is
    enough.

    Args:
        trials: the search.
        each: an input that takes text.
        numbers: those with which the program compares what it reads, each with a text before it.
    """
    done: set[tuple[float, frozenset[Place]]] = set()
    for before in dict.fromkeys(before for before, _ in numbers):
        known = [number for text, number in numbers if text == before]

        def look(number: float, before: str = before) -> Look | None:
            over = trials.effort.is_over(_NUMBERS_SHARE)
            return None if over else _look(trials, each, f"{before}{_written(number)}\r", {})

        step = _TENTH if _reads_fractions(look) else 1.0
        values = {*_NUMBERS, *(float(number + more) for number in known for more in (-1, 0, 1))}
        tried = -math.inf
        for turn in branch_thresholds(values, look, Fineness(step, step), _LOOKS, _MOST_BORDERS + 2 * len(known)):
            where = frozenset(place[:1] for place in turn.apart)
            if turn.high - tried < 1.5 * step or (turn.high, where) in done:
                continue
            tried = turn.high
            done.add((turn.high, where))
            # a fraction at which both sides are equal may be read a little above or below it
            least = turn.low - step if step < 1 else turn.low
            texts = tuple(f"{before}{_written(number)}\r" for number in (least, turn.high, turn.high + step))
            there: Place = (BESIDE, each.name, each.setting, texts[-1])
            try_in_series(trials, replace(each, series=texts), there, (4, 16))


def _reads_fractions(look: Callable[[float], Look | None]) -> bool:
    """Whether what a program compares lies in the middle for a number in the middle."""
    found = [look(number) for number in (0.0, 0.5, 1.0)]
    if None in found:
        return False
    low, middle, high = (seen.compared if seen else {} for seen in found)
    return any(
        low[place][0] != high[place][0] and 2 * middle[place][0] == low[place][0] + high[place][0]
        for place in low.keys() & middle.keys() & high.keys()
    )


def _written(number: float) -> str:
    return str(int(number)) if number == int(number) else f"{number:.1f}"


def try_in_series(trials: Trials, each: ScenarioInput, goal: Place, slower: Sequence[int]) -> None:
    """Try an input's series, with values held longer and longer by the factors `slower` as long as the scenario is racy."""

    def attempts() -> Iterator[tuple[Signals, float]]:
        for times in slower:
            points = series_points(each, times)
            ends_ms = min(LONGEST_MS, 1000 * math.ceil(points[-1][0] / 1000 + 1)) if points else 0.0
            yield {each.name: {each.setting: points}}, max(trials.horizon, ends_ms)

    trials.try_until_steady(attempts(), frozenset([goal]))


# ---- durations


def try_durations(trials: Trials, contacts: Sequence[ScenarioInput]) -> None:
    """Hold buttons for less and for more than each duration that a program tells apart, and let them go for so long.

    Buttons that a program asks at the same places of its text are told apart by one of them.
    """
    done: set[Place] = set()
    begun_s = trials.effort.spent_s
    for each in contacts:
        for kind, signal in (("held", press), ("twice", pressed_twice)):
            begin = max(FIRST_TEXT_MS, min(trials.probe_ms, _LATEST_MS))
            until = begin + _HELD_MS[-1] + _AFTER_MS

            def look(
                ms: float, each: ScenarioInput = each, signal: InputSignals = signal, begin: float = begin, until: float = until
            ) -> Look | None:
                over = trials.effort.has_spent(begun_s, _EFFORT_S)
                return None if over else trials.look(signal(each, ms, begin), until)

            for turn in branch_thresholds(_HELD_MS, look, _DURATION, _LOOKS, _MOST_BORDERS):
                if not turn.apart <= done and _try_beside(trials, each, kind, signal, begin, turn.high):
                    done |= turn.apart


def _try_beside(trials: Trials, each: ScenarioInput, kind: str, signal: InputSignals, begin: float, border: float) -> bool:
    """Hold a button for less and for more than a border; whether the source does the same in each of its runs."""
    for part in _FURTHER:
        racy = trials.found.racy
        moved = max(_MOVED_MS, part * border)
        for side, ms in enumerate((border - moved, border + moved)):
            if ms > 0:
                there: Place = (BESIDE, each.name, kind, round(border), side)
                ends = 1000 * math.ceil((begin + ms + _AFTER_MS) / 1000)
                trials.try_signals(signal(each, round(ms), begin), frozenset([there]), ends, at_any_phase=True)
        if trials.found.racy == racy:
            return True
    return False


# ---- values


def with_thresholds(trials: Trials, each: ScenarioInput) -> ScenarioInput:
    """Seek the values at which the source goes another way.

    Some behaviour shows only at the border itself, such as that of a count that equals a limit, and faults that move a
    border show beside it: the input gets these values as well, and a scenario that goes from one side to the other is
    tried.
    """
    values = list(each.values)
    known: list[float] = []
    begun_s = trials.effort.spent_s
    for number, background in enumerate(_backgrounds(trials, each)):
        if number >= _SURE_BACKGROUNDS and trials.effort.has_spent(begun_s, _EFFORT_S):
            break
        values += [value for value in _borders(trials, each, background, known) if value not in values]
    if known:
        try_bands(trials, each, known, _seen_after_ms(trials, each))
    return replace(each, values=tuple(values))


def _backgrounds(trials: Trials, each: ScenarioInput) -> list[Signals]:
    """Constant signals of the other inputs while borders are sought: none, and those of the scenarios that were kept."""
    found: list[Signals] = [{}]
    for scenario, _ in trials.found.scenarios:
        others = {name: settings for name, settings in scenario.signals.items() if name != each.name}
        if is_steady(others) and others not in found:
            found.append(others)
    return found[:_MOST_BACKGROUNDS]


def _borders(trials: Trials, each: ScenarioInput, background: Signals, known: list[float]) -> list[float]:
    """The values at both sides of each border that is found with a background of other signals.

    Borders are added to `known`, those of all backgrounds.
    """
    numbers = numbers_of(each)

    def look(value: float) -> Look | None:
        shown = showable(each, value)
        seen = _look(trials, each, shown, background)
        if seen is not None and value not in numbers and trials.takes_new_edge(seen):
            trials.try_signals({**background, **constant(each, shown)})
        return seen

    values: list[float] = []
    fine = fineness(each)
    before = -math.inf
    for turn in branch_thresholds(numbers, look, fine, _MOST_LOOKS, _MOST_LOOKS) if len(numbers) > 2 else ():
        sides = both_sides(each, turn.low, turn.high)
        near = 2.5 * fine.width(turn.high)
        if turn.high - before < near or any(
            sides[0] <= border <= sides[1] and abs(border - turn.high) >= near for border in known
        ):
            continue  # two sides of one value, or a value that another board may see on the other side of another border
        before = turn.high
        known.append(turn.high)
        values += sides
        there: Place = (BESIDE, each.name, each.setting, round(turn.high))
        turns = {each.name: {each.setting: in_turn(each, [*sides, sides[0]], trials.horizon)}}
        trials.try_signals({**background, **turns}, frozenset([there]))
        both = trials.look({**background, **turns}, trials.horizon) if background else None
        if both is not None and not {place for place in turn.apart if len(place) == 1} <= both.told:
            for side, value in enumerate(sides):  # the program looks once, as after a press, and sees one side alone
                trials.try_signals({**background, **constant(each, value)}, frozenset([(*there, side)]))
    return values


def _seen_after_ms(trials: Trials, each: ScenarioInput) -> float:
    """How long a program may take to see what an input shows, in milliseconds."""
    return trials.probe_ms + (FIRST_TEXT_MS if each.happens else each.hold_ms if each.hold_ms > 1000 else 0)


def _look(trials: Trials, each: ScenarioInput, value: Json, background: Signals) -> Look | None:
    """What a short run tells in which an input shows one value; None when the search is over."""
    return trials.look({**background, **constant(each, value)}, min(trials.horizon, _seen_after_ms(trials, each)))


# ---- bands

_MOST_BANDS = 5
_TURNS = 5
"""So often an input goes from its first band to its last one: a program may count lines that it crosses."""
_BAND_TRIALS = 12
_MAX_BAND_BORDERS = 2


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
    return branch_thresholds((low, (low + high) / 2, high), look, fineness(each), _BAND_TRIALS, _MAX_BAND_BORDERS)


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


# ---- numbers that an input shows

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
    below, above = near_threshold(high, device_facts().get(each.device, {}), each.near)
    return round(below, 1), round(above, 1)
