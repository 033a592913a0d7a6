"""Compares the order of events on different pins that follow each other too closely for their times to tell.

The comparison of a channel tolerates tens of milliseconds, so two lamps that flash a millisecond apart could be swapped unseen.
If a single thread of the program causes both, and the source keeps their order and distance whatever its steps cost, the order
is intended. Only events with a sharp begin are compared: levels and begins of waves, not servo frames, and not text, which is
sent later than it is printed. Near a change of an input the order may depend on where in its loop the program is, so nothing is
compared there.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from robosmi.verify.activity import BURST, LEVEL, WAVE, ActivityEvent
from robosmi.verify.alignment import aligned
from robosmi.verify.comparison import FirstDifference

_SURE_MS = 0.3
"""Events closer to each other have no order: the source's times are not known below about 100 us."""
_NEAR_MS = 150.0
"""Events further apart are compared by their times only."""
_QUIET_MS = 150.0
"""Minimum time between the last change of an input and an event that is compared."""
_SHARP = (LEVEL, WAVE, BURST)


class _Begin(NamedTuple):
    """The begin of an event in the source's nominal run, with its times in the varied runs and on the target (ms)."""

    at_ms: float
    channel: str
    event: ActivityEvent
    varied_ms: tuple[float, ...]
    target_ms: float
    target: ActivityEvent


def first_disorder(
    source: Mapping[str, Sequence[Sequence[ActivityEvent]]],
    target: Mapping[str, Sequence[ActivityEvent]],
    input_changes_ms: Sequence[float],
) -> FirstDifference | None:
    """The first two events of different channels that come in the other order on the target, or None.

    Args:
        source: channel -> its events in the nominal run, then in each varied run; channels without a difference of their own.
        target: channel -> the target's events.
        input_changes_ms: when inputs change, on either side.
    """
    begins = [begin for channel, runs in source.items() for begin in _begins(channel, runs, target[channel])]
    begins.sort(key=lambda begin: begin.at_ms)
    for number, before in enumerate(begins):
        if any(0 <= before.at_ms - at_ms <= _QUIET_MS for at_ms in input_changes_ms):
            continue
        for after in begins[number + 1 :]:
            if after.at_ms - before.at_ms > _NEAR_MS or any(before.at_ms <= at_ms <= after.at_ms for at_ms in input_changes_ms):
                break
            if after.channel != before.channel and _swapped(before, after):
                return _told(before, after)
    return None


def _begins(channel: str, runs: Sequence[Sequence[ActivityEvent]], target: Sequence[ActivityEvent]) -> list[_Begin]:
    """The sharp begins on a channel that have a counterpart in all runs and on the target."""
    nominal, *varied = runs
    sharp = [number for number in range(1, len(nominal)) if _sharp(nominal[number - 1], nominal[number])]
    if not sharp:
        return []  # text and servos: nothing to align
    seen = [dict(aligned(nominal, run).pairs) for run in varied]
    theirs = dict(aligned(nominal, target).pairs)
    found = []
    for number in sharp:
        if number not in theirs:
            continue
        times = [run[pairs[number]].at_us / 1000 for run, pairs in zip(varied, seen, strict=True) if number in pairs]
        if len(times) == len(varied):
            event, other = nominal[number], target[theirs[number]]
            found.append(_Begin(event.at_us / 1000, channel, event, tuple(times), other.at_us / 1000, other))
    return found


def _sharp(before: ActivityEvent, event: ActivityEvent) -> bool:
    """Whether the program determines the exact time of an event, unlike that of the end of a wave or of servo frames."""
    if event.kind not in _SHARP:
        return False
    return before.kind == LEVEL if event.kind == LEVEL else not (event.kind == WAVE and float(event.value[0]) <= 0)


def _swapped(before: _Begin, after: _Begin) -> bool:
    """Whether the target clearly reverses two events whose order and distance are the same in all runs of the source."""
    apart_ms = after.at_ms - before.at_ms
    spread_ms = max((abs(b - a - apart_ms) for a, b in zip(before.varied_ms, after.varied_ms, strict=True)), default=0.0)
    coarse_ms = max(_SURE_MS, *(_period_ms(each.event) for each in (before, after)))
    return apart_ms > 2 * spread_ms + coarse_ms and before.target_ms - after.target_ms > coarse_ms


def _period_ms(event: ActivityEvent) -> float:
    """The uncertainty of an event's begin: a wave's period, since its first period may be seen only partly; 0 for others."""
    return 1000 / float(event.value[0]) if event.kind == WAVE else 0.0


def _told(before: _Begin, after: _Begin) -> FirstDifference:
    message = (
        f"{before.event} comes {before.target_ms - after.target_ms:.2f} ms after {after.event} of {after.channel}, "
        f"instead of {after.at_ms - before.at_ms:.2f} ms before it"
    )
    return FirstDifference(before.at_ms, before.channel, message, before.event, before.target)
