"""simpletools.h: pins and time. Semantics of the library's sources (libsimpletools, Simple-Libraries 1cc167c10)."""

from __future__ import annotations

import itertools
from dataclasses import replace

import pytest

from robosmi.verify.simulation import DeviceUse, PinTrace
from tests.adapters.bench import Uno, proves


def driven(trace: PinTrace, pin: str) -> list[int | str]:
    """The levels to which a program drives a pin, without pull-ups of up to 3 us between them."""
    return [level for _, level in trace.levels(pin) if level != "p"]


def s(*names: str) -> list[str]:
    """The `header/name` of these functions of simpletools.h."""
    return [f"simpletools.h/{name}" for name in names]


@proves(*s("high", "low", "pause"))
def high_drives_and_pause_waits_in_milliseconds(uno: Uno) -> None:
    trace = uno.run(
        "void setup() { high(8); pause(20); low(8); pause(5); high(8); }\nvoid loop() {}", s("high", "low", "pause"), 60
    )
    assert trace.pulses("D8")[0][1] == pytest.approx(20_000, rel=0.01)
    assert [level for _, level in trace.levels("D8")][-3:] == [1, 0, 1]


@proves(*s("input", "get_state"))
def input_lets_go_and_reads(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200); high(8); }
void loop() { Serial.print(get_state(2)); Serial.print(input(8)); Serial.println(input(2)); pause(10); }
"""
    devices = [
        DeviceUse("levels", {"pin": "D2"}, {"points": [[0, 0], [15, 1]]}),
        DeviceUse("levels", {"pin": "D8"}, {"points": [[0, 1], [25, 0]]}),
    ]
    trace = uno.run(program, s("high", "input", "get_state", "pause"), 40, devices)
    assert trace.text.split() == ["010", "010", "111", "101"]
    assert trace.levels("D8")[-1][1] == "z"


@proves(*s("set_output", "set_direction", "get_output", "get_direction", "toggle", "reverse"))
def latch_and_direction_are_independent(uno: Uno) -> None:
    program = """
void setup() {
  Serial.begin(115200);
  set_output(8, 6); pause(2);
  set_direction(8, 2); pause(2);
  Serial.print(get_output(8)); Serial.print(get_output(9)); Serial.print(get_direction(8)); Serial.print(get_direction(9));
  Serial.print(toggle(8)); pause(2); Serial.print(toggle(8)); pause(2);
  Serial.print(reverse(8)); pause(2); Serial.print(get_output(8)); Serial.print(reverse(8)); pause(2);
  set_direction(8, 0); pause(2); set_output(8, 0); set_direction(8, 1);
  Serial.print(toggle(10)); set_output(255, 1); Serial.print(get_output(255)); Serial.print(toggle(255));
}
void loop() {}
"""
    names = s("set_output", "set_direction", "get_output", "get_direction", "toggle", "reverse", "pause")
    trace = uno.run(program, names, 40)
    assert trace.text == "1010" + "01" + "011" + "100"
    assert driven(trace, "D8") == [1, 0, 1, "z", 1, "z", 0]
    assert trace.levels("D10")[-1][1] == 1


@proves(*s("get_states", "get_outputs", "get_directions", "set_outputs", "set_directions"))
def ranges_of_ports_are_looked_up_one_by_one(uno: Uno) -> None:
    program = """
void setup() {
  Serial.begin(115200);
  set_directions(14, 12, 7); set_outputs(12, 14, 5); pause(1); set_outputs(14, 12, 0b1011); pause(1);
  Serial.print(get_outputs(14, 12)); Serial.print(get_outputs(12, 13)); Serial.print(get_directions(11, 15));
  set_directions(13, 12, 1);
  Serial.print(get_directions(14, 12)); Serial.print(' ');
  Serial.print(get_states(3, 0)); Serial.print(' '); Serial.print(get_states(0, 3)); Serial.print(' ');
  Serial.print(get_states(31, 0));
}
void loop() {}
"""
    wired = replace(uno, numbers={12: "9", 13: "8", 14: "A0", 0: "2", 1: "4", 3: "3"})
    devices = [DeviceUse("levels", {"pin": pin}, {"points": [[0, level]]}) for pin, level in (("D2", 1), ("D4", 0), ("D3", 1))]
    names = s("get_states", "get_outputs", "get_directions", "set_outputs", "set_directions", "pause")
    trace = wired.run(program, names, 20, devices)
    # 0b1011 of ports 14 to 12 sets port 15, too, which is not wired; nor is port 11
    assert trace.text == "3" + "3" + str(0b01110) + str(0b101) + " 9 9 " + str(0b1001 | 0b011 << 12)
    assert [driven(trace, pin) for pin in ("D9", "D8", "A0")] == [[0, 1], [0, 1, "z"], [0, 1, 0]]


@proves(*s("set_outputs", "set_directions"))
def patterns_longer_than_their_ports_set_those_that_follow(uno: Uno) -> None:
    """setOutputs.c shifts the pattern to its place and does not cut it."""
    program = """
void setup() { set_directions(1, 0, 0b1111); pause(1); set_outputs(1, 0, 0b1110); pause(1); set_outputs(0, 1, 0b101);
  pause(1); set_directions(0, 0, 0xFFFFFFF1); pause(1); set_directions(0, 0, 0); }
void loop() {}
"""
    wired = replace(uno, numbers={0: "9", 1: "8", 2: "A0", 3: "7", 31: "6"})
    trace = wired.run(program, s("set_outputs", "set_directions", "pause"), 20)
    assert [driven(trace, pin) for pin in ("D9", "D8", "A0", "D7", "D6")] == [[0, 1, "z"], [0, 1, 0], [0, 1], [0, 1], [0]]


@proves(*s("set_pause_dt", "pause_ticks", "mark", "timeout", "wait"))
def time_goes_in_units_and_from_a_mark(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200); low(8); low(9);
  set_pause_dt(8000); high(8); pause(100); low(8);
  high(8); pause_ticks(CLKFREQ / 200); low(8);
  mark(); for (int turn = 0; turn < 3; turn++) { high(9); pause(4); low(9); wait(2000); }
  Serial.print(timeout(900)); mark(); pause(10); Serial.print(timeout(900)); Serial.print(timeout(3000));
  set_io_dt(800); mark(); high(8); wait(400); low(8); Serial.print(timeout(500));
}
void loop() {}
"""
    uses = [
        *s("set_pause_dt", "pause", "pause_ticks", "mark", "timeout", "wait", "set_io_dt", "high", "low"),
        "propeller.h/CLKFREQ",
    ]
    trace = uno.run(program, uses, 40)
    widths = [width for _, width in trace.pulses("D8")]
    assert widths == [pytest.approx(us, rel=0.01, abs=8) for us in (10_000, 5000, 4000)]
    begins = [begun for begun, _ in trace.pulses("D9")]
    assert [late - early for early, late in itertools.pairwise(begins)] == [pytest.approx(2000, abs=12)] * 2
    assert trace.text == "0" + "10" + "0"
