"""Serial lines, servos of servoAux.h, voltages of dacctr.h and a compass: what the libraries' sources do (1cc167c10)."""

from __future__ import annotations

import pytest

from robosmi.verify.simulation import DeviceUse
from tests.host_model.bench import run, said
from tests.tools import require_tools

SAY = '#define SAY(value) print("%d ", (int)(value))\n'


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("gcc", "objcopy")


def numbers(header: str, statements: str, milliseconds: float, devices: list[DeviceUse]) -> list[int]:
    """The numbers that a main with these statements prints."""
    return [int(word) for word in said(statements, milliseconds, devices, SAY, header)]


def test_positions_are_read_beside_the_program() -> None:
    sentences = "$GPRMC,123519,A,4807.038,N,01131.000,W,022.4,084.4,230394,,W*6A\r\n$BDGGA,123519,1,N,2,E,1,08,0.9,545.4,M*4\r\n"
    line = DeviceUse("serial_line", {"receive": "P8", "transmit": "P9"}, {"points": [[700, sentences]]})
    told = numbers(
        "gps.h",
        "SAY(gps_open(8, 9, 9600)); pause(900); gps_txByte(0x141); SAY(gps_fixValid()); SAY(gps_fix());"
        "SAY(gps_latitude() * 1000); SAY(gps_longitude() * 1000); SAY(gps_velocity(KPH) * 10); SAY(gps_velocity(5));"
        "SAY(gps_heading() * 10); SAY(gps_magneticVariation()); SAY(gps_rawDate()); SAY(gps_rawTime());"
        "SAY(gps_satsTracked()); SAY(gps_altitude() * 10); SAY(gps_sources()[0]); SAY(gps_sources()[1]);"
        "SAY(gps_changeBaud(4800)); SAY(gps_rawTime()); gps_close();",
        2500, [line],
    )  # fmt: skip
    assert told[:7] == [1, 1, 1, 48117, -11516, 414, -1]
    assert told[7:] == [844, 0, 230394, 123519, 8, 5454, ord("B"), ord("P"), 1, 0]


def test_fingers_are_scanned() -> None:
    answers = [[300, [0xF5, 0x0C, 1, 2, 3, 0, 0x0C, 0xF5]], [400, [0xF5, 9, 0, 0, 1, 0, 8, 0xF5]]]
    line = DeviceUse("serial_line", {"receive": "P8", "transmit": "P9"}, {"baud": 19200, "points": answers})
    trace = run(
        '#include "fingerprint.h"\nint main() { int user; fpScanner *f = fingerprint_open(8, 9); '
        'print("%d ", fingerprint_scan(f, 0, &user)); print("%d ", user); print("%d", fingerprint_countUsers(f)); }',
        1000, [line],
    ).trace  # fmt: skip
    assert trace.text == "3 258 -1"
    sent = [event.value for event in trace.device_events]
    assert sent == [0xF5, 0x0C, 0, 0, 0, 0, 0x0C, 0xF5, 0xF5, 9, 0, 0, 0, 0, 9, 0xF5]


def test_colours_come_on_one_wire() -> None:
    line = DeviceUse("serial_line", {"receive": "P5", "transmit": "P5"}, {"baud": 4800, "points": [[400, "$0A01FFabc"]]})
    told = numbers(
        "colorpal.h",
        "int r, g, b; colorPal *eye = colorPal_open(5); pause(50); colorPal_getRGB(eye, &r, &g, &b); SAY(r); SAY(g); SAY(b); "
        "SAY(colorPalRRGGBB(100, 80, 200)); colorPal_close(eye);",
        1000, [line],
    )  # fmt: skip
    assert told == [0x0A0, 0x1FF, 0xABC, 101 << 16 | 118 << 8 | 124]


def test_a_compass_gives_its_axes() -> None:
    compass = DeviceUse("registers", {}, {"address": 0x1E, "content": [0, 0, 1, 1, 2, 0xFF, 0x38, 0, 0x64]})
    told = numbers(
        "compass3d.h",
        "int x, y, z; i2c *bus = i2c_newbus(3, 2, 0); compass_init(bus); compass_read(bus, &x, &y, &z); SAY(x); SAY(y); SAY(z);",
        100, [compass],
    )  # fmt: skip
    assert told == [258, 100, -200]


def test_servos_of_the_other_library_move_too() -> None:
    trace = run(
        '#include "servoAux.h"\nint main() { servoAux_angle(4, 900); pause(100); servoAux_stop(); pause(100); }', 300, []
    ).trace
    assert [width for _, width in trace.pulses("P4")] == pytest.approx([1400] * 5, abs=3)


def test_counters_of_two_cogs_put_out_voltages() -> None:
    trace = run(
        '#include "dacctr.h"\nint main() { dac a = dac_setup(4, 0, 8), b = dac_setup(5, 1 + NEW_COG, 8); dacmem memory; '
        "dac_set(&a, 64); dac_set(&b, 128); int cog = dac_start(memory, 44100, 0, &b); pause(5); dac_set(&b, 32); pause(5); "
        "dac_close(&a); dac_stop(cog); pause(5); }",
        30, [],
    ).trace  # fmt: skip
    duties = {pin: [wave.duty for wave in trace.waves if wave.pin == pin and wave.duty] for pin in ("P4", "P5")}
    assert duties["P4"] == pytest.approx([0.25])
    assert duties["P5"][:2] == pytest.approx([0.5, 0.125])
    assert [trace.levels(pin)[-1][1] for pin in ("P4", "P5")] == ["z", "z"]
