"""Comparing what two programs do, channel by channel: the same values in the same order, at about the same times, for as long.

This is the (tau, eps)-closeness of conformance testing with a clause for durations. What counts as about the same is derived: a
base from the kind of the channel, and twice as much as the source differs from itself when its steps cost more or less and its
inputs come a little earlier or later. A source whose values differ from its own is racy: nothing can be decided with it.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from robosmi.verify.activity import BURST, LEVEL, LINE, PULSES, READING, WAVE, ActivityEvent

SAME, DIFFERENT, NOT_EXERCISED, RACY = "same", "different", "not-exercised", "racy"

_BASE_MS = {LEVEL: 45.0, PULSES: 65.0, WAVE: 45.0, BURST: 45.0, LINE: 45.0, READING: 45.0}
"""The longer of two polling periods and 5 ms; where a servo's frame makes the event, that frame too."""
_PRINTED = (LINE, READING)
_DURATION = 0.01
_RESOLUTION_MS = 0.25
"""Nothing is claimed of the source below about 100 us, at the begin and at the end of what lasts."""
_FRAME_MS = 21.0
_PULSE_US = 3.0
_HZ = 0.015
_NUMBERS = 0.01
_NUMBER = re.compile(r"(?<![\w.])-?\d{1,15}(?:\.\d{1,15})?(?![\w.])")
_DUTY = 0.02
_FASTEST_HZ = 5_000.0
"""Edges that a program makes itself faster than this are only counted: nothing is claimed of how fast the source makes them."""
RESONATOR = 0.005
"""A board's resonator may be off by so much: times drift by it."""


@dataclass(frozen=True)
class FirstDifference:
    """Where two programs differ first.

    Attributes:
        at_ms: when, in milliseconds of the source's time.
        channel: of what.
        message: what is different, in words.
        source, target: what each side does from then on, None where it does nothing more.
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


def _event_json(event: ActivityEvent | None) -> dict[str, Any] | None:
    return None if event is None else {"at_ms": round(event.at_us / 1000, 3), "what": str(event)}


@dataclass(frozen=True)
class ChannelComparison:
    """What became of one channel in one scenario.

    Attributes:
        channel: its name.
        status: same, different, not-exercised, or racy.
        difference: the first one, or None.
        events: how many were compared, or the source has where it is racy, without what it does at the beginning.
        greatest_dt_ms: the greatest distance in time of two events that belong together.
    """

    channel: str
    status: str
    difference: FirstDifference | None = None
    events: int = 0
    greatest_dt_ms: float = 0.0


@dataclass(frozen=True)
class EventTolerance:
    """How far an event may be off beyond the base, in ms, and how much longer or shorter what it begins may last."""

    time_ms: float = 0.0
    duration_ms: float = 0.0


def tolerances(source: Sequence[ActivityEvent], varied: Sequence[Sequence[ActivityEvent]]) -> list[EventTolerance] | None:
    """How far each event may be off, from runs of the source itself; None if these have other values: the channel is racy.

    Args:
        source: the nominal run's events.
        varied: those of runs with other costs and slightly moved inputs; each may be longer or shorter at its end.
    """
    times, spans = [0.0] * len(source), [0.0] * len(source)
    for run in varied:
        for number, event in enumerate(source):
            if number >= len(run):
                break
            if not alike(event, run[number]):
                return None
            times[number] = max(times[number], abs(run[number].at_us - event.at_us) / 1000)
            if number + 1 < min(len(source), len(run)):
                own = source[number + 1].at_us - event.at_us
                other = run[number + 1].at_us - run[number].at_us
                spans[number] = max(spans[number], abs(other - own) / 1000)
    return [EventTolerance(2 * time, 2 * span) for time, span in zip(times, spans, strict=True)]


def alike(one: ActivityEvent, other: ActivityEvent) -> bool:
    """Whether two events say the same, within what can be told apart."""
    if one.pulses and other.pulses and (one.kind != other.kind or float(one.value[0]) > _FASTEST_HZ):
        return one.pulses == other.pulses
    if one.kind != other.kind:
        return False
    if one.kind == WAVE:
        (hz, duty), (other_hz, other_duty) = one.value, other.value
        near = abs(float(hz) - float(other_hz)) <= _HZ * max(float(hz), float(other_hz))
        return near and abs(float(duty) - float(other_duty)) <= _DUTY
    if one.kind == PULSES:
        return abs(float(one.value[0]) - float(other.value[0])) <= _PULSE_US + 0.01 * abs(float(one.value[0]) - 1500)
    if one.kind == READING:
        return _reads_alike(str(one.value[0]), str(other.value[0]))
    return one.value == other.value


def _reads_alike(one: str, other: str) -> bool:
    """Whether two lines are the same, but for numbers that are off by one in their last digit, or by 1 %: measured values."""
    if one == other:
        return True
    if _NUMBER.sub("0", one) != _NUMBER.sub("0", other):
        return False
    for mine, theirs in zip(_NUMBER.findall(one), _NUMBER.findall(other), strict=True):
        step = 10.0 ** -len(mine.partition(".")[2])
        if abs(float(mine) - float(theirs)) > max(1.001 * step, _NUMBERS * abs(float(mine))):
            return False
    return True


def compare(
    channel: str,
    source: Sequence[ActivityEvent],
    target: Sequence[ActivityEvent],
    varied: Sequence[Sequence[ActivityEvent]],
    horizon_ms: float,
) -> ChannelComparison:
    """Compare one channel.

    Args:
        channel: its name.
        source: what the source does there.
        target: what the target does there.
        varied: what the source does in varied runs.
        horizon_ms: how long both ran; what happens so near to it that it may be beyond on the other side is not compared, nor
            what the source does after it.
    """
    allowed = tolerances(source, varied)
    if allowed is None or _ends_differ(source, varied, horizon_ms):
        return ChannelComparison(channel, RACY, events=max(0, len(source) - 1))
    greatest, matched = 0.0, 0
    for number in range(max(len(source), len(target))):
        mine = source[number] if number < len(source) else None
        theirs = target[number] if number < len(target) else None
        beyond = allowed[number].time_ms if number < len(allowed) else allowed[-1].time_ms if allowed else 0.0
        if mine is None or theirs is None:
            extra = mine or theirs
            assert extra is not None
            at_ms = extra.at_us / 1000
            if at_ms < horizon_ms - _tau(extra, beyond):
                what = f"{extra} is missing" if mine is not None else f"{extra}, which the source does not do"
                return _different(channel, at_ms, what, mine, theirs, source, greatest)
            break
        tau = _tau(mine, beyond)
        dt = (theirs.at_us - mine.at_us) / 1000
        if not alike(mine, theirs):
            if mine.at_us / 1000 >= horizon_ms - tau:
                break
            return _different(channel, mine.at_us / 1000, f"{theirs} instead of {mine}", mine, theirs, source, greatest)
        matched = number + 1
        greatest = dt if abs(dt) > abs(greatest) else greatest
        if abs(dt) > tau:
            return _different(
                channel, mine.at_us / 1000,
                f"{mine} comes {abs(dt):.1f} ms too {'late' if dt > 0 else 'early'} (allowed are {tau:.1f} ms)",
                mine, theirs, source, greatest,
            )  # fmt: skip
        if number + 1 < min(len(source), len(target)) and mine.kind not in _PRINTED:
            lasts = (source[number + 1].at_us - mine.at_us) / 1000
            theirs_last = (target[number + 1].at_us - theirs.at_us) / 1000
            if not _lasts_alike(mine, source[number + 1], lasts, theirs_last, allowed[number].duration_ms):
                message = f"{mine} lasts {theirs_last:.2f} ms instead of {lasts:.2f} ms"
                return _different(channel, mine.at_us / 1000, message, mine, theirs, source, greatest)
    told = matched - bool(source and source[0].kind not in _PRINTED)
    if told <= 0:
        return ChannelComparison(channel, NOT_EXERCISED)
    return ChannelComparison(channel, SAME, None, told, greatest)


def _tau(event: ActivityEvent, beyond_ms: float) -> float:
    return _BASE_MS[event.kind] + beyond_ms + RESONATOR * event.at_us / 1000


def _lasts_alike(event: ActivityEvent, after: ActivityEvent, source_ms: float, target_ms: float, beyond_ms: float) -> bool:
    """Whether something lasts as long on both sides; what a servo's frames begin or end is as coarse as a frame."""
    if event.kind == LEVEL and event.value == (0,):
        return True  # a rest: the times of its begin and its end say it
    coarse = _FRAME_MS if PULSES in (event.kind, after.kind) else 0.0
    return abs(target_ms - source_ms) <= _DURATION * source_ms + _RESOLUTION_MS + coarse + beyond_ms


def _ends_differ(source: Sequence[ActivityEvent], varied: Sequence[Sequence[ActivityEvent]], horizon_ms: float) -> bool:
    """Whether a varied run has events more or less, other than at its very end."""
    for run in varied:
        longer, shorter = (source, run) if len(source) > len(run) else (run, source)
        if len(longer) > len(shorter):
            extra = longer[len(shorter)]
            if extra.at_us / 1000 < horizon_ms - 3 * _tau(extra, 20.0):
                return True
    return False


def _different(
    channel: str, at_ms: float, message: str, source: ActivityEvent | None, target: ActivityEvent | None,
    events: Sequence[ActivityEvent], greatest: float,
) -> ChannelComparison:  # fmt: skip
    difference = FirstDifference(at_ms, channel, message, source, target)
    return ChannelComparison(channel, DIFFERENT, difference, max(0, len(events) - 1), greatest)
