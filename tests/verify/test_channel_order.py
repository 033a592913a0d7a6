"""In which order near events of two channels come: when it is compared, and when nothing may be said of it."""

from __future__ import annotations

import pytest

from robosmi.transformations.verification.judgement.verdict import first_disorder
from robosmi.verify.traces.activity import IDLE, LEVEL, LINE, PULSES, WAVE, ActivityEvent


def wave(at_ms: float, hz: float = 38_000.0) -> list[ActivityEvent]:
    return [IDLE, ActivityEvent(at_ms * 1000, WAVE, (hz, 0.5))]


def high(at_ms: float) -> list[ActivityEvent]:
    return [IDLE, ActivityEvent(at_ms * 1000, LEVEL, (1,))]


def test_two_transmitters_that_are_swapped_are_told() -> None:
    source = {"left": [wave(500.0)] * 3, "right": [wave(501.1)] * 3}
    found = first_disorder(source, {"left": wave(501.2), "right": wave(500.1)}, [])
    assert found is not None
    assert (found.channel, found.at_ms) == ("left", 500.0)
    assert found.message == "38000 Hz comes 1.10 ms after 38000 Hz of right; in the original 1.10 ms before it"


@pytest.mark.parametrize("apart_ms", [0.0, 0.2, 1.1, 60.0])
def test_what_comes_in_the_same_order_is_no_difference(apart_ms: float) -> None:
    source = {"one": [high(500.0)] * 3, "two": [high(500.0 + apart_ms)] * 3}
    assert first_disorder(source, {"one": high(503.0), "two": high(503.0 + 1.2 * apart_ms)}, []) is None


@pytest.mark.parametrize(
    ("first", "second", "varied", "changes_ms"),
    [
        (high(500.0), high(500.2), [], []),  # nearer than anything is claimed of the source
        (high(500.0), high(502.0), [(high(500.0), high(501.0))], []),  # the source itself does not keep the distance
        (high(500.0), high(502.0), [(high(502.0), high(500.0))], []),  # nor the order
        (high(500.0), high(502.0), [], [450.0]),  # an input has changed just before
        (high(500.0), high(502.0), [], [501.0]),  # or between them
        (wave(500.0, 50.0), high(510.0), [], []),  # a wave is seen from some part of its period on
        ([IDLE, ActivityEvent(500_000.0, LINE, ("a",))], high(502.0), [], []),  # text is sent later than it is printed
        ([IDLE, ActivityEvent(500_000.0, PULSES, (1500.0,))], high(502.0), [], []),  # frames of a servo come when they come
        ([*wave(100.0), ActivityEvent(500_000.0, LEVEL, (0,))], high(502.0), [], []),  # so does the end of a wave
    ],
)
def test_nothing_is_said_where_the_order_is_not_the_programs(
    first: list[ActivityEvent],
    second: list[ActivityEvent],
    varied: list[tuple[list[ActivityEvent], list[ActivityEvent]]],
    changes_ms: list[float],
) -> None:
    source = {"one": [first, *(one for one, _ in varied)], "two": [second, *(two for _, two in varied)]}
    later = [*first[:-1], ActivityEvent(503_000.0, first[-1].kind, first[-1].value)]
    assert first_disorder(source, {"one": later, "two": high(499.0)}, changes_ms) is None
