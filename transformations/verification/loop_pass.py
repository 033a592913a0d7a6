"""Runs of the source in which it sees its inputs a pass of its loop earlier or later.

A program that polls sees a change of an input at its next read. Where the change is just beside a read, one board sees it a pass
earlier than the other, and neither is wrong. Moving all inputs by a pass of the source's own loop gives the run that the other
board should have made: only if that is what the target did is the difference one of the instant alone. Each of several changes
may be seen earlier or later.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import pairwise

from msgspec.structs import replace

from robosmi.transformations.verification.bound_devices.played_devices import brief_pins, played
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.bound_devices.varied_devices import MOVED_MS, late_devices
from robosmi.transformations.verification.original_side import SETTLED, SourceRuns, channel_events
from robosmi.transformations.verification.pause_comparison import observed_pauses
from robosmi.transformations.verification.rest_comparison import observed_rests
from robosmi.verify.original import LibraryCall, Original, OriginalRun
from robosmi.verify.scenario import Scenario
from robosmi.verify.traces.activity import READING, ActivityEvent
from robosmi.verify.traces.alignment import numbers_of, shape_of

Range = tuple[float, float]
Ranges = tuple[Range | None, ...]
_FEWEST_PASSES = 4
_LONGEST_PASS_MS = 200.0
"""A loop with longer passes is not taken for one that polls its inputs, in milliseconds."""
_PARTS = (1.0, -1.0, 2 / 3, -2 / 3, 1 / 3, -1 / 3)
"""By which parts of a pass inputs are moved: the loops of two boards may stand anywhere in theirs when an input changes."""
_BESIDE = 3
"""How many changes may be the cause of a difference: an event ends, or begins, with one of those next to its beginning."""


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

    First all changes are moved alike, then, at each difference that is left, one of those beside it. A difference long before
    the first change hangs on none, so nothing is run.

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
    if (early_ms := differs_at(runs)) is not None and early_ms < changes[0] - _LONGEST_PASS_MS:
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
    between: dict[str, Ranges] = {}
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


def _widest(one: Range | None, other: Range | None) -> Range | None:
    return None if one is None or other is None else (min(one[0], other[0]), max(one[1], other[1]))
