"""Servo widths of one or two frames: one may be missing, but none may lie beyond all that the source shows."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from robosmi.verify.traces.activity import LEVEL, PULSES, ActivityEvent
from robosmi.verify.traces.comparison import DIFFERENT, SAME, compare

Shown = Sequence[tuple[float, float, int]]
"""When a width begins (ms), the width (us; 0 for no pulses), and for how many frames it is shown."""


def _events(shown: Shown) -> list[ActivityEvent]:
    found = [ActivityEvent(0.0, LEVEL, (0,))]
    for at_ms, width, frames in shown:
        value = ActivityEvent(1000 * at_ms, PULSES, (width,), frames=frames)
        found.append(value if width else ActivityEvent(1000 * at_ms, LEVEL, (0,)))
    return found


_SOURCE: Shown = [(5, 1500, 2), (60, 0, 0), (160, 1482, 1), (180, 1463, 90), (2000, 0, 0)]


@pytest.mark.parametrize(
    ("target", "status"),
    [
        (_SOURCE, SAME),
        ([(5, 1500, 1), (45, 0, 0), (180, 1463, 90), (2000, 0, 0)], SAME),  # one frame less, and none
        ([(5, 1515, 2), (60, 0, 0), (160, 1482, 1), (180, 1463, 90), (2000, 0, 0)], SAME),
        ([(5, 1305, 2), (60, 0, 0), (160, 1482, 1), (180, 1463, 90), (2000, 0, 0)], DIFFERENT),
        ([(5, 1695, 2), (60, 0, 0), (160, 1482, 1), (180, 1463, 90), (2000, 0, 0)], DIFFERENT),
        ([(5, 1500, 2), (60, 0, 0), (160, 1482, 1), (180, 1463, 50), (1180, 1500, 1), (1200, 1463, 39), (2000, 0, 0)], SAME),
        ([(5, 1500, 2), (60, 0, 0), (160, 1482, 1), (180, 1463, 50), (1180, 1700, 1), (1200, 1463, 39), (2000, 0, 0)], DIFFERENT),
    ],
)
def test_a_brief_width_does_not_lie_beyond_those_of_the_source(target: Shown, status: str) -> None:
    found = compare("servo", _events(_SOURCE), _events(target), [], 3000.0)
    assert found.status == status
    if status == DIFFERENT:
        assert found.difference is not None
        assert "outside all pulse widths of the original" in found.difference.message


def test_what_another_run_of_the_source_shows_counts() -> None:
    target = [(5, 1500, 2), (60, 0, 0), (160, 1600, 1), (180, 1463, 90), (2000, 0, 0)]
    varied = [(5, 1500, 2), (60, 0, 0), (160, 1620, 1), (180, 1463, 90), (2000, 0, 0)]
    assert compare("servo", _events(_SOURCE), _events(target), [], 3000.0).status == DIFFERENT
    assert compare("servo", _events(_SOURCE), _events(target), [_events(varied)], 3000.0).status == SAME
