"""abdrive360.h: two wheels with feedback. Semantics of the library's sources (libabdrive360, Simple-Libraries 1cc167c10)."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import pytest

from tests.adapters.bench import Uno, proves
from tests.adapters.cases_servo360 import SAY, SERVOS, turned

PORTS = {f"abdrive360.{name}": pin for name, pin in (("left_servo", "5"), ("right_servo", "6"), ("left_encoder", "A0"),
                                                      ("right_encoder", "A1"))}  # fmt: skip


def d(*names: str) -> list[str]:
    """The `header/name` of these functions of abdrive360.h."""
    return [f"abdrive360.h/drive_{name}" for name in names]


@proves(*d("goto", "getTicks", "speed", "ramp", "setMaxVelocity", "encoderPins", "gotoStatus", "gotoMode"))
def drives_with_feedback_go_ticks_and_speeds(uno: Uno) -> None:
    used = d("goto", "getTicks", "speed", "ramp", "setMaxVelocity", "setAcceleration", "encoderPins", "gotoStatus", "gotoMode")
    program = f"""{SAY}
void ticks() {{ int left, right; drive_getTicks(&left, &right); say(left); say(right); }}
void setup() {{ Serial.begin(115200); drive_encoderPins(A0, A1);
  drive_goto(64, 32); ticks(); drive_gotoMode(1); drive_setMaxVelocity(1, 16); drive_goto(32, 32); say(drive_gotoStatus(2));
  say(drive_gotoStatus(0)); delay(2500); say(drive_gotoStatus(2)); ticks();
  drive_setAcceleration(0, 3000); uint32_t begun = millis(); drive_speed(48, 24); say(millis() - begun); delay(1000);
  begun = millis(); drive_ramp(16, 0); say(millis() - begun); delay(400); ticks(); delay(1000); ticks();
  drive_speed(0, 0); delay(800); ticks(); }}
void loop() {{}}
"""
    ports = {**PORTS, "abdrive360.left_encoder": "255", "abdrive360.right_encoder": "255"}
    trace = replace(uno, ports=ports).run(program, used, 10_000, SERVOS)
    told = [int(each) for each in trace.text.split()]
    assert told[:2] == pytest.approx([64, -32], abs=2)
    assert told[2:5] == [2, 1, 0]
    assert told[5:7] == pytest.approx([96, -64], abs=2)
    assert told[7] <= 1
    assert told[8] < 400
    assert told[9:11] == pytest.approx([96 + 56, -64 - 25], abs=8)
    assert [told[11] - told[9], told[12] - told[10]] == pytest.approx([16, 0], abs=3)
    assert [turned(trace, 0) / 5.625, turned(trace, 1) / 5.625] == pytest.approx(told[13:], abs=2)


@proves(beside=d("goto"))
def drives_with_feedback_notice_that_wheels_stand(uno: Uno) -> None:
    program = f"""{SAY}
void setup() {{ Serial.begin(115200); drive_encoderPins(A0, A1); drive_gotoMode(0);
  for (int ways = 0; ways < 3; ways++) {{ uint32_t begun = millis(); drive_goto(24, 24); say(millis() - begun); }} }}
void loop() {{}}
"""
    ports = {**PORTS, "abdrive360.left_encoder": "255", "abdrive360.right_encoder": "255"}
    trace = replace(uno, ports=ports).run(program, d("goto", "gotoMode", "encoderPins"), 6_000, SERVOS)
    took = [int(each) for each in trace.text.split()]
    assert len(took) == 3
    assert max(took) < 1530  # a wheel whose angle trembles by its last digit stands: up to 0.3 s later without it


@proves(beside=d("ramp", "goto"))
def drives_with_feedback_and_no_pin_hold_nothing_up(uno: Uno) -> None:
    program = f"""{SAY}
void setup() {{ Serial.begin(115200); uint32_t begun = millis(); drive_ramp(60, 60); say(millis() - begun);
  drive_goto(8, 8); say(1); }}
void loop() {{}}
"""
    for wired in ((), ("right_servo",), ("left_servo",)):
        ports = {name: pin if name.partition(".")[2] in wired else "255" for name, pin in PORTS.items()}
        told = [int(each) for each in replace(uno, ports=ports).run(program, d("ramp", "goto"), 4_000).text.split()]
        assert len(told) == 2
        assert 40 <= told[0] <= 1000


@proves(*d("rampStep", "getTicksCalc", "servoPins", "setMaxSpeed", "setRampStep", "feedback"))
def drives_without_feedback_go_as_calculated(uno: Uno) -> None:
    used = d("rampStep", "getTicksCalc", "servoPins", "setMaxSpeed", "setRampStep", "feedback", "goto", "gotoMode")
    program = f"""{SAY}
void ticks() {{ int left, right; drive_getTicksCalc(&left, &right); say(left); say(right); }}
void setup() {{ Serial.begin(115200); drive_servoPins(9, 10);
  drive_rampStep(64, 32); drive_setRampStep(2); delay(1000); ticks(); drive_rampStep(0, 0); delay(300); ticks();
  drive_gotoMode(1); drive_goto(200, 200); drive_setMaxSpeed(10); delay(200); ticks(); delay(1000); ticks();
  drive_feedback(0); delay(50); ticks(); delay(500); ticks(); }}
void loop() {{}}
"""
    ports = {**PORTS, "abdrive360.left_encoder": "255", "abdrive360.right_encoder": "255"}
    trace = replace(uno, ports=ports).run(program, used, 4900)
    told = [int(each) for each in trace.text.split()]
    left = [late - early for early, late in pairwise(told[::2])]
    assert told[:2] == pytest.approx([64 * 0.68, -32 * 0.84], abs=3)  # the ramps take 640 and 320 ms
    assert left[1] == pytest.approx(64 * 1.1, abs=8)
    assert left[2] == pytest.approx(10, abs=2)
    assert left[3:] == [0, 0]
    assert max(width for _, width in trace.pulses("D9")) == pytest.approx(1520 + 64 * 64 * 0.018, abs=4)


@proves(*d("setAcceleration"))
def drives_speed_up_as_asked(uno: Uno) -> None:
    used = d("setAcceleration", "speed", "getTicksCalc")
    program = f"""{SAY}
void ticks() {{ int left, right; drive_getTicksCalc(&left, &right); say(left); say(right); }}
void setup() {{ Serial.begin(115200); drive_setAcceleration(0, 100); drive_setAcceleration(1, 3000); drive_speed(64, -64);
  delay(410); ticks(); drive_setAcceleration(0, 1000); delay(100); ticks(); delay(200); ticks(); }}
void loop() {{}}
"""
    ports = {**PORTS, "abdrive360.left_encoder": "255", "abdrive360.right_encoder": "255"}
    told = [int(each) for each in replace(uno, ports=ports).run(program, used, 1600).text.split()]
    assert told[:2] == pytest.approx([0.02 * 2 * 20 * 21 / 2] * 2, abs=1)  # 20 frames, 2 ticks/s faster in each of them
    assert told[4:] == pytest.approx([told[2] + 0.2 * 64] * 2, abs=2)  # 20 ticks/s in each frame: the ramp has ended


@proves("abdrive360.h/drive360_ticksPerRev")
def turns_are_counted_in_other_ticks(uno: Uno) -> None:
    program = f"""{SAY}
void setup() {{ Serial.begin(115200); drive360_ticksPerRev(360); drive_suppress_eeprom(1);
  servo360_monitorRun(); servo360_monitorEnd();  say(servo360_getUnitsFullCircle(5)); say(servo360_getUnitsFullCircle(6)); }}
void loop() {{}}
"""
    used = [
        "abdrive360.h/drive360_ticksPerRev", *d("suppress_eeprom"),
        *(f"servo360.h/servo360_{name}" for name in ("monitorRun", "monitorEnd", "getUnitsFullCircle")),
    ]  # fmt: skip
    ports = {**PORTS, "abdrive360.left_encoder": "255", "abdrive360.right_encoder": "255"}
    assert replace(uno, ports=ports).run(program, used, 700).text.split() == ["360", "360"]
