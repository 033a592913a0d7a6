"""The runs of a search for scenarios: what was found, what is reached, and for how long nothing new was."""

from __future__ import annotations

import math
import random
from collections.abc import Iterable, Sequence

from msgspec import Struct

from robosmi.base.progress_events import announce
from robosmi.transformations.verification.bound_devices.played_devices import brief_pins, played
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.bound_devices.varied_devices import moved_devices
from robosmi.transformations.verification.original_side import (
    ChannelEvents,
    Place,
    SourceRuns,
    channel_events,
    compared,
    places_reached,
    run_source,
    run_varied,
)
from robosmi.transformations.verification.search.branch_thresholds import Look, look_of
from robosmi.transformations.verification.search.scenario_goals import (
    ENDS,
    GOALS,
    SERIES,
    behaviour,
    final_values,
    shown,
    shown_values,
)
from robosmi.transformations.verification.search.scenario_inputs import Signals, is_steady
from robosmi.transformations.verification.search.search_effort import SearchEffort
from robosmi.verify.original import Original, OriginalRun
from robosmi.verify.scenario import Scenario
from robosmi.verify.traces.comparison import DIFFERENT

_RETRIES = 30
_FEW_CHANGING = 3
_PHASES_MS = (-38.0, -25.0, -13.0, 13.0, 25.0, 38.0)
"""Less than what the time of an event may differ by."""
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
        repeatable: whether the same search finds the same on any machine: no clock has ended it.
        cut: whether its budget or the clock has ended it though it had more to try.
        seconds: how long it took, by the clock.
    """

    scenarios: list[tuple[Scenario, SourceRuns]] = []
    racy: int = 0
    racy_counts: list[bytes] = []
    least_racy: tuple[Scenario, OriginalRun] | None = None
    tried: int = 0
    repeatable: bool = True
    cut: bool = False
    seconds: float = 0.0


class Trials:
    """The state of a search: what was found and reached, and how many scenarios in a row have reached nothing new."""

    def __init__(self, program: Original, ports: Sequence[BoundPort], seen: set[Place], effort: SearchEffort) -> None:
        self.program = program
        self.ports = ports
        self.seen = seen
        self.effort = effort
        self.horizon = 0.0
        self.longest_ms = math.inf
        self.probe_ms = _PROBE_MS
        self.fruitless = 0
        self.found = FoundScenarios()
        self.reached_by: list[frozenset[Place]] = []
        self.only_racy: set[Place] = set()
        self.retried = 0
        self.at_rest: dict[str, list[str]] = {}
        self.ways: set[Place] = set()

    def try_signals(
        self,
        signals: Signals,
        also: frozenset[Place] = frozenset(),
        horizon: float = 0.0,
        at_any_phase: bool = False,
    ) -> frozenset[Place]:
        """Run a scenario, and keep it if it reaches what no other does and is not racy.

        Args:
            signals: what the inputs show.
            also: goals that it has beside what it reaches.
            horizon: how long it lasts; as long as all do if 0.
            at_any_phase: whether the source must do the same wherever its loops are when the inputs change. A long row of events
                meets a program that polls at all places of its loop, and one on another board at others.

        Returns:
            What it reaches, and `also`.
        """
        found = self.found
        left = f"at most {self.effort.left_s:.0f} s left"
        announce(f"search for test cases: {found.tried} tried, {len(found.scenarios)} selected, {left}")
        if found.tried and self.effort.is_over():
            return frozenset()
        found.tried += 1
        scenario = Scenario(f"generated {found.tried}", min(horizon or self.horizon, self.longest_ms), signals, "generated")
        run = run_source(self.program, self.ports, scenario)
        self.effort.add(run)
        seen = channel_events(run.trace, self.ports, target=False)
        if found.tried == 1:
            self.at_rest = shown(seen)
        if any(place[0] in (ENDS, SERIES) for place in also) and shown(seen) == self.at_rest:
            also = frozenset()  # the program does not react to it
        self.ways |= self._look_of(run, seen).told
        places = places_reached(self.program, run, self.ports, seen) | behaviour(seen) | also
        self.fruitless += 1
        if found.scenarios and places <= self.seen:
            return places
        first = not found.scenarios and not found.racy  # kept even if it reaches nothing: the verdict says why
        if not first and places <= self.seen | self.only_racy and not self._worth_another(places):
            return places
        runs = run_varied(self.program, self.ports, scenario, run, until_racy=True, own=seen)
        self.effort.add(run, len(runs.varied))
        if runs.given_up and not first:
            return places
        if runs.given_up:  # other scenarios would be given up as well
            self.effort.given_up = True
        elif runs.nondeterministic_channels or runs.unsteady or (at_any_phase and self._hangs_on_phase(scenario, runs)):
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

    def try_until_steady(
        self, attempts: Iterable[tuple[Signals, float]], also: frozenset[Place] = frozenset(), at_any_phase: bool = False
    ) -> None:
        """Try signals with their horizons, each slower than the one before, up to the first that is not racy."""
        for signals, horizon in attempts:
            racy = self.found.racy
            self.try_signals(signals, also, horizon, at_any_phase)
            if self.found.racy == racy:
                return

    def _hangs_on_phase(self, scenario: Scenario, runs: SourceRuns) -> bool:
        """Whether the source would be called different from itself if all inputs changed a little earlier or later."""
        devices = played(self.ports, scenario, target=False)
        for shift in _PHASES_MS:
            moved = moved_devices(devices, random.Random(0), shift)
            run = self.program.run(scenario.horizon_ms * 1000, moved, brief=brief_pins(self.ports, target=False))
            self.effort.add(run)
            seen = channel_events(run.trace, self.ports, target=False)
            for name, source in runs.channels.items():
                if compared(name, source, seen[name], scenario.horizon_ms, runs.loop).status == DIFFERENT:
                    return True
        return False

    def _worth_another(self, places: frozenset[Place]) -> bool:
        """Whether to vary a scenario that only reaches what racy ones did: some times, for places of the source.

        As long as inputs change in few scenarios, what follows one another is worth it, too: where no switch changes, a program
        that waits for minutes between two looks at it does not differ.
        """
        missing = places - self.seen
        if sum(not is_steady(scenario.signals) for scenario, _ in self.found.scenarios) >= _FEW_CHANGING:
            missing = frozenset(place for place in missing if place[0] not in GOALS)
        self.retried += bool(missing)
        return self.retried <= _RETRIES and bool(missing)

    def look(self, signals: Signals, horizon_ms: float) -> Look | None:
        """What a short run tells of the way that the program goes; None when the search is over."""
        run = self._looked_at(signals, horizon_ms)
        return None if run is None else self._look_of(run, channel_events(run.trace, self.ports, target=False))

    def left_in(self, signals: Signals, horizon_ms: float) -> dict[str, str] | None:
        """What each channel does at the end of a short run; None when the search is over."""
        run = self._looked_at(signals, horizon_ms)
        return None if run is None else final_values(channel_events(run.trace, self.ports, target=False))

    def _looked_at(self, signals: Signals, horizon_ms: float) -> OriginalRun | None:
        if self.effort.is_over():
            return None
        run = run_source(self.program, self.ports, Scenario("look", horizon_ms, signals))
        self.effort.add(run)
        return run

    def is_new(self, look: Look) -> bool:
        """Whether a run has gone where no scenario has gone yet."""
        return not look.told <= self.ways

    def takes_new_edge(self, look: Look) -> bool:
        """Whether a run has taken an edge of the flow that no scenario has taken yet."""
        return any(len(place) == 1 for place in look.told - self.ways)

    def _look_of(self, run: OriginalRun, seen: ChannelEvents) -> Look:
        edges = self.program.reached(run.counts) if run.counts else frozenset()
        return look_of(shown_values(seen), edges, run.compared)
