"""Runs the migrated program in each scenario, and compares it with what the original has done there.

Of each run of the migrated program only the events of the channels are kept, since a trace may have some hundred thousand
edges: only the traces of the runs in progress are in memory.

A scenario in which the migrated program differs gets a second look: does the source differ from itself there as well? The few
varied runs of a scenario are a sample. If an input changes just beside the instant at which the program reads it, only some of
them, by chance, see it at the next read; the same holds for the servo frame in which a new speed takes effect. So further runs
are made, and the difference counts only if they do not show it themselves. Nor does it count if the target does, on all channels
that differ, what the source does if it sees its inputs a pass of its loop earlier or later.

A second look costs more than all other runs of its scenario. So where it has confirmed a difference, further stored scenarios in
which nothing else differs get none: they cannot change the verdict. Generated ones do, since those that are racy are not stored.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from msgspec import Struct
from msgspec.structs import replace

from robosmi.base.progress_events import announce
from robosmi.errors import VerificationError
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.judgement.after_the_end import simulated_longer
from robosmi.transformations.verification.judgement.side_effects import NO_LEVELS
from robosmi.transformations.verification.judgement.verdict import SAME_MS, ended_badly, verdict_of, without_target
from robosmi.transformations.verification.loop_pass import hangs_on_a_pass
from robosmi.transformations.verification.original_side import CONSOLE_CHANNEL, SourceRuns, channel_events, run_further
from robosmi.transformations.verification.stored_bytes import EEPROM_CHANNEL
from robosmi.transformations.verification.target_side import EMPTY_TRACE, LIMIT_S, TargetSide
from robosmi.verify.original import Original
from robosmi.verify.scenario import Scenario
from robosmi.verify.simulation import PinTrace
from robosmi.verify.traces.activity import ActivityEvent
from robosmi.verify.traces.alignment import alike
from robosmi.verify.traces.comparison import DIFFERENT, RACY, SAME, ChannelComparison
from robosmi.verify.traces.verdict import DIFFERENT_VERDICT, NOT_DECIDABLE, ScenarioVerdict

Case = tuple[Scenario, SourceRuns]
_HANGS_ON_A_PASS = (
    "an input changes during a pass of the loop: the migrated program does what the original does if it reads the input a pass "
    "earlier or later; change the input at another time"
)


class ComparedScenario(Struct):
    """A scenario that was compared.

    Attributes:
        told: the verdict on it.
        runs: the original's runs.
        target: channel -> the events of the migrated program.
        trace: its whole trace, if that was asked for.
    """

    told: ScenarioVerdict
    runs: SourceRuns
    target: dict[str, list[ActivityEvent]]
    trace: PinTrace | None = None


class ComparedScenarios(Struct):
    """The results of all scenarios.

    Attributes:
        kept: the scenarios that were compared.
        racy: generated scenarios that were dropped because a second look shows that the source differs from itself there.
        undecided: the errors because of which a run of the migrated program is not known and a verdict is not possible.
    """

    kept: list[ComparedScenario] = []
    racy: list[Case] = []
    undecided: list[VerificationError] = []


def compare_scenarios(
    program: Original, ports: Sequence[BoundPort], cases: Sequence[Case], side: TargetSide, one_thread: bool,
    at_rest: Mapping[str, int], whole: bool = False,
) -> ComparedScenarios:  # fmt: skip
    """Run the migrated program in each scenario, and compare what both do.

    Args:
        program: the original.
        ports: the ports.
        cases: the scenarios with the original's runs.
        side: the migrated program on its board.
        one_thread: whether a single thread of the source does all that is observed.
        at_rest: the pins that the migrated program holds so that the component there does nothing, with their levels.
        whole: whether to keep the whole traces of the migrated program.
    """

    def further(scenario: Scenario, runs: SourceRuns) -> SourceRuns:
        announce(f"check that the original is repeatable in '{scenario.name}'")
        return run_further(program, ports, scenario, runs, LIMIT_S)

    def apart(scenario: Scenario, runs: SourceRuns, differs_at: Callable[[SourceRuns], float | None]) -> bool:
        return hangs_on_a_pass(program, ports, scenario, runs, LIMIT_S, differs_at)

    found = ComparedScenarios()
    confirmed: set[str] = set()  # channels
    number = 0
    for (scenario, runs), trace in zip(cases, side.run([simulated_longer(*case) for case in cases]), strict=True):
        number += 1
        announce(f"compare both programs: {number} of {len(cases)}")
        if not side.shows_console:
            runs.channels.pop(CONSOLE_CHANNEL, None)
        if isinstance(trace, PinTrace) and not (trace.store_bytes and program.store_bytes):
            runs.channels.pop(EEPROM_CHANNEL, None)
        if isinstance(trace, VerificationError):
            told, seen = without_target(scenario, runs, trace), EMPTY_TRACE
            found.undecided += [] if ended_badly(runs) else [trace]
        else:
            first, seen = verdict_of(scenario, runs, trace, ports, one_thread, at_rest), trace
            differ = _channels_that_differ(first)
            told = first
            if scenario.origin == "generated" or not differ or not differ <= confirmed:
                told = looked_at_again(first, scenario, trace, ports, one_thread, runs, further, at_rest, apart)
                confirmed |= _channels_that_differ(told)
            if told is not first and told.verdict == NOT_DECIDABLE and scenario.origin == "generated":
                found.racy.append((scenario, runs))
                continue
        target = {name: events for name, (events, *_) in channel_events(seen, ports, target=True).items()}
        found.kept.append(ComparedScenario(told, runs, target, seen if whole else None))
    return found


# ---- a second look


def looked_at_again(
    told: ScenarioVerdict,
    scenario: Scenario,
    trace: PinTrace,
    ports: Sequence[BoundPort],
    one_thread: bool,
    runs: SourceRuns,
    further: Callable[[Scenario, SourceRuns], SourceRuns],
    at_rest: Mapping[str, int] = NO_LEVELS,
    apart: Callable[[Scenario, SourceRuns, Callable[[SourceRuns], float | None]], bool] | None = None,
) -> ScenarioVerdict:
    """The verdict on a scenario, with further runs of the source if it is a difference.

    Args:
        told: the verdict from the runs so far.
        scenario: the scenario.
        trace: the run of the migrated program.
        ports: the ports.
        one_thread: whether a single thread of the source does all that is observed.
        runs: the runs of the source.
        further: adds further runs of the source.
        at_rest: the pins that the migrated program holds so that the component there does nothing, with their levels.
        apart: whether the source does what the target did if it sees its inputs a pass earlier or later.
    """
    first = told.first
    if told.verdict != DIFFERENT_VERDICT or first is None or told.crash is not None:
        return told
    more = further(scenario, runs)
    again = verdict_of(scenario, more, trace, ports, one_thread, at_rest)
    selves = [each.itself for each in again.channels if each.channel == first.channel]
    itself = selves[0] if selves else None
    if again.verdict == DIFFERENT_VERDICT and apart is not None:
        differ = _channels_that_differ(again)
        target = channel_events(trace, ports, target=True)

        def events_of(channel: str, each: SourceRuns) -> tuple[Sequence[ActivityEvent], Sequence[ActivityEvent]]:
            if channel not in each.channels or channel not in target:  # compared beside the channels: pauses, foreign pins
                return (), ()
            return each.channels[channel][0][0], target[channel][0]

        def differs_at(each: SourceRuns) -> float | None:
            other = verdict_of(scenario, each, trace, ports, one_thread, at_rest)
            left = [c for c in other.channels if c.channel in differ and c.status != SAME]
            if differ <= {c.channel for c in other.channels} and not left:
                return None
            return min((_agrees_until(c, *events_of(c.channel, each)) for c in left), default=0.0)

        if apart(scenario, runs, differs_at):
            return ScenarioVerdict(scenario, NOT_DECIDABLE, _without_differences(again), again.simulated_ms, _HANGS_ON_A_PASS)
    if itself is None or again.verdict == DIFFERENT_VERDICT:
        return again
    until_ms = first.at_ms
    if first.source is not None and first.target is not None and alike(first.source, first.target):  # only its duration differs
        events = more.channels[first.channel][0][0]
        later_ms = [event.at_us / 1000 for event in events if event.at_us / 1000 > first.at_ms]
        until_ms = min(later_ms) if later_ms else scenario.horizon_ms
    return again if itself.at_ms <= until_ms + SAME_MS else told  # a later one explains nothing


def _channels_that_differ(told: ScenarioVerdict) -> set[str]:
    return {each.channel for each in told.channels if each.status == DIFFERENT}


def _agrees_until(channel: ChannelComparison, source: Sequence[ActivityEvent], target: Sequence[ActivityEvent]) -> float:
    """Until when two runs agree on a channel, in milliseconds: where only a duration differs, until the shorter one ends."""
    found = channel.difference
    if found is None:
        return 0.0
    if found.source is None or found.target is None or not alike(found.source, found.target):
        return found.at_ms
    begin_us, late_us = sorted((found.source.at_us, found.target.at_us))
    if late_us - begin_us > SAME_MS * 1000:
        return found.at_ms
    return min((event.at_us / 1000 for event in (*source, *target) if event.at_us > late_us), default=found.at_ms)


def _without_differences(told: ScenarioVerdict) -> tuple[ChannelComparison, ...]:
    """The channels of a verdict, with those that differ as racy."""
    return tuple(replace(c, status=RACY, difference=None) if c.status == DIFFERENT else c for c in told.channels)
