"""Pins of the parts in `parts/wokwi.toml`, held against the element classes of the npm package @wokwi/elements."""

from __future__ import annotations

import tomllib
from typing import Any

import pytest

from robosmi.resources import built_in
from robosmi.transformations.knowledge.drawn_boards import drawn_board
from robosmi.transformations.knowledge.parts_catalogue import Catalogue
from tests.wiring.elements import wokwi_elements

OTHERS = {"wokwi-esp32-devkit-v1", "wokwi-franzininho", "wokwi-nano-rp2040-connect"}
"""Boards of other families, whose pins are taken as a diagram has them."""


@pytest.fixture
def elements() -> dict[str, list[str]]:
    """The names of the pins of each element, as its class has them."""
    return wokwi_elements()


def entries() -> list[dict[str, Any]]:
    """The entries of the catalogue."""
    found: list[dict[str, Any]] = tomllib.loads((built_in("platform_repo") / "parts" / "wokwi.toml").read_text("utf-8"))["part"]
    return found


def test_every_part_of_the_package_is_known_with_all_of_its_pins(elements: dict[str, list[str]]) -> None:
    known = {name for entry in entries() for name in entry["ids"]["wokwi"]}
    assert {*elements} - known == OTHERS
    catalogue = Catalogue(tool="wokwi")
    lacking = {}
    for name, pins in elements.items():
        part = catalogue.find(name)
        if part is not None and (missing := [pin for pin in pins if not part.has(pin)]):
            lacking[name] = missing
    assert lacking == {}


def test_each_pin_of_a_board_that_is_numbered_is_a_pin_of_the_boards_file(elements: dict[str, list[str]]) -> None:
    for name in ("wokwi-arduino-uno", "wokwi-arduino-nano", "wokwi-arduino-mega"):
        board = drawn_board(name, "wokwi")
        assert board is not None
        assert {*board.pins} <= {*elements[name]}
        wanted = {pin for pin in elements[name] if pin.partition(".")[0].removeprefix("A").isdigit() and pin != "3.3V"}
        assert wanted <= {*board.pins}
        for pin, label in board.pins.items():
            number = pin.partition(".")[0]
            assert label in {number, f"D{number}", {"SDA": "D20", "SCL": "D21"}.get(number)}


def test_no_entry_has_an_id_twice() -> None:
    ids = [name for entry in entries() for name in entry["ids"]["wokwi"]]
    assert len(ids) == len(set(ids))
