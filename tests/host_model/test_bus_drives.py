"""arlodrive.h and bme680.h: what the libraries' sources do (Simple-Libraries 1cc167c10)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import pytest

from robosmi.verify.simulation import DeviceUse, PinTrace
from tests.adapters.cases_bme680 import content, truth, written
from tests.host_model.bench import ended, run
from tests.tools import require_tools

HEAD = """#include <simpletools.h>
#include "{}"
#define SAY(value) print("%d ", value)
#define TELL(value) print("%.3f ", value)
"""


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("gcc", "objcopy")


def controller(answers: Mapping[str, Sequence[str]], pin: str = "P12") -> DeviceUse:
    """The motor controller on its line."""
    return DeviceUse("answering_line", {"line": pin}, {"answers": {"verb 1": ["verbose"], **answers}})


def commands(trace: PinTrace) -> list[str]:
    """The commands sent to the controller after the greeting."""
    assert [event for event in trace.device_events if event.what == "framing"] == []
    found = [str(event.value) for event in trace.device_events if event.what == "command"]
    assert found[:2] == ["", "verb 1"]
    return found[2:]


def arlo(statements: str, devices: list[DeviceUse], milliseconds: float = 9000) -> PinTrace:
    """Run a main with these statements and the drive's controller."""
    return ended(HEAD.format("arlodrive.h") + f"int main() {{ {statements} cogstop(1); }}", milliseconds, devices)


def test_the_controller_is_asked_and_answers() -> None:
    answers = {"go 3 -4": [""], "dist": ["64 -123"], "spd": ["32 -33"], "rst": ["reset"]}
    trace = arlo(
        'int l, r; putStr(drive_open()); putStr(dhb10_com("go 3 -4\\r")); drive_getTicks(&l, &r); SAY(l); SAY(r); '
            'drive_getSpeed(&l, &r); '
        'SAY(l); SAY(r); putStr(drive_clearTicks()); SAY(dhb10_com("\\r") == 0); unsigned t = CNT; char *s = '
            'dhb10_com("what\\r"); '
        "SAY((CNT - t) / 80000); putStr(s);",
        [controller(answers)],
    )  # fmt: skip
    assert commands(trace) == ["go 3 -4", "dist", "spd", "rst", "", "what"]
    assert trace.text.startswith("verbose\r\r64 -123 32 -33 reset\r1 10")
    assert trace.text.endswith("no reply from DHB-10!\r")


def test_speeds_are_said_when_they_change() -> None:
    plain = ("gospd 24 48", "gospd 200 -200", "gospd 60 7", "go 9 8", "gospd 0 0", "gospd 32 40", "gospd 1 2")
    answers = {**{each: ["ok"] for each in plain}, "spd": ["0 0", "10 12", "20 30", "32 40"]}
    told = commands(arlo(
        "drive_speed(24, 48); drive_speed(24, 48); drive_speed(300, -300); drive_setMaxSpeed(60); drive_speed(100, 7); "
            "drive_feedback(0); "
        "drive_speed(9, 8); drive_speed(9, 8); drive_feedback(1); drive_speed(0, 0); drive_speedBlocking(1); "
            "drive_speed(32, 40); "
        "drive_feedback(0); drive_feedback(1); drive_speed(32, 40); drive_speedBlocking(0); drive_speed(1, 2);",
        [controller(answers)],
    ))  # fmt: skip
    assert told[:6] == ["gospd 24 48", "gospd 200 -200", "gospd 60 7", "go 9 8", "go 9 8", "gospd 0 0"]
    assert told[6:8] == ["spd", "gospd 32 40"]
    assert told[8:] == ["spd"] * 10 + ["gospd 1 2"]


def test_distances_and_ramps() -> None:
    ticks = ["10 10", "30 0", "50 -10", "74 -22", "74 -22"]
    told = commands(
        arlo("drive_gotoDoneDelay(3); drive_goto(64, -32);", [controller({"dist": ticks, "move 64 -32 200": ["ok"]})])
    )
    assert told == ["dist", "move 64 -32 200", *["dist"] * 5]
    known = ("acc 10", "acc 512", "gospd 20 40", "gospd 0 0", "go 2 -2", "go 4 -3")
    answers = {**{each: ["ok"] for each in known}, "spd": ["0 0"]}
    told = commands(arlo(
        "drive_setRampStep(40); drive_ramp(20, 40); drive_rampStep(30, 40); drive_speed(0, 0); drive_feedback(0); "
            "drive_ramp(4, -3); "
        "drive_feedback(1); drive_close();",
        [controller(answers)],
    ))  # fmt: skip
    assert told[:8] == ["acc 10", "gospd 20 40", "acc 512", "gospd 0 0", "acc 10", "go 2 -2", "go 4 -3", "spd"]
    assert told[8:10] == ["acc 512", "gospd 0 0"]


def test_a_person_can_talk_to_the_controller() -> None:
    typing = DeviceUse("typing", {}, {"points": [[1700, "spd\r"], [1900, "exit\r"]]})
    text = 'int main() { dhb10_terminal(SIDE_TERM); print("back"); while (1) pause(9); }'
    found = run(HEAD.format("arlodrive.h") + text, 4000, [controller({"spd": ["1 2"]}), typing])
    assert commands(found.trace) == ["spd", "exit"]
    lines = found.trace.text.split("\r")
    assert [lines[0], lines[1], lines[2], lines[-1]] == ["Arlo Command Mode", "Ready", "> spd", "back"]
    assert "1 2\\r" in lines


AIR = (
    "SAY(bme680_readSensor(air)); TELL(bme680_temperature(air, CELSIUS)); TELL(bme680_temperature(air, FAHRENHEIT)); "
    "TELL(bme680_temperature(air, KELVIN)); TELL(bme680_pressure(air, PASCALS)); TELL(bme680_pressure(air, MMHG)); "
    "TELL(bme680_pressure(air, INHG)); TELL(bme680_altitude(air, METERS)); TELL(bme680_altitude(air, FEET)); "
    "TELL(bme680_humidity(air)); "
    "TELL(bme680_gasResistance(air)); "
)


def test_air_is_measured_over_four_wires() -> None:
    device = DeviceUse("serial_registers", {"select": "P5", "clock": "P6", "data_in": "P7", "data_out": "P8"},
                       {"content": content(), "step": True, "page": 0x73})  # fmt: skip
    trace = ended(
        HEAD.format("bme680.h") + f"int main() {{ bme680 *air = bme680_openSPI(6, 7, 8, 5); {AIR} unsigned char b = 0; "
        "bme680_write(air, 0x1d, &b, 1); SAY(bme680_readSensor(air)); TELL(bme680_humidity(air)); bme680_close(air); }",
        5000, [device],
    )  # fmt: skip
    told, right = [float(word) for word in trace.text.split()], truth()
    metres = 44330 * (1 - (right["pressure"] / 101325) ** 0.1903)
    assert told[0] == 0
    assert told[1:4] == pytest.approx([right["celsius"], right["celsius"] * 1.8 + 32, right["celsius"] + 273.15], abs=0.02)
    assert told[4:7] == pytest.approx([right["pressure"] * part for part in (1, 0.0075006156, 0.00029529983)], rel=1e-4)
    assert told[7:9] == pytest.approx([metres, metres * 3.28084], abs=6)
    assert told[9] == pytest.approx(right["humidity"], abs=0.02)
    assert told[10] == pytest.approx(right["gas"], rel=1e-3)
    assert told[11:] == [255, 0]  # -1 in a plain char
    stored = written(trace.device_events)
    assert stored[:6] == [(0x73, 0), (0x60 + 128, 0), (0x73, 0x10), (0x5A, right["heater"]), (0x5B, 0x64), (0x5C, 64 + 37)]


def test_air_is_measured_on_the_bus_and_the_sensor_is_set() -> None:
    device = DeviceUse("registers", {}, {"address": 0x77, "content": content()})
    trace = ended(
        HEAD.format("bme680.h") + f"int main() {{ bme680 *air = bme680_openI2C(i2c_newbus(28, 29, 0), 0x77); {AIR} unsigned "
            f"char b; "
        "bme680_heaterDisable(air); bme680_read(air, 0x70, &b, 1); SAY(b); bme680_heaterEnable(air); bme680_read(air, "
            "0x70, &b, 1); SAY(b); "
        "bme680_configure(air, BME680_SETTING_HUMIDITY_SAMPLES, BME680_OS_16X); bme680_configure(air, "
            "BME680_SETTING_TEMP_SAMPLES, BME680_OS_16X); "
        "bme680_configure(air, BME680_SETTING_PRESSURE_SAMPLES, BME680_OS_NONE); SAY(air->sensor_reading_period); "
        "bme680_configure(air, BME680_SETTING_HEATER_TEMP, 500); SAY(air->heater_temp); }", 9000, [device],
    )  # fmt: skip
    told = [float(word) for word in trace.text.split()]
    assert told[1] == pytest.approx(truth()["celsius"], abs=0.02)
    assert told[11:] == [8, 0, 30769, 400]  # without samples 1 is shifted by -1, which the chip takes for 31
    assert written(trace.device_events)[0] == (0xE0, 0)
