"""ping.h, servo.h and abdrive.h. Expected is what the libraries' sources do (Simple-Libraries 1cc167c10)."""

from __future__ import annotations

from itertools import pairwise

import pytest

from robosmi.verify.original import OriginalRun
from robosmi.verify.simulation import DeviceUse, PinTrace
from tests.host_model.bench import run, said
from tests.tools import require_tools

WHEELS = [
    DeviceUse("wheel", {"servo": "P12", "encoder": "P14"}, {}),
    DeviceUse("wheel", {"servo": "P13", "encoder": "P15"}, {"ticks_per_s_per_us": -0.64}),
]


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("gcc", "objcopy")


@pytest.mark.parametrize(
    ("centimetres", "words"), [(10, ["580", "10", "3"]), (100, ["5800", "100", "39"]), (None, ["0", "0", "0"])]
)
def test_ping_measures_the_echo(centimetres: float | None, words: list[str]) -> None:  # ping.c: /58, /148
    use = DeviceUse("ranger", {"signal": "P15"}, {"points": [[0, centimetres]]})
    found = said(
        'print("%d ", ping(15)); pause(10); print("%d ", ping_cm(15)); pause(10); print("%d", ping_inches(15));', 2000, [use]
    )
    assert [int(word) for word in found] == pytest.approx([int(word) for word in words], abs=1)


def widths(trace: PinTrace, pin: str, begin_ms: float, end_ms: float) -> list[float]:
    return [width for at, width in trace.pulses(pin) if begin_ms * 1000 <= at < end_ms * 1000]


def test_servos_get_their_pulses_every_20_ms() -> None:  # servo.c
    program = """#include <simpletools.h>
#include "servo.h"
#define SAY(call) print("%d ", call)
int main() {
  SAY(servo_get(5)); SAY(servo_setramp(5, 9)); SAY(servo_angle(5, 0)); SAY(servo_speed(6, -200)); pause(100);
  SAY(servo_angle(5, 1800)); pause(40); SAY(servo_get(5)); pause(60);
  SAY(servo_setramp(5, 100)); SAY(servo_angle(5, 900)); pause(110); SAY(servo_get(5)); pause(110);
  SAY(servo_set(7, 1234)); SAY(servo_disable(5)); pause(40); SAY(servo_get(5)); pause(60);
  servo_stop(); pause(100); SAY(servo_speed(7, 20)); while (1) pause(10); }
"""
    trace = run(program, 740).trace
    assert trace.text.split()[:8] == ["-4", "-4", "5", "6", "1", "2300", "5", "1"]
    assert trace.text.split()[8] in ("1700", "1800", "1900")
    assert trace.text.split()[9:] == ["7", "1", "-4", "1"]
    assert widths(trace, "P5", 5, 95) == pytest.approx([500] * len(widths(trace, "P5", 5, 95)), abs=0.1)
    assert widths(trace, "P6", 5, 500) == pytest.approx([1300] * len(widths(trace, "P6", 5, 500)), abs=0.1)
    begins = [at for at, _ in trace.pulses("P6") if at < 500_000]
    assert [late - early for early, late in pairwise(begins)] == pytest.approx([20_000] * (len(begins) - 1), abs=1)
    steps = [early - late for early, late in pairwise(widths(trace, "P5", 210, 400))]
    assert max(steps) == pytest.approx(100, abs=0.1)
    assert trace.levels("P5")[-1][1] == "z"
    assert widths(trace, "P6", 540, 620) == []
    assert widths(trace, "P6", 650, 740)[-1] == pytest.approx(1300, abs=0.1)


def test_the_fifteenth_servo_finds_no_place() -> None:
    found = run(
        '#include <simpletools.h>\n#include "servo.h"\nint main() { int r; for (int i = 0; i < 15; i++) r = servo_set(i, '
        '1500); print("%d", r); }',
        50,
    )
    assert found.trace.text == "-3"


def driven(statements: str, milliseconds: float, devices: list[DeviceUse] | None = None) -> OriginalRun:
    text = f"""#include <simpletools.h>
#include "abdrive.h"
#define TIME(call) do {{ unsigned begun = CNT; call; print("%d ", (CNT - begun) / 80000); }} while (0)
void ticks() {{ int left, right; drive_getTicks(&left, &right); print("%d %d ", left, right); }}
int main() {{ {statements} while (1) pause(10); }}
"""
    found = run(text, milliseconds, devices or [])
    assert found.status == "running", found.cause
    return found


def test_drive_speed_acts_on_a_change_and_blocks_while_the_ramp_goes_on() -> None:  # speed.c, abdrive.c
    trace = driven("TIME(drive_speed(0, 0)); pause(50); TIME(drive_speed(128, 64)); pause(160); TIME(drive_speed(128, 64)); "
                   "TIME(drive_rampStep(48, 48)); pause(100); TIME(drive_speed(0, 0)); pause(100);", 1500).trace  # fmt: skip
    began, change, same, slower, stop = map(int, trace.text.split())
    assert 120 <= began <= 160
    assert 100 <= change <= 121
    assert same == 0
    assert 100 <= slower <= 121
    assert 139 <= stop <= 161  # a wheel that comes to a stand rests for five frames, which the call waits for
    left, right = (trace.pulses(pin) for pin in ("P12", "P13"))
    assert [round(width) for _, width in left[:2]] == [1500, 1500]
    ramp = [width for _, width in left if width > 1501]
    assert ramp[:4] == pytest.approx([1518.75, 1537.5, 1556.25, 1575], abs=1)
    assert max(ramp) == pytest.approx(1700, abs=0.1)
    assert min(width for _, width in right) == pytest.approx(1400, abs=1)
    assert right[-1][0] < 1_300_000  # no pulses at a stand
    begins = [at for at, width in left if width > 1501]
    assert [late - early for early, late in pairwise(begins)] == pytest.approx([20_000] * (len(begins) - 1), abs=1)


def test_drive_ramp_waits_for_one_of_the_wheels() -> None:  # ramp.c
    took = int(driven("drive_setMaxSpeed(100); drive_setRampStep(4); TIME(drive_ramp(-100, 40));", 2000).trace.text)
    assert took == pytest.approx(140 + 24 * 20, abs=45)


def test_drive_goto_goes_so_many_ticks() -> None:  # goto.c
    found = driven("drive_goto(64, 32); ticks(); drive_goto(-16, 16); ticks(); drive_goto(1, 0); ticks(); drive_gotoMode(0); "
                   'drive_goto(0, 40); print("%d %d ", drive_gotoStatus(0) > 0, drive_gotoStatus(1) > 0); pause(3000); '
                   'print("%d ", drive_gotoStatus(2)); ticks();', 9000, WHEELS)  # fmt: skip
    told = [int(word) for word in found.trace.text.split()]
    assert told[:6] == pytest.approx([64, 32, 48, 48, 49, 48], abs=1)
    assert told[7:9] == [1, 0]
    assert told[9:] == pytest.approx([49, 88], abs=1)


def test_drive_goto_divides_by_whole_steps_and_keeps_when_to_stop() -> (
    None
):  # abdrive.c: abd_ticksGuard, abd_ditherA, abd_ditherV
    """A wheel with the shorter way makes its last ticks at 4 ticks/s, and each of a short way after a long one."""
    told = driven("TIME(drive_goto(100, 100)); TIME(drive_goto(26, -25)); TIME(drive_goto(9, 9)); TIME(drive_goto(100, 20)); "
                  "drive_setMaxSpeed(30); TIME(drive_goto(-64, 64));", 13_000, WHEELS).trace  # fmt: skip
    straight, turn, short, bow, back = map(int, told.text.split())
    assert 2000 <= straight <= 2600
    assert 1300 <= turn <= 1700
    assert 2200 <= short <= 2800
    assert 2000 <= bow <= 2600
    assert 1400 <= back <= 2000


def test_drive_goto_without_encoders_never_ends() -> None:
    assert driven("drive_goto(10, 10); high(3);", 5000).trace.levels("P3") == []


CALCULATED = 'int l, r; drive_getTicksCalc(&l, &r); print("%d %d", l, r);'


def test_settings_of_the_drive() -> None:  # setAcceleration.c: FOR_SPEED sets both; setMaxSpeed.c
    set_up = "drive_setAcceleration(FOR_SPEED, 200); drive_setMaxVelocity(FOR_GOTO, 50); drive_feedback(0); "
    trace = driven(f"{set_up} drive_speed(100, -100); pause(1000); {CALCULATED}", 1400).trace
    left, right = map(int, trace.text.split())
    assert left == pytest.approx(50 * 1.11 - 50 * 50 / 400, abs=3)
    assert right == pytest.approx(-left, abs=1)
    assert [width for _, width in trace.pulses("P12") if width > 1501][:3] == pytest.approx([1506, 1512.5, 1518.75], abs=1)


def test_calculated_ticks_stay_near_to_those_of_the_encoders() -> None:  # abdrive.c: abd_edMax
    assert driven(f"drive_speed(60, -60); pause(1500); {CALCULATED}", 2000).trace.text == "10 -10"
    assert driven(f"drive_setErrorLimit(4); drive_speed(60, -60); pause(1500); {CALCULATED}", 2000).trace.text == "4 -4"


def test_pins_of_the_drive_are_kept_in_the_eeprom() -> None:  # servoPins.c
    trace = driven("drive_servoPins(4, 5); drive_speed(64, 64);", 400).trace
    assert trace.pulses("P12") == []
    assert max(width for _, width in trace.pulses("P4")) > 1590
