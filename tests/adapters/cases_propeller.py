"""propeller.h: counter, registers of the pins, locks. Semantics of propgcc b280e7a77 and of the Propeller."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import pytest

from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno, proves


def p(*names: str) -> list[str]:
    """The `header/name` of these names of propeller.h."""
    return [f"propeller.h/{name}" for name in names]


@proves(*p("INA", "waitpeq", "waitpne"))
def levels_at_the_pins_are_waited_for(uno: Uno) -> None:
    program = """
void show(uint32_t value) { Serial.print(value, HEX); Serial.print(' '); }
void setup() { Serial.begin(115200); show(INA & 0x60); Serial.flush();
  waitpeq(0x20, 0x60); show((micros() + 500) / 1000); waitpne(0x20, 0x60); show((micros() + 500) / 1000);
} void loop() {}
"""
    wired = replace(uno, numbers={5: "2", 6: "3"})
    devices = [
        DeviceUse("levels", {"pin": "D2"}, {"points": [[0, 1], [3, 0], [12, 1]]}),
        DeviceUse("levels", {"pin": "D3"}, {"points": [[0, 1], [10, 0], [20, 1]]}),
    ]
    trace = wired.run(program, p("INA", "waitpeq", "waitpne"), 50, devices)
    first, second, third = (int(each, 16) for each in trace.text.split())
    assert first == 0x60
    assert second == pytest.approx(12, abs=1)
    assert third == pytest.approx(20, abs=1)


@proves(*p("_CNT", "_INA", "_OUTA", "_DIRA", "_clkfreq", "_CLKFREQ"))
def registers_have_names_with_an_underscore_too(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200); _DIRA |= 1 << 3; _OUTA |= 1 << 3; Serial.print(_OUTA, HEX); Serial.print(_DIRA, HEX);
  Serial.print(_INA >> 3 & 1); uint32_t at = _CNT; delay(10); Serial.print((_CNT - at) / (_clkfreq / 1000));
  Serial.print(_CLKFREQ); } void loop() {}
"""
    trace = replace(uno, numbers={3: "8"}).run(program, p("_CNT", "_INA", "_OUTA", "_DIRA", "_clkfreq", "_CLKFREQ"), 40)
    assert trace.text == "88" + "1" + "10" + "80000000"


@proves(*p("INA", "OUTA", "DIRA", "waitpeq", "waitpne"))
def registers_of_the_pins_are_those_of_the_ports(uno: Uno) -> None:
    program = """
void show(uint32_t value) { Serial.print(value, HEX); Serial.print(' '); }
void setup() { Serial.begin(115200);
  DIRA |= 1 << 3 | 1L << 26; OUTA = 1L << 26; OUTA |= 1 << 3; show(OUTA); show(DIRA); delay(2);
  OUTA ^= 1L << 26; OUTA &= ~(1UL << 3); OUTA |= 1L << 30; show(OUTA);
  if (OUTA >> 3 & 1) show(0xBAD);
  DIRA = 1L << 26; show(DIRA); show(INA & 0xFF); delay(1); Serial.flush();
  waitpeq(0x20, 0x60); show((micros() + 500) / 1000); waitpne(0x20, 0x60); show((micros() + 500) / 1000);
  uint32_t was = OUTA; OUTA = DIRA; show(OUTA); OUTA = was;
} void loop() {}
"""
    wired = replace(uno, numbers={3: "8", 26: "13", 5: "2", 6: "3"})
    devices = [
        DeviceUse("levels", {"pin": "D2"}, {"points": [[0, 1], [3, 0], [12, 1]]}),
        DeviceUse("levels", {"pin": "D3"}, {"points": [[0, 1], [10, 0], [20, 1]]}),
    ]
    trace = wired.run(program, p("INA", "OUTA", "DIRA", "waitpeq", "waitpne"), 50, devices)
    words = trace.text.split()
    assert words[:4] == ["4000008", "4000008", "0", "4000000"]
    assert int(words[4], 16) & 0x60 == 0x40 or int(words[4], 16) & 0x60 == 0x60
    assert words[5:] == [f"{12:X}", f"{20:X}", "4000000"]
    levels = {pin: [level for _, level in trace.levels(pin) if level != "p"] for pin in ("D8", "D13")}
    assert levels == {"D8": [0, 1, 0, "z"], "D13": [0, 1, 0, 1, 0]}


@proves(*p("OUTA", "DIRA"), "simpletools.h/get_direction", "simpletools.h/reverse")
def a_pin_that_rests_at_a_level_is_no_output_of_the_program(uno: Uno) -> None:
    program = """
void setup() {
  pinMode(8, OUTPUT); digitalWrite(8, HIGH); Serial.begin(115200);
  Serial.print(DIRA); DIRA = 1L << 26; OUTA = 1L << 26; delay(2); Serial.print(get_direction(8)); DIRA |= 1 << 3; delay(2);
  DIRA = 0; delay(2); reverse(8); delay(2); Serial.print(get_direction(8));
}
void loop() {}
"""
    names = [*p("OUTA", "DIRA"), "simpletools.h/get_direction", "simpletools.h/reverse"]
    trace = replace(uno, numbers={3: "8", 26: "13"}).run(program, names, 30)
    assert trace.text == "001"
    assert [level for _, level in trace.levels("D8") if level != "p"] == [0, 1, 0, "z", 0]


@proves(*p("waitpeq"), in_c=False)  # there a change reaches the pins with the next wait
def one_bit_of_a_register_takes_little_time(uno: Uno) -> None:
    program = """
void setup() { DIRA |= 1L << 26; waitpeq(1 << 5, 3 << 5);
  for (uint8_t turn = 0; turn < 10; turn++) { OUTA |= 1L << 26; OUTA &= ~(1L << 26); } OUTA ^= 1L << 26; OUTA ^= 1L << 26; }
void loop() {}
"""
    wired = replace(uno, numbers={26: "13", 5: "2"})
    device = DeviceUse("levels", {"pin": "D2"}, {"points": [[0, 0], [5, 1]]})
    trace = wired.run(program, p("waitpeq", "OUTA", "DIRA"), 30, [device])
    _, first, *later = [at_us for at_us, _ in trace.levels("D13")]
    assert 0 < first - 5000 <= 80
    times = [late - early for early, late in pairwise([first, *later])]
    assert len(times) == 21
    assert max(times) <= 60


@proves(*p("waitcnt", "waitcnt2", "CNT", "CLKFREQ"))
def the_counter_counts_ticks_of_80_megahertz(uno: Uno) -> None:
    program = """
void setup() { pinMode(8, OUTPUT); uint32_t at = CNT + CLKFREQ / 100; digitalWrite(8, 1); waitcnt(at); digitalWrite(8, 0);
  for (int turn = 0; turn < 4; turn++) { digitalWrite(8, turn & 1); at = waitcnt2(at, CLKFREQ / 200); }
  Serial.begin(115200); Serial.print(waitcnt2(100, 20)); Serial.print(' '); Serial.print(waitcnt(at) == at); } void loop() {}
"""
    trace = uno.run(program, p("waitcnt", "waitcnt2", "CNT", "CLKFREQ"), 60)
    _, begun, *later = [at_us for at_us, _ in trace.levels("D8")]
    assert [at_us - begun for at_us in later] == [pytest.approx(us, abs=24) for us in (10_000, 10_000, 15_000, 20_000)]
    assert trace.text == "120 1"


@proves(*p("locknew", "lockret", "lockset", "lockclr", "HUBDATA", "HUBTEXT"))
def locks_are_given_set_and_cleared(uno: Uno) -> None:
    program = """
HUBDATA int32_t kept = 5;
HUBTEXT void show(int32_t value) { Serial.print(value); Serial.print(' '); }
void setup() { Serial.begin(115200); show(kept); for (int turn = 0; turn < 9; turn++) show(locknew()); lockret(3);
  show(locknew());
  show(lockset(1)); show(lockset(1)); show(lockset(2)); show(lockclr(1)); show(lockclr(1)); show(lockset(1)); } void loop() {}
"""
    trace = uno.run(program, p("locknew", "lockret", "lockset", "lockclr", "HUBDATA", "HUBTEXT"), 30)
    assert trace.text.split() == ["5", "0", "1", "2", "3", "4", "5", "6", "7", "-1", "3", "0", "-1", "0", "-1", "0", "0"]


@proves(*p("getcnt", "getpin", "setpin", "togglepin"))
def single_pins_are_read_and_written(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200); uint32_t at = getcnt(); setpin(8, 1); delay(2); togglepin(8); delay(2); setpin(9, 0);
  Serial.print((getcnt() - at) / 80000); Serial.print(' '); Serial.print(getpin(2)); Serial.print(getpin(3)); delay(2);
  togglepin(9); delay(2); Serial.print(getpin(9)); setpin(12, 5); togglepin(13); }
void loop() {}
"""
    devices = [DeviceUse("levels", {"pin": f"D{pin}"}, {"points": [[0, level]]}) for pin, level in ((2, 1), (3, 0))]
    trace = uno.run(program, p("getcnt", "getpin", "setpin", "togglepin"), 30, devices)
    assert trace.text == "4 100"
    assert [level for _, level in trace.levels("D8") if level != "p"] == [1, 0]
    assert [level for _, level in trace.levels("D9")] == [0, 1, 0]  # to read an output puts it low, as there
    assert [trace.levels(f"D{pin}")[-1][1] for pin in (12, 13)] == [1, 1]


def b(*names: str) -> list[str]:
    """What the macros of propeller.h stand for."""
    return p(*(f"__builtin_propeller_{name}" for name in names))


@proves(*b("waitcnt", "waitpeq", "waitpne", "locknew", "lockret", "lockset", "lockclr"))
def what_the_macros_stand_for_does_the_same(uno: Uno) -> None:
    program = """
#define B(name) __builtin_propeller_##name
void show(int32_t value) { Serial.print(value); Serial.print(' '); }
void setup() { Serial.begin(115200); uint32_t begun = micros(); show(B(waitcnt)(CNT + 400000, 7) > 400000);
  show((micros() - begun) / 1000); show(B(waitcnt)(100, 20)); for (int turn = 0; turn < 8; turn++) B(locknew)();
  show(B(locknew)()); B(lockret)(3); show(B(locknew)());
  show(B(lockset)(1)); show(B(lockset)(1)); show(B(lockclr)(1)); show(B(lockclr)(1)); Serial.flush();
  B(waitpeq)(0x20, 0x60); show(millis()); B(waitpne)(0x20, 0x60); show(millis()); }
void loop() {}
"""
    devices = [
        DeviceUse("levels", {"pin": "D2"}, {"points": [[0, 1], [3, 0], [22, 1]]}),
        DeviceUse("levels", {"pin": "D3"}, {"points": [[0, 1], [20, 0], [30, 1]]}),
    ]
    names = b("waitcnt", "waitpeq", "waitpne", "locknew", "lockret", "lockset", "lockclr")
    trace = replace(uno, numbers={5: "2", 6: "3"}).run(program, [*names, *p("CNT")], 60, devices)
    told = [int(each) for each in trace.text.split()]
    assert told[:9] == [1, 5, 120, -1, 3, 0, -1, -1, 0]
    assert told[9:] == [pytest.approx(22, abs=1), pytest.approx(30, abs=1)]


@proves(*b("rev"))
def the_lower_bits_are_turned_round(uno: Uno) -> None:
    program = """
void show(int32_t value) { Serial.print((uint32_t)value, HEX); Serial.print(' '); }
void setup() { Serial.begin(115200); show(__builtin_propeller_rev(0x73, 28)); show(__builtin_propeller_rev(1, 0));
  show(__builtin_propeller_rev(6, 33)); }
void loop() {}
"""
    assert uno.run(program, b("rev"), 20).text.split() == ["C", "80000000", "30000000"]
