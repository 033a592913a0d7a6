"""simpletools.h: waves that go on, duty, shifting. Semantics of the library's sources (Simple-Libraries 1cc167c10)."""

from __future__ import annotations

import itertools

import pytest

from robosmi.verify.simulation import DeviceUse, PinTrace
from tests.adapters.bench import Uno, proves


def s(*names: str) -> list[str]:
    """The `header/name` of these functions of simpletools.h."""
    return [f"simpletools.h/{name}" for name in names]


def hertz(trace: PinTrace, pin: str, from_ms: float, to_ms: float) -> float:
    """The mean frequency at a pin between two times; 0 without two pulses."""
    begins = [begun for begun, _ in trace.pulses(pin) if from_ms * 1000 <= begun < to_ms * 1000]
    return (len(begins) - 1) / (begins[-1] - begins[0]) * 1e6 if len(begins) > 1 else 0


@proves(*s("square_wave", "square_wave_stop", "set_io_timeout", "set_io_dt"))
def square_waves_go_on_until_they_are_ended(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200);
  square_wave(8, 0, 3000); pause(20); square_wave(9, 0, 500); pause(20); square_wave(-9, 0, 0); pause(20);
  square_wave(10, 1, 2000); pause(20); square_wave_stop(); pause(20); square_wave(255, 0, 1000); square_wave(8, 0, 20); pause(10);
  square_wave(8, 0, 38000); pause(5);
  square_wave_stop(); set_io_timeout(CLKFREQ / 50); Serial.print(pulse_in(4, 1)); Serial.print(' ');
  set_io_dt(8000); Serial.print(rc_time(4, 0));
} void loop() {}
"""
    uses = [
        *s("square_wave", "square_wave_stop", "set_io_timeout", "set_io_dt", "pause", "pulse_in", "rc_time"),
        "propeller.h/CLKFREQ",
    ]
    trace = uno.run(program, uses, 200, [DeviceUse("levels", {"pin": "D4"}, {"points": [[0, 0]]})])
    assert hertz(trace, "D8", 0, 20) == pytest.approx(3000, rel=0.01)
    assert hertz(trace, "D9", 20, 40.1) == pytest.approx(500, rel=0.01)
    assert not [begun for begun, _ in trace.pulses("D8") if 20_500 < begun < 110_000]
    assert hertz(trace, "D10", 60, 80.1) == pytest.approx(2000, rel=0.01)
    assert hertz(trace, "D8", 110, 116) == pytest.approx(38000, rel=0.01)
    assert [trace.levels(pin)[-1][1] for pin in ("D8", "D9", "D10")] == ["z", "z", "z"]
    assert [begun for begun, _ in trace.pulses("D9")][-1] < 40_500
    assert trace.text == "0 200"  # 20 ms without a pulse, and in units of 100 us


@proves(*s("square_wave", "count"), in_c=False)
def a_wave_is_counted_at_its_own_pin(uno: Uno) -> None:
    """The wave is another cog's, which goes on driving."""
    program = """
void setup() { Serial.begin(115200); square_wave(8, 0, 20); delay(10); Serial.print(count(8, 300)); Serial.print(' ');
  square_wave(8, 0, 400); Serial.print(count(8, 100)); high(9); Serial.print(' '); Serial.print(count(9, 10)); delay(5); }
void loop() {}
"""
    trace = uno.run(program, s("square_wave", "count", "high"), 500)
    assert trace.text in ("6 40 0", "6 41 0")
    assert hertz(trace, "D8", 20, 310) == pytest.approx(20, rel=0.01)
    assert trace.levels("D9")[-1][1] == "z"  # any other pin becomes an input


@proves(*s("square_wave", "square_wave_stop", "freqout"), in_c=False)
def slow_waves_go_on_until_they_are_ended(uno: Uno) -> None:
    """The phase of a counter begins at 0, so that the first half period is low."""
    program = """
void setup() {
  square_wave(8, 0, 10); delay(420); square_wave(8, 0, 30); delay(400); square_wave(8, 0, 3000); delay(20);
  square_wave(8, 0, 20); delay(120); freqout(9, 50, 2000); delay(210); square_wave(-8, 0, 0); delay(200);
  square_wave(10, 1, 1); delay(1600); square_wave_stop(); freqout(9, 50, 1000); delay(50);
} void loop() {}
"""
    trace = uno.run(program, s("square_wave", "square_wave_stop", "freqout"), 3400)
    pulses = trace.pulses("D8")
    assert [begun / 1000 for begun, _ in pulses[:4]] == pytest.approx([50, 150, 250, 350], abs=0.3)
    assert [width / 1000 for _, width in pulses[:3]] == pytest.approx([50] * 3, abs=0.1)
    assert hertz(trace, "D8", 480, 820) == pytest.approx(30, rel=0.003)
    assert hertz(trace, "D8", 822, 839) == pytest.approx(3000, rel=0.01)
    assert [begun / 1000 for begun, _ in pulses if begun > 841e3] == pytest.approx([865, 915], abs=0.5)  # until the tone
    assert hertz(trace, "D9", 960, 1010) == pytest.approx(2000, rel=0.01)
    assert trace.levels("D8")[-1][1] == "z"
    assert [begun / 1000 for begun, _ in trace.pulses("D10")] == pytest.approx([1920, 2920], abs=1)
    assert [width / 1000 for _, width in trace.pulses("D10")] == pytest.approx([500, 100], abs=1)
    assert hertz(trace, "D9", 3020, 3070) == pytest.approx(1000, rel=0.01)
    assert trace.levels("D10")[-1][1] == "z"


@proves(*s("pwm_start", "pwm_set", "pwm_stop"))
def two_channels_have_pulses_of_their_own_in_any_cycle(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200);
  Serial.print(pwm_start(1000) > 0); pwm_set(4, 0, 250); pwm_set(7, 1, 600); pause(20);
  pwm_set(4, 0, 0); pwm_set(7, 1, 1000); pause(10); pwm_set(7, 1, 100); pause(10);
  pwm_set(8, 1, 100); pause(5); Serial.print(get_direction(7));
  pwm_stop(); pause(10); Serial.print(get_direction(8)); Serial.print(get_direction(0));
  pwm_start(100000); pwm_set(4, 0, 20000); pause(320); pwm_stop();
} void loop() {}
"""
    trace = uno.run(program, s("pwm_start", "pwm_set", "pwm_stop", "pause", "get_direction"), 420)
    four, seven, eight = (trace.pulses(pin) for pin in ("D4", "D7", "D8"))
    eight = [pulse for pulse in eight if pulse[0] < 60_000]
    quick = [pulse for pulse in four if pulse[0] < 19_500]
    assert [width for _, width in quick] == [pytest.approx(250, abs=8)] * len(quick)
    assert [late[0] - early[0] for early, late in itertools.pairwise(quick)] == [pytest.approx(1000, abs=8)] * (len(quick) - 1)
    assert len(quick) == 19
    assert [width for begun, width in seven if begun < 18_500] == [pytest.approx(600, abs=8)] * 18
    assert max(width for _, width in seven) > 8000  # the whole cycle
    assert [width for begun, width in seven if 33_000 < begun < 39_000] == [pytest.approx(100, abs=8)] * 6
    assert not [begun for begun, _ in four if 21_500 < begun < 55_000]
    assert [width for _, width in eight] == [pytest.approx(100, abs=8)] * len(eight)
    assert 4 <= len(eight) <= 5
    assert [width for begun, width in four if begun > 60_000] == [pytest.approx(20_000, abs=20)] * 3
    assert trace.text == "1" + "0" + "00"


@proves(*s("pwm_start", "pwm_set"))
def a_new_length_counts_from_the_next_cycle_on(uno: Uno) -> None:  # the cog looks for it once in a cycle
    program = """
void setup() { pwm_start(10000); pwm_set(4, 0, 10000); pwm_set(7, 1, 6000);
  for (int turn = 0; turn < 10; turn++) { pause(7); pwm_set(4, 0, 10000); pwm_set(7, 1, turn & 1 ? 6000 : 2000); }
} void loop() {}
"""
    trace = uno.run(program, s("pwm_start", "pwm_set", "pause"), 90)
    assert [level for _, level in trace.levels("D4")][-2:] == [0, 1]
    assert [level for _, level in trace.levels("D4")].count(1) == 1
    lengths = [width for _, width in trace.pulses("D7")]
    assert len(lengths) >= 6
    assert {2000 if width < 4000 else 6000 for width in lengths} == {2000, 6000}
    assert lengths == [pytest.approx(2000 if width < 4000 else 6000, abs=8) for width in lengths]


@proves(*s("dac_ctr", "dac_ctr_res", "dac_ctr_stop"))
def duty_stands_for_a_voltage(uno: Uno) -> None:
    program = """
void setup() { dac_ctr(5, 0, 64); pause(5); dac_ctr(6, 1, 128); pause(5); dac_ctr_res(10); dac_ctr(5, 0, 768); pause(5);
  dac_ctr(3, 0, 256); pause(5); dac_ctr_res(0); dac_ctr(6, 1, 256 + 32); pause(5); dac_ctr_stop(); } void loop() {}
"""
    trace = uno.run(program, s("dac_ctr", "dac_ctr_res", "dac_ctr_stop", "pause"), 50)
    duties = {pin: [wave.duty for wave in trace.waves if wave.pin == pin] for pin in ("D3", "D5", "D6")}
    assert duties["D5"] == [pytest.approx(0.25, abs=0.01), pytest.approx(0.75, abs=0.01), 0]
    assert duties["D6"] == [pytest.approx(0.5, abs=0.01), pytest.approx(0.125, abs=0.01), 0]
    assert duties["D3"] == [pytest.approx(0.25, abs=0.01), 0]
    assert [trace.levels(pin)[-1][1] for pin in ("D3", "D5", "D6")] == ["z", "z", "z"]


@proves(*s("shift_out", "shift_in"))
def bits_are_shifted_in_both_orders_before_and_after_the_clock(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200);
  shift_out(8, 9, LSBFIRST, 8, 0x1D); pause(1); shift_out(8, 9, MSBFIRST, 12, 0x51D); pause(1);
  shift_out(8, 9, MSBFIRST, 32, 0x80000001);
  for (int32_t mode = 0; mode < 4; mode++) { pause(2); Serial.print(shift_in(7, 10, mode, 6), HEX); Serial.print(' '); }
  set_output(12, 1); shift_out(12, 13, LSBFIRST, 1, 0); pause(1); Serial.print(shift_in(7, 10, MSBPRE, 32) == -1);
} void loop() {}
"""
    names = s("shift_out", "shift_in", "pause", "set_output", "LSBFIRST", "MSBFIRST", "MSBPRE")
    loop_back = uno.run(program, names, 60, [DeviceUse("levels", {"pin": "D7"}, {"points": [[0, 1]]})])
    clocks = [begun for begun, _ in loop_back.pulses("D9")]
    data = loop_back.levels("D8")
    bits = [next(level for at, level in reversed(data) if at <= clock) for clock in clocks]
    text = "".join(map(str, bits))
    assert text == f"{0x1D:08b}"[::-1] + f"{0x51D:012b}" + f"{0x80000001:032b}"
    assert loop_back.text.split() == ["3F", "3F", "3F", "3F", "1"]
    assert next(level for _, level in loop_back.levels("D9")) == 0


@proves(*s("shift_in"))
def bits_are_taken_where_the_mode_says(uno: Uno) -> None:
    """Each run gets its data line from the clock of the one before, a new bit 1 us after each rising edge, until the clock stays.

    What a bit is may change the time that a call takes by some cycles.
    """
    program = """
void setup() { Serial.begin(115200); int32_t read[4];
  for (int32_t mode = 0; mode < 4; mode++) { pause(2); read[mode] = shift_in(7, 10, mode, 6); }
  for (int mode = 0; mode < 4; mode++) { Serial.print(read[mode], BIN); Serial.print(' '); }
} void loop() {}
"""
    names = s("shift_in", "pause")
    bits, trace, rises = [0, 1, 1, 0, 1, 0, 0], uno.run(program, names, 40), list[float]()
    for _ in range(8):
        if (now := [begun for begun, _ in trace.pulses("D10")]) == rises:
            break
        rises, points = now, list[list[float]]()
        for first in range(0, 24, 6):
            clocks = rises[first : first + 6]
            later = zip(clocks, bits[1:], strict=True)
            points += [[clocks[0] / 1000 - 1, bits[0]], *([(at + 1) / 1000, bit] for at, bit in later)]
        trace = uno.run(program, names, 40, [DeviceUse("levels", {"pin": "D7"}, {"points": [[0, 0], *points]})])
    else:
        raise AssertionError("the clock is another one in each run")
    before, after = bits[:6], bits[1:]
    highest = [int("".join(map(str, each)), 2) for each in (before, after)]
    lowest = [int("".join(map(str, reversed(each))), 2) for each in (before, after)]
    assert trace.text.split() == [f"{each:b}" for each in (highest[0], lowest[0], highest[1], lowest[1])]
