"""gps.h: positions. Semantics of the library's sources (libgps, Simple-Libraries 1cc167c10), sentences of NMEA 0183."""

from __future__ import annotations

import pytest

from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno, proves

NAMES = (
    "open", "close", "changeBaud", "fix", "fixValid", "latitude", "longitude", "velocity", "heading", "magneticVariation",
    "rawDate", "rawTime", "satsTracked", "altitude", "txByte", "sources",
)  # fmt: skip
ALL = [f"gps.h/gps_{name}" for name in NAMES]
NORTH = "$GPRMC,123519,A,4807.038,N,01131.000,E,022.4,084.4,230394,003.1,W*6A\r\n"
HEIGHT = "$GNGGA,123519,4807.038,N,01131.000,E,2,08,0.9,545.4,M,46.9,M,,*47\r\n"
SOUTH = "$BDRMC,010203,V,3300.500,S,07030.250,W,,,010225,,*00\r\n"


@proves(*ALL)
def positions_are_read_while_the_program_does_something_else(uno: Uno) -> None:
    program = """
void say(float number) { Serial.print(number, 4); Serial.print(' '); }
void all() { say(gps_fix()); say(gps_fixValid()); say(gps_latitude()); say(gps_longitude()); say(gps_velocity(KNOTS));
  say(gps_velocity(MPH)); say(gps_velocity(KPH)); say(gps_velocity(MPS)); say(gps_velocity(9)); say(gps_heading());
  say(gps_magneticVariation()); say(gps_rawDate()); say(gps_rawTime()); say(gps_satsTracked()); say(gps_altitude());
  Serial.println(); }
void setup() { Serial.begin(115200); say(gps_open(10, 11, 9600)); gps_txByte(0x155); all(); delay(250); all(); delay(200); all();
  Serial.println(gps_sources()); gps_close(); all(); say(gps_changeBaud(4800)); delay(300); say(gps_rawTime()); gps_close();
  pinMode(10, OUTPUT); }
void loop() {}
"""
    pins = {"receive": "D10", "transmit": "D11"}
    points = [[50, NORTH + HEIGHT], [300, "$GPRMC,broken\n" + SOUTH]]
    uses = [*ALL, *(f"gps.h/{unit}" for unit in ("KNOTS", "MPH", "KPH", "MPS"))]
    trace = uno.run(program, uses, 1100, [DeviceUse("serial_line", pins, {"points": points})])
    lines = trace.text.splitlines()
    before, first, second = ([float(each) for each in line.split()] for line in lines[:3])
    assert before == [1, 0, 0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0, 0]
    assert first[:2] == [2, 1]
    assert first[2:4] == pytest.approx([48.1173, 11.516667], abs=2e-4)
    assert first[4:8] == pytest.approx([22.4, 25.7775, 41.4848, 11.5236], abs=1e-3)
    assert first[8:] == pytest.approx([-1, 84.4, 3.1, 230394, 123519, 8, 545.4], abs=1e-3)
    assert second[:2] == [2, 0]
    assert second[2:4] == pytest.approx([-33.008333, -70.504167], abs=2e-4)
    assert second[4:8] == [0, 0, 0, 0]
    assert second[9:] == pytest.approx([0, 0, 10225, 10203, 8, 545.4], abs=1e-3)
    assert lines[3] == "BNP" + " " * 61
    assert [float(each) for each in lines[4].split()] == [0, 0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0, 0]
    assert lines[5].split() == ["1.0000", "0.0000"]
    assert [event.value for event in trace.device_events] == [0x55]


@proves("gps.h/gps_changeBaud")
def a_receiver_is_heard_at_another_speed(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200); gps_open(10, 255, 9600); delay(20); Serial.print(gps_changeBaud(4800)); delay(250);
  Serial.print(gps_rawTime()); gps_close(); delay(10); pinMode(10, OUTPUT); digitalWrite(10, LOW); }
void loop() {}
"""
    line = DeviceUse("serial_line", {"receive": "D10"}, {"baud": 4800, "points": [[80, NORTH]]})
    uses = ["gps.h/gps_changeBaud", "gps.h/gps_rawTime", "gps.h/gps_open", "gps.h/gps_close"]
    assert uno.run(program, uses, 400, [line]).text == "1123519"
