"""fdserial.h: serial lines. Semantics of the library's sources (libfdserial, Simple-Libraries 1cc167c10)."""

from __future__ import annotations

import pytest

from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno, proves

NAMES = ("open", "rxChar", "rxCheck", "rxCount", "rxReady", "rxPeek", "rxTime", "rxFlush", "txChar")
ALL = [f"fdserial.h/fdserial_{name}" for name in NAMES]


@proves(*ALL)
def bytes_go_both_ways_on_a_serial_line(uno: Uno) -> None:
    program = """
void say(int32_t number) { Serial.print(number); Serial.print(' '); }
void setup() { Serial.begin(115200); uint32_t begun = millis(); fdserial *line = fdserial_open(10, 11, 0, 9600);
  say(millis() - begun); say(fdserial_txChar(line, 'A')); fdserial_txChar(line, 200); begun = millis();
  say(fdserial_rxTime(line, 20)); say(millis() - begun); say(fdserial_rxCheck(line)); say(fdserial_rxPeek(line));
  say(fdserial_rxReady(line)); say(fdserial_rxChar(line)); delay(20); say(fdserial_rxReady(line)); say(fdserial_rxCount(line));
  say(fdserial_rxPeek(line)); say(fdserial_rxCheck(line)); say(fdserial_rxTime(line, 20)); fdserial_rxFlush(line);
  say(fdserial_rxCount(line)); }
void loop() {}
"""
    pins = {"receive": "D10", "transmit": "D11"}
    trace = uno.run(program, ALL, 700, [DeviceUse("serial_line", pins, {"points": [[600, "hello"]]})])
    told = [int(each) for each in trace.text.split()]
    assert told[0] == pytest.approx(500, abs=2)
    assert told[1:3] == [-1, -1]
    assert told[3] == pytest.approx(21, abs=1)
    assert told[4:] == [-1, 0, 0, ord("h"), 1, 4, ord("e"), ord("e"), ord("l"), 0]
    assert [(event.what, event.value) for event in trace.device_events] == [("byte", ord("A")), ("byte", 200)]


@proves("fdserial.h/fdserial_txFlush", "fdserial.h/fdserial_open")
def the_console_is_a_serial_line_too(uno: Uno) -> None:
    program = """
void setup() { fdserial *line = fdserial_open(0, 1, 0, 9600); for (char c = 'a'; c < 'k'; c++) fdserial_txChar(line, c);
  fdserial_txFlush(line); digitalWrite(8, HIGH); pinMode(8, OUTPUT); }
void loop() {}
"""
    used = ["fdserial.h/fdserial_txFlush", "fdserial.h/fdserial_open", "fdserial.h/fdserial_txChar"]
    trace = uno.run(program, used, 560)
    assert trace.text == "abcdefghij"
    assert trace.levels("D8")[0][0] == pytest.approx(500_000 + 10 * 10 / 9600 * 1e6, abs=3000)


@proves("fdserial.h/fdserial_close", "fdserial.h/fdserial_txEmpty")
def lines_are_closed_when_all_is_sent(uno: Uno) -> None:
    names = ("open", "close", "txChar", "txEmpty")
    program = """
void setup() { fdserial *line = fdserial_open(10, 11, FDSERIAL_MODE_NONE, 9600), *console = fdserial_open(0, 1, 0, 9600);
  fdserial_txChar(line, 'A'); fdserial_txChar(console, '0' + fdserial_txEmpty(line));
  for (int turn = 0; turn < 3; turn++) fdserial_txChar(console, 'x');
  fdserial_txChar(console, '0' + fdserial_txEmpty(console)); delay(8); fdserial_txChar(console, '0' + fdserial_txEmpty(console));
  fdserial_close(line); fdserial_close(console); pinMode(1, OUTPUT); digitalWrite(1, LOW); }
void loop() {}
"""
    pins = {"receive": "D10", "transmit": "D11"}
    used = [*[f"fdserial.h/fdserial_{name}" for name in names], "fdserial.h/FDSERIAL_MODE_NONE"]
    trace = uno.run(program, used, 1020, [DeviceUse("serial_line", pins, {})])
    assert trace.text == "1xxx01"
    assert [event.value for event in trace.device_events] == [ord("A")]
    assert trace.levels("D11")[-1][1] == "z"
    assert trace.levels("D1")[-1][1] == 0
