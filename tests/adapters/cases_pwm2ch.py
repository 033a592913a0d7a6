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
