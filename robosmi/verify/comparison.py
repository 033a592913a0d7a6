"""Compares two programs channel by channel: the same values in the same order, at about the same times, for as long.

This is the (tau, eps)-closeness of conformance testing, extended by durations. The tolerance is derived: a base that depends on
the kind of channel, plus twice the differences between runs of the source whose steps cost more or less and whose inputs come a
little earlier or later. If even the values of these runs differ, the channel is racy and nothing can be decided with it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from msgspec import Struct
from msgspec.structs import replace

from robosmi.verify.activity import BURST, HELD, LEVEL, LINE, PULSE, PULSES, READING, WAVE, ActivityEvent
from robosmi.verify.alignment import aligned, alike, larger, parts_off
from robosmi.verify.brief_widths import first_stray_width
from robosmi.verify.difference_words import lasts_otherwise, told_difference
from robosmi.verify.self_difference import SelfDifference, first_self_difference, first_wrong_line

if TYPE_CHECKING:
    from robosmi.data_text import Json

SAME, DIFFERENT, NOT_EXERCISED, RACY = "same", "different", "not-exercised", "racy"

_BASE_MS = {LEVEL: 45.0, PULSES: 65.0, WAVE: 45.0, BURST: 45.0, LINE: 45.0, READING: 45.0, HELD: 45.0, PULSE: 45.0}
"""Base tolerance in ms by kind of event: the longer of two polling periods, 5 ms, and a servo frame where one makes the event."""
_PRINTED = (LINE, READING, HELD, PULSE)
_DURATION = 0.01
_RESOLUTION_MS = 0.25
"""Tolerance in ms for both ends of a duration, since the source's times are not known below about 100 us."""
_FRAME_MS = 21.0
_REST_MS = 5.0
"""Tolerance in ms for a low level, which ends when the program's loop comes round: the code in between takes other times."""
_OWN_HZ = 0.05
"""Relative difference of a wave that a program makes edge by edge, between runs of the source: its steps set the frequency."""
RESONATOR = 0.005
"""Relative error of a board's ceramic resonator, by which times drift."""


class FirstDifference(Struct, frozen=True):
    """The first difference between two programs.

    Attributes:
        at_ms: its time, in milliseconds of the source.
        channel: the channel's name.
        message: what differs, in words.
        source, target: the differing events, None for a side that has no further event.
    """

    at_ms: float
    channel: str
    message: str
    source: ActivityEvent | None
    target: ActivityEvent | None

    def to_json(self) -> dict[str, Any]:
        """The contract's form."""
        return {
            "at_ms": round(self.at_ms, 3), "channel": self.channel, "message": self.message,
            "source": _event_json(self.source), "target": _event_json(self.target),
        }  # fmt: skip


def _event_json(event: ActivityEvent | None) -> dict[str, Json] | None:
    return None if event is None else {"at_ms": round(event.at_us / 1000, 3), "what": str(event)}


class ChannelComparison(Struct, frozen=True):
    """The result of comparing one channel in one scenario.

    Attributes:
        channel: its name.
        status: same, different, not-exercised, or racy.
        difference: the first one, or None.
        events: the number of events compared (of a racy channel: of the source), without the initial state.
        greatest_dt_ms: the greatest time difference between corresponding events.
        itself: where runs of the source first differ from each other, or None.
    """

    channel: str
    status: str
    difference: FirstDifference | None = None
    events: int = 0
    greatest_dt_ms: float = 0.0
    itself: SelfDifference | None = None


class EventTolerance(Struct, frozen=True):
    """The tolerance of one event in addition to the base.

    Attributes:
        time_ms: of its time, in milliseconds.
        duration_ms: of its duration.
        parts: relative tolerances of its value: of a wave's frequency, or of each number of a reading.
    """

    time_ms: float = 0.0
    duration_ms: float = 0.0
    parts: tuple[float, ...] = ()


class ClosedLoop(Struct, frozen=True):
    """A program that waits for a motion by reading a sensor of it, so that the wait ends with the last small step of the
    motion.

    Whether one more step is needed depends on microseconds, on the source as on the target. Runs of the source show how far the
    ends of several such waits diverge together, but not the tolerance of each single one.

    Attributes:
        since_ms: when the first such motion begins.
        ms: the tolerance of the end of one motion.
        rests: whether the channel has events for standing still, whose duration depends only on the program's own waits.
    """

    since_ms: float
    ms: float
    rests: bool = False

    def loosened(self, source: Sequence[ActivityEvent], allowed: Sequence[EventTolerance]) -> list[EventTolerance]:
        """The tolerances increased by that of a single motion's end, from the first motion on."""
        return [
            EventTolerance(each.time_ms + self.ms, each.duration_ms + self._lasts_ms(source[at]), each.parts)
            if source[at].at_us / 1000 >= self.since_ms
            else each
            for at, each in enumerate(allowed)
        ]

    def _lasts_ms(self, event: ActivityEvent) -> float:
        return 2 * _FRAME_MS if self.rests and event.value == (0,) else self.ms


def tolerances(source: Sequence[ActivityEvent], varied: Sequence[Sequence[ActivityEvent]]) -> list[EventTolerance] | None:
    """The tolerance of each event, from runs of the source itself; None if their values differ, so that the channel is racy.

    Args:
        source: the nominal run's events.
        varied: those of runs with other costs and slightly moved inputs; each may be longer or shorter at its end.
    """
    times, spans = [0.0] * len(source), [0.0] * len(source)
    parts: list[tuple[float, ...]] = [()] * len(source)
    for run in varied:
        found = aligned(source, run)
        if found.own < len(source) and found.other < len(run):
            return None
        for at, (number, other) in enumerate(found.pairs):
            after = found.pairs[at + 1] if at + 1 < len(found.pairs) else None
            times[number] = max(times[number], abs(run[other].at_us - source[number].at_us) / 1000)
            if source[number].value != run[other].value:
                parts[number] = larger(parts[number], parts_off(source[number], run[other]))
            if after is not None:
                own_ms = source[after[0]].at_us - source[number].at_us
                other_ms = run[after[1]].at_us - run[other].at_us
                spans[number] = max(spans[number], abs(other_ms - own_ms) / 1000)
        if found.pairs:  # what comes later than the run lasts is off by no less than its last event
            own, other = found.pairs[-1]
            off_ms = abs(run[other].at_us - source[own].at_us) / 1000
            for at in range(own + 1, len(times)):
                times[at] = max(times[at], off_ms)
    return [EventTolerance(2 * time, 2 * spans[at], tuple(2 * part for part in parts[at])) for at, time in enumerate(times)]


def _loose_waves(source: Sequence[ActivityEvent]) -> list[ActivityEvent]:
    """The events, with the waves that the program makes edge by edge as vague in their frequency as its steps are."""
    return [replace(each, off=(_OWN_HZ,)) if each.kind == WAVE and each.pulses else each for each in source]


def compare(
    channel: str,
    source: Sequence[ActivityEvent],
    target: Sequence[ActivityEvent],
    varied: Sequence[Sequence[ActivityEvent]],
    horizon_ms: float,
    loop: ClosedLoop | None = None,
) -> ChannelComparison:
    """Compare one channel.

    Args:
        channel: its name.
        source: what the source does there.
        target: what the target does there.
        varied: what the source does in varied runs.
        horizon_ms: how long both ran; what happens so near to it that it may be beyond on the other side is not compared, nor
            what the source does after it.
        loop: how the program waits for what it drives, if it does.
    """
    vague = _loose_waves(source)
    allowed = tolerances(vague, varied)
    if allowed is not None and loop is not None:
        allowed = loop.loosened(source, allowed)
    if allowed is None or _ends_differ(vague, varied, horizon_ms, allowed):
        return _racy(channel, source, target, varied, horizon_ms)
    off = allowed or [EventTolerance()]
    source = [replace(event, off=allowed[at].parts or event.off) for at, event in enumerate(source)]

    def in_time(own: int, other: int) -> bool:
        vague_ms = _vague_ms(source[own], target[other])
        return abs(target[other].at_us - source[own].at_us) / 1000 <= _tau(source[own], off[own].time_ms + vague_ms)

    found = aligned(source, target, in_time)
    greatest = 0.0
    late = found.own < len(source) and found.other < len(target) and alike(source[found.own], target[found.other])
    for at, (own, other) in enumerate(found.pairs):
        last = at + 1 == len(found.pairs)
        after = found.pairs[at + 1] if not last else (found.own, found.other) if late else None
        dt = (target[other].at_us - source[own].at_us) / 1000
        greatest = dt if abs(dt) > abs(greatest) else greatest
        if after is None or source[own].kind in _PRINTED or own == 0:
            continue  # nothing begins with a run's begin
        lasts = (source[after[0]].at_us - source[own].at_us) / 1000
        theirs_last = (target[after[1]].at_us - target[other].at_us) / 1000
        vague_ms = _vague_ms(source[own], target[other]) + _vague_ms(source[after[0]], target[after[1]])
        if not _lasts_alike(source[own], source[after[0]], lasts, theirs_last, off[own].duration_ms + vague_ms):
            message = lasts_otherwise(source[own], lasts, theirs_last)
            difference = FirstDifference(source[own].at_us / 1000, channel, message, source[own], target[other])
            return ChannelComparison(channel, DIFFERENT, difference, max(0, len(source) - 1), greatest)
    mine = source[found.own] if found.own < len(source) else None
    theirs = target[found.other] if found.other < len(target) else None
    if (mine or theirs) is not None:
        beyond = off[min(found.own, len(off) - 1)].time_ms
        if not _may_be_beyond(mine, theirs, beyond, horizon_ms):
            told = told_difference(source, target, found, in_time, lambda own: _tau(source[own], off[own].time_ms))
            difference = FirstDifference(told.at_us / 1000, channel, told.message, told.source, told.target)
            return ChannelComparison(channel, DIFFERENT, difference, max(0, len(source) - 1), greatest)
    if (stray := first_stray_width((source, *varied), target[: found.other], found.pairs)) is not None:
        message = f"{stray}, beyond all widths that the source shows"
        difference = FirstDifference(stray.at_us / 1000, channel, message, None, stray)
        return ChannelComparison(channel, DIFFERENT, difference, max(0, len(source) - 1), greatest)
    matched = len(found.pairs) - bool(source and source[0].kind not in _PRINTED)
    if matched <= 0:
        return ChannelComparison(channel, NOT_EXERCISED)
    return ChannelComparison(channel, SAME, None, matched, greatest)


def _racy(
    channel: str,
    source: Sequence[ActivityEvent],
    target: Sequence[ActivityEvent],
    varied: Sequence[Sequence[ActivityEvent]],
    horizon_ms: float,
) -> ChannelComparison:
    """The result for a racy channel: values that all runs of the source agree on are still compared, their times are not."""
    itself = first_self_difference(source, varied)
    found = ChannelComparison(channel, RACY, events=max(0, len(source) - 1), itself=itself)
    if itself is None:
        return found
    own = [event for event in source if event.at_us / 1000 < itself.at_ms]
    while own and any(each is not None and alike(own[-1], each) for each in (itself.nominal, itself.varied)):
        own.pop()  # how often it says so in a row is what differs
    before = aligned(own, target)
    mine = own[before.own] if before.own < len(own) else None
    theirs = target[before.other] if before.other < len(target) else None
    if mine is not None and (theirs is not None or mine.at_us / 1000 < horizon_ms - 3 * _tau(mine, 20.0)):
        message = f"{mine} {'are' if mine.kind == PULSES else 'is'} missing" if theirs is None else f"{theirs} instead of {mine}"
        return replace(found, status=DIFFERENT, difference=FirstDifference(mine.at_us / 1000, channel, message, mine, theirs))
    wrong = first_wrong_line(source, target, varied)
    if wrong is not None:
        message = f"{wrong.target} instead of {wrong.source}, which the source prints in each run, though other lines change"
        first = FirstDifference(wrong.source.at_us / 1000, channel, message, wrong.source, wrong.target)
        return replace(found, status=DIFFERENT, difference=first)
    return found


def _may_be_beyond(mine: ActivityEvent | None, theirs: ActivityEvent | None, beyond_ms: float, horizon_ms: float) -> bool:
    """Whether events without counterparts are so near the horizon that the counterparts may come after it."""
    if mine is None or theirs is None:
        extra = mine or theirs
        assert extra is not None
        return extra.at_us / 1000 >= horizon_ms - _tau(extra, beyond_ms)
    near = mine.at_us / 1000 >= horizon_ms - _tau(mine, beyond_ms)
    return near and (not alike(mine, theirs) or max(mine.at_us, theirs.at_us) / 1000 >= horizon_ms)


def _vague_ms(own: ActivityEvent, other: ActivityEvent) -> float:
    """The uncertainty, in milliseconds, of the begins of two events."""
    return max(own.vague_us, other.vague_us) / 1000


def _tau(event: ActivityEvent, beyond_ms: float) -> float:
    return _BASE_MS[event.kind] + beyond_ms + RESONATOR * event.at_us / 1000


def _lasts_alike(event: ActivityEvent, after: ActivityEvent, source_ms: float, target_ms: float, beyond_ms: float) -> bool:
    """Whether the durations of an event agree on both sides; next to servo frames only to within the period of a frame."""
    coarse = _REST_MS if event.value == (0,) else 0.0
    if PULSES in (event.kind, after.kind):
        coarse = _FRAME_MS * (1 + (event.value == (0,)))
    return abs(target_ms - source_ms) <= _DURATION * source_ms + _RESOLUTION_MS + coarse + beyond_ms


def _ends_differ(
    source: Sequence[ActivityEvent],
    varied: Sequence[Sequence[ActivityEvent]],
    horizon_ms: float,
    allowed: Sequence[EventTolerance],
) -> bool:
    """Whether a varied run has more or fewer events, except near its end, where the others may come after it."""
    late_ms = max((each.time_ms for each in allowed), default=0.0)
    for run in varied:
        found = aligned(source, run)
        for events, number in ((source, found.own), (run, found.other)):
            if number < len(events) and events[number].at_us / 1000 < horizon_ms - 3 * _tau(events[number], 20.0) - late_ms:
                return True
    return False
