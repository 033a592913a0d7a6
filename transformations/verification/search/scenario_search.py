"""A search for scenarios: signals at the inputs of a program, kept if they reach what no other scenario has reached.

Counted are lines and branches of the source, and the goals of `scenario_goals`. The random generator has a seed; the search
ends when nothing new is reached for a while, or when its effort is used up (`search_effort`). Scenarios in which the source
differs from itself are dropped and counted, since nothing can be decided with them. Of the others, a small set is kept that
reaches everything that was reached.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from itertools import pairwise

from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.original_side import LIMITS, Place, places_reached, run_source
from robosmi.transformations.verification.search.combination_search import try_sequences, try_settings
from robosmi.transformations.verification.search.scenario_goals import ENDS, SERIES
from robosmi.transformations.verification.search.scenario_inputs import (
    ScenarioInput,
    constant,
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
from robosmi.transformations.verification.search.undisturbed_search import try_undisturbed
from robosmi.verify.original import Original
from robosmi.verify.scenario import Scenario

_HORIZONS_MS = (3_000.0, 6_000.0, 12_000.0, 24_000.0)
_HORIZON_ALONE_MS = 48_000.0
"""A further horizon for a program without inputs, which has only one scenario, in milliseconds."""
_MOST = 120
"""At most this many scenarios are tried."""
_PATIENCE = 30
_MOST_SERIES = 8


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
    try_settings(made, inputs)
    try_durations(made, [each for each in inputs if each.is_contact and each.rest in each.values][:_MOST_SERIES])
    for each in inputs:
        if each.takes_text:
            try_numbers(made, each, numbers)
    chance = random.Random(seed)
    try_sequences(made, inputs, chance)
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
