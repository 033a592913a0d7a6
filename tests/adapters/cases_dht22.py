"""dht22.h: humidity and temperature. Semantics of the library's source (libdht22, Simple-Libraries 1cc167c10)."""

from __future__ import annotations

import pytest

from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno, proves

ALL = [f"dht22.h/dht22_{name}" for name in ("read", "getTemp", "getHumidity", "set_timeout_ignore")]


@proves(*ALL)
def humidity_and_temperature_are_read(uno: Uno) -> None:
    program = """
void say(int32_t number) { Serial.print(number); Serial.print(' '); }
void setup() { Serial.begin(115200); delay(100); say(dht22_read(7)); say(dht22_getTemp(0)); say(dht22_getTemp(1));
  say(dht22_getTemp(2)); say(dht22_getHumidity()); uint32_t begun = millis(); say(dht22_read(7)); say(millis() - begun > 490);
  say(dht22_getTemp(CELSIUS)); dht22_set_timeout_ignore(7, 1); begun = millis(); dht22_read(7); say(millis() - begun > 490);
  say(dht22_read(255)); }
void loop() {}
"""
    settings = {"humidity": [[0, 65.2]], "celsius": [[0, 35.1], [400, -10.1]]}
    trace = uno.run(program, [*ALL, "dht22.h/CELSIUS"], 900, [DeviceUse("dht22", {"signal": "D7"}, settings)])
    assert [int(each) for each in trace.text.split()] == [1, 351, 951, 3083, 652, 0, 1, -101, 0, 0]


@proves("dht22.h/dht22_read", "dht22.h/dht22_set_timeout_ignore")
def a_reading_takes_18_ms_of_asking_and_47_ms_of_listening(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200); delay(100); dht22_set_timeout_ignore(7, 1);
  for (int time = 0; time < 2; time++) { uint32_t begun = millis(); dht22_read(7); Serial.println(millis() - begun); } }
void loop() {}
"""
    settings = {"humidity": [[0, 65.2]], "celsius": [[0, 35.1]]}
    trace = uno.run(program, ALL, 900, [DeviceUse("dht22", {"signal": "D7"}, settings)])
    assert [int(each) for each in trace.text.split()] == pytest.approx([65, 65], abs=2)


@proves("dht22.h/dht22_read")
def bits_are_right_whichever_edges_an_interrupt_hides(uno: Uno) -> None:
    program = """
ISR(TIMER2_COMPA_vect) { delayMicroseconds(25); }
void setup() { Serial.begin(115200); TCCR2A = _BV(WGM21); TCCR2B = _BV(CS22); OCR2A = 241; TIMSK2 = _BV(OCIE2A);
  dht22_set_timeout_ignore(7, 1);
  for (int turn = 0; turn < 30; turn++) { Serial.print(dht22_read(7) + 0); Serial.print(' '); Serial.print(dht22_getTemp(0));
    Serial.print(' '); Serial.println(dht22_getHumidity()); } }
void loop() {}
"""
    settings = {"humidity": [[0, 40]], "celsius": [[0, 21]]}
    trace = uno.run(program, ALL, 2500, [DeviceUse("dht22", {"signal": "D7"}, settings)])
    assert trace.text.splitlines() == ["1 210 400"] * 30
