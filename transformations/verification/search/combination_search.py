"""The stages of a search for scenarios that need several inputs: some that show something at once, or one after the other.

Both grow what has led the source further by one more step, as coverage-guided fuzzing does: one more input that shows something
else, one more press of a button. Short runs (`Look`) show what leads further: new edges of the flow, a comparison that goes
the other way for the first time, or one whose two sides have come nearer to one another than ever.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence

from robosmi.base.data_text import Json
from robosmi.transformations.verification.search.branch_thresholds import Compared
from robosmi.transformations.verification.search.scenario_inputs import (
    FIRST_TEXT_MS,
    LONGEST_MS,
    ScenarioInput,
    Signals,
    constant,
    is_steady,
)
from robosmi.transformations.verification.search.scenario_trials import Trials
from robosmi.verify.scenario import Points

Event = tuple[ScenarioInput, Json]
_MOST_SETTINGS = 150
_MOST_SEQUENCES = 120
_NEWEST = 0.6
"""So often what was found last is made longer, else any other."""
_EFFORT_S = 3.0
"""Seconds of a usual machine that each of both stages may take to look."""
_WALK_MS = 10_000.0
_PRESS_MS = 150.0
_AFTER_MS = 600.0
_NEARER = 0.7
_FEW = 16
"""A comparison has come nearer where its sides are this part as far apart as ever before, or where they are so few apart."""


def try_settings(trials: Trials, inputs: Sequence[ScenarioInput]) -> None:
    """Let one more input show something else beside those that have led the source further: three buttons held, and a voltage."""
    levels = [each for each in inputs if not each.happens]
    known: list[Signals] = [{}]
    tried: list[Signals] = []
    begun_s = trials.effort.spent_s
    for parent in known if len(levels) > 1 else ():
        listed = (scenario.signals for scenario, _ in trials.found.scenarios)
        known += [signals for signals in listed if is_steady(signals) and signals not in known]
        for each in levels:
            for value in each.values:
                if len(tried) >= _MOST_SETTINGS or trials.effort.has_spent(begun_s, _EFFORT_S):
                    return
                signals = {**parent, each.name: {**parent.get(each.name, {}), **constant(each, value)[each.name]}}
                if value == each.rest or signals in known or signals in tried:
                    continue
                tried.append(signals)
                look = trials.look(signals, trials.probe_ms + each.hold_ms)
                if look is not None and trials.is_new(look):
                    trials.try_signals(signals)
                    known.append(signals)


def try_sequences(trials: Trials, inputs: Sequence[ScenarioInput], chance: random.Random) -> None:
    """Let events follow one another that lead the source further and further, as the digits of a code, and others behind them.

    Those are needed since a state shows in what follows it: a lock that is not locked again opens too soon.
    """
    events: list[Event] = [(each, value) for each in inputs for value in each.values if value is not None and value != each.rest]
    if len(events) < 2 or not any(each.happens or is_let_go(each) for each in inputs):
        return  # what is shown all the time is tried in other ways
    nearest: dict[tuple[int, bool], float] = {}
    grown: list[list[Event]] = [[]]
    begun_s = trials.effort.spent_s
    untried = [chance.sample(events, len(events))]
    for _ in range(_MOST_SEQUENCES):
        open_ones = [number for number, left in enumerate(untried) if left]
        if not open_ones or trials.effort.has_spent(begun_s, _EFFORT_S):
            break
        parent = open_ones[-1] if chance.random() < _NEWEST else chance.choice(open_ones)
        sequence = [*grown[parent], untried[parent].pop()]
        signals, end_ms = in_sequence(sequence)
        look = trials.look(signals, end_ms + _AFTER_MS) if end_ms < LONGEST_MS else None
        if look is not None and (_is_nearer(look.compared, nearest) or trials.is_new(look)):
            trials.ways |= look.told
            grown.append(sequence)
            untried.append(chance.sample(events, len(events)))
    for sequence in (max(grown, key=len), []) if len(grown) > 1 else ([],):
        if sequence == [] and trials.effort.has_spent(begun_s, _EFFORT_S):
            break
        while in_sequence(sequence)[1] < _WALK_MS:
            sequence = [*sequence, chance.choice(events)]
        trials.try_until_steady(_attempts(trials, sequence, begun_s), at_any_phase=True)


def _attempts(trials: Trials, events: Sequence[Event], begun_s: float) -> Iterator[tuple[Signals, float]]:
    """Events in sequence, and half of them twice as slowly if there is effort left."""
    for slower in (1, 2):
        if slower == 1 or not trials.effort.has_spent(begun_s, _EFFORT_S):
            signals, end_ms = in_sequence(events[: len(events) // slower], slower)
            yield signals, min(end_ms + _AFTER_MS, LONGEST_MS)


def in_sequence(events: Sequence[Event], slower: int = 1) -> tuple[Signals, float]:
    """Signals in which events follow one another, and when the last one has ended.

    Args:
        events: what happens; a device that has a rest shows it between two events.
        slower: by how much longer than usual each one takes.
    """
    signals: dict[str, dict[str, Points]] = {}
    at_ms = FIRST_TEXT_MS
    for each, value in events:
        lasts = (_PRESS_MS if each.is_contact else each.hold_ms) * slower
        rests = is_let_go(each)
        points: Points = ((at_ms, value), (at_ms + lasts, each.rest)) if rests else ((at_ms, value),)
        settings = signals.setdefault(each.name, {})
        settings[each.setting] = (*settings.get(each.setting, ()), *points)
        at_ms += (2 if rests else 1) * lasts
    return signals, at_ms


def is_let_go(each: ScenarioInput) -> bool:
    """Whether a device is pressed and let go, as a button and the keys of a matrix."""
    return each.is_contact or None in each.values


def _is_nearer(compared: Compared, nearest: dict[tuple[int, bool], float]) -> bool:
    """Whether the sides of a comparison have come nearer to one another; `nearest` is brought up to date."""
    found = False
    for place, ends in compared.items():
        for end in ends:
            side, before = (place, end > 0), nearest.get((place, end > 0))
            if before is None or abs(end) < before:
                found = found or (before is not None and (abs(end) <= _NEARER * before or before <= _FEW))
                nearest[side] = abs(end)
    return found
