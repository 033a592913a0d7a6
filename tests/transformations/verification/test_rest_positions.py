"""Where a device on a servo's line notes that it rests."""

from __future__ import annotations

import pytest

from robosmi.base.data_text import Json, as_list
from robosmi.transformations.verification.devices.servo_pulses import RestPositions

FRAME_MS = 20


def driven(*steps: tuple[float, int]) -> list[Json]:
    """What is noted of a wheel that goes at such speeds (ticks a second) for so many frames each, and stands without pulses.

    That is for each rest its place, the way to it, the changes of speed on that, and whether it is barely one.
    """
    told: list[Json] = []
    rests = RestPositions(150_000.0, 250_000.0, 0.5, lambda _, value: told.append(value))
    rests.begin(3.0)
    place, now_ms = 3.0, 0
    for speed, frames in steps:
        for _ in range(frames):
            if speed:
                rests.driven(speed, 1000.0 * now_ms)
            for _ in range(FRAME_MS):
                place += speed / 1000
                now_ms += 1
                rests.moved(place, 1000.0 * now_ms)
    rests.ended(1000.0 * now_ms)
    return [[*as_list(each)[:3], as_list(each)[4]] for each in told]


@pytest.mark.parametrize(
    ("aims", "timed"),
    [
        (("time", "time"), [20.0, 200.0, "time"]),
        (("time", "way"), [10.0, 100.0, "way"]),  # as if it had stopped in between
        (("way", "time"), [10.0, 200.0, "time"]),
        (("place", "place"), [0.0, 0.0, "place"]),
    ],
)
def test_what_is_driven_for_a_time_is_told_apart(aims: tuple[str, str], timed: list[Json]) -> None:
    told: list[Json] = []
    rests = RestPositions(150_000.0, 250_000.0, 0.5, lambda _, value: told.append(value))
    place, now_ms = 0.0, 0
    for aim, speed in zip(aims, (50, 100), strict=True):
        rests.aimed(aim)
        for _ in range(10 * FRAME_MS * 50 // speed):
            rests.driven(speed, 1000.0 * now_ms)
            place, now_ms = place + speed / 1000, now_ms + 1
            rests.moved(place, 1000.0 * now_ms)
    for _ in range(300):
        now_ms += 1
        rests.moved(place, 1000.0 * now_ms)
    rests.ended(1000.0 * now_ms)
    assert [as_list(each)[5] for each in told] == [timed]


FIRST: Json = [10.0, 10.0, 100.0, False]


@pytest.mark.parametrize(
    ("steps", "told"),
    [
        ([(50, 10), (0, 20)], [FIRST]),
        ([(50, 10), (-50, 10), (0, 20)], [[0.0, 20.0, 200.0, False]]),
        ([(50, 10), (0, 6), (4, 10), (0, 20)], [[10.8, 10.8, 100.0, False]]),  # a push to the last tick is of the same motion
        ([(0, 50), (50, 10)], []),  # it has not moved yet, and has not come to rest yet
        ([(50, 10), (0, 20), (50, 10), (0, 20)], [FIRST, [20.0, 10.0, 100.0, False]]),
        ([(50, 10), (0, 9), (50, 10), (0, 20)], [[10.0, 10.0, 100.0, True], [20.0, 10.0, 100.0, False]]),
        ([(50, 10), (0, 9)], [[10.0, 10.0, 100.0, True]]),
        ([(50, 10), (0, 20), (2, 2), (-2, 2), (0, 20)], [FIRST]),  # it holds its place
        ([(50, 10), (0, 20), (2, 5), (0, 20)], [[10.1, 10.0, 100.0, False]]),  # it settles there
        ([(50, 10), (0, 20), (2, 20), (0, 20)], [FIRST, [10.8, 0.8, 4.0, True]]),
    ],
)
def test_places_of_rest_are_noted_once_each(steps: list[tuple[float, int]], told: list[Json]) -> None:
    assert driven(*steps) == told
