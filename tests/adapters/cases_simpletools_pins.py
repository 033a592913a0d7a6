"""simpletools.h: pins and time. Semantics of the library's sources (libsimpletools, Simple-Libraries 1cc167c10)."""

from __future__ import annotations

import pytest

from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno, proves


def s(*names: str) -> list[str]:
    """These functions of simpletools.h."""
    return [f"simpletools.h/{name}" for name in names]


@proves(*s("high", "low", "pause"))
def high_drives_and_pause_waits_in_milliseconds(uno: Uno) -> None:
    trace = uno.run(
        "void setup() { high(8); pause(20); low(8); pause(5); high(8); }\nvoid loop() {}", s("high", "low", "pause"), 60
    )
    assert trace.pulses("D8")[0][1] == pytest.approx(20_000, rel=0.01)
    assert [level for _, level in trace.levels("D8")][-3:] == [1, 0, 1]


@proves(*s("input", "get_state"))
def input_lets_go_and_reads(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200); high(8); }
void loop() { Serial.print(get_state(2)); Serial.print(input(8)); Serial.println(input(2)); pause(10); }
"""
    devices = [
        DeviceUse("levels", {"pin": "D2"}, {"points": [[0, 0], [15, 1]]}),
        DeviceUse("levels", {"pin": "D8"}, {"points": [[0, 1], [25, 0]]}),
    ]
    trace = uno.run(program, s("high", "input", "get_state", "pause"), 40, devices)
    assert trace.text.split() == ["010", "010", "111", "101"]
    assert trace.levels("D8")[-1][1] == "z"
