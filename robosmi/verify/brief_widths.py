"""Compares servo widths that are shown for so few frames that the alignment of two runs may skip them.

Such a width may be missing, since it depends on when frames begin: a program may set a width and another one before the next
frame. But if the target shows a width beyond all that the source ever shows, the servo twitches. Marginal widths of a slow
change are not judged: the source may pass the same width in a single frame.
"""

from __future__ import annotations

from collections.abc import Sequence

from robosmi.verify.activity import PULSES, ActivityEvent
from robosmi.verify.alignment import is_brief

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
