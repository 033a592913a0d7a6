"""Compares servo widths that are shown for so few frames that the alignment of two runs may skip them.

Such a width may be missing, since it depends on when frames begin. But one that the target shows must lie between the widths
that the source shows around it: a width beyond these is no part of the same motion, it makes the servo twitch. Marginal widths
of a slow change are not judged: the source may pass the same width in a single frame.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from robosmi.verify.activity import PULSES, ActivityEvent
from robosmi.verify.alignment import FEW_FRAMES

_BEYOND_US = 20.0
"""How far beyond the source's widths one may lie, in microseconds: the distance of the marks by which ramps are compared."""
_AROUND_US = 100_000.0
"""By how much the events of one motion may begin earlier or later in another run, in microseconds: five frames."""


def first_stray_width(
    runs: Sequence[Sequence[ActivityEvent]], target: Sequence[ActivityEvent], pairs: Sequence[tuple[int, int]]
) -> ActivityEvent | None:
    """The first width of the target without a counterpart that lies beyond the widths of the source around it.

    Args:
        runs: the events of the source's runs, the nominal one first; if none has a servo's width, nothing is judged.
        target: the events of the target.
        pairs: the indices of corresponding events of the nominal run and of the target, in order.
    """
    paired = {other: own for own, other in pairs}
    for number, event in enumerate(target):
        if event.kind != PULSES or event.barely or not 0 < event.frames <= FEW_FRAMES or number in paired:
            continue
        before = max((own for other, own in paired.items() if other < number), default=None)
        after = min((own for other, own in paired.items() if other > number), default=None)
        begin_us = runs[0][before].at_us if before is not None else event.at_us
        end_us = runs[0][after].at_us if after is not None else event.at_us
        widths = [width for run in runs for width in _widths(run, begin_us - _AROUND_US, end_us + _AROUND_US)]
        if widths and not min(widths) - _BEYOND_US <= float(event.value[0]) <= max(widths) + _BEYOND_US:
            return event
    return None


def _widths(run: Sequence[ActivityEvent], begin_us: float, end_us: float) -> Iterator[float]:
    """The servo widths that begin in a time, and the last one before it, which may last into it, and the first one after it."""
    last: ActivityEvent | None = None
    first: ActivityEvent | None = None
    for event in run:
        if event.kind != PULSES:
            continue
        if event.at_us < begin_us:
            last = event
        elif event.at_us <= end_us:
            yield float(event.value[0])
        elif first is None:
            first = event
    for near in (last, first):
        if near is not None:
            yield float(near.value[0])
