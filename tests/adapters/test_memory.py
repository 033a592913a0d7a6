"""What adapter files say of the memory of their variables (`ram`) is what the compiler says, of some headers."""

from __future__ import annotations

from collections import Counter

import pytest

from robosmi.transformations.knowledge.adapters.adapter_files import HAL
from robosmi.transformations.queries.plans.adapter_needs import AdapterPieces
from tests.adapters import bench
from tests.adapters.memory import MCU, main, measured, measurements, written
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


def test_the_command_measures_one_header_again_and_leaves_right_markers_alone(capsys: pytest.CaptureFixture[str]) -> None:
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    assert main("servo.h") == 0, capsys.readouterr().out


def test_the_hardware_layer_is_measured_with_the_headers_that_need_it() -> None:
    """Its pieces for other architectures do not compile on an AVR, and some of those for an AVR exclude each other."""
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    known = AdapterPieces(bench.pieces(), architecture="avr")
    sizes = measurements("C++", bench.pieces(), ["abdrive.h"])
    of_layer = {name: size for (header, name), size in sizes.items() if header == HAL}
    assert of_layer
    assert of_layer == {name: piece.ram for name in of_layer if (piece := known.variant((HAL, name), MCU)) is not None}


def test_markers_are_written_where_they_were_or_behind_the_head() -> None:
    head = "//# header some.h\n\n//# adapter one\n//#   for: void one(int time)\n"
    right = f"{head}//#   ram: 4\n//#   stack: 12\nvoid one() {{}}\n"
    sizes = Counter({("some.h", "one"): 4})
    assert written(right, sizes) == right
    assert written(right.replace("ram: 4", "ram: 9"), sizes) == right
    assert written(right, Counter()) == f"{head}//#   stack: 12\nvoid one() {{}}\n"
    assert written(f"{head}void one() {{}}\n", sizes) == f"{head}//#   ram: 4\nvoid one() {{}}\n"
    variant = right.replace("//#   stack", "//#   beside: two\n//#   stack")
    assert written(variant, Counter({("some.h", "one"): 8})) == variant
