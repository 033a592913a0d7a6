"""Compares two programs channel by channel: the same values in the same order, at about the same times, for as long.

This is the (tau, eps)-closeness of conformance testing, extended by durations. The tolerance is derived: a base that depends on
the kind of channel, plus twice the differences between runs of the source whose steps cost more or less and whose inputs come a
little earlier or later. `alignment` finds which events correspond.

If even the values of these runs differ, the channel is racy. Before the first such place the source is as reliable as on any
other channel. After it, only lines of text are compared: those that all runs print identically, as long as all runs print lines
of the same shape (the text without its numbers) in the same order. Their times are not compared, since these vary, too.

A servo width that is shown for few frames may be missing, since it depends on when frames begin: a program may set a width and
another one before the next frame. But if the target shows a width beyond all that the source ever shows, the servo twitches.
Marginal widths of a slow change are not judged: the source may pass the same width in a single frame.

A difference is described by the first events that do not correspond: late, early, missing, repeated, or different. The
description is true for the whole runs: an event that only comes late is not one that the other program lacks.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from msgspec import Struct
from msgspec.structs import replace

from robosmi.base.data_text import Json
from robosmi.verify.traces.activity import BURST, HELD, LEVEL, LINE, PULSE, PULSES, READING, WAVE, ActivityEvent, on_or_off
from robosmi.verify.traces.alignment import Alignment, aligned, alike, is_brief, larger, parts_off, shape_of

if TYPE_CHECKING:
    from robosmi.base.data_text import Json


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
        if source[own].pulses and WAVE in (source[own - 1].kind, source[after[0]].kind):
            vague_ms += _period_ms(source[own])
        if not _lasts_alike(source[own], source[after[0]], lasts, theirs_last, off[own].duration_ms + vague_ms):
            message = lasts_otherwise(source[own], lasts, theirs_last)
            difference = FirstDifference(source[own].at_us / 1000, channel, message, source[own], target[other])
            return ChannelComparison(channel, DIFFERENT, difference, max(0, len(source) - 1), greatest)
    mine = source[found.own] if found.own < len(source) else None
    theirs = target[found.other] if found.other < len(target) else None
    if (mine or theirs) is not None:
        beyond = off[min(found.own, len(off) - 1)].time_ms
        if not _may_be_beyond(mine, theirs, beyond, horizon_ms):
            told = report_difference(source, target, found, in_time, lambda own: _tau(source[own], off[own].time_ms))
            difference = FirstDifference(told.at_us / 1000, channel, told.message, told.source, told.target)
            return ChannelComparison(channel, DIFFERENT, difference, max(0, len(source) - 1), greatest)
    if (stray := first_stray_width((source, *varied), target[: found.other], found.pairs)) is not None:
        message = f"{stray.does()}, outside all pulse widths of the original"
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
        message = _missing(mine, target[: before.other]) if theirs is None else _instead(mine, theirs)
        return replace(found, status=DIFFERENT, difference=FirstDifference(mine.at_us / 1000, channel, message, mine, theirs))
    wrong = first_wrong_line(source, target, varied)
    if wrong is not None:
        message = f"{_instead(wrong.source, wrong.target)} in each run, though other lines change"
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


def _period_ms(event: ActivityEvent) -> float:
    """The period of a wave in milliseconds: between two waves without a gap either may have the period at the change."""
    return 1000 / float(event.value[0]) if event.kind == WAVE and event.value[0] else 0.0


def _vague_ms(own: ActivityEvent, other: ActivityEvent) -> float:
    """The uncertainty, in milliseconds, of the begins of two events."""
    return max(own.vague_us, other.vague_us) / 1000


def _tau(event: ActivityEvent, beyond_ms: float) -> float:
    return _BASE_MS[event.kind] + beyond_ms + RESONATOR * event.at_us / 1000


def _lasts_alike(event: ActivityEvent, after: ActivityEvent, source_ms: float, target_ms: float, beyond_ms: float) -> bool:
    """Whether the durations of an event agree on both sides; next to servo frames only to within the period of a frame."""
    coarse = _REST_MS if event.value == (0,) else 0.0
    if event.kind == WAVE and not event.pulses:
        coarse = _period_ms(event)  # a timer's wave ends with a whole period
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


# ---- servo widths

_BEYOND_US = 20.0
"""How far beyond the source's widths one may lie, in microseconds: the distance of the marks by which ramps are compared."""


def first_stray_width(
    runs: Sequence[Sequence[ActivityEvent]], target: Sequence[ActivityEvent], pairs: Sequence[tuple[int, int]]
) -> ActivityEvent | None:
    """The first width of the target without a counterpart that lies beyond the widths that the source shows in the scenario.

    Args:
        runs: the events of the source's runs; if none has a servo's width, nothing is judged.
        target: the events of the target.
        pairs: the indices of corresponding events of a run of the source and of the target.
    """
    widths = [float(event.value[0]) for run in runs for event in run if event.kind == PULSES]
    if not widths:
        return None
    least, most = min(widths) - _BEYOND_US, max(widths) + _BEYOND_US
    paired = {other for _, other in pairs}
    for number, event in enumerate(target):
        judged = is_brief(event) and not event.barely and number not in paired
        if judged and not least <= float(event.value[0]) <= most:
            return event
    return None


# ---- racy channels


class SelfDifference(NamedTuple):
    """The first place where two runs of the source do something else on a channel.

    Attributes:
        at_ms: when, in milliseconds; the earlier one of what both do.
        nominal, varied: what the source does, and what it does with other costs or inputs; None where it does nothing more.
    """

    at_ms: float
    nominal: ActivityEvent | None
    varied: ActivityEvent | None

    def __str__(self) -> str:
        own, other = (f"{each} at {each.at_us / 1000:.1f} ms" if each else "nothing more" for each in (self.nominal, self.varied))
        return f"{own}, or {other}"

    def to_json(self) -> dict[str, Json]:
        """The contract's form."""
        return {"at_ms": round(self.at_ms, 3), "source": _said(self.nominal), "again": _said(self.varied)}


def _said(event: ActivityEvent | None) -> Json:
    return None if event is None else {"at_ms": round(event.at_us / 1000, 3), "what": str(event)}


def first_self_difference(source: Sequence[ActivityEvent], varied: Sequence[Sequence[ActivityEvent]]) -> SelfDifference | None:
    """The earliest place where a varied run has something else than the nominal one, or something more or less."""
    found = []
    for run in varied:
        both = aligned(source, run)
        own = source[both.own] if both.own < len(source) else None
        other = run[both.other] if both.other < len(run) else None
        times = [event.at_us / 1000 for event in (own, other) if event is not None]
        if times:
            found.append(SelfDifference(min(times), own, other))
    return min(found, key=lambda each: each.at_ms, default=None)


class WrongLine(NamedTuple):
    """A line that each run of the source prints, and what the target prints instead."""

    source: ActivityEvent
    target: ActivityEvent


def first_wrong_line(
    source: Sequence[ActivityEvent], target: Sequence[ActivityEvent], varied: Sequence[Sequence[ActivityEvent]]
) -> WrongLine | None:
    """The first line with other numbers than each run of the source prints there; None where nothing can be said.

    What is compared ends with the first line whose shape is not that of all runs of the source, and of the target. Lines of a
    shape that has other numbers in any run are not compared at all.
    """
    runs = [source, *varied]
    rows = []
    for row in zip(*[*runs, target], strict=False):
        if any(event.kind not in (LINE, READING) for event in row) or len({shape_of(event) for event in row}) > 1:
            break
        rows.append(row)
    wobbling = {shape_of(row[0]) for row in rows if any(not alike(row[0], again) for again in row[1:-1])}
    for row in rows:
        if shape_of(row[0]) not in wobbling and not alike(row[0], row[-1]):
            return WrongLine(row[0], row[-1])
    return None


# ---- differences in words

_MOST = 20_000
"""Limit on the events of a run that are searched."""


class DifferenceReport(Struct, frozen=True):
    """A difference in words.

    Attributes:
        at_us: when it begins, in microseconds.
        message: what is different.
        source, target: the events that it is about, None for a side that has none.
    """

    at_us: float
    message: str
    source: ActivityEvent | None
    target: ActivityEvent | None


def report_difference(
    source: Sequence[ActivityEvent],
    target: Sequence[ActivityEvent],
    found: Alignment,
    in_time: Callable[[int, int], bool],
    allowed_ms: Callable[[int], float],
) -> DifferenceReport:
    """Describe the first events without a counterpart.

    Args:
        source, target: the events of both programs, at least one of which has events without a counterpart.
        found: the alignment of these events.
        in_time: whether an event of the source and one of the target, given by their indices, are close enough in time.
        allowed_ms: the time tolerance of an event of the source, given by its index, in milliseconds.
    """
    sides = _Sides(source, target, found, in_time)
    mine = source[found.own] if found.own < len(source) else None
    theirs = target[found.other] if found.other < len(target) else None
    if mine is not None and theirs is not None:
        moved = alike(mine, theirs)
        lost, more = sides.met_elsewhere(found.other), sides.is_elsewhere(found.own)
        if lost and more and not moved:
            return DifferenceReport(theirs.at_us, f"{theirs.does()} before it {mine.does()}, not after", mine, theirs)
        if lost and not more:
            return DifferenceReport(mine.at_us, _missing(mine, target[: found.other]), mine, theirs)
        if more and not lost:
            return DifferenceReport(theirs.at_us, sides.more(theirs), mine, theirs)
        if not moved:
            return DifferenceReport(mine.at_us, _instead(mine, theirs), mine, theirs)
        return _moved(mine, theirs, allowed_ms(found.own))
    if mine is None:
        assert theirs is not None
        place = sides.nearest(theirs, source, sides.paired_source)
        return _moved(source[place], theirs, allowed_ms(place)) if place is not None else DifferenceReport(
            theirs.at_us, sides.more(theirs), None, theirs
        )  # fmt: skip
    place = sides.nearest(mine, target, sides.paired_target)
    if place is not None:
        return _moved(mine, target[place], allowed_ms(found.own))
    return DifferenceReport(mine.at_us, _missing(mine, target[: found.other]), mine, None)


def lasts_otherwise(event: ActivityEvent, source_ms: float, target_ms: float) -> str:
    """The message that something lasts too long or too short."""
    lasting = f"stays {on_or_off(event)}" if _is_switched(event) else event.does()
    return f"{lasting} for {target_ms:.2f} ms; the original for {source_ms:.2f} ms"


class _Sides(Struct, frozen=True):
    """Both runs, and which of their events belong together."""

    source: Sequence[ActivityEvent]
    target: Sequence[ActivityEvent]
    found: Alignment
    in_time: Callable[[int, int], bool]

    @property
    def paired_source(self) -> set[int]:
        return {own for own, _ in self.found.pairs}

    @property
    def paired_target(self) -> set[int]:
        return {other for _, other in self.found.pairs}

    def met_elsewhere(self, other: int) -> bool:
        """Whether an event of the target matches a later event of the source in value and time."""
        return any(self._fit(own, other) for own in range(self.found.own + 1, min(len(self.source), self.found.own + _MOST)))

    def is_elsewhere(self, own: int) -> bool:
        """Whether an event of the source matches a later event of the target in value and time."""
        return any(
            self._fit(own, other) for other in range(self.found.other + 1, min(len(self.target), self.found.other + _MOST))
        )

    def _fit(self, own: int, other: int) -> bool:
        return self.in_time(own, other) and alike(self.source[own], self.target[other])

    def nearest(self, event: ActivityEvent, events: Sequence[ActivityEvent], paired: set[int]) -> int | None:
        """The index of the unpaired event with the same value that is nearest in time; None if there is none."""
        free = [number for number, each in enumerate(events[:_MOST]) if number not in paired and alike(each, event)]
        return min(free, key=lambda number: abs(events[number].at_us - event.at_us), default=None)

    def more(self, event: ActivityEvent) -> str:
        """The message that the target does something which the source does not do, at all or at that time."""
        if any(alike(each, event) for each in self.source[1:_MOST]):
            return f"{event.does()} again at {event.at_us / 1000:.1f} ms; the original does not"
        return f"{event.does()} at {event.at_us / 1000:.1f} ms; the original never does"


def _is_switched(event: ActivityEvent) -> bool:
    return event.kind == LEVEL and not isinstance(event.value[0], str)


def _missing(event: ActivityEvent, before: Sequence[ActivityEvent]) -> str:
    """The message that the target lacks an event of the source.

    Args:
        event: the event of the source.
        before: the events of the target before the missing one.
    """
    original = f"the original {event.does()} at {event.at_us / 1000:.1f} ms"
    if _is_switched(event) and before and _is_switched(before[-1]) and before[-1].value != event.value:
        return f"stays {on_or_off(before[-1])}; {original}"
    return f"missing: {original}"


def _instead(mine: ActivityEvent, theirs: ActivityEvent) -> str:
    """The message that the target does something else than the source."""
    constant = _is_switched(theirs) and mine.kind != LEVEL
    return f"{f'constantly {on_or_off(theirs)}' if constant else theirs.does()}; the original {mine.does()}"


def _moved(mine: ActivityEvent, theirs: ActivityEvent, allowed_ms: float) -> DifferenceReport:
    dt = (theirs.at_us - mine.at_us) / 1000
    message = f"{mine.does()} {abs(dt):.1f} ms too {'late' if dt > 0 else 'early'} (tolerance {allowed_ms:.1f} ms)"
    return DifferenceReport(min(mine.at_us, theirs.at_us) if dt < 0 else mine.at_us, message, mine, theirs)
