"""abdrive.h: two wheels with encoders. Semantics of the library's sources (libabdrive, Simple-Libraries 1cc167c10)."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import pytest

from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno, proves

PORTS = {"abdrive.left_servo": "5", "abdrive.right_servo": "6", "abdrive.left_encoder": "A0", "abdrive.right_encoder": "A1"}
WHEELS = [
    DeviceUse("wheel", {"servo": "D5", "encoder": "A0"}, {}),
    DeviceUse("wheel", {"servo": "D6", "encoder": "A1"}, {"ticks_per_s_per_us": -0.64}),
]
SAY = "void say(int32_t number) { Serial.print(number); Serial.print(' '); }"


def d(*names: str) -> list[str]:
    """The `header/name` of these functions of abdrive.h."""
    return [f"abdrive.h/drive_{name}" for name in names]


@proves(*d("speed", "rampStep", "ramp", "setMaxSpeed", "setRampStep", "servoPins"))
def drives_change_their_speed_in_frames_of_20_ms_and_calls_take_as_long_as_there(uno: Uno) -> None:
    program = f"""{SAY}
#define TIME(call) do {{ uint32_t begun = millis(); call; say(millis() - begun); }} while (0)
void setup() {{ Serial.begin(115200); drive_servoPins(9, 10);
  TIME(drive_speed(0, 0)); delay(50);
  TIME(drive_speed(128, 64)); delay(160);
  TIME(drive_speed(128, 64));
  TIME(drive_rampStep(48, 56)); delay(100);
  TIME(drive_speed(0, 0)); delay(60);
  drive_setMaxSpeed(100); drive_setRampStep(4);
  TIME(drive_ramp(-200, 40));
  TIME(drive_ramp(-200, 0)); drive_speed(-90, 90); }}
void loop() {{}}
"""
    used = d("speed", "rampStep", "ramp", "setMaxSpeed", "setRampStep", "servoPins")
    trace = replace(uno, ports=PORTS).run(program, used, 3200)
    began, change, same, slower, stop, ramp, over = map(int, trace.text.split())
    assert 120 <= began <= 160
    assert 100 <= change <= 121
    assert same == 0
    assert 99 <= slower <= 121
    assert 159 <= stop <= 181  # 179 in the library: one frame more than from 48 ticks/s
    assert ramp == pytest.approx(
        46 * 20, abs=45
    )  # the right wheel makes 0.8 of its 40 each frame while the left one makes 4 of its 200
    assert over < 700
    left, right = trace.pulses("D9"), trace.pulses("D10")
    assert trace.pulses("D5") == []
    assert [round(width) for _, width in left[:2]] == pytest.approx([1500, 1500], abs=2)
    first = next(number for number, (_, width) in enumerate(left) if width > 1510)
    assert first <= 3
    ramped = [width for _, width in left[first:] if width > 1510]
    assert ramped[:4] == pytest.approx([1518, 1537, 1556, 1575], abs=20)
    assert max(ramped) == pytest.approx(1700, abs=2)
    assert sum(abs(width - (1500 - 56 * 25 / 16)) <= 2 for _, width in right) >= 5
    assert min(width for at, width in right if at < left[first][0] + 300_000) == pytest.approx(1400, abs=2)
    quiet = max(late[0] - early[0] for early, late in pairwise(left))
    assert quiet > 100_000  # no pulses at a stand
    assert min(width for _, width in left) == pytest.approx(1500 - 156, abs=3)
    assert right[-1][1] == pytest.approx(1500 - 141, abs=20)


@proves(*d("speed"))
def calls_again_and_again_do_not_drift_against_the_frames(uno: Uno) -> None:
    program = f"""{SAY}
void setup() {{ Serial.begin(115200); drive_speed(20, 20); uint32_t begun = micros();
  for (uint8_t turn = 0; turn < 10; turn++) {{ drive_speed(turn & 1 ? 20 : 80, 50); delay(100); }}
  say((micros() - begun) / 100); }}
void loop() {{}}
"""
    trace = replace(uno, ports=PORTS).run(program, d("speed"), 2600)
    assert int(trace.text) == pytest.approx(22_000, abs=15)  # tenths of a millisecond: six frames each, and five of delay
    began = [at for at, _ in trace.pulses("D5")]
    gaps = [late - early for early, late in pairwise(began)][2:]  # it begins with two pulses, and stands until the first speed
    assert gaps == pytest.approx([20_000] * len(gaps), abs=12)
    left, right = ([width for _, width in trace.pulses(pin)][5:] for pin in ("D5", "D6"))
    assert max(left) - min(left) > 1.5 * (max(right) - min(right))  # the left wheel alone changes its speed again and again


@proves(*d("goto", "getTicks", "gotoMode", "gotoStatus", "encoderPins"))
def drives_go_so_many_ticks_and_count_them(uno: Uno) -> None:
    program = f"""{SAY}
void ticks() {{ int left, right; drive_getTicks(&left, &right); say(left); say(right); }}
void setup() {{ Serial.begin(115200); drive_encoderPins(A0, A1);
  drive_goto(64, 32); ticks(); drive_goto(-16, 16); ticks(); drive_goto(1, 0); ticks();
  drive_gotoMode(0); drive_goto(0, 40); say(drive_gotoStatus(0)); say(drive_gotoStatus(1) > 0);
  delay(500); say(drive_gotoStatus(2)); delay(3000); say(drive_gotoStatus(2)); ticks(); }}
void loop() {{}}
"""
    used = d("goto", "getTicks", "gotoMode", "gotoStatus", "encoderPins")
    ports = {**PORTS, "abdrive.left_encoder": "255", "abdrive.right_encoder": "255"}
    trace = replace(uno, ports=ports).run(program, used, 7500, WHEELS)
    told = [int(each) for each in trace.text.split()]
    assert told[:6] == pytest.approx([64, 32, 48, 48, 49, 48], abs=1)
    assert told[7:10] == [1, 1, 0]
    assert told[10:] == pytest.approx([49, 88], abs=1)


@proves(beside=d("goto", "setMaxSpeed"))
def drives_take_as_long_for_a_way_as_there(uno: Uno) -> None:
    program = f"""{SAY}
void go(int left, int right) {{ uint32_t begun = millis(); drive_goto(left, right); say(millis() - begun); }}
void setup() {{ Serial.begin(115200); go(100, 100); go(26, -25); go(9, 9); go(100, 20); drive_setMaxSpeed(30); go(-64, 64); }}
void loop() {{}}
"""
    trace = replace(uno, ports=PORTS).run(program, d("goto", "setMaxSpeed"), 13_000, WHEELS)
    straight, turn, short, bow, back = map(int, trace.text.split())
    assert 2000 <= straight <= 2600
    assert 1300 <= turn <= 1700  # the right wheel stops two ticks too early: its step of 3.84 counts as 3
    assert 2200 <= short <= 2800  # when to stop is still that of the way before: nine ticks at 4 ticks/s
    assert 2000 <= bow <= 2600
    assert 1400 <= back <= 2000  # the limit of drive_speed does not count


@proves(*d("speed", "ramp", "setRampStep"), beside=["ping.h/ping_cm"])
def a_ramp_keeps_its_time_while_a_ranger_is_polled_and_steps_once_a_frame_after_a_new_call(uno: Uno) -> None:
    """Echoes of 17 ms put frames off; what was owed before a call must not be made up for with what the call asks for."""
    program = """
void setup() { drive_speed(0, 0); drive_setRampStep(10); delay(300); }
void loop() {
  for (int16_t turn = 0; turn < 5; turn++) {
    drive_speed(128, 100);
    for (int16_t polls = 20; polls; polls--) { ping_cm(7); delay(5); }
    delay(turn * 3);
    drive_ramp(0, 0); delay(500);
  }
}
"""
    used = [*d("speed", "ramp", "setRampStep"), "ping.h/ping_cm"]
    ranger = DeviceUse("ranger", {"signal": "D7"}, {"points": [[0, 299.6]]})
    trace = replace(uno, ports=PORTS).run(program, used, 7200, [ranger])
    pulses = trace.pulses("D5")
    assert min(width for _, width in trace.pulses("D6")) == pytest.approx(1500 - 100 * 200 / 128, abs=3)
    step = 10 * 200 / 128
    rises, falls = [], []
    for (at_us, width), (next_us, following) in pairwise(pulses):
        if next_us - at_us > 30_000:
            rises.append(next_us)
        if width >= 1698 and following < 1690:
            falls.append(next_us)
            begins = [each for at, each in pulses if at_us <= at][:4]
            assert [before - after for before, after in pairwise(begins)] == pytest.approx([step] * 3, abs=3)
        if width < 1698 <= following:
            assert next_us - rises[-1] == pytest.approx(12 * 20_000, abs=21_000)
    assert len(rises) == len(falls) == 5


@proves(*d("speed", "ramp", "setRampStep"))
def a_call_just_before_a_frame_takes_six_frames_as_any_other(uno: Uno) -> None:
    program = f"""{SAY}
void setup() {{ Serial.begin(115200); drive_speed(0, 0); drive_setRampStep(10); delay(300);
  for (uint16_t ticks = 40; ticks < 440; ticks += 40) {{  // of half a microsecond, before the job of a frame
    drive_ramp(64, 40); delay(100);
    while ((uint16_t)(OCR1B - TCNT1) < 1000) {{}}
    while ((uint16_t)(OCR1B - TCNT1) > ticks) {{}}
    uint32_t begun = millis();
    drive_ramp(0, 0);
    say(millis() - begun); delay(200);
  }} }}
void loop() {{}}
"""
    trace = replace(uno, ports=PORTS).run(program, d("speed", "ramp", "setRampStep"), 8000)
    assert max(width for _, width in trace.pulses("D5")) == pytest.approx(1600, abs=3)
    times = list(map(int, trace.text.split()))
    assert len(times) == 10
    assert all(100 <= time <= 141 for time in times), times


@proves(*d("getTicks", "speed", "ramp"))
def ticks_count_from_the_first_call_that_drives(uno: Uno) -> None:
    program = f"""{SAY}
void ticks() {{ int left, right; drive_getTicks(&left, &right); say(left); say(right); }}
void setup() {{ Serial.begin(115200); ticks(); delay(300); ticks(); drive_ramp(20, 40); delay(1000); drive_speed(0, 0);
  delay(500); ticks(); }}
void loop() {{}}
"""
    trace = replace(uno, ports=PORTS).run(program, d("getTicks", "speed", "ramp"), 2600, WHEELS)
    told = [int(each) for each in trace.text.split()]
    assert told[:4] == [0, 0, 0, 0]
    assert told[4:] == pytest.approx([22, 43], abs=5)


@proves(*d("setAcceleration", "setMaxVelocity", "getTicksCalc"))
def drives_accelerate_as_they_are_told(uno: Uno) -> None:
    program = f"""{SAY}
void setup() {{ Serial.begin(115200); drive_setAcceleration(FOR_SPEED, 200); drive_setMaxVelocity(FOR_GOTO, 50);
  drive_speed(100, -100); delay(1000); int32_t left, right; drive_getTicksCalc(&left, &right); say(left); say(right); }}
void loop() {{}}
"""
    used = [*d("setAcceleration", "setMaxVelocity", "getTicksCalc", "speed"), "abdrive.h/FOR_SPEED", "abdrive.h/FOR_GOTO"]
    trace = replace(uno, ports=PORTS).run(program, used, 1400)
    left, right = map(int, trace.text.split())
    assert left == pytest.approx(50 * 1.11 - 50 * 50 / 400, abs=3)
    assert right == -left
    widths = [width for _, width in trace.pulses("D5") if width > 1501]
    assert widths[:3] == pytest.approx([1506, 1512, 1518], abs=8)
    assert widths[-1] == pytest.approx(1578, abs=2)
