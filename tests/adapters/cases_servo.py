"""servo.h: pulses in the background. Semantics of the library's source (libservo, Simple-Libraries 1cc167c10)."""

from __future__ import annotations

from itertools import pairwise

import pytest

from tests.adapters.bench import Uno, proves

ALL = [f"servo.h/servo_{name}" for name in ("angle", "speed", "set", "get", "setramp", "disable", "stop")]


@proves(*ALL)
def servos_get_their_widths_every_20_ms_until_they_are_disabled(uno: Uno) -> None:
    program = """
void say(int32_t number) { Serial.print(number); Serial.print(' '); }
void setup() { Serial.begin(115200);
  say(servo_get(9)); say(servo_setramp(9, 9)); say(servo_angle(9, 0)); say(servo_speed(10, -200)); delay(100);
  say(servo_angle(9, 1800)); say(servo_get(9)); delay(100);
  say(servo_setramp(9, 100)); say(servo_angle(9, 900)); delay(110); say(servo_get(9)); delay(110);
  say(servo_set(8, 1234)); say(servo_disable(9)); say(servo_get(9)); delay(100);
  servo_stop(); delay(100); say(servo_speed(8, 20)); say(servo_set(255, 1500)); }
void loop() {}
"""
    trace = uno.run(program, ALL, 740)
    assert trace.text.split()[:8] == ["-4", "-4", "9", "10", "1", "2300", "9", "1"]
    ramped, *rest = map(int, trace.text.split()[8:])
    assert ramped in (1700, 1800, 1900)  # after 110 ms at 100 us every 20 ms
    assert rest == [8, 1, -4, 1, 0]
    widths = {pin: trace.pulses(f"D{pin}") for pin in (9, 10, 8)}

    def seen(pin: int, begin: float, end: float) -> list[float]:
        return [width for at, width in widths[pin] if begin * 1000 <= at < end * 1000]

    assert seen(9, 0, 95) == pytest.approx([500] * len(seen(9, 0, 95)), abs=2)
    assert seen(10, 0, 500) == pytest.approx([1300] * len(seen(10, 0, 500)), abs=2)
    assert 23 <= len(seen(10, 0, 500)) <= 26
    assert seen(9, 130, 195)[-1] == pytest.approx(2300, abs=2)
    steps = [early - late for early, late in pairwise(seen(9, 200, 400))]
    ramp = [step for step in steps if step > 50]
    assert ramp == pytest.approx([100] * 9, abs=2)  # each pulse a step: none is skipped
    assert steps[steps.index(ramp[0]) :][:9] == ramp  # and none is made twice
    assert seen(9, 395, 415)[-1] == pytest.approx(1400, abs=2)
    assert seen(9, 425, 740) == []
    assert trace.levels("D9")[-1][1] == "z"
    assert seen(8, 425, 515)[-1] == pytest.approx(1234, abs=2)
    assert [seen(pin, 525, 615) for pin in (10, 8)] == [[], []]
    assert seen(10, 625, 740)[-1] == pytest.approx(1300, abs=2)
    assert seen(8, 625, 740)[-1] == pytest.approx(1520, abs=2)


AUX = [f"servoAux.h/servoAux_{name}" for name in ("angle", "speed", "set", "get", "setRamp", "disable", "stop")]


@proves(*AUX)
def auxiliary_servos_get_their_widths_until_they_are_disabled(uno: Uno) -> None:
    program = """
void say(int32_t number) { Serial.print(number); Serial.print(' '); }
void setup() { Serial.begin(115200); say(servoAux_get(9)); say(servoAux_setRamp(9, 9)); say(servoAux_angle(9, 0));
  say(servoAux_speed(10, -200)); delay(100); say(servoAux_setRamp(9, 100)); say(servoAux_angle(9, 900)); delay(110);
  say(servoAux_get(9)); delay(110); say(servoAux_set(8, 1234)); say(servoAux_disable(9)); say(servoAux_get(9)); delay(100);
  servoAux_stop(); delay(100); }
void loop() {}
"""
    trace = uno.run(program, AUX, 440)
    told = [int(each) for each in trace.text.split()]
    assert told[:6] == [-4, -4, 9, 10, 9, 1]
    assert told[6] in (900, 1000, 1100)
    assert told[7:] == [8, 1, -4]
    widths = {pin: trace.pulses(f"D{pin}") for pin in (8, 9, 10)}
    assert [width for at, width in widths[9] if at < 95_000] == pytest.approx([500] * 5, abs=2)
    assert [width for at, width in widths[9] if 295_000 < at < 325_000] == pytest.approx([1400] * 2, abs=2)
    assert [at for at, _ in widths[9] if at > 325_000] == []
    assert [width for at, width in widths[10] if at < 320_000] == pytest.approx([1300] * 16, abs=2)
    assert [width for at, width in widths[8] if at < 430_000] == pytest.approx([1234] * 6, abs=2)
    assert [at for pin in (8, 10) for at, _ in widths[pin] if at > 430_000] == []
    assert [trace.levels(f"D{pin}")[-1][1] for pin in (8, 9, 10)] == ["z", "z", "z"]
