"""A search for scenarios: signals at the inputs of a program, kept if they reach what no other scenario has reached.

Counted are lines and branches of the source, and the goals of `scenario_goals`. The random generator has a seed; the search
ends when nothing new is reached for a while, or when its effort is used up (`search_effort`). Scenarios in which the source
differs from itself are dropped and counted, since nothing can be decided with them. Of the others, a small set is kept that
reaches everything that was reached.

In some scenarios the inputs come to rest and the program goes on alone, as a countdown does after the last key
(`try_undisturbed`). The other scenarios let something happen all the time, so that a loop that waits is left after a round or
two: a wait that is a tenth too short is within the tolerance of a single event, but not of the fifth in a row.

Some scenarios need several inputs: some that show something at once, or one after the other. Both stages (`_try_settings`,
`_try_sequences`) grow what has led the source further by one more step, as coverage-guided fuzzing does: one more input that
shows something else, one more press of a button. Short runs (`Look`) show what leads further: new edges of the flow, a
comparison that goes the other way for the first time, or one whose two sides have come nearer to one another than ever.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from itertools import pairwise

from robosmi.base.data_text import Json
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.original_side import (
    LIMITS,
    ChannelEvents,
    Place,
    channel_events,
    places_reached,
    run_source,
)
from robosmi.transformations.verification.search.branch_thresholds import Compared
from robosmi.transformations.verification.search.scenario_goals import ENDS, SERIES, UNDISTURBED
from robosmi.transformations.verification.search.scenario_inputs import (
    FIRST_TEXT_MS,
    LONGEST_MS,
    ScenarioInput,
    Signals,
    constant,
    is_steady,
    random_signals,
    scenario_inputs,
    together,
    turned,
)
from robosmi.transformations.verification.search.scenario_trials import FoundScenarios, Trials
from robosmi.transformations.verification.search.search_effort import SearchEffort
from robosmi.transformations.verification.search.threshold_search import (
    try_durations,
    try_in_series,
    try_numbers,
    with_thresholds,
)
from robosmi.verify.original import Original
from robosmi.verify.scenario import Points, Scenario

_HORIZONS_MS = (3_000.0, 6_000.0, 12_000.0, 24_000.0)
_HORIZON_ALONE_MS = 48_000.0
"""A further horizon for a program without inputs, which has only one scenario, in milliseconds."""
_MOST = 120
"""At most this many scenarios are tried."""
_PATIENCE = 30
_MOST_SERIES = 8

_ALONE_MS = 8_000.0
"""How long the program goes on alone, in milliseconds."""
_LONGEST_MS = 24_000.0
_ROUND_MS = 150.0
"""Least time between two events of a loop that waits, in milliseconds."""
_FEWEST, _ENOUGH = 3, 6
"""Rounds that show a wait, and rounds after which more of them show it no better."""
_EFFORT_S = 6.0
_MOST_ALONE = 60

_Event = tuple[ScenarioInput, Json]
_MOST_SETTINGS = 150
_MOST_SEQUENCES = 120
_NEWEST = 0.6
"""So often what was found last is made longer, else any other."""
_GROWTH_S = 3.0
"""Seconds of a usual machine that each of both stages may take to look."""
_WALK_MS = 10_000.0
_PRESS_MS = 150.0
_AFTER_MS = 600.0
_NEARER = 0.7
_FEW = 16
"""A comparison has come nearer where its sides are this part as far apart as ever before, or where they are so few apart."""


def search(
    program: Original,
    ports: Sequence[BoundPort],
    texts: Sequence[str],
    types: bool,
    seed: int,
    known: frozenset[Place] = frozenset(),
    budget_s: float = 240.0,
    steps: int = 0,
    numbers: Sequence[tuple[str, int]] = (),
    clock_s: float | None = None,
    horizon_ms: float | None = None,
) -> FoundScenarios:
    """Search scenarios for a program.

    Args:
        program: the original.
        ports: its ports.
        texts: texts that the program may react to, typed or sent.
        types: whether the program reads what is typed on the console.
        seed: seed of the random generator.
        known: places of the source that other scenarios reach.
        budget_s: seconds of a typical machine's time after which the search ends; at most three times as many by the clock.
        clock_s: the limit by the clock instead, in seconds.
        horizon_ms: how long scenarios last at most, in milliseconds, and the one without signals at least; what the program needs
            if None.
        steps: the number of steps of a variable that the program tells apart.
        numbers: the numbers that the program compares with what is typed or sent, each with the text to type before it.
    """
    effort = SearchEffort(budget_s, clock_s=clock_s, second_s=program.second_s)
    made = Trials(program, ports, set(known), effort)
    inputs = scenario_inputs(ports, texts, types, steps)
    horizons = _HORIZONS_MS + (() if inputs else (_HORIZON_ALONE_MS,))
    if horizon_ms is not None:
        horizons = _up_to(horizon_ms)
        made.longest_ms = horizon_ms
    made.horizon = _horizon(program, ports, effort, horizons)
    _try_rest(made, horizons, _whole_ms(made, horizons, horizon_ms is not None))
    if inputs:
        _find_probe(made)
    for each in inputs:
        for value in each.values:
            made.try_signals(constant(each, value))
    levels = [each for each in inputs if not any(isinstance(value, str) for value in each.values)]
    for number in range(max((len(each.values) for each in levels), default=0) if len(levels) > 1 else 0):
        made.try_signals(together(levels, number))
    _try_ends(made, inputs)
    _try_series(made, inputs)
    _try_settings(made, inputs)
    try_durations(made, [each for each in inputs if each.is_contact and each.rest in each.values][:_MOST_SERIES])
    for each in inputs:
        if each.takes_text:
            try_numbers(made, each, numbers)
    chance = random.Random(seed)
    _try_sequences(made, inputs, chance)
    try_undisturbed(made, inputs)
    inputs = [with_thresholds(made, each.with_ends()) for each in inputs]
    while inputs and made.found.tried < _MOST and made.fruitless < _PATIENCE and not effort.is_over():
        made.try_signals(random_signals(inputs, made.horizon, chance))
    made.found.repeatable = not effort.late
    made.found.cut, made.found.seconds = effort.cut, effort.elapsed_s
    return _fewest(made.found, made.reached_by, known)


def _up_to(horizon_ms: float) -> tuple[float, ...]:
    """The horizons up to one, each twice as long as the one before."""
    found = [_HORIZONS_MS[0]]
    while 2 * found[-1] < horizon_ms:
        found.append(2 * found[-1])
    return (*(each for each in found if each < horizon_ms), horizon_ms)


def _try_rest(trials: Trials, horizons: Sequence[float], whole_ms: float) -> None:
    """Try the scenario without signals, with ever shorter horizons as long as the source differs from itself.

    Args:
        trials: the search.
        horizons: those that were tried.
        whole_ms: the first one.
    """
    trials.try_signals({}, horizon=whole_ms)
    for shorter in reversed([each for each in horizons if each < whole_ms]):
        if trials.found.scenarios or not trials.found.racy or trials.effort.is_over():
            return
        trials.horizon = min(shorter, trials.horizon)
        trials.only_racy.clear()
        trials.try_signals({}, horizon=shorter)


def _find_probe(trials: Trials) -> None:
    """Lengthen the probe until a run without signals reaches in it all that it reaches up to the horizon."""
    wanted = _at_rest(trials, trials.horizon)
    while (
        trials.probe_ms < trials.horizon and not wanted <= _at_rest(trials, trials.probe_ms) and not trials.effort.is_over(0.25)
    ):
        trials.probe_ms *= 2


def _at_rest(trials: Trials, horizon_ms: float) -> frozenset[Place]:
    """The places that a run without signals reaches."""
    run = run_source(trials.program, trials.ports, Scenario("rest", horizon_ms))
    trials.effort.add(run)
    return places_reached(trials.program, run, trials.ports)


def _try_ends(trials: Trials, inputs: Sequence[ScenarioInput]) -> None:
    """Try the least and the greatest values that each device measures."""
    for name in dict.fromkeys(each.name for each in inputs if each.ends):
        its = [each for each in inputs if each.name == name and each.ends]
        for end in (0, -1):
            signals = {setting: points for each in its for setting, points in constant(each, each.ends[end])[name].items()}
            trials.try_signals({name: signals}, frozenset([(ENDS, name, end)]))


def _try_series(trials: Trials, inputs: Sequence[ScenarioInput]) -> None:
    """Try the series of each input, and knobs made of two contacts."""
    for each in [each for each in inputs if each.series][:_MOST_SERIES]:
        try_in_series(trials, each, (SERIES, each.name, each.setting), (1, 2, 4))
    contacts = [each for each in inputs if each.is_contact and each.series][:_MOST_SERIES]
    for one, other in pairwise(contacts):
        for backwards in (False, True):
            trials.try_signals(turned(one, other, backwards))


def _horizon(
    program: Original, ports: Sequence[BoundPort], effort: SearchEffort, horizons: Sequence[float] = _HORIZONS_MS
) -> float:
    """The length of scenarios in milliseconds: until a program without signals reaches nothing new for as long again.

    All horizons are tried, since a program may reach something new late. A horizon whose run is given up is too long, and so is
    one after a quarter of the effort.
    """
    before: frozenset[Place] | None = None
    reached, settled = 0.0, 0.0
    for horizon in horizons:
        if before is not None and effort.is_over(0.25):
            return settled or horizon
        run = run_source(program, ports, Scenario("rest", horizon))
        effort.add(run)
        if run.status in LIMITS:
            return settled or reached or horizon
        reached = horizon
        places = places_reached(program, run, ports)
        settled = (settled or horizon) if places == before else 0.0
        if run.status == "finished":
            return settled or horizon
        before = places
    return settled or reached


def _whole_ms(trials: Trials, horizons: Sequence[float], to_the_end: bool) -> float:
    """The length of the scenario without signals in milliseconds: that of all others, or until the program ends if it does.

    A course may be a table, so that a program reaches nothing new on its way.

    Args:
        trials: the search, with the length of scenarios.
        horizons: those that may be tried.
        to_the_end: whether it lasts as long as any may, though the program does not end.
    """
    if horizons[-1] <= trials.horizon or (trials.effort.is_over(0.25) and not to_the_end):
        return trials.horizon
    run = run_source(trials.program, trials.ports, Scenario("rest", horizons[-1]))
    trials.effort.add(run)
    if run.status == "finished":
        return next(each for each in horizons if each * 1000 >= run.trace.simulated_us)
    return horizons[-1] if to_the_end and run.status not in LIMITS else trials.horizon


def _fewest(found: FoundScenarios, places: list[frozenset[Place]], known: frozenset[Place]) -> FoundScenarios:
    """Keep the first scenario, then repeatedly the one that reaches most of what is still missing."""
    keep = [0] if places else []
    missing = frozenset().union(*places) - known - (places[0] if places else frozenset())
    while missing:
        best = max(range(len(places)), key=lambda number: len(places[number] & missing))
        keep.append(best)
        missing -= places[best]
    found.scenarios = [found.scenarios[number] for number in sorted(keep)]
    return found


def try_undisturbed(trials: Trials, inputs: Sequence[ScenarioInput]) -> None:
    """Try the beginnings of the scenarios found so far, with nothing behind, and keep that with most rounds of a waiting loop."""
    if not inputs:
        return
    begun_s = trials.effort.spent_s
    alone = _rounds(trials, {}, 0.0)
    best: tuple[int, Signals, float] | None = None
    found = list(trials.found.scenarios)
    tried = ((signals, end_ms) for scenario, _ in found for signals, end_ms in _beginnings(scenario.signals, inputs))
    for (signals, end_ms), _ in zip(tried, range(_MOST_ALONE), strict=False):
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
        held = (key for key, value in ends.items() if key in known and _is_let_go(known[key]) and value != known[key].rest)
        if next(held, None) is None:
            yield {name: kept for name, each in cut.items() if (kept := {s: p for s, p in each.items() if p})}, end


def _rounds(trials: Trials, signals: Signals, end_ms: float) -> int:
    """How often a channel changes after the end of the signals, each time after a wait."""
    run = run_source(trials.program, trials.ports, Scenario("undisturbed", end_ms + _ALONE_MS, signals, "generated"))
    trials.effort.add(run)
    seen: ChannelEvents = channel_events(run.trace, trials.ports, target=False)
    times = ([event.at_us / 1000 for event in events if event.at_us / 1000 > end_ms] for events, *_ in seen.values())
    return max((sum(after - before >= _ROUND_MS for before, after in pairwise(each)) for each in times), default=0)


def _try_settings(trials: Trials, inputs: Sequence[ScenarioInput]) -> None:
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
                if len(tried) >= _MOST_SETTINGS or trials.effort.has_spent(begun_s, _GROWTH_S):
                    return
                signals = {**parent, each.name: {**parent.get(each.name, {}), **constant(each, value)[each.name]}}
                if value == each.rest or signals in known or signals in tried:
                    continue
                tried.append(signals)
                look = trials.look(signals, trials.probe_ms + each.hold_ms)
                if look is not None and trials.is_new(look):
                    trials.try_signals(signals)
                    known.append(signals)


def _try_sequences(trials: Trials, inputs: Sequence[ScenarioInput], chance: random.Random) -> None:
    """Let events follow one another that lead the source further and further, as the digits of a code, and others behind them.

    Those are needed since a state shows in what follows it: a lock that is not locked again opens too soon.
    """
    events: list[_Event] = [(each, value) for each in inputs for value in each.values if value is not None and value != each.rest]
    if len(events) < 2 or not any(each.happens or _is_let_go(each) for each in inputs):
        return  # what is shown all the time is tried in other ways
    nearest: dict[tuple[int, bool], float] = {}
    grown: list[list[_Event]] = [[]]
    begun_s = trials.effort.spent_s
    untried = [chance.sample(events, len(events))]
    for _ in range(_MOST_SEQUENCES):
        open_ones = [number for number, left in enumerate(untried) if left]
        if not open_ones or trials.effort.has_spent(begun_s, _GROWTH_S):
            break
        parent = open_ones[-1] if chance.random() < _NEWEST else chance.choice(open_ones)
        sequence = [*grown[parent], untried[parent].pop()]
        signals, end_ms = _in_sequence(sequence)
        look = trials.look(signals, end_ms + _AFTER_MS) if end_ms < LONGEST_MS else None
        if look is not None and (_is_nearer(look.compared, nearest) or trials.is_new(look)):
            trials.ways |= look.told
            grown.append(sequence)
            untried.append(chance.sample(events, len(events)))
    for sequence in (max(grown, key=len), []) if len(grown) > 1 else ([],):
        if sequence == [] and trials.effort.has_spent(begun_s, _GROWTH_S):
            break
        while _in_sequence(sequence)[1] < _WALK_MS:
            sequence = [*sequence, chance.choice(events)]
        trials.try_until_steady(_attempts(trials, sequence, begun_s), at_any_phase=True)


def _attempts(trials: Trials, events: Sequence[_Event], begun_s: float) -> Iterator[tuple[Signals, float]]:
    """Events in sequence, and half of them twice as slowly if there is effort left."""
    for slower in (1, 2):
        if slower == 1 or not trials.effort.has_spent(begun_s, _GROWTH_S):
            signals, end_ms = _in_sequence(events[: len(events) // slower], slower)
            yield signals, min(end_ms + _AFTER_MS, LONGEST_MS)


def _in_sequence(events: Sequence[_Event], slower: int = 1) -> tuple[Signals, float]:
    """Signals in which events follow one another, and when the last one has ended.

    Args:
        events: what happens; a device that has a rest shows it between two events.
        slower: by how much longer than usual each one takes.
    """
    signals: dict[str, dict[str, Points]] = {}
    at_ms = FIRST_TEXT_MS
    for each, value in events:
        lasts = (_PRESS_MS if each.is_contact else each.hold_ms) * slower
        rests = _is_let_go(each)
        points: Points = ((at_ms, value), (at_ms + lasts, each.rest)) if rests else ((at_ms, value),)
        settings = signals.setdefault(each.name, {})
        settings[each.setting] = (*settings.get(each.setting, ()), *points)
        at_ms += (2 if rests else 1) * lasts
    return signals, at_ms


def _is_let_go(each: ScenarioInput) -> bool:
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
