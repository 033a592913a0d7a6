"""keypad.h: a matrix of keys. Semantics of the library's source (libkeypad, Simple-Libraries 1cc167c10)."""

from __future__ import annotations

from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno, proves

ALL = [f"keypad.h/keypad_{name}" for name in ("setup", "read", "readFrom")]


@proves(*ALL)
def keys_that_are_held_are_found(uno: Uno) -> None:
    program = """
int rows[2] = {4, 5}, columns[3] = {6, 7, 8}, values[6] = {1, 2, 3, 'A', 'B', 'C'};
void say(int32_t number) { Serial.print(number); Serial.print(' '); }
void setup() { Serial.begin(115200); keypad_setup(2, 3, rows, columns, values);
  for (int turn = 0; turn < 4; turn++) { say(keypad_read()); say(keypad_readFrom(2)); say(keypad_readFrom('B')); delay(50); } }
void loop() {}
"""
    pins = {"row0": "D4", "row1": "D5", "column0": "D6", "column1": "D7", "column2": "D8"}
    points = [[0, None], [25, [0, 1]], [75, [1, 2]], [125, [0, 2]]]
    trace = uno.run(program, ALL, 260, [DeviceUse("keypad", pins, {"points": points})])
    told = [int(each) for each in trace.text.split()]
    assert told == [-1, -1, -1, 2, -1, -1, ord("C"), ord("C"), ord("C"), 3, 3, -1]
    assert trace.levels("D4")[-1][1] == "z"


@proves("keypad.h/keypad_getNumber", "keypad.h/keypad_getNumberEndKey")
def numbers_are_keyed_in(uno: Uno) -> None:
    used = ["keypad.h/keypad_setup", "keypad.h/keypad_getNumber", "keypad.h/keypad_getNumberEndKey", "simpletext.h/putDec"]
    program = """
int rows[2] = {4, 5}, columns[3] = {6, 7, 8}, values[6] = {1, 2, 3, 'A', 'B', 'C'};
void setup() { keypad_setup(2, 3, rows, columns, values); int32_t number = keypad_getNumber(); putDec(number);
  putDec(keypad_getNumberEndKey()); }
void loop() {}
"""
    pins = {"row0": "D4", "row1": "D5", "column0": "D6", "column1": "D7", "column2": "D8"}
    points = [[0, None], [10, [0, 1]], [30, None], [40, [0, 1]], [60, None], [70, [0, 0]], [90, None], [100, [1, 1]], [120, None]]
    trace = uno.run(program, used, 150, [DeviceUse("keypad", pins, {"points": points})])
    assert trace.text == f"221 B 221{ord('B')}"
