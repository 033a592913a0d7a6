"""Runs the migrated program in each scenario, and compares it with what the original has done there.

Of each run of the migrated program only the events of the channels are kept, since a trace may have some hundred thousand
edges: only the traces of the runs in progress are in memory.

A scenario in which the migrated program differs gets a second look: does the source differ from itself there as well? The few
varied runs of a scenario are a sample. If an input changes just beside the instant at which the program reads it, only some of
them, by chance, see it at the next read; the same holds for the servo frame in which a new speed takes effect. So further runs
are made, and the difference counts only if they do not show it themselves. Nor does it count if the target does, on all
channels that differ, what the source does if it sees its inputs a pass of its loop earlier or later.

A program that polls sees a change of an input at its next read. Where the change is just beside a read, one board sees it a
pass earlier than the other, and neither is wrong. Moving all inputs by a pass of the source's own loop gives the run that the
other board should have made: only if that is what the target did is the difference one of the instant alone. Each of several
changes may be seen earlier or later.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import pairwise

from msgspec import Struct
from msgspec.structs import replace

from robosmi.base.progress_events import announce
from robosmi.errors import VerificationError
from robosmi.transformations.verification.bound_devices.played_devices import brief_pins, played
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.bound_devices.varied_devices import MOVED_MS, late_devices
from robosmi.transformations.verification.judgement.after_the_end import simulated_longer
from robosmi.transformations.verification.judgement.side_effects import NO_LEVELS
from robosmi.transformations.verification.judgement.verdict import SAME_MS, ended_badly, verdict_of, without_target
from robosmi.transformations.verification.original_side import CONSOLE_CHANNEL, SETTLED, SourceRuns, channel_events, run_further
from robosmi.transformations.verification.pause_comparison import observed_pauses
from robosmi.transformations.verification.rest_comparison import observed_rests
from robosmi.transformations.verification.stored_bytes import EEPROM_CHANNEL
from robosmi.transformations.verification.target_side import EMPTY_TRACE, LIMIT_S, TargetSide
from robosmi.verify.original import LibraryCall, Original, OriginalRun
from robosmi.verify.scenario import Scenario
from robosmi.verify.simulation import PinTrace
from robosmi.verify.traces.activity import READING, ActivityEvent
from robosmi.verify.traces.alignment import alike, numbers_of, shape_of
from robosmi.verify.traces.comparison import DIFFERENT, RACY, SAME, ChannelComparison
from robosmi.verify.traces.verdict import DIFFERENT_VERDICT, NOT_DECIDABLE, ScenarioVerdict

Case = tuple[Scenario, SourceRuns]
_HANGS_ON_A_PASS = (
    "an input changes during a pass of the loop: the migrated program does what the original does if it reads the input a pass "
    "earlier or later; change the input at another time"
)

_Range = tuple[float, float]
_Ranges = tuple[_Range | None, ...]
_FEWEST_PASSES = 4
_LONGEST_PASS_MS = 200.0
"""A loop with longer passes is not taken for one that polls its inputs, in milliseconds."""
_PARTS = (1.0, -1.0, 2 / 3, -2 / 3, 1 / 3, -1 / 3)
"""By which parts of a pass inputs are moved: the loops of two boards may stand anywhere in theirs when an input changes."""
_BESIDE = 3
"""How many changes may be the cause of a difference: an event ends, or begins, with one of those next to its beginning."""


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
            told = looked_at_again(first, scenario, trace, ports, one_thread, runs, further, at_rest, apart)
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
        differ = {each.channel for each in again.channels if each.status == DIFFERENT}

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


def longest_pass_ms(calls: Iterable[LibraryCall]) -> float:
    """The longest time between two calls from one place, which is how late a program that polls may see a change; 0 without."""
    places: dict[tuple[str, str, int], list[float]] = {}
    for call in calls:
        places.setdefault((call.function, call.file, call.line), []).append(call.at_us / 1000)
    often = (times for times in places.values() if len(times) > _FEWEST_PASSES)
    between = (after - before for times in often for before, after in pairwise(times))
    return max((each for each in between if each <= _LONGEST_PASS_MS), default=0.0)


def hangs_on_a_pass(
    program: Original,
    ports: Sequence[BoundPort],
    scenario: Scenario,
    runs: SourceRuns,
    limit_s: float,
    differs_at: Callable[[SourceRuns], float | None],
) -> bool:
    """Whether the source does what the target did if it sees the inputs of a scenario up to a pass of its loop earlier or later.

    First all changes are moved alike, then, at each difference that is left, one of those beside it.

    Args:
        program: the original.
        ports: its ports.
        scenario: the scenario.
        runs: its runs so far.
        limit_s: seconds of processor time for each run.
        differs_at: when the target first differs from a run of the source, in milliseconds; None if it does not.
    """
    points = (point for settings in scenario.signals.values() for points in settings.values() for point in points)
    changes = sorted({float(at_ms) for at_ms, _ in points if float(at_ms) > 0})
    if not changes:
        return False
    devices, until_us = played(ports, scenario, target=False), scenario.horizon_ms * 1000
    pass_ms = longest_pass_ms(program.calls(devices, 0, until_us, limit_s))
    if pass_ms <= MOVED_MS:  # the varied runs of the scenario are moved as far
        return False

    def found_at(moved: Mapping[float, float]) -> float | None:
        if sorted(changes, key=lambda at_ms: at_ms + moved.get(at_ms, 0.0)) != changes:
            return 0.0  # a change does not pass another
        run = program.run(until_us, late_devices(devices, moved), limit_s=limit_s, brief=brief_pins(ports, target=False))
        return differs_at(_as_runs(run, ports, runs)) if run.status in SETTLED else 0.0

    if any(found_at(dict.fromkeys(changes, part * pass_ms)) is None for part in _PARTS):
        return True
    moved: dict[float, float] = {}
    at_ms = found_at(moved)
    while at_ms is not None:
        tries = ({**moved, change: part * pass_ms} for change in _beside(changes, moved, at_ms) for part in _PARTS)
        best, agrees_ms = moved, at_ms
        for each in tries:
            if (later_ms := found_at(each)) is None:
                return True
            if later_ms > agrees_ms:
                best, agrees_ms = each, later_ms
        if best is moved:
            return False
        moved, at_ms = best, agrees_ms
    return True


def _beside(changes: Iterable[float], moved: Mapping[float, float], at_ms: float) -> list[float]:
    """The changes next to a time that are not moved yet."""
    return sorted((each for each in changes if each not in moved), key=lambda each: abs(each - at_ms))[:_BESIDE]


def _as_runs(run: OriginalRun, ports: Sequence[BoundPort], runs: SourceRuns) -> SourceRuns:
    """A run of the source on the channels of others."""
    seen = channel_events(run.trace, ports, target=False)
    channels = {
        name: [[_as_exact(events, runs.channels[name][sight][0])] for sight, events in enumerate(sights)]
        for name, sights in seen.items()
        if name in runs.channels
    }
    rests = {name: [each] for name, each in observed_rests(run.trace, ports, target=False).items()}
    pauses = {name: [each] for name, each in observed_pauses(run.trace, ports, target=False).items()}
    return SourceRuns(run, (), channels, loop=runs.loop, rests=rests, pauses=pauses)


def _as_exact(events: Sequence[ActivityEvent], known: Sequence[ActivityEvent]) -> list[ActivityEvent]:
    """Events whose numbers are as exact as those of another run: all, but for what is measured in lines of the same shape there.

    A measured number lies in the range that lines of the same text have there. Nothing is known of another text, so it is exact.

    Args:
        events: the events.
        known: those of the run of which it is known which numbers are measured.
    """
    exact: dict[str, tuple[bool, ...]] = {}
    between: dict[str, _Ranges] = {}
    for event in known:
        if event.kind == READING:
            shape, text, many = shape_of(event), str(event.value[0]), len(numbers_of(event))
            own = event.exact or (False,) * many
            exact[shape] = tuple(map(min, own, exact.get(shape, own)))
            ranges = event.between or (None,) * many
            between[text] = tuple(map(_widest, ranges, between.get(text, ranges)))
    return [
        replace(
            event,
            exact=exact[shape_of(event)] if str(event.value[0]) in between else (True,) * len(numbers_of(event)),
            between=between.get(str(event.value[0]), ()),
        )
        if event.kind == READING
        else event
        for event in events
    ]


def _widest(one: _Range | None, other: _Range | None) -> _Range | None:
    return None if one is None or other is None else (min(one[0], other[0]), max(one[1], other[1]))
