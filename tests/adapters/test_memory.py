"""What adapter files say of the memory of their variables (`ram`) is what the compiler says, of some headers."""

from __future__ import annotations

import pytest

from robosmi.transformations.queries.plans.adapter_needs import AdapterPieces
from tests.adapters import bench
from tests.adapters.memory import MCU, measured
from tests.tools import require_tools

HEADERS = sorted({piece.header for piece in bench.pieces()})


@pytest.mark.parametrize("header", ["abdrive.h", "gps.h", "servo.h"])
def test_the_marker_is_what_is_measured(header: str) -> None:
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    mine = [piece for piece in bench.pieces() if piece.header == header]
    for drawn in {tuple(piece.drawn) for piece in mine}:
        known = AdapterPieces(bench.pieces(), architecture="avr", drawn=drawn)
        names = sorted({piece.name for piece in mine})
        chosen = [piece for name in names if (piece := known.variant((header, name), MCU)) is not None]
        sizes = measured(bench.pieces(), [(header, piece.name) for piece in chosen], MCU, "C++", drawn)
        assert {piece.name: piece.ram for piece in chosen} == {piece.name: sizes[header, piece.name] for piece in chosen}
        assert any(piece.ram for piece in chosen)
