"""In which order two things happen at different pins, when they follow each other too closely for their times to tell.

The comparison of a channel lets an event come tens of milliseconds too early or late, so that two lamps that flash one after
the other, a millisecond apart, may be swapped unseen. But where one thread of a program makes both, and the source keeps their
order and distance however much its steps cost, the order is the program's own. Only what is seen to begin sharply is looked at:
levels and the begins of waves; not frames of servos, and not text, which is sent later than it is printed. Near a change of an
input the order may hang on where in its loop the program is, so that nothing is said there.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from robosmi.typed import paired
from robosmi.verify.activity import BURST, LEVEL, WAVE, ActivityEvent
from robosmi.verify.alignment import aligned
from robosmi.verify.comparison import FirstDifference

_SURE_MS = 0.3
"""Events nearer to one another are unordered: nothing is claimed of the source below about 100 us."""
_NEAR_MS = 150.0
"""Events further apart are compared by their times alone."""
_QUIET_MS = 150.0
"""For so long before an event no input may have changed."""
_SHARP = (LEVEL, WAVE, BURST)


class _Begin(NamedTuple):
    """A begin in the source's nominal run: when, of what, and when it comes in the varied runs and on the target (ms)."""

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
    """What begins sharply on a channel and has its counterpart in all runs and on the target."""
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
        times = [run[pairs[number]].at_us / 1000 for run, pairs in paired(varied, seen) if number in pairs]
        if len(times) == len(varied):
            event, other = nominal[number], target[theirs[number]]
            found.append(_Begin(event.at_us / 1000, channel, event, tuple(times), other.at_us / 1000, other))
    return found


def _sharp(before: ActivityEvent, event: ActivityEvent) -> bool:
    """Whether the instant of an event is the program's: how a wave or a servo's frames end is not."""
    if event.kind not in _SHARP:
        return False
    return before.kind == LEVEL if event.kind == LEVEL else not (event.kind == WAVE and float(event.value[0]) <= 0)


def _swapped(before: _Begin, after: _Begin) -> bool:
    """Whether the target has clearly turned round what the source always does in one order, at about one distance."""
    apart_ms = after.at_ms - before.at_ms
    spread_ms = max((abs(b - a - apart_ms) for a, b in paired(before.varied_ms, after.varied_ms)), default=0.0)
    coarse_ms = max(_SURE_MS, *(_period_ms(each.event) for each in (before, after)))
    return apart_ms > 2 * spread_ms + coarse_ms and before.target_ms - after.target_ms > coarse_ms


def _period_ms(event: ActivityEvent) -> float:
    """A wave is seen from some part of its first period on."""
    return 1000 / float(event.value[0]) if event.kind == WAVE else 0.0


def _told(before: _Begin, after: _Begin) -> FirstDifference:
    message = (
        f"{before.event} comes {before.target_ms - after.target_ms:.2f} ms after {after.event} of {after.channel}, "
        f"instead of {after.at_ms - before.at_ms:.2f} ms before it"
    )
    return FirstDifference(before.at_ms, before.channel, message, before.event, before.target)
