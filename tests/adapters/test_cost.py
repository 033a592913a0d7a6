"""Calls of adapters whose pin the compiler knows cost about what plain Arduino code costs, and what it knows of pins is right."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest

from tests.adapters import bench
from tests.adapters.cost import BOUND, costs
from tests.tools import require_engine, require_tools

REPOSITORY = bench.ROOT / "platform_repo"
BOARDS = sorted(
    path
    for path in (REPOSITORY / "arduino" / "boards").glob("*.toml")
    if tomllib.loads(path.read_text())["fqbn"].startswith("arduino:avr")
)


def test_a_call_costs_no_more_than_a_fifth_above_plain_code() -> None:
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    require_engine("simavr")
    assert {name: each for name, each in costs().items() if each.ratio > BOUND} == {}


@pytest.mark.parametrize("path", BOARDS, ids=lambda path: path.stem)
def test_known_pins_are_those_of_the_board(path: Path) -> None:
    """Against the board's file, which each compile holds against the core."""
    hardware = tomllib.loads((REPOSITORY / "boards" / path.name).read_text())
    mapping = tomllib.loads(path.read_text())
    places = {tuple(piece.mcus): piece.text for piece in bench.pieces() if piece.name == "pin_places"}
    text = places.get((hardware["mcu"],), places[()])
    condition, _, _ = text.partition("#else")
    assert re.search(rf"\(ARDUINO_{mapping['define']}\)", condition), "the board looks each pin up"
    (ports,), (bits,) = (re.findall(rf'pin_{name}\[\] = "(\w+)"', condition) for name in ("ports", "bits"))
    known = {number: f"P{port}{bit}" for number, (port, bit) in enumerate(zip(ports, bits, strict=True))}
    pins = {mapping["numbers"][pin["label"]]: pin["port"] for pin in hardware["pins"] if "digital" in pin["abilities"]}
    assert pins
    assert {number: known.get(number) for number in pins} == pins
