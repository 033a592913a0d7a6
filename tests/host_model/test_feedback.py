"""servo360.h and abdrive360.h: servos that tell their angle. What the libraries' sources do (Simple-Libraries 1cc167c10)."""

from __future__ import annotations

import pytest

from robosmi.base.data_text import as_list, as_number
from robosmi.verify.simulation import DeviceUse, PinTrace
from tests.host_model.bench import run
from tests.tools import require_tools

SERVOS = [
    DeviceUse("feedback_servo", {"servo": "P12", "feedback": "P14"}, {}),
    DeviceUse("feedback_servo", {"servo": "P13", "feedback": "P15"}, {"degrees": 10.0, "dead_us": 25.0}),
]


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("gcc", "objcopy")


def driven(header: str, statements: str, milliseconds: float, devices: list[DeviceUse] = SERVOS) -> tuple[list[int], PinTrace]:
    """The numbers that a main with these statements prints, and the trace."""
    text = f"""#include <simpletools.h>
#include "{header}"
#define SAY(value) print("%d ", value)
void ticks() {{ int l, r; drive_getTicks(&l, &r); SAY(l); SAY(r); }}
int main() {{ {statements} while (1) pause(10); }}
"""
    found = run(
        text if "360" in header and "ab" in header else text.replace(text.splitlines()[3] + "\n", ""), milliseconds, devices
    )
    assert found.status == "running", found.cause
    return [int(word) for word in found.trace.text.split()], found.trace


def turned(trace: PinTrace, number: int) -> float:
    """How far a servo has turned, in degrees."""
    start = SERVOS[number].settings.get("degrees", 90.0)
    return float(
        next(as_number(event.value) for event in trace.device_events if event.device == number and event.what == "degrees")
    ) - float(start)


def test_servos_turn_to_angles_and_hold_them() -> None:
    told, trace = driven(
        "servo360.h",
        "SAY(servo360_connect(12, 4)); SAY(servo360_connect(12, 14)); SAY(servo360_connect(12, 14)); "
            "SAY(servo360_connect(13, 15)); "
        "SAY(servo360_angle(9, 3)); SAY(servo360_angle(12, 120)); servo360_setAngleLimits(13, 45, -45); servo360_angle(13, "
            "-90); pause(1500); "
        "SAY(servo360_getAngle(12)); SAY(servo360_getAngle(13)); servo360_setMaxSpeed(12, 180); "
            "servo360_setAcceleration(12, 180); "
        "servo360_goto(12, 360); pause(100); SAY(servo360_getCsop(12)); pause(900); SAY(servo360_getAngle(12)); pause(2900); "
        "SAY(servo360_getCsop(12)); SAY(servo360_getTurns(12)); SAY(servo360_getAngle(12));",
        7000,
    )  # fmt: skip
    assert told[:6] == [-8, 0, -4, 1, -1, 0]
    assert told[6:8] == pytest.approx([120, -45], abs=3)
    assert told[8] == 3
    assert told[9] == pytest.approx(120 + 90, abs=25)
    assert told[10] == 2
    assert told[11] == 1
    assert told[12] == pytest.approx(480, abs=6)
    assert [turned(trace, 0), turned(trace, 1)] == pytest.approx([480, -45], abs=6)


def test_servos_turn_at_speeds_that_are_ramped_and_held() -> None:
    told, trace = driven(
        "servo360.h",
        "servo360_connect(12, 14); servo360_connect(13, 15); SAY(servo360_couple(13, 9)); SAY(servo360_couple(13, 12)); "
        "SAY(servo360_getMaxSpeed(12)); SAY(servo360_setUnitsFullCircle(13, 64)); servo360_setRampStep(12, 410); "
            "servo360_setRampStep(13, 410); "
        "SAY(servo360_speed(12, 360)); servo360_speed(13, -64); pause(2000); SAY(servo360_getSpeed(12)); "
            "SAY(servo360_getSpeed(13)); "
        "SAY(servo360_stop(12)); servo360_stop(13); pause(1000); SAY(servo360_getSpeed(12)); servo360_feedback(12, 0); "
            "SAY(servo360_set(12, 1600)); "
        "pause(200); servo360_enable(12, 0); pause(200);",
        4400,
    )  # fmt: skip
    assert told[:5] == [-2, 1, 720, 1, 0]
    assert told[5] == pytest.approx(360, abs=40)
    assert told[6] == pytest.approx(-64, abs=8)
    assert told[7] == 0
    assert told[8] == pytest.approx(0, abs=10)
    assert told[9] == 0
    assert [width for _, width in trace.pulses("P12")[-4:-1]] == pytest.approx([1600] * 3, abs=0.2)
    assert trace.pulses("P12")[-1][0] < trace.simulated_us - 150_000


def test_settings_are_kept_and_told() -> None:
    told, _ = driven(
        "servo360.h",
        "servo360_connect(12, 14); SAY(servo360_getUnitsFullCircle(12)); SAY(servo360_getRampStep(12)); "
            "SAY(servo360_getAcceleration(12)); "
        "SAY(servo360_getAngleCtrlSpeedMax(12)); servo360_setAngleCtrlSpeedMax(12, 180); SAY(servo360_getAngleCtrlSpeedMax(12)); "
        "SAY(servo360_setAngleCtrlSpeedMax(12, 721)); SAY(servo360_setCoupleScale(13, 12, 1000)); "
            "SAY(servo360_getAngleOffset(12)); "
        "servo360_angle(12, 45); pause(900); SAY(servo360_getAngle12Bit(12)); SAY(servo360_setTurns(12, 2)); "
            "SAY(servo360_getTurns(12)); "
        "servo360_setAngleCalc(12, 30); servo360_setControlSys(12, S360_SETTING_KPA, 77); SAY(servo360_getControlSys(12, "
            "S360_SETTING_KPA)); "
        "int a, b; servo360_setAngleLimits(12, 9, -9); servo360_getAngleLimits(12, &a, &b); SAY(a); SAY(b); "
        "SAY(servo360_unitsAngleToEncoder(90, 360)); SAY(servo360_unitsEncoderToAngle(1024, 360));",
        2000,
    )  # fmt: skip
    assert told[:7] == [360, 819, 3599, 720, 180, -2, -1]
    assert told[7:9] == pytest.approx([90, 512], abs=30)
    assert told[9:] == [0, 2, 77, 9, -9, 1024, 90]


def test_turns_that_are_set_before_the_first_order_move_no_goal() -> None:
    """A servo that was never told what to do has no target yet, so the library leaves the calculated angle where it is."""
    told, _ = driven(
        "servo360.h",
        "servo360_connect(12, 14); servo360_setTurns(12, 2); pause(100); SAY(servo360_getAngleCalc(12)); "
            "SAY(servo360_getTurns(12)); servo360_speed(12, 90); servo360_setTurns(12, 2); SAY(servo360_getAngleCalc(12));",
        1000,
    )  # fmt: skip
    assert told[:2] == [0, 2]
    assert told[2] == pytest.approx(720, abs=10)


def test_drives_with_feedback_go_ticks_and_speeds() -> None:
    told, trace = driven(
        "abdrive360.h",
        "drive_goto(64, 32); ticks(); drive_gotoMode(1); drive_setMaxVelocity(1, 16); drive_goto(32, 32); "
            "SAY(drive_gotoStatus(2)); "
        "SAY(drive_gotoStatus(0)); pause(2500); SAY(drive_gotoStatus(2)); ticks(); drive_setAcceleration(0, 3000); "
            "unsigned t = CNT; "
        "drive_speed(48, 24); SAY((CNT - t) / 80000); pause(1000); t = CNT; drive_ramp(16, 0); SAY((CNT - t) / 80000); "
            "pause(400); ticks(); "
        "pause(1000); ticks(); drive_speed(0, 0); pause(800); ticks();",
        11_000,
    )  # fmt: skip
    assert told[:2] == pytest.approx([64, -32], abs=2)
    assert told[2:5] == [2, 1, 0]
    assert told[5:7] == pytest.approx([96, -64], abs=2)
    assert told[7] <= 1
    assert told[8] < 400
    assert told[9:11] == pytest.approx([96 + 56, -64 - 25], abs=8)
    assert [told[11] - told[9], told[12] - told[10]] == pytest.approx([16, 0], abs=3)
    assert [turned(trace, 0) / 5.625, turned(trace, 1) / 5.625] == pytest.approx(told[13:], abs=2)


def test_a_drive_without_feedback_waits_for_it() -> None:
    told, trace = driven("abdrive360.h", "SAY(1); drive_speed(10, 10); SAY(2);", 3000, [])
    assert told == [1]
    assert trace.pulses("P12") == []


def test_calculated_ticks_and_settings_of_the_drive() -> None:
    told, trace = driven(
        "abdrive360.h",
        "int l, r; drive_rampStep(64, 32); drive_setRampStep(2); pause(1000); drive_getTicksCalc(&l, &r); SAY(l); SAY(r); "
            "drive_setMaxSpeed(10); "
        "drive_setAcceleration(1, 100); drive_feedback(0); pause(50); drive_getTicksCalc(&l, &r); SAY(l); pause(500); "
            "drive_getTicksCalc(&l, &r); SAY(l);",
        4000,
    )  # fmt: skip
    assert told[:2] == pytest.approx([64 * 0.68, -32 * 0.84], abs=4)
    assert told[3] == told[2]
    assert trace.pulses("P12")


def test_the_header_says_which_drive_is_meant() -> None:
    plain = run(
        '#include <simpletools.h>\n#include "abdrive.h"\nint main() { drive_speed(0, 0); while (1) pause(9); }', 500
    ).trace
    assert [round(width) for _, width in plain.pulses("P12")] == [1500, 1500]


def test_each_motion_tells_what_it_aims_at() -> None:
    """Where a servo rests hangs on that: an angle, for so long as the program waits, or so far from the last goal."""
    _, trace = driven(
        "servo360.h",
        "servo360_connect(12, 14); servo360_angle(12, 60); pause(1500); servo360_speed(12, 180); pause(700); "
        "servo360_speed(12, 0); pause(800); servo360_goto(12, 90); pause(2000);",
        7000,
    )
    rests = [as_list(event.value) for event in trace.device_events if event.what == "rests"]
    assert [as_list(rest[5])[2] for rest in rests] == ["place", "time", "way"]
    timed = [as_number(as_list(rest[5])[0]) / as_number(rest[1]) for rest in rests]
    assert timed == pytest.approx([0, 1, 0], abs=0.02)
