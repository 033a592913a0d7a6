"""A search for scenarios: signals at the inputs of a program, kept if they reach what no other scenario has reached.

Counted are lines and branches of the source, and the goals of `scenario_goals`. The random generator has a seed; the search
ends when nothing new is reached for a while, or when its effort is used up (`search_effort`). Scenarios in which the source
differs from itself are dropped and counted, since nothing can be decided with them. Of the others, a small set is kept that
reaches everything that was reached.
"""

from __future__ import annotations

import math
import random
from collections.abc import Mapping, Sequence
from itertools import pairwise

from msgspec import Struct

from robosmi.data_text import Json
from robosmi.doing import doing
from robosmi.transformations.verification.original_side import LIMITS, Place, SourceRuns, places_reached, run_source, run_varied
from robosmi.transformations.verification.port_devices import BoundPort
from robosmi.transformations.verification.scenario_goals import (
    BESIDE,
    ENDS,
    GOALS,
    SERIES,
    VALUE,
    behaviour,
    beside,
    shown,
    values_told,
)
from robosmi.transformations.verification.scenario_inputs import (
    FIRST_TEXT_MS,
    LONGEST_MS,
    ScenarioInput,
    Signals,
    constant,
    in_turn,
    random_signals,
    scenario_inputs,
    series_points,
    together,
    turned,
)
from robosmi.transformations.verification.search_effort import SearchEffort
from robosmi.transformations.verification.simulated_kinds import device_facts
from robosmi.typed import distinct, replaced
from robosmi.verify.original_build import OriginalProgram
from robosmi.verify.original_run import OriginalRun
from robosmi.verify.scenario import Points, Scenario

_HORIZONS_MS = (3_000.0, 6_000.0, 12_000.0, 24_000.0)
_HORIZON_ALONE_MS = 48_000.0
"""A further horizon for a program without inputs, which has only one scenario, in milliseconds."""
_MOST = 120
"""At most this many scenarios are tried."""
_PATIENCE = 30
_RETRIES = 30
_MOST_BACKGROUNDS = 4
_MOST_SERIES = 8
_NUMBERS_SHARE = 0.5
"""Share of the effort after which no more numbers are typed."""
_PROBE_MS = 600.0
"""Initial length in ms of a probe, a short run that shows which way a program takes; a device's long holding time is added."""


class FoundScenarios(Struct):
    """The result of a search.

    Attributes:
        scenarios: the scenarios to verify with, each with its runs of the source.
        racy: how many were dropped because the source differs from itself.
        racy_counts: coverage counters of the dropped ones, for the branches that only they reach.
        least_racy: the first dropped one, in which least happens, with its nominal run.
        tried: how many were run.
    """

    scenarios: list[tuple[Scenario, SourceRuns]] = []
    racy: int = 0
    racy_counts: list[bytes] = []
    least_racy: tuple[Scenario, OriginalRun] | None = None
    tried: int = 0


def search(
    program: OriginalProgram,
    ports: Sequence[BoundPort],
    texts: Sequence[str],
    types: bool,
    seed: int,
    known: frozenset[Place] = frozenset(),
    budget_s: float = 240.0,
    steps: int = 0,
    numbers: Sequence[tuple[str, int]] = (),
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
        steps: the number of steps of a variable that the program tells apart.
        numbers: the numbers that the program compares with what is typed or sent, each with the text to type before it.
    """
    effort = SearchEffort(budget_s)
    made = _Search(program, ports, set(known), effort)
    inputs = scenario_inputs(ports, texts, types, steps)
    made.horizon = _horizon(program, ports, effort, _HORIZONS_MS + (() if inputs else (_HORIZON_ALONE_MS,)))
    made.try_rest()
    if inputs:
        made.find_probe()
    for each in inputs:
        for value in each.values:
            made.try_signals(constant(each, value))
    levels = [each for each in inputs if not any(isinstance(value, str) for value in each.values)]
    for number in range(max((len(each.values) for each in levels), default=0) if len(levels) > 1 else 0):
        made.try_signals(together(levels, number))
    made.try_ends(inputs)
    made.try_series(inputs)
    for each in inputs:
        if each.takes_text:
            made.try_numbers(each, numbers)
    inputs = [made.with_borders(each.with_ends()) for each in inputs]
    chance = random.Random(seed)
    while inputs and made.found.tried < _MOST and made.fruitless < _PATIENCE and not effort.is_over():
        made.try_signals(random_signals(inputs, made.horizon, chance))
    return _fewest(made.found, made.reached_by, known)


class _Search:
    """The state of a search: what was found and reached, and how many scenarios in a row have reached nothing new."""

    def __init__(self, program: OriginalProgram, ports: Sequence[BoundPort], seen: set[Place], effort: SearchEffort) -> None:
        self.program = program
        self.ports = ports
        self.seen = seen
        self.effort = effort
        self.horizon = 0.0
        self.probe_ms = _PROBE_MS
        self.fruitless = 0
        self.found = FoundScenarios()
        self.reached_by: list[frozenset[Place]] = []
        self.only_racy: set[Place] = set()
        self.retried = 0
        self.at_rest: dict[str, list[str]] = {}

    def try_signals(
        self, signals: Mapping[str, Mapping[str, Points]], also: frozenset[Place] = frozenset(), horizon: float = 0.0
    ) -> frozenset[Place]:
        """Run a scenario, and keep it if it is new and not racy; returns the places that it reaches, with `also`."""
        found = self.found
        doing(f"look for scenarios: {found.tried} tried, {len(found.scenarios)} kept")
        if found.tried and self.effort.is_over():
            return frozenset()
        found.tried += 1
        scenario = Scenario(f"generated {found.tried}", horizon or self.horizon, signals, "generated")
        run = run_source(self.program, self.ports, scenario)
        self.effort.add(run)
        if found.tried == 1:
            self.at_rest = shown(run, self.ports)
        if any(place[0] in (ENDS, SERIES) for place in also) and shown(run, self.ports) == self.at_rest:
            also = frozenset()  # the program does not react to it
        places = places_reached(self.program, run, self.ports) | behaviour(run, self.ports) | also
        self.fruitless += 1
        if found.scenarios and places <= self.seen:
            return places
        first = not found.scenarios and not found.racy  # kept even if it reaches nothing: the verdict says why
        if not first and places <= self.seen | self.only_racy and not self._worth_another(places):
            return places
        runs = run_varied(self.program, self.ports, scenario, run, until_racy=True)
        self.effort.add(run, len(runs.varied))
        if runs.given_up and not first:
            return places
        if runs.given_up:  # other scenarios would be given up as well
            self.effort.given_up = True
        elif runs.racy_channels or runs.unsteady:
            found.least_racy = found.least_racy or (scenario, run)
            found.racy += 1
            found.racy_counts.append(run.counts)
            self.only_racy |= places - self.seen
            return places
        self.seen |= places
        self.fruitless = 0
        found.scenarios.append((scenario, runs))
        self.reached_by.append(places)
        return places

    def _worth_another(self, places: frozenset[Place]) -> bool:
        """Whether to vary a scenario that only reaches what racy ones did: places of the source are, some times."""
        self.retried += any(place[0] not in GOALS for place in places - self.seen)
        return self.retried <= _RETRIES and any(place[0] not in GOALS for place in places - self.seen)

    def try_rest(self) -> None:
        """Try the scenario without signals, with ever shorter horizons as long as the source differs from itself."""
        self.try_signals({})
        for shorter in reversed([each for each in _HORIZONS_MS if each < self.horizon]):
            if self.found.scenarios or not self.found.racy or self.effort.is_over():
                return
            self.horizon = shorter
            self.only_racy.clear()
            self.try_signals({})

    def find_probe(self) -> None:
        """Lengthen the probe until a run without signals reaches in it all that it reaches up to the horizon."""
        wanted = self._at_rest(self.horizon)
        while self.probe_ms < self.horizon and not wanted <= self._at_rest(self.probe_ms) and not self.effort.is_over(0.25):
            self.probe_ms *= 2

    def _at_rest(self, horizon_ms: float) -> frozenset[Place]:
        """The places that a run without signals reaches."""
        run = run_source(self.program, self.ports, Scenario("rest", horizon_ms))
        self.effort.add(run)
        return places_reached(self.program, run, self.ports)

    def try_ends(self, inputs: Sequence[ScenarioInput]) -> None:
        """Try the least and the greatest values that each device measures."""
        for name in distinct(each.name for each in inputs if each.ends):
            its = [each for each in inputs if each.name == name and each.ends]
            for end in (0, -1):
                signals = {setting: points for each in its for setting, points in constant(each, each.ends[end])[name].items()}
                self.try_signals({name: signals}, frozenset([(ENDS, name, end)]))

    def try_series(self, inputs: Sequence[ScenarioInput]) -> None:
        """Try the series of each input, and knobs made of two contacts."""
        for each in [each for each in inputs if each.series][:_MOST_SERIES]:
            self._try_in_series(each, (SERIES, each.name, each.setting), (1, 2, 4))
        contacts = [each for each in inputs if each.is_contact and each.series][:_MOST_SERIES]
        for one, other in pairwise(contacts):
            for backwards in (False, True):
                self.try_signals(turned(one, other, backwards))

    def try_numbers(self, each: ScenarioInput, numbers: Sequence[tuple[str, int]]) -> None:
        """Let an input give the numbers around each one at which the source takes another way.

        If the source takes the same ways after several texts in front of a number, as if it ignores them, the first text is
        enough.
        """
        known: set[tuple[int, frozenset[Place]]] = set()
        for before, number in numbers:
            if self.effort.is_over(_NUMBERS_SHARE):
                return
            texts = [f"{before}{number + more}\r" for more in (-1, 0, 1)]
            ways = [self._probe(each, text, {}) for text in texts]
            apart = frozenset().union(*ways) - ways[0].intersection(*ways)
            if apart and (number, apart) not in known:
                known.add((number, apart))
                there: Place = (BESIDE, each.name, each.setting, texts[1])
                self._try_in_series(replaced(each, series=tuple(texts)), there, (4, 16))

    def _try_in_series(self, each: ScenarioInput, goal: Place, slower: Sequence[int]) -> None:
        """Try an input's series, with values held longer and longer by the factors `slower` as long as the scenario is racy."""
        for times in slower:
            points, racy = series_points(each, times), self.found.racy
            ends_ms = min(LONGEST_MS, 1000 * math.ceil(points[-1][0] / 1000 + 1)) if points else 0.0
            self.try_signals({each.name: {each.setting: points}}, frozenset([goal]), max(self.horizon, ends_ms))
            if self.found.racy == racy:
                break

    def with_borders(self, each: ScenarioInput) -> ScenarioInput:
        """Find by bisection where the source's way changes between two values of an input.

        Some behaviour shows only at the border itself, such as that of a count that equals a limit, and faults that move a
        border show beside it: the input gets these values as well, and a scenario that goes from one side to the other is
        tried.
        """
        values = list(each.values)
        for background in self._backgrounds(each):
            values += [value for value in self._borders(each, background) if value not in values]
        return replaced(each, values=tuple(values))

    def _backgrounds(self, each: ScenarioInput) -> list[Signals]:
        """Constant signals of the other inputs while borders are sought: none, and those of the scenarios that were kept."""
        found: list[Signals] = [{}]
        for scenario, _ in self.found.scenarios:
            others = {name: settings for name, settings in scenario.signals.items() if name != each.name}
            steady = all(len(points) == 1 and points[0][0] == 0 for settings in others.values() for points in settings.values())
            if steady and others not in found:
                found.append(others)
        return found[:_MOST_BACKGROUNDS]

    def _borders(self, each: ScenarioInput, background: Signals) -> list[float]:
        """The values at both sides of each border that is found with a background of other signals."""
        numbers = sorted({v for v in each.values if isinstance(v, (int, float)) and not isinstance(v, bool)})
        ways = {value: self._probe(each, value, background) for value in numbers} if len(numbers) > 2 else {}
        facts = device_facts().get(each.device, {})
        smallest = float(facts.get("finest", 1.0))
        values: list[float] = []
        for low, high in pairwise(numbers if ways else []):
            begin, end = float(low), float(high)
            if ways[low] == ways[high]:
                continue
            while end - begin > max(smallest, 0.001 * end) and not self.effort.is_over():
                middle = round((begin + end) / 2 / smallest) * smallest
                if not begin < middle < end:
                    break
                places = self._probe(each, middle, background)
                if not {place for place in places if place[0] != VALUE} <= self.seen | self.only_racy:
                    self.only_racy |= self.try_signals({**background, **constant(each, middle)}) - self.seen
                begin, end = (middle, end) if places == ways[low] else (begin, middle)
            sides = [round(value, 1) for value in beside(end, facts, each.near)]
            values += sides
            there: Place = (BESIDE, each.name, each.setting, round(end))
            turns = {each.name: {each.setting: in_turn(each, [*sides, sides[0]], self.horizon)}}
            self.try_signals({**background, **turns}, frozenset([there]))
        return values

    def _probe(self, each: ScenarioInput, value: Json, background: Signals) -> frozenset[Place]:
        """The places that a short run with one value reaches, and the values that it shows; empty if the search is over."""
        if self.effort.is_over():
            return frozenset()
        lasts = self.probe_ms + (FIRST_TEXT_MS if each.happens else each.hold_ms if each.hold_ms > 1000 else 0)
        scenario = Scenario("probe", min(self.horizon, lasts), {**background, **constant(each, value)})
        run = run_source(self.program, self.ports, scenario)
        self.effort.add(run)
        return places_reached(self.program, run, self.ports) | values_told(run, self.ports)


def _horizon(
    program: OriginalProgram, ports: Sequence[BoundPort], effort: SearchEffort, horizons: Sequence[float] = _HORIZONS_MS
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
