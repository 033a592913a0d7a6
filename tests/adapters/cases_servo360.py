"""servo360.h: servos that tell their angle. Semantics of the library's sources (libservo360, Simple-Libraries 1cc167c10)."""

from __future__ import annotations

from itertools import pairwise

import pytest

from robosmi.base.data_text import as_number
from robosmi.verify.simulation import DeviceUse, PinTrace
from tests.adapters.bench import Uno, proves

SAY = "void say(int32_t number) { Serial.print(number); Serial.print(' '); }"
SERVOS = [
    DeviceUse("feedback_servo", {"servo": "D5", "feedback": "A0"}, {}),
    DeviceUse("feedback_servo", {"servo": "D6", "feedback": "A1"}, {"degrees": 10.0, "dead_us": 25.0}),
]


def s(*names: str) -> list[str]:
    """The `header/name` of these functions of servo360.h."""
    return [f"servo360.h/servo360_{name}" for name in names]


def turned(trace: PinTrace, number: int) -> float:
    """The angle in degrees by which a servo has turned."""
    start = SERVOS[number].settings.get("degrees", 90.0)
    said = [as_number(event.value) for event in trace.device_events if event.device == number and event.what == "degrees"]
    return float(said[-1]) - float(start)


@proves(*s("connect", "angle", "goto", "getAngle", "getCsop", "getTurns", "setAngleLimits", "setMaxSpeed", "setAcceleration"))
def servos_turn_to_angles_and_hold_them(uno: Uno) -> None:
    used = s("connect", "angle", "goto", "getAngle", "getCsop", "getTurns", "setAngleLimits", "setMaxSpeed", "setAcceleration")
    program = f"""{SAY}
void setup() {{ Serial.begin(115200); say(servo360_connect(5, 4)); say(servo360_connect(5, A0)); say(servo360_connect(5, A0));
  say(servo360_connect(6, A1)); say(servo360_angle(9, 3)); say(servo360_angle(5, 120)); servo360_setAngleLimits(6, 45, -45);
  servo360_angle(6, -90); delay(1500); say(servo360_getAngle(5)); say(servo360_getAngle(6));
  servo360_setMaxSpeed(5, 180); servo360_setAcceleration(5, 180);
  servo360_goto(5, 360); delay(100); say(servo360_getCsop(5)); delay(900); say(servo360_getAngle(5)); delay(2900);
  say(servo360_getCsop(5)); say(servo360_getTurns(5)); say(servo360_getAngle(5)); }}
void loop() {{}}
"""
    trace = uno.run(program, used, 6600, [*SERVOS, DeviceUse("levels", {"pin": "D4"}, {"points": [[0, 0]]})])
    told = [int(each) for each in trace.text.split()]
    assert told[:6] == [-8, 0, -4, 1, -1, 0]
    assert told[6:8] == pytest.approx([120, -45], abs=3)
    assert told[8] == 3
    assert told[9] == pytest.approx(120 + 90, abs=25)
    assert told[10] == 2
    assert told[11] == 1
    assert told[12] == pytest.approx(480, abs=6)
    assert [turned(trace, 0), turned(trace, 1)] == pytest.approx([480, -45], abs=6)


@proves(
    *s("speed", "stop", "set", "feedback", "enable", "getSpeed", "couple", "setRampStep", "getMaxSpeed", "setUnitsFullCircle")
)
def servos_turn_at_speeds_that_are_ramped_and_held(uno: Uno) -> None:
    used = s(
        "speed", "stop", "set", "feedback", "enable", "getSpeed", "couple", "setRampStep", "getMaxSpeed", "setUnitsFullCircle",
        "getRampStep",
    )  # fmt: skip
    program = f"""{SAY}
void setup() {{ Serial.begin(115200); servo360_connect(5, A0); servo360_connect(6, A1);
  say(servo360_couple(6, 9)); say(servo360_couple(6, 5));
  say(servo360_getMaxSpeed(5)); say(servo360_setUnitsFullCircle(6, 64));
  servo360_setRampStep(5, 410); servo360_setRampStep(6, 410);
  say(servo360_speed(5, 360)); servo360_speed(6, -64); delay(2000); say(servo360_getSpeed(5)); say(servo360_getSpeed(6));
  say(servo360_stop(5)); servo360_stop(6); delay(1000);
  for (uint8_t n = 0; n < 48; n++) {{ say(servo360_getSpeed(5)); delay(19); }}
  servo360_feedback(5, 0); say(servo360_set(5, 1600)); delay(200); servo360_enable(5, 0); delay(200);
  say(servo360_getRampStep(5)); }}
void loop() {{}}
"""
    trace = uno.run(program, [*used, "servo360.h/servo360_connect"], 5200, SERVOS)
    told = [int(each) for each in trace.text.split()]
    assert told.pop(0) == -2
    assert told.pop() == 410
    assert told[:4] == [1, 720, 1, 0]
    assert told[4] == pytest.approx(360, abs=40)
    assert told[5] == pytest.approx(-64, abs=8)
    assert told[6] == 0
    at_rest, told[7:55] = told[7:55], []
    frames = [each for before, each in pairwise([0, *at_rest]) if each != before]  # each is asked for once, or twice
    late = [each for each in frames if abs(each) > 31]  # seven units of 4,096 in 20 ms, as the adapter says
    assert len(late) <= 6
    assert sum(frames) == pytest.approx(0, abs=31), "one edge that is late is a speed and then the same one back"
    assert all(abs(each) <= 110 for each in late)
    assert told[7] == 0
    widths = trace.pulses("D5")
    assert [width for _, width in widths[-4:-1]] == pytest.approx([1600] * 3, abs=10)
    assert trace.levels("D5")[-1][0] < trace.simulated_us - 150_000
    assert turned(trace, 1) == pytest.approx(-708, abs=40)


SETTINGS = s(
    "getAngle12Bit", "getAngleFixedOrigin", "getAngleCalc", "getAngleOffset", "getRampStep", "getAcceleration",
    "getUnitsFullCircle", "getAngleCtrlSpeedMax", "setAngleCtrlSpeedMax",
    "setAngleOffset", "setAngleCalc", "setTurns", "setTransferFunction", "setCoupleScale",
)  # fmt: skip


@proves(*SETTINGS)
def servos_with_feedback_are_set_and_asked(uno: Uno) -> None:
    program = f"""{SAY}
void setup() {{ Serial.begin(115200); servo360_connect(5, A0); servo360_connect(6, 255); say(servo360_getUnitsFullCircle(5));
  say(servo360_getRampStep(5)); say(servo360_getAcceleration(5)); say(servo360_getAngleCtrlSpeedMax(5));
  servo360_setAngleCtrlSpeedMax(5, 180); say(servo360_getAngleCtrlSpeedMax(5)); say(servo360_setAngleCtrlSpeedMax(5, 721));
  say(servo360_setCoupleScale(6, 5, 1000)); say(servo360_getAngleFixedOrigin(5)); say(servo360_getAngleOffset(5));
  servo360_angle(5, 45); delay(900); say(servo360_getAngle12Bit(5)); servo360_setAngleOffset(5, 45); delay(25);
  servo360_setControlSys(5, S360_SETTING_KPA, 0); servo360_setControlSys(5, S360_SETTING_KIA, 0);
  servo360_setControlSys(5, S360_SETTING_KDA, 0); delay(200); say(servo360_getAngle12Bit(5)); say(servo360_setTurns(5, 2));
  say(servo360_getTurns(5)); servo360_setAngleCalc(5, 30); say(servo360_getAngleCalc(5));
  servo360_setTransferFunction(6, S360_SETTING_VB_CCW, 1000); servo360_speed(6, 36); delay(200); }}
void loop() {{}}
"""
    constants = [f"servo360.h/S360_SETTING_{name}" for name in ("KPA", "KIA", "KDA", "VB_CCW")]
    used = [*SETTINGS, *s("connect", "angle", "getTurns", "speed", "setControlSys"), *constants]
    trace = uno.run(program, used, 1950, SERVOS[:1])
    told = [int(each) for each in trace.text.split()]
    assert told[:7] == [360, 819, 3599, 720, 180, -2, 1]
    assert told[7:10] == pytest.approx([1024, 90, 512], abs=30)
    assert told[10] > 700  # the offset was 90 degrees: the angle reads 45 more, and nothing holds it any longer
    assert told[11:13] == [0, 2]
    assert told[13] == pytest.approx(30, abs=1)
    assert trace.pulses("D6")[-1][1] == pytest.approx(1500 + 100 + 7, abs=3)


@proves(*s("connect", "speed"))
def connecting_takes_a_few_cycles_and_parts_of_a_microsecond_are_made_up_for(uno: Uno) -> None:
    """The library reads one duty, which takes 3 ms at most, and times pulses to 0.1 us: at 100 units/s by the mean of several.

    The pulses are measured without feedback of other servos, whose interrupts delay the ends of some by up to 4 us.
    """
    program = f"""{SAY}
void setup() {{ Serial.begin(115200); servo360_connect(5, A0); uint32_t begun = millis(); servo360_connect(6, A1);
  say(millis() - begun); }}
void loop() {{}}
"""
    assert int(uno.run(program, [*s("connect")], 1000, SERVOS).text) <= 10
    program = "void setup() { servo360_connect(9, 255); servo360_speed(9, 11); } void loop() {}"
    trace = uno.run(program, [*s("connect", "speed")], 3500)
    widths = [width for _, width in trace.pulses("D9")][-61:-1]
    assert sum(map(round, widths)) / 60 == pytest.approx(1500 + 20 + 11 / 360 * 4096 * 0.018, abs=0.2)


@proves(*s("setControlSys", "getControlSys", "getAngleLimits", "unitsAngleToEncoder", "unitsEncoderToAngle"))
def settings_are_those_of_the_servo_asked(uno: Uno) -> None:
    names = ("KPV", "KIV", "KDV", "IV_MAX", "KPA", "KIA", "KDA", "IA_MAX")
    asked = "".join(f"say(servo360_getControlSys(5, S360_SETTING_{name})); " for name in names)
    changed = "".join(f"say(servo360_setControlSys(5, S360_SETTING_{name}, {at + 11})); " for at, name in enumerate(names))
    program = f"""{SAY}
void setup() {{ Serial.begin(115200); int most, least; servo360_connect(6, 255); servo360_connect(5, 255);
  {asked}{changed}{asked} say(servo360_getControlSys(6, S360_SETTING_KIA)); say(servo360_getControlSys(9, 1));
  say(servo360_getAngleLimits(5, &most, &least)); servo360_setAngleLimits(5, 90, -45);
  say(servo360_getAngleLimits(5, &most, &least)); say(most); say(least); say(servo360_getAngleLimits(9, &most, &least));
  say(servo360_unitsAngleToEncoder(90, 360)); say(servo360_unitsAngleToEncoder(-64, 64));
  say(servo360_unitsEncoderToAngle(1024, 360)); say(servo360_unitsEncoderToAngle(-4096, 64)); }}
void loop() {{}}
"""
    constants = [f"servo360.h/S360_SETTING_{name}" for name in names]
    functions = s("connect", "setControlSys", "getControlSys", "setAngleLimits", "getAngleLimits")
    used = [*functions, *s("unitsAngleToEncoder", "unitsEncoderToAngle"), *constants]
    told = [int(each) for each in uno.run(program, used, 650).text.split()]
    assert told[:8] == [500, 0, 0, 0, 12000, 600, 6000, 600]
    assert told[8:16] == [1] * 8
    assert told[16:24] == list(range(11, 19))
    assert told[24:] == [600, -1, 1, 1, 90, -45, -1, 1024, -4096, 90, -64]
