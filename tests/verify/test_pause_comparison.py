"""Whether a program leaves a sensor alone for as long as the original does: a loop with another pause reacts later."""

from __future__ import annotations

import pytest

from robosmi.transformations.verification.pause_comparison import Pause, Stretch, compare_pauses
from robosmi.verify.traces.comparison import DIFFERENT, SAME

ALL = (Stretch(50.0, 3000.0),)


def loop(*pauses: float, answer: float = 6.0) -> list[Pause]:
    """Pauses one after the other, with an answer of the sensor between them."""
    found, at = [], 100.0
    for each in pauses:
        found.append(Pause(at, each))
        at += each + answer
    return found


@pytest.mark.parametrize(
    ("runs", "target", "status"),
    [
        ([loop(*[6.0] * 50)], loop(*[6.1] * 50), SAME),
        ([loop(*[6.0] * 50)], loop(*[41.0] * 50), DIFFERENT),
        ([loop(*[41.0] * 30)], loop(*[6.0] * 50), DIFFERENT),
        ([loop(*[200.0] * 12)], loop(*[190.0] * 12), DIFFERENT),
        ([loop(*[200.0] * 12)], loop(*[202.0] * 12), SAME),
        ([loop(*[6.0] * 40, 500.0)], loop(500.0, *[6.0] * 40), SAME),  # a pass in which the program acts
        ([loop(*[6.0] * 50), loop(*[6.4] * 50)], loop(*[8.0] * 50), SAME),  # steps that cost twice as much take 0.4 ms more
        ([loop(*[6.0] * 50), loop(*[6.4] * 50)], loop(*[11.5] * 50), DIFFERENT),
        ([loop(*[6.0] * 50), loop(*[6.4] * 50)], loop(*[4.0] * 50), DIFFERENT),  # steps cannot be that much faster
        ([loop(*[6.0] * 50), loop(*[6.0] * 50), loop(*[9.0] * 50)], loop(*[9.0] * 50), SAME),  # the source itself varies
        ([loop(*[6.0, 60.0] * 15)], loop(*[30.0] * 20), None),  # no pause is usual
        ([loop(*[6.0] * 4)], loop(*[41.0] * 4), None),  # too few to tell
        ([loop(*[6.0] * 50), loop(6.0)], loop(*[41.0] * 50), None),  # not in all runs of the source
        ([loop(*[6.0] * 50)], [], DIFFERENT),  # the sensor is asked no more
    ],
)
def test_the_usual_pause_is_the_same_within_what_steps_cost(
    runs: list[list[Pause]], target: list[Pause], status: str | None
) -> None:
    found = compare_pauses("ranger", runs, target, ALL, ())
    assert (None if found is None else found.status) == status


def test_what_the_original_prints_in_its_loop_may_be_sent_beside_it() -> None:
    runs, target = [loop(*[8.0] * 40)], loop(*[6.1] * 40)
    printed = [100.0 + 14.0 * number + 0.09 * byte for number in range(40) for byte in range(22)]
    assert compare_pauses("ranger", runs, target, ALL, printed).status == SAME  # type: ignore[union-attr]
    assert compare_pauses("ranger", runs, target, ALL, ()).status == DIFFERENT  # type: ignore[union-attr]


def test_pauses_are_compared_between_changes_of_the_inputs_and_the_first_difference_is_told() -> None:
    one, other = loop(*[6.0] * 20), [Pause(each.at_ms + 1000, 41.0) for each in loop(*[41.0] * 10)]
    runs = [[*one, *(Pause(each.at_ms + 1000, 6.0) for each in loop(*[6.0] * 20))]]
    stretches = (Stretch(50.0, 1000.0), Stretch(1050.0, 3000.0))
    found = compare_pauses("ranger", runs, [*one, *other], stretches, ())
    assert found is not None
    assert found.difference is not None
    assert (found.status, found.events, found.difference.at_ms) == (DIFFERENT, 2, 1050.0)
    assert "41.00 ms" in found.difference.message
    assert "6.00 ms" in found.difference.message
