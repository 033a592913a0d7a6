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

A difference that the tolerances of a polling program hide gets such a look as well. A program that waits 420 ms instead of 300
after a switch differs by less than twice what runs of the source differ by, if one of them sees the switch a pass later. But it
does what no run of the source does, wherever in its loop the switch changes.

A second look costs more than all other runs of its scenario. So where it has confirmed a difference, further stored scenarios in
which nothing else differs get none: they cannot change the verdict. Generated ones do, since those that are racy are not stored.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import pairwise

from msgspec import Struct
from msgspec.structs import replace

from robosmi.base.data_text import as_number
from robosmi.base.progress_events import announce
from robosmi.errors import VerificationError
from robosmi.transformations.verification.bound_devices.played_devices import brief_pins, played
from robosmi.transformations.verification.bound_devices.port_devices import LEVELS_DEVICE, BoundPort
from robosmi.transformations.verification.bound_devices.varied_devices import MOVED_MS, late_devices
from robosmi.transformations.verification.judgement.after_the_end import simulated_longer
from robosmi.transformations.verification.judgement.side_effects import NO_LEVELS
from robosmi.transformations.verification.judgement.verdict import (
    SAME_MS,
    costs_ms,
    ended_badly,
    first_late_reaction,
    verdict_of,
    without_target,
)
from robosmi.transformations.verification.original_side import (
    CONSOLE_CHANNEL,
    MEASURED,
    SETTLED,
    SourceRuns,
    channel_events,
    run_further,
)
from robosmi.transformations.verification.pause_comparison import observed_pauses
from robosmi.transformations.verification.rest_comparison import observed_rests
from robosmi.transformations.verification.stored_bytes import EEPROM_CHANNEL
from robosmi.transformations.verification.target_side import EMPTY_TRACE, LIMIT_S, TargetSide
from robosmi.verify.original import LibraryCall, Original, OriginalRun
from robosmi.verify.scenario import POINTS, Scenario
from robosmi.verify.simulation import PinTrace
from robosmi.verify.traces.activity import READING, ActivityEvent
from robosmi.verify.traces.alignment import alike, numbers_of, shape_of
from robosmi.verify.traces.comparison import DIFFERENT, RACY, SAME, ChannelComparison, FirstDifference
from robosmi.verify.traces.verdict import DIFFERENT_VERDICT, NO_DIFFERENCE, NOT_DECIDABLE, ScenarioVerdict

Case = tuple[Scenario, SourceRuns]
_HANGS_ON_A_PASS = (
    "an input changes during a pass of the loop: the migrated program does what the original does if it reads the input a pass "
    "earlier or later; change the input at another time"
)

_Late = tuple[str, FirstDifference] | None
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
            told = with_reactions(told, program, trace, ports, runs, one_thread, at_rest)
            if told is not first and told.verdict == NOT_DECIDABLE and scenario.origin == "generated":
                found.racy.append((scenario, runs))
                continue
        target = {name: events for name, (events, *_) in channel_events(seen, ports, target=True).items()}
        found.kept.append(ComparedScenario(told, runs, target, seen if whole else None))
    return found


# ---- how late a program reacts


def with_reactions(
    told: ScenarioVerdict,
    program: Original,
    trace: PinTrace,
    ports: Sequence[BoundPort],
    runs: SourceRuns,
    one_thread: bool,
    at_rest: Mapping[str, int],
) -> ScenarioVerdict:
    """The verdict on a scenario in which the target may react to a contact at a time at which no run of the source does.

    Nothing is judged where a program measures or waits for what it drives, or where the length of its passes is not known. A
    program that prints may be anywhere in a pass, since the boards print at other speeds.

    Args:
        told: the verdict from the runs so far.
        program: the original.
        trace: the run of the migrated program.
        ports: the ports.
        runs: the runs of the source.
        one_thread: whether a single thread of the source does all that is observed.
        at_rest: the pins that the migrated program holds so that the component there does nothing, with their levels.
    """
    scenario = told.scenario
    devices = played(ports, scenario, target=False)
    if told.verdict != NO_DIFFERENCE or runs.loop is not None or any(use.kind in MEASURED for use in devices):
        return told
    signals = [use.settings[POINTS] for use in devices if use.kind == LEVELS_DEVICE]
    changes_ms = [as_number(at_ms) for points in signals for at_ms, _ in points if at_ms]
    if not changes_ms:
        return told
    target = channel_events(trace, ports, target=True)
    loose_ms = 2 * costs_ms(told.channels, runs)

    def late(each: SourceRuns, found: Sequence[ChannelComparison] = told.channels, more_ms: float = 0.0) -> _Late:
        return first_late_reaction(found, each, target, changes_ms, loose_ms + more_ms)

    if late(runs) is None or not (pass_ms := pass_of(program, ports, scenario, LIMIT_S)):
        return told
    first = late(runs, more_ms=pass_ms if runs.nominal.trace.console else 0.0)

    def differs_at(each: SourceRuns) -> float | None:
        other = verdict_of(scenario, each, trace, ports, one_thread, at_rest)
        differ = [c.difference.at_ms for c in other.channels if c.difference is not None]
        if (again := late(each, other.channels)) is not None:
            differ.append(again[1].at_ms)
        return min(differ, default=None)

    if first is None or hangs_on_a_pass(program, ports, scenario, runs, LIMIT_S, differs_at, pass_ms):
        return told
    name, difference = first
    channels = tuple(replace(c, status=DIFFERENT, difference=difference) if c.channel == name else c for c in told.channels)
    return replace(told, verdict=DIFFERENT_VERDICT, channels=channels)


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


def longest_pass_ms(calls: Iterable[LibraryCall]) -> float:
    """The longest time between two calls from one place, which is how late a program that polls may see a change; 0 without."""
    places: dict[tuple[str, str, int], list[float]] = {}
    for call in calls:
        places.setdefault((call.function, call.file, call.line), []).append(call.at_us / 1000)
    often = (times for times in places.values() if len(times) > _FEWEST_PASSES)
    between = (after - before for times in often for before, after in pairwise(times))
    return max((each for each in between if each <= _LONGEST_PASS_MS), default=0.0)


def pass_of(program: Original, ports: Sequence[BoundPort], scenario: Scenario, limit_s: float) -> float:
    """The longest pass of the loops of the source in a scenario, in milliseconds; 0 if it is not known."""
    calls = program.calls(played(ports, scenario, target=False), 0, scenario.horizon_ms * 1000, limit_s)
    return longest_pass_ms(calls)


def hangs_on_a_pass(
    program: Original,
    ports: Sequence[BoundPort],
    scenario: Scenario,
    runs: SourceRuns,
    limit_s: float,
    differs_at: Callable[[SourceRuns], float | None],
    pass_ms: float | None = None,
) -> bool:
    """Whether the source does what the target did if it sees the inputs of a scenario up to a pass of its loop earlier or later.

    First all changes are moved alike, then, at each difference that is left, one of those beside it. A difference long before
    the first change hangs on none, so nothing is run.

    Args:
        program: the original.
        ports: its ports.
        scenario: the scenario.
        runs: its runs so far.
        limit_s: seconds of processor time for each run.
        differs_at: when the target first differs from a run of the source, in milliseconds; None if it does not.
        pass_ms: the length of a pass; None to take the program's, if inputs are not moved as far in the runs so far.
    """
    points = (point for settings in scenario.signals.values() for points in settings.values() for point in points)
    changes = sorted({float(at_ms) for at_ms, _ in points if float(at_ms) > 0})
    if not changes:
        return False
    if (early_ms := differs_at(runs)) is not None and early_ms < changes[0] - _LONGEST_PASS_MS:
        return False
    devices, until_us = played(ports, scenario, target=False), scenario.horizon_ms * 1000
    if pass_ms is None:
        pass_ms = pass_of(program, ports, scenario, limit_s)
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
