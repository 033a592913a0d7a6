"""What adapter files say of the stack (`stack`, `interrupt`) is what the machine code says, of some adapters."""

from __future__ import annotations

import pytest

from tests.adapters import bench
from tests.adapters.stack import marks, measured, written
from tests.tools import require_tools


@pytest.mark.parametrize("place", ["simpletools.h/pause", "servo.h/servo_angle"])
def test_the_marker_is_what_is_measured(place: str) -> None:
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    piece = next(each for each in bench.pieces() if f"{each.header}/{each.name}" == place)
    found = measured(piece)
    assert (piece.stack, piece.stack_once) == found.stack
    assert {each.vector: (each.stack, each.others) for each in piece.interrupts} == dict(found.interrupts)
    assert piece.stack > 0


def test_markers_are_written_where_they_were_or_behind_the_head() -> None:
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    piece = next(each for each in bench.pieces() if f"{each.header}/{each.name}" == "simpletools.h/pause")
    found = measured(piece)
    head = "//# header simpletools.h\n\n//# adapter pause\n//#   for: void pause(int time)\n//#   kind: semantic\n"
    text = f"{head}void pause(int32_t time) {{}}\n"
    once = written(text, {("simpletools.h", "pause"): found})
    assert once == head + "\n".join(marks(found)) + "\nvoid pause(int32_t time) {}\n"
    assert written(once, {("simpletools.h", "pause"): found}) == once
    assert written(text, {}) == text
