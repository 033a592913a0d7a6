"""fdserial.h: serial lines. Semantics of the library's sources (libfdserial, Simple-Libraries 1cc167c10)."""

from __future__ import annotations

from collections.abc import Sequence

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


ECHOES = """
fdserial *line, *other;
uint8_t kept[100], count, sent;
void setup() { Serial.begin(115200); BEGIN line = fdserial_open(10, 11, 0, BAUD); other = fdserial_open(12, 255, 0, BAUD); }
void loop() { int32_t byte; while ((byte = fdserial_rxCheck(line)) >= 0) { Serial.write(byte); kept[count++] = byte; }
  while ((byte = fdserial_rxCheck(other)) >= 0) { Serial.write(byte + 32); }
  if (millis() > 2700 && sent < count) fdserial_txChar(line, kept[sent++] ^ 1); GO_ON }
"""


def both_lines_are_understood(
    uno: Uno, baud: int, begin: str, go_on: str, used: Sequence[str], beside: Sequence[DeviceUse]
) -> None:
    """Two lines receive texts at the same time, and what one of them got is sent back, changed, beside something else."""
    program = ECHOES.replace("BEGIN", begin).replace("GO_ON", go_on).replace("BAUD", str(baud))
    said, heard = "The quick brown fox jumps over the lazy dog", "0123456789@ABCDEFGHIJKLMNOPQRSTUVWXYZ!?"
    begun = 2300
    lines = [
        DeviceUse(
            "serial_line", {"receive": "D10", "transmit": "D11"}, {"baud": baud, "points": [[begun, said], [begun + 300, said]]}
        ),
        DeviceUse("serial_line", {"receive": "D12"}, {"baud": baud, "points": [[begun + 0.3, heard], [begun + 301.7, heard]]}),
    ]
    trace = uno.run(program, [*ALL, *used], begun + 550, [*lines, *beside])
    assert len(trace.text) == 2 * len(said + heard)
    for part in (trace.text[: len(said + heard)], trace.text[len(said + heard) :]):
        assert sorted(part) == sorted(said + "".join(chr(ord(each) + 32) for each in heard))
    sent = [(event.what, event.value) for event in trace.device_events if event.device == 0]
    assert sent == [("byte", ord(each) ^ 1) for each in said * 2]


FEEDBACK = ["servo360.h/servo360_connect", "servo360.h/servo360_speed"]


@proves("fdserial.h/fdserial_open", "fdserial.h/fdserial_rxCheck", "fdserial.h/fdserial_txChar", beside=FEEDBACK)
def lines_are_understood_beside_servos_with_feedback(uno: Uno) -> None:
    begin = "servo360_connect(5, A0); servo360_connect(6, A1); servo360_speed(5, 180); servo360_speed(6, -90);"
    servos = [
        DeviceUse("feedback_servo", {"servo": "D5", "feedback": "A0"}, {}),
        DeviceUse("feedback_servo", {"servo": "D6", "feedback": "A1"}, {"degrees": 10.0}),
    ]
    both_lines_are_understood(uno, 9600, begin, "", FEEDBACK, servos)


@proves("fdserial.h/fdserial_open", "fdserial.h/fdserial_rxCheck", "fdserial.h/fdserial_txChar")
def lines_are_understood_beside_servos_that_move(uno: Uno) -> None:
    begin = "servo_set(5, 1500); servo_set(6, 1200); servo_setramp(6, 4);"
    go_on = "servo_set(6, millis() & 512 ? 1000 : 2000);"
    both_lines_are_understood(uno, 19200, begin, go_on, ["servo.h/servo_set", "servo.h/servo_setramp"], [])


@proves("fdserial.h/fdserial_open", "fdserial.h/fdserial_rxCheck", "fdserial.h/fdserial_txChar", in_c=False)
def fast_lines_are_understood(uno: Uno) -> None:
    program = """
fdserial *line;
void setup() { line = fdserial_open(10, 11, 0, 57600); Serial.begin(115200); }
void loop() { int32_t byte; while ((byte = fdserial_rxCheck(line)) >= 0) Serial.write(byte);
  if (millis() > 600) { for (char c = 0; c < 100; c++) fdserial_txChar(line, c * 7); delay(1000); } }
"""
    said = "The quick brown fox jumps over the lazy dog"
    pins = {"receive": "D10", "transmit": "D11"}
    points = [[510, said], [530.3, said], [550.7, said]]
    trace = uno.run(program, ALL, 640, [DeviceUse("serial_line", pins, {"baud": 57600, "points": points})])
    assert trace.text == said * 3
    assert [(event.what, event.value) for event in trace.device_events] == [("byte", each * 7 & 255) for each in range(100)]


@proves("fdserial.h/fdserial_open", "fdserial.h/fdserial_txChar", "fdserial.h/fdserial_rxCheck")
def modes_invert_the_lines_and_leave_the_high_level_to_a_resistor(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200); fdserial *line = fdserial_open(10, 10, FDSERIAL_MODE_OPENDRAIN_TX, 9600);
  fdserial_txChar(line, 'U'); delay(2); Serial.println(fdserial_rxCheck(line));
  fdserial_open(255, 8, FDSERIAL_MODE_INVERT_TX, 2400); fdserial_open(255, 9, FDSERIAL_MODE_NONE, 2400);
  line = fdserial_open(12, 12, FDSERIAL_MODE_OPENDRAIN_TX | FDSERIAL_MODE_IGNORE_TX_ECHO, 9600);
  fdserial_txChar(line, 'U'); fdserial_txChar(line, 0xF0); delay(2); Serial.println(fdserial_rxCheck(line)); }
void loop() {}
"""
    modes = [f"fdserial.h/FDSERIAL_MODE_{name}" for name in ("OPENDRAIN_TX", "INVERT_TX", "NONE", "IGNORE_TX_ECHO")]
    trace = uno.run(program, [*ALL, *modes], 2040)
    assert trace.text.split() == ["85", "-1"]  # one pin both ways hears itself, unless that is not wanted
    assert {level for _, level in trace.levels("D10")} <= {"z", 0, "p"}
    assert trace.levels("D8")[-1][1] == 0
    assert trace.levels("D9")[-1][1] == 1
