"""Bare microcontrollers as boards: which board, which pin by port, and what is no board of ours."""

from __future__ import annotations

import pytest

from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.knowledge.drawn_chips import chip_named, drawn_chip, port_of

PORTS = [f"P{port}{bit}" for port, bits in (("B", 8), ("C", 7), ("D", 8)) for bit in range(bits)]


def symbol(pins: int, text: str = "{}") -> dict[str, str]:
    """Connectors of a chip with that many pins, its ports first."""
    names = [text.format(port) for port in PORTS] + (["ADC6", "ADC7"] if pins > 28 else [])
    names += [f"VCC{number}" for number in range(pins - len(names))]
    return {str(number): name for number, name in enumerate(names, 1)}


@pytest.mark.parametrize(
    ("pins", "board", "text"), [(28, "uno", "{}"), (32, "nano", "(PCINT5/SCK){}"), (28, "uno", "{}(XTAL1/TOSC1)")]
)
def test_a_chip_is_the_board_with_its_ports(pins: int, board: str, text: str) -> None:
    connectors = symbol(pins, text)
    found = drawn_chip(["ATMEGA328P-PU"], connectors)
    assert found is not None
    assert (found.board.name, found.chip, found.clock) == (board, "ATMEGA328P", 16_000_000)
    own = {pin.label: pin.port for pin in load_board(board).pins}
    assert {own[label] for label in found.board.pins.values()} == {port_of(connectors[c]) for c in found.board.pins}
    assert {*found.board.pins.values()} == {*own}
    assert next(label for c, label in found.board.pins.items() if "PB5" in connectors[c]) == "D13"


def test_the_value_decides_over_the_symbol() -> None:
    assert chip_named(["ATMEGA328P-AU", "ATMEGA168-20AU"]) == "ATMEGA328P"
    assert chip_named(["", "atmega32u4"]) == "ATMEGA32U4"
    assert chip_named(["10k", "LM7805"]) == ""


def test_another_chip_is_no_board_of_ours() -> None:
    assert drawn_chip(["ATTINY85"], symbol(28)) is None
    assert drawn_chip(["LM7805"], symbol(28)) is None
    assert drawn_chip(["ATMEGA328P"], {"1": "VCC"}) is None


@pytest.mark.parametrize(
    ("name", "port"), [("PB5", "PB5"), ("(SCK)PB5", "PB5"), ("PB5/SCK", "PB5"), ("ADC6", "ADC6"), ("SPB51", ""), ("PB55", "")]
)
def test_the_port_is_found_in_the_name_of_a_pin(name: str, port: str) -> None:
    assert port_of(name) == port
