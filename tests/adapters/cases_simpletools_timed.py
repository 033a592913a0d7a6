"""simpletools.h: pulses, RC time, counting, tones. Semantics of the library's sources (Simple-Libraries 1cc167c10)."""

from __future__ import annotations

import pytest

from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno, proves


def near(us: float) -> object:
    """A time within the greater of 1 % and 8 us."""
    return pytest.approx(us, rel=0.01, abs=8)


@proves("simpletools.h/pulse_out")
def pulse_out_makes_pulses_of_that_width(uno: Uno) -> None:
    program = """
void setup() { low(8); pulse_out(8, 10); pause(1); pulse_out(8, 150); pause(1); pulse_out(8, 1500); pause(1);
  pulse_out(8, 20000); pause(1); high(8); pause(3); pulse_out(8, 700); pause(3); low(8); }
void loop() {}
"""
    trace = uno.run(program, ["simpletools.h/pulse_out", "simpletools.h/pause", "simpletools.h/high", "simpletools.h/low"], 60)
    widths = [width for _, width in trace.pulses("D8")]
    assert widths[:4] == [near(10), near(150), near(1500), near(20000)]
    lows = [late[0] - (early[0] + early[1]) for early, late in zip(trace.pulses("D8"), trace.pulses("D8")[1:], strict=False)]
    assert lows[-1] == near(700)  # the inverse of the latch


@proves("simpletools.h/pulse_in")
def pulse_in_measures_the_next_pulse_in_microseconds(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200); Serial.println(pulse_in(7, 1)); Serial.println(pulse_in(7, 0)); Serial.println(1);
  Serial.println(pulse_in(7, 1)); Serial.println((millis() + 5) / 10); }
void loop() {}
"""
    points = [[0, 0], [10, 1], [11.234, 0], [30, 1], [40, 0], [45.5, 1]]
    trace = uno.run(program, ["simpletools.h/pulse_in"], 400, [DeviceUse("levels", {"pin": "D7"}, {"points": points})])
    first, second, _, third, ended = map(int, trace.text.split())
    assert first == near(1234)
    assert second == near(5500)
    assert third == 0
    assert ended == pytest.approx(29.6, abs=1)  # 250 ms without a pulse


@proves("simpletools.h/rc_time")
def rc_time_measures_a_decay(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200); high(4); pause(1); Serial.println(rc_time(4, 1)); low(4); pause(1);
Serial.println(rc_time(4, 1)); } void loop() {}
"""
    devices = [DeviceUse("capacitor", {"pin": "D4"}, {"points": [[0, 3000]]})]
    trace = uno.run(program, [f"simpletools.h/{name}" for name in ("rc_time", "high", "low", "pause")], 40, devices)
    first, second = map(int, trace.text.split())
    assert first == near(3000)
    assert second < 20  # the call itself


@proves("simpletools.h/count")
def count_counts_rising_edges(uno: Uno) -> None:
    program = "void setup() { Serial.begin(115200); Serial.println(count(5, 50)); Serial.println(count(5, 20)); }\nvoid loop() {}"
    points = [[1 + number / 2, number % 2] for number in range(200)]
    trace = uno.run(program, ["simpletools.h/count"], 120, [DeviceUse("levels", {"pin": "D5"}, {"points": points})])
    first, second = map(int, trace.text.split())
    assert first == pytest.approx(50, abs=1)
    assert second == pytest.approx(20, abs=1)


@proves("simpletools.h/freqout")
def freqout_plays_a_burst_of_that_length_and_frequency(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200); freqout(8, 1, 38000); Serial.println((int)input(2)); pause(9); freqout(8, 50, 3000);
pause(9); freqout(8, 20, 440); } void loop() {}
"""
    devices = [DeviceUse("levels", {"pin": "D2"}, {"points": [[0, 1]]})]
    trace = uno.run(program, [f"simpletools.h/{name}" for name in ("freqout", "input", "pause")], 150, devices)
    bursts: list[list[float]] = []
    for begun, _ in trace.pulses("D8"):
        if not bursts or begun - bursts[-1][-1] > 5000:
            bursts.append([])
        bursts[-1].append(begun)
    found = [((len(each) - 1) / (each[-1] - each[0]) * 1e6, each[-1] - each[0]) for each in bursts]
    assert [hertz for hertz, _ in found] == [pytest.approx(hertz, rel=0.01) for hertz in (38000, 3000, 440)]
    assert found[0][1] == pytest.approx(1000, abs=60)
    assert found[1][1] == pytest.approx(50_000, rel=0.02)
    assert trace.levels("D8")[-1][1] == "z"
    assert trace.text.strip() == "1"
