"""Frames of a servo: what is held is a width, a slow change passes marks, and neither hangs on a microsecond."""

from __future__ import annotations

import random
from collections.abc import Sequence
from itertools import pairwise

import pytest

from robosmi.transformations.verification.original_side import compared
from robosmi.verify.simulation import PinChange, PinTrace
from robosmi.verify.traces.activity import activity
from robosmi.verify.traces.comparison import DIFFERENT, RACY, SAME, compare
from robosmi.verify.traces.pulses import Pulse
from robosmi.verify.traces.servo_widths import servo_widths

HORIZON_US = 8_000_000.0


def pulses(widths: Sequence[float]) -> list[Pulse]:
    return [Pulse(n * 20_000.0, n * 20_000.0 + width) for n, width in enumerate(widths)]


def trace(widths: Sequence[float], begin_us: float = 30_000.0) -> PinTrace:
    edges = [(begin_us + n * 20_000 + at, level) for n, width in enumerate(widths) for at, level in ((0.0, 1), (width, 0))]
    return PinTrace("e", "running", HORIZON_US, tuple(PinChange(at, "D1", level) for at, level in edges), (), (), ())


def status(source: Sequence[float], target: Sequence[float], begin_us: float = 30_000.0) -> str:
    own, other = activity(trace(source), "D1"), activity(trace(target, begin_us), "D1")
    return compare("D1", own, other, [], HORIZON_US / 1000).status


def ramp(*points: tuple[int, float]) -> list[float]:
    """Widths between corners, each a number of frames and the width that is reached with them, as whole microseconds."""
    found: list[float] = []
    for (_, width), (frames, after) in pairwise([(0, 1500.0), *points]):
        found += [float(round(width + (after - width) * n / frames)) for n in range(frames)]
    return found


def nearing(width: float, goal: float, part: float, frames: int) -> list[float]:
    """Widths that each cover a part of the remaining distance to a goal."""
    found = []
    for _ in range(frames):
        found.append(float(round(width)))
        width += part * (goal - width)
    return found


def test_widths_that_are_held_are_widths_however_near_they_are() -> None:
    told = servo_widths(pulses([*[1500.0] * 20, *[1510.0] * 20, *[1520.0] * 20]), 2)
    assert [(each.width_us, each.frames, each.barely) for each in told] == [
        (1500, 20, False), (1510, 20, False), (1520, 20, False),
    ]  # fmt: skip


def test_a_slow_change_passes_marks_between_what_is_held() -> None:
    told = servo_widths(pulses([*[1500.0] * 20, *(1500.0 + n for n in range(1, 101)), *[1600.0] * 20]), 2)
    sure = [each.width_us for each in told if not each.barely]
    assert {1540.0, 1560.0} <= set(sure) <= {1500.0, 1520.0, 1540.0, 1560.0, 1580.0, 1600.0}
    assert told[-1].at_us + told[-1].vague_us >= 119 * 20_000


def test_a_fast_ramp_is_not_seen() -> None:
    told = servo_widths(pulses([*[1500.0] * 10, *(1500.0 + 20 * n for n in range(1, 11)), *[1700.0] * 10]), 2)
    assert [(each.width_us, each.vague_us) for each in told] == [(1500, 0), (1700, 0)]


@pytest.mark.parametrize("seed", range(40))
def test_a_change_that_is_a_microsecond_off_is_the_same(seed: int) -> None:
    chance = random.Random(seed)
    goals = [chance.randrange(1300, 1700) for _ in range(4)]
    source = ramp(*((chance.choice((12, 30, 70, 100)), goal) for goal in goals))
    source += nearing(source[-1], chance.randrange(1300, 1700), chance.choice((0.05, 0.1, 0.3)), 60)
    target = [width + chance.choice((-1, 0)) for width in source]
    assert status(source, target, 30_000 + chance.uniform(-15_000, 15_000)) == SAME


def test_a_change_of_another_shape_is_different() -> None:
    slow = [*[1500.0] * 20, *ramp((100, 1700.0)), *[1700.0] * 40]
    assert status(slow, [*[1500.0] * 20, *ramp((50, 1700.0)), *[1700.0] * 90]) == DIFFERENT
    assert status(slow, [*[1500.0] * 20, *ramp((50, 1550.0), (50, 1700.0)), *[1700.0] * 40]) == DIFFERENT
    assert status(slow, [*[1500.0] * 20, *ramp((100, 1680.0)), *[1680.0] * 40]) == DIFFERENT
    assert status(slow, [*[1500.0] * 20, *ramp((100, 1300.0)), *[1300.0] * 40]) == DIFFERENT


def by_hand(costs_us: Sequence[float], target: Sequence[float]) -> str:
    """Frames of 1500 and then of 1600 us to which the program's steps add a cost in each run of the source, and the target's."""
    runs = [activity(trace([*[1500 + cost] * 20, *[1600 + cost] * 20]), "D1") for cost in costs_us]
    return compared("D1", [runs], [activity(trace(target), "D1")], HORIZON_US / 1000).status


def test_a_width_that_the_program_makes_by_its_own_steps_is_as_vague_as_these_are() -> None:
    runs = (10.0, 20.0, 5.0, 10.0, 9.2, 8.4)
    assert by_hand(runs, [*[1517.0] * 20, *[1629.0] * 20]) == SAME
    assert by_hand(runs, [*[1517.0] * 20, *[1645.0] * 20]) == DIFFERENT
    assert by_hand(runs, [*[1517.0] * 20, *[1700.0] * 20]) == DIFFERENT
    assert by_hand(runs[:2], [*[1517.0] * 20, *[1629.0] * 20]) == SAME


def test_a_width_that_does_not_vary_with_the_cost_of_steps_is_held_as_before() -> None:
    assert by_hand((0.0, 0.0, 0.0, 0.0), [*[1500.0] * 20, *[1602.0] * 20]) == SAME
    assert by_hand((0.0, 0.0, 0.0, 0.0), [*[1500.0] * 20, *[1606.0] * 20]) == DIFFERENT
    assert by_hand((1.0, 2.0, 0.0, 1.0), [*[1500.0] * 20, *[1606.0] * 20]) == DIFFERENT


@pytest.mark.parametrize("runs", [(10.0, 0.0, 20.0), (10.0, 20.0, 15.0), (10.0, 200.0, 5.0), (10.0, 20.0, 5.0, 60.0)])
def test_a_width_that_varies_otherwise_is_racy(runs: tuple[float, ...]) -> None:
    assert by_hand(runs, [*[1510.0] * 20, *[1610.0] * 20]) == RACY
