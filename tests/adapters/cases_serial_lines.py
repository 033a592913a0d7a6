"""serial.h, fingerprint.h and colorpal.h: serial lines. Semantics of the libraries' sources (Simple-Libraries 1cc167c10)."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import pytest

from robosmi.base.data_text import as_whole
from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno, proves

LINES = [f"serial.h/serial_{name}" for name in ("open", "rxChar", "txChar", "close")]


@proves(*LINES)
def a_line_sends_and_receives(uno: Uno) -> None:
    program = """
void say(int32_t number) { Serial.print(number); Serial.print(' '); }
void setup() { Serial.begin(115200); uint32_t begun = millis();
  serial *line = serial_open(10, 11, 32, 9600), *one = serial_open(12, 12, 0, 9600);
  say(millis() - begun); say(line->terminalEcho); say(one->terminalEcho); say(serial_txChar(line, 200));
  say(serial_txChar(one, 65)); writeChar(line, 'b'); say(serial_rxChar(line)); say(serial_rxChar(line)); say(serial_rxChar(one));
  writeChar(one, 'c');   serial_close(one); serial_close(line); serial_close(0); }
void loop() {}
"""
    devices = [
        DeviceUse("serial_line", {"receive": "D10", "transmit": "D11"}, {"points": [[50, "hi"]]}),
        DeviceUse("serial_line", {"receive": "D12", "transmit": "D12"}, {"points": [[80, "x"]]}),
    ]
    trace = uno.run(program, [*LINES, "simpletext.h/writeChar"], 150, devices)
    assert [int(each) for each in trace.text.split()] == [0, 1, 0, 200, 65, ord("h"), ord("i"), ord("x")]
    assert sorted(as_whole(event.value) for event in trace.device_events) == [65, 98, 99, 200]
    assert [trace.levels(pin)[-1][1] for pin in ("D10", "D11", "D12")] == ["z", "z", "z"]


FINGERS = [
    f"fingerprint.h/fingerprint_{name}"
    for name in (
        "open", "close", "sendCommand", "readResponse", "allowOverwrite", "add", "deleteUser", "countUsers", "scan",
        "lookupUserPrivlage", "setTimeout", "setStrictness",
    )
]  # fmt: skip


def frame(command: int, *parameters: int) -> list[int]:
    """The eight bytes of a command or an answer."""
    total = command
    for each in parameters:
        total ^= each
    return [0xF5, command, *parameters, 0, total, 0xF5]


@proves(*FINGERS)
def fingers_are_added_scanned_and_deleted(uno: Uno) -> None:
    program = """
void say(int32_t number) { Serial.print(number); Serial.print(' '); }
char answer[8];
int user;
void setup() { Serial.begin(115200); uint32_t begun = millis(); fpScanner *reader = fingerprint_open(10, 11);
  say(millis() - begun);
  fingerprint_sendCommand(reader, 0x2C, 1, 2, 3); fingerprint_readResponse(reader, answer); say(answer[0]); say(answer[1]);
  say(answer[2]); say((uint8_t)answer[5]); say(fingerprint_allowOverwrite(reader, 0)); say(fingerprint_deleteUser(reader, 0));
  say(fingerprint_deleteUser(reader, 0x102)); say(fingerprint_countUsers(reader)); say(fingerprint_countUsers(reader));
  say(fingerprint_scan(reader, 0, &user)); say(user); say(fingerprint_scan(reader, 7, &user)); say(user);
  say(fingerprint_scan(reader, 8, &user)); say(user); say(fingerprint_lookupUserPrivlage(reader, 9));
  say(fingerprint_setTimeout(reader, -4)); say(fingerprint_setStrictness(reader, 12)); say(fingerprint_add(reader, 0, 1, 1));
  say(fingerprint_add(reader, 5, 7, 2)); say(fingerprint_add(reader, 6, 1, 0)); fingerprint_close(reader);
  pinMode(10, OUTPUT); }
void loop() {}
"""
    answers = [
        frame(0x2C, 9, 8, 7), frame(0x2D, 0, 1, 3), frame(5, 0, 0, 0), frame(4, 0, 0, 5), frame(9, 1, 4, 0), frame(9, 0, 0, 1),
        frame(0x0C, 1, 2, 3), frame(0x0B, 0, 0, 0), frame(0x0A, 0, 7, 2), frame(0x0B, 0, 0, 5), frame(0x0A, 0, 0, 1),
        frame(0x2E, 0, 4, 0), frame(0x28, 0, 9, 4), frame(2, 0, 0, 6), frame(1, 0, 0, 0), frame(2, 0, 0, 8),
    ]  # fmt: skip
    times = [150 + 20 * number + (1000 if number == 15 else 0) for number in range(len(answers))]
    line = DeviceUse(
        "serial_line", {"receive": "D10", "transmit": "D11"},
        {"baud": 19200, "points": [[at, answer] for at, answer in zip(times, answers, strict=True)]},
    )  # fmt: skip
    trace = replace(uno, numbers={26: "13"}).run(program, FINGERS, 1550, [line])
    told = [int(each) for each in trace.text.split()]
    assert told[0] == pytest.approx(100, abs=1)
    assert told[1:6] == [9, 8, 7, 0xF5, 3]
    assert told[6:10] == [0, 0, 0x104, -1]
    assert told[10:17] == [3, 0x102, 2, 7, 5, 0, 1]
    assert told[17:] == [0, 4, 5, 0, 8]
    sent = [event.value for event in trace.device_events]
    assert [sent[at : at + 8] for at in range(0, len(sent), 8)] == [
        frame(0x2C, 1, 2, 3), frame(0x2D, 0, 1, 0), frame(5, 0, 0, 0), frame(4, 1, 2, 0), frame(9, 0, 0, 0), frame(9, 0, 0, 0),
        frame(0x0C, 0, 0, 0), frame(0x0B, 0, 7, 0), frame(0x0A, 0, 7, 0), frame(0x0B, 0, 8, 0), frame(0x0A, 0, 9, 0),
        frame(0x2E, 0, 4, 0), frame(0x28, 0, 9, 0), frame(2, 0, 5, 3), frame(1, 0, 6, 1), frame(2, 0, 6, 1),
    ]  # fmt: skip
    assert trace.levels("D13")[-1][1] == 1
    assert trace.levels("D11")[-1][1] == "z"


COLOURS = [f"colorpal.h/colorPal{name}" for name in ("_open", "_close", "_getRGB", "RRGGBB")]


@proves(*COLOURS)
def colours_are_read_on_one_wire(uno: Uno) -> None:
    program = """
void say(int32_t number) { Serial.print(number); Serial.print(' '); }
int r, g, b;
void setup() { Serial.begin(115200); colorPal *eye = colorPal_open(10); say(millis()); colorPal_getRGB(eye, &r, &g, &b); say(r);
  say(g); say(b); colorPal_getRGB(eye, &r, &g, &b); say(r); say(g); say(b);
  say(colorPalRRGGBB(100, 80, 200)); say(colorPalRRGGBB(0, 300, 500)); delay(20);
  colorPal_close(eye); delay(1); pinMode(10, OUTPUT); digitalWrite(10, LOW); }
void loop() {}
"""
    points = [[230, "$0A01FFabc"], [270, "$100002003"]]
    line = DeviceUse("serial_line", {"receive": "D10", "transmit": "D10"}, {"baud": 4800, "points": points})
    trace = uno.run(program, COLOURS, 500, [line])
    told = [int(each) for each in trace.text.split()]
    assert told[0] == pytest.approx(100 + 80 + 10 + 10 * 10 / 4.8, abs=3)
    assert told[1:7] == [0x0A0, 0x1FF, 0xABC, 0x100, 2, 3]
    assert told[7:] == [101 << 16 | 118 << 8 | 124, 248 << 8 | 255]  # what is below 0 is 0, above 255 255
    said = [as_whole(event.value) for event in trace.device_events if event.what == "byte"]
    assert bytes(said).endswith(b"=(00 $ m)!")
    levels = trace.levels("D10")
    held = [until - at for (at, level), (until, _) in pairwise(levels) if level == 0 and until - at > 20_000]
    assert held == pytest.approx([80_000], abs=200)
    assert [level for _, level in trace.levels("D10")][-2:] == ["z", 0]
