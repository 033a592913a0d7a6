"""Tones of a timer that are hardly apart are compared with edges, which do not tell them apart."""

from __future__ import annotations

import pytest

from robosmi.transformations.verification.original_side import compared
from robosmi.verify.traces.activity import IDLE, LEVEL, SIGHTS, WAVE, ActivityEvent
from robosmi.verify.traces.comparison import DIFFERENT, SAME

ENDS = ActivityEvent(900_000.0, LEVEL, (0,))


def tone(at_ms: float, hz: float, pulses: int = 0, duty: float = 0.5) -> ActivityEvent:
    return ActivityEvent(1000 * at_ms, WAVE, (hz, duty), pulses)


def status(source: list[ActivityEvent], target: list[ActivityEvent]) -> str:
    runs = [[IDLE, *source, ENDS]] * 3
    return compared("speaker", [runs] * len(SIGHTS), [[IDLE, *target, ENDS]] * len(SIGHTS), 2000.0).status


@pytest.mark.parametrize(
    ("source", "target", "expected"),
    [
        ([(100, 1051), (500, 1064)], [(100, 1057.5, 846)], SAME),
        ([(100, 1000), (200, 1030), (300, 1060), (500, 1090)], [(100, 1060, 848)], SAME),
        ([(100, 1051), (500, 1064)], [(100, 1110, 888)], DIFFERENT),
        ([(100, 1000), (500, 1200)], [(100, 1100, 880)], DIFFERENT),
        ([(100, 1000), (500, 1020)], [(100, 1000), (500, 1040)], DIFFERENT),
    ],
    ids=["two", "a rising tone", "another tone", "two notes", "a timer on both boards"],
)
def test_tones_that_edges_do_not_tell_apart(
    source: list[tuple[float, ...]], target: list[tuple[float, ...]], expected: str
) -> None:
    assert (
        status([tone(each[0], each[1]) for each in source], [tone(each[0], each[1], int(sum(each[2:]))) for each in target])
        == expected
    )


def test_parts_of_the_power_are_no_tones() -> None:
    source, target = [tone(100, 1000, duty=0.1), tone(500, 1020, duty=0.1)], [tone(100, 1010, 808, duty=0.1)]
    assert status(source, target) == DIFFERENT
