"""What adapter files say of the memory of their variables (`ram`) is what the compiler says, of some headers."""

from __future__ import annotations

import pytest

from tests.adapters import bench
from tests.adapters.memory import MCU, measured
from tests.tools import require_tools

HEADERS = sorted({piece.header for piece in bench.pieces()})


@pytest.mark.parametrize("header", ["abdrive.h", "gps.h", "servo.h"])
def test_the_marker_is_what_is_measured(header: str) -> None:
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    mine = [piece for piece in bench.pieces() if piece.header == header]
    sizes = measured(bench.pieces(), [(header, piece.name) for piece in mine], MCU, "C++")
    assert {piece.name: piece.ram for piece in mine} == {piece.name: sizes[header, piece.name] for piece in mine}
    assert any(piece.ram for piece in mine)
