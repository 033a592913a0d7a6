"""Which events of two runs belong together, and what needs no counterpart."""

from __future__ import annotations

import pytest

from robosmi.verify.traces.activity import IDLE, LEVEL, LINE, PULSES, ActivityEvent
from robosmi.verify.traces.alignment import aligned


def frames(*told: tuple[float, float, int]) -> list[ActivityEvent]:
    """Idle, then pulses of a servo: (ms, us, frames)."""
    return [IDLE, *(ActivityEvent(at * 1000, PULSES, (us,), frames=count) for at, us, count in told)]


FAST, SLOW = 1560.0, 1530.0


@pytest.mark.parametrize(
    ("own", "other", "pairs"),
    [
        (frames((20, FAST, 10)), frames((25, FAST, 9)), [(0, 0), (1, 1)]),
        (frames((20, FAST, 10), (220, SLOW, 2)), frames((20, FAST, 12)), [(0, 0), (1, 1)]),
        (frames((20, FAST, 12)), frames((20, FAST, 10), (220, SLOW, 2)), [(0, 0), (1, 1)]),
        (frames((20, FAST, 9), (200, SLOW, 2), (240, FAST, 9)), frames((20, FAST, 20)), [(0, 0), (1, 1)]),
        (frames((20, SLOW, 2), (60, FAST, 9)), frames((20, SLOW, 3), (80, FAST, 9)), [(0, 0), (1, 1), (2, 2)]),
    ],
)
def test_what_a_servo_shows_for_a_moment_may_be_missing(
    own: list[ActivityEvent], other: list[ActivityEvent], pairs: list[tuple[int, int]]
) -> None:
    found = aligned(own, other)
    assert found.pairs == pairs
    assert (found.own, found.other) == (len(own), len(other))


def test_what_a_servo_shows_for_three_frames_may_not_be_missing() -> None:
    found = aligned(frames((20, FAST, 9), (200, SLOW, 3), (260, FAST, 9)), frames((20, FAST, 20)))
    assert (found.pairs, found.own, found.other) == ([(0, 0), (1, 1)], 2, 2)


def test_it_ends_where_values_differ_and_where_they_do_not_come_in_time() -> None:
    own = [IDLE, *(ActivityEvent(at * 1000.0, LEVEL, (at // 100 % 2,)) for at in (100, 200, 300))]
    other = [*own[:2], ActivityEvent(250_000.0, LEVEL, (0,)), own[3]]
    assert aligned(own, other).pairs == [(0, 0), (1, 1), (2, 2), (3, 3)]
    found = aligned(own, other, lambda one, two: abs(own[one].at_us - other[two].at_us) < 40_000)
    assert (found.pairs, found.own, found.other) == ([(0, 0), (1, 1)], 2, 2)


def marks(*told: int) -> list[ActivityEvent]:
    """Marks of a device's way, one per second; negative ones are only just reached."""
    return [ActivityEvent(1e6 * at, LINE, (f"at {abs(mark)}",), barely=mark < 0) for at, mark in enumerate(told)]


@pytest.mark.parametrize(
    ("own", "other", "alike"),
    [
        ((12, 28, -44, 12), (12, 28, 12), True),
        ((12, 28, 12), (12, 28, -44, 12), True),
        ((12, 28, -44, 12), (12, 28, -44, 12), True),
        ((12, 28, 44, 12), (12, 28, 12), False),
        ((12, 28, -44, 12), (12, 12), False),
    ],
)
def test_a_mark_that_is_barely_reached_may_be_missing(own: tuple[int, ...], other: tuple[int, ...], alike: bool) -> None:
    found = aligned(marks(*own), marks(*other))
    assert ((found.own, found.other) == (len(own), len(other))) == alike
