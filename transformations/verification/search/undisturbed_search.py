"""Scenarios in which the inputs come to rest and the program goes on alone, as a countdown does after the last key.

The other scenarios let something happen all the time, so that a loop that waits is left after a round or two: a wait that is a
tenth too short is within the tolerance of a single event, but not of the fifth in a row.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from robosmi.transformations.verification.original_side import ChannelEvents, channel_events, run_source
from robosmi.transformations.verification.search.combination_search import is_let_go
from robosmi.transformations.verification.search.scenario_goals import UNDISTURBED
from robosmi.transformations.verification.search.scenario_inputs import ScenarioInput, Signals
from robosmi.transformations.verification.search.scenario_trials import Trials
from robosmi.verify.scenario import Scenario

_ALONE_MS = 8_000.0
"""How long the program goes on alone, in milliseconds."""
_LONGEST_MS = 24_000.0
_ROUND_MS = 150.0
"""Least time between two events of a loop that waits, in milliseconds."""
_FEWEST, _ENOUGH = 3, 6
"""Rounds that show a wait, and rounds after which more of them show it no better."""
_EFFORT_S = 6.0
_MOST = 60


def try_undisturbed(trials: Trials, inputs: Sequence[ScenarioInput]) -> None:
    """Try the beginnings of the scenarios found so far, with nothing behind, and keep that with most rounds of a waiting loop."""
    if not inputs:
        return
    begun_s = trials.effort.spent_s
    alone = _rounds(trials, {}, 0.0)
    best: tuple[int, Signals, float] | None = None
    found = list(trials.found.scenarios)
    tried = ((signals, end_ms) for scenario, _ in found for signals, end_ms in _beginnings(scenario.signals, inputs))
    for (signals, end_ms), _ in zip(tried, range(_MOST), strict=False):
        if trials.effort.has_spent(begun_s, _EFFORT_S) or (best is not None and best[0] >= _ENOUGH):
            break
        rounds = min(_rounds(trials, signals, end_ms), _ENOUGH)
        if rounds > max(alone, _FEWEST - 1) and (best is None or rounds > best[0]):
            best = (rounds, signals, end_ms)
    if best is not None:
        trials.try_signals(best[1], frozenset([(UNDISTURBED, best[0])]), best[2] + _ALONE_MS)


def _beginnings(signals: Signals, inputs: Sequence[ScenarioInput]) -> Iterator[tuple[Signals, float]]:
    """The beginnings of signals after which what can be let go is let go, each with its end in milliseconds."""
    known = {(each.name, each.setting): each for each in inputs}
    times = sorted({at for settings in signals.values() for points in settings.values() for at, _ in points if at > 0})
    for end in times:
        if end + _ALONE_MS > _LONGEST_MS:
            return
        cut = {
            name: {setting: tuple(point for point in points if point[0] <= end) for setting, points in settings.items()}
            for name, settings in signals.items()
        }
        ends = {(name, setting): points[-1][1] for name, each in cut.items() for setting, points in each.items() if points}
        held = (key for key, value in ends.items() if key in known and is_let_go(known[key]) and value != known[key].rest)
        if next(held, None) is None:
            yield {name: kept for name, each in cut.items() if (kept := {s: p for s, p in each.items() if p})}, end


def _rounds(trials: Trials, signals: Signals, end_ms: float) -> int:
    """How often a channel changes after the end of the signals, each time after a wait."""
    run = run_source(trials.program, trials.ports, Scenario("undisturbed", end_ms + _ALONE_MS, signals, "generated"))
    trials.effort.add(run)
    seen: ChannelEvents = channel_events(run.trace, trials.ports, target=False)
    times = ([event.at_us / 1000 for event in events if event.at_us / 1000 > end_ms] for events, *_ in seen.values())
    return max((sum(after - before >= _ROUND_MS for before, after in pairwise(each)) for each in times), default=0)
