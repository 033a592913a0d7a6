"""Whether a device comes to rest at the same places: within a width of each run of the source, and no further."""

from __future__ import annotations

import pytest

from robosmi.transformations.verification.rest_comparison import compare_rests
from robosmi.verify.traces.comparison import DIFFERENT, NOT_EXERCISED, SAME
from robosmi.verify.traces.goals_of_motions import Driven, Rest, RestKind

PLACED, TIMED = RestKind("ticks", 1.6, timed=False), RestKind("ticks", 0.0, timed=True)


def way(*places: float, barely: tuple[int, ...] = ()) -> list[Rest]:
    """Rests a second apart, reached at 64 ticks a second each."""
    before = [0.0, *places]
    return [
        Rest(1000.0 * (number + 1), place, abs(place - before[number]), 128.0, number in barely)
        for number, place in enumerate(places)
    ]


@pytest.mark.parametrize(
    ("runs", "target", "status"),
    [
        ([way(64, 90)], way(65, 91), SAME),
        ([way(64, 90)], way(64, 88.3), DIFFERENT),
        ([way(64, 90), way(64, 91)], way(64, 91.8), DIFFERENT),  # further than the width from the run that is first
        ([way(64, 90), way(64, 91)], way(64, 91.5), SAME),
        ([way(64, 90), way(64, 92)], way(64, 92.3), SAME),  # the source itself is so far off
        ([way(64, 90), way(64, 92)], way(64, 92.4), DIFFERENT),
        ([way(64, 90), way(64, 99)], way(64, 40), SAME),  # these are not the same rests, nor
        ([way(64, 90)], [*way(64), Rest(3500.0, 154, 90, 128.0)], SAME),  # what comes at another time
        ([way(64, 90), way(64)], way(64, 40), SAME),  # beyond what all runs of the source come to
        ([way(64, 90)], way(64), SAME),  # that there is no second rest is another channel's
        ([way(64, 70, 90, barely=(1,))], [*way(64), Rest(3000.0, 90, 26, 128.0)], SAME),
        ([[*way(64), Rest(3000.0, 90, 26, 128.0)]], way(64, 75, 90, barely=(1,)), SAME),
        ([way(64, 70, 90, barely=(1,))], [*way(64), Rest(3000.0, 84, 20, 128.0)], DIFFERENT),
        ([way(64)], [], NOT_EXERCISED),
    ],
)
def test_a_place_is_the_same_within_the_width_of_each_run(runs: list[list[Rest]], target: list[Rest], status: str) -> None:
    assert compare_rests("wheel at rest", runs, target, PLACED).status == status


@pytest.mark.parametrize(
    ("target", "status"),
    [(way(65, 91), SAME), (way(65.5, 93), SAME), (way(65.5, 89), DIFFERENT), (way(66.5, 93), DIFFERENT)],
)
def test_motions_that_last_for_a_time_are_compared_one_by_one(target: list[Rest], status: str) -> None:
    """A frame at 64 ticks/s is 1.3 of them, beside 1 % of the way."""
    assert compare_rests("wheel at rest", [way(64, 90)], target, TIMED).status == status


@pytest.mark.parametrize(
    ("beyond", "place", "status"),
    [
        (0.0, 62.5, SAME),  # two servos
        (0.0, 58.9, DIFFERENT),
        (3.2, 58.9, SAME),  # a motor does not go on for 50 ms
        (3.2, 55.0, DIFFERENT),
    ],
)
def test_a_servo_that_is_left_alone_goes_on_and_a_motor_does_not(beyond: float, place: float, status: str) -> None:
    servo = [each._replace(beyond=3.2) for each in way(64)]
    motor = [each._replace(beyond=3.2 - beyond) for each in way(place)]
    assert compare_rests("wheel at rest", [servo], motor, TIMED).status == status


def test_a_difference_tells_both_places_and_what_is_the_same() -> None:
    found = compare_rests("left at rest", [way(64, 90), way(64, 90.5)], way(64, 84), PLACED)
    assert found.difference is not None
    assert (found.difference.at_ms, found.difference.channel, found.events) == (2000.0, "left at rest", 1)
    assert found.difference.message == ("rests 84.0 ticks from where it began; the original 90.0 (tolerance 88.9 to 91.6)")


WHEEL, SERVO = RestKind("ticks", 1.6, timed=True, recounts=6.0), RestKind("degrees", 5.7, timed=True)


def motions(*steps: tuple[str, float]) -> list[Rest]:
    """Rests a second apart, after motions of such a kind and length; those for a time are at 64 units a second."""
    rests: list[Rest] = []
    place = 0.0
    for aim, way in steps:
        place = way if aim == "place" else place + way
        driven = Driven(abs(way), 128.0, aim) if aim == "time" else Driven(0.0, 0.0, aim)
        rests.append(Rest(1000.0 * (len(rests) + 1), place, abs(way), 128.0, driven=driven))
    return rests


@pytest.mark.parametrize(
    ("kind", "source", "target", "status"),
    [
        (WHEEL, [("time", 50.5), ("way", 26)], [52.0, 78.0], SAME),
        (WHEEL, [("time", 50.5), ("way", 26)], [52.9, 78.0], DIFFERENT),  # a frame at 64 ticks/s is 1.3 of them
        (WHEEL, [("time", 50.5), ("way", 26)], [52.0, 75.6], DIFFERENT),  # a tenth less
        (WHEEL, [("time", 50.5), ("way", 26)], [51.9, 76.6], SAME),  # counted from the tick where it stood
        (WHEEL, [("time", 50.5), ("way", 26), ("way", 26)], [51.9, 78.0, 103.0], SAME),
        (WHEEL, [("time", 50.5), ("way", 26), ("way", 26)], [51.9, 78.0, 100.8], DIFFERENT),  # what is counted adds up
        (WHEEL, [("way", 26.2), ("time", 3.9), ("way", 26)], [26.2, 28.9, 56.1], SAME),  # so short that the old goal counts
        (WHEEL, [("way", 26.2), ("time", 50.0), ("way", 26)], [26.2, 77.0, 105.0], DIFFERENT),
        (SERVO, [("time", 200), ("way", 90)], [203.0, 288.0], SAME),
        (SERVO, [("time", 200), ("way", 90)], [190.0, 290.0], SAME),  # where it stands in between does not matter to its goal
        (SERVO, [("time", 200), ("way", 90)], [200.0, 280.0], DIFFERENT),
        (SERVO, [("time", 200), ("way", 90), ("time", 200), ("way", 90)], [207.0, 297.0, 500.0, 588.0], SAME),
        (SERVO, [("time", 200), ("place", 90)], [206.0, 95.0], SAME),
        (SERVO, [("time", 200), ("place", 90)], [206.0, 96.0], DIFFERENT),  # a place is the same wherever it began
        (SERVO, [("time", 200), ("place", 90), ("way", 90)], [206.0, 92.0, 186.0], DIFFERENT),
        (TIMED, [("way", 26)], [27.0], SAME),  # how exactly such a goal is reached is not known of the device
    ],
)
def test_each_motion_is_compared_as_exactly_as_its_kind_allows(
    kind: RestKind, source: list[tuple[str, float]], target: list[float], status: str
) -> None:
    theirs = [Rest(1000.0 * (number + 1), place, 0.0, 0.0) for number, place in enumerate(target)]
    assert compare_rests("wheel at rest", [motions(*source)], theirs, kind).status == status


def test_a_short_rest_that_all_runs_have_is_compared() -> None:
    brief = way(64, 90, barely=(0, 1))
    assert compare_rests("wheel at rest", [brief, brief], way(64, 90), PLACED).status == SAME
    assert compare_rests("wheel at rest", [brief, brief], way(64, 87), PLACED).status == DIFFERENT
    assert compare_rests("wheel at rest", [brief, way(64)], way(64, 87), PLACED).status == SAME
