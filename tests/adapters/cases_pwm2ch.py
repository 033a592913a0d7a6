"""pwm2ch.h: pulses on two pins. Semantics of the library's source (libpwm2ch, Simple-Libraries 1cc167c10)."""

from __future__ import annotations

from itertools import pairwise

import pytest

from tests.adapters.bench import Uno, proves

ALL = [f"pwm2ch.h/pwm2ch_{name}" for name in ("start", "set", "stop")]


@proves(*ALL)
def two_pins_get_their_pulses_in_a_common_cycle(uno: Uno) -> None:
    program = """
void setup() { pwm2ch *device = pwm2ch_start(2000); pwm2ch_set(device, 5, 0, 500); pwm2ch_set(device, 6, 1, 1500); delay(20);
  pwm2ch_set(device, 5, 0, 0); pwm2ch_set(device, 6, 1, 2000); delay(20); pwm2ch_set(device, 7, 0, 100);
  pwm2ch_set(device, 6, 1, -1); delay(20); pwm2ch_stop(device); delay(20);
  device = pwm2ch_start(20000); pwm2ch_set(device, 8, 1, 1500); pwm2ch_set(device, 9, 1, 2500); }
void loop() {}
"""
    trace = uno.run(program, ALL, 190)
    widths = {pin: trace.pulses(f"D{pin}") for pin in (5, 6, 7, 8, 9)}
    starts = [at for at, _ in widths[5]]
    assert len(starts) == pytest.approx(10, abs=1)
    assert [late - early for early, late in pairwise(starts)] == pytest.approx([2000] * (len(starts) - 1), abs=8)
    assert [width for _, width in widths[5]] == pytest.approx([500] * len(starts), abs=8)
    assert [width for _, width in widths[6][:8]] == pytest.approx([1500] * 8, abs=8)
    assert widths[6][-1][1] > 15_000  # all of the cycle
    assert [width for _, width in widths[7]] == pytest.approx([100] * len(widths[7]), abs=8)
    assert len(widths[7]) == pytest.approx(10, abs=1)
    assert [trace.levels(f"D{pin}")[-1][1] for pin in (5, 6, 7, 8)] == ["z"] * 4
    assert [late[0] - early[0] for early, late in pairwise(widths[9])] == pytest.approx([20_000] * (len(widths[9]) - 1), abs=8)
    assert [width for _, width in widths[9]] == pytest.approx([2500] * len(widths[9]), abs=8)
    assert len(widths[9]) >= 3


@proves(*ALL)
def two_devices_have_cycles_of_their_own(uno: Uno) -> None:
    program = """
void setup() { pwm2ch *one = pwm2ch_start(1000), *other = pwm2ch_start(1200);
  pwm2ch_set(one, 5, 0, 300); pwm2ch_set(one, 6, 1, 600); pwm2ch_set(other, 7, 0, 100); pwm2ch_set(other, 8, 1, 200); delay(60);
  pwm2ch_set(other, 8, 1, -1); pwm2ch_set(one, 8, 1, 600); delay(40);
  pwm2ch_stop(one); delay(40);
  one = pwm2ch_start(20000); pwm2ch_set(one, 9, 0, 1500); delay(90);
  pwm2ch_stop(other); pwm2ch_stop(one); delay(10); }
void loop() {}
"""
    trace = uno.run(program, ALL, 260)

    def between(pin: int, begin_ms: float, end_ms: float) -> tuple[list[float], list[float]]:
        pulses = [each for each in trace.pulses(f"D{pin}") if begin_ms * 1000 <= each[0] < end_ms * 1000]
        return [later - begun for (begun, _), (later, _) in pairwise(pulses)], [width for _, width in pulses]

    for pin, cycle, width, begin_ms, end_ms in (
        (5, 1000, 300, 3, 98), (6, 1000, 600, 3, 58), (7, 1200, 100, 3, 138), (8, 1200, 200, 3, 58), (8, 1000, 600, 63, 98),
        (7, 1200, 100, 143, 228), (9, 20000, 1500, 143, 226),
    ):  # fmt: skip
        cycles, widths = between(pin, begin_ms, end_ms)
        assert len(widths) == pytest.approx((end_ms - begin_ms) * 1000 / cycle, abs=1.5)
        assert cycles == pytest.approx([cycle] * len(cycles), abs=20)
        assert widths == pytest.approx([width] * len(widths), abs=20)
        assert sum(cycles) / len(cycles) == pytest.approx(cycle, rel=0.002)
    assert [trace.levels(f"D{pin}")[-1][1] for pin in (5, 6, 7, 8, 9)] == ["z"] * 5
    assert not between(5, 101, 260)[1]
    assert not between(7, 231, 260)[1]


@proves(*ALL)
def a_third_device_makes_no_pulses(uno: Uno) -> None:
    program = """
void setup() { pwm2ch *one = pwm2ch_start(1000), *other = pwm2ch_start(1000), *third = pwm2ch_start(1000);
  pwm2ch_set(third, 5, 0, 300); pwm2ch_set(one, 6, 0, 300); pwm2ch_set(other, 7, 1, 300); delay(10);
  pwm2ch_stop(third); delay(10); pwm2ch_stop(one); pwm2ch_stop(other); }
void loop() {}
"""
    trace = uno.run(program, ALL, 30)
    assert not trace.pulses("D5")
    assert [len(trace.pulses(f"D{pin}")) for pin in (6, 7)] == pytest.approx([20, 20], abs=1)
