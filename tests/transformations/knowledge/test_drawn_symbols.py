"""Boards of one's own in schematics: pins without aliases, labels of their own, parts that a board's file names by ids."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.transformations.t2m.drawing import CircuitBuilder
from robosmi.transformations.t2m.schematic import Schematic, SchematicPart, circuit_of, drawn_symbol

LABELS = {
    "numbered": ["D0", "D2", "D3", "D9", "D13", "A0"],
    "own": ["R0", "P2", "P3", "P9", "L13", "Q0"],
}


@pytest.fixture(params=sorted(LABELS))
def labels(request: pytest.FixtureRequest, tmp_path: Path) -> list[str]:
    """The labels of a board whose file is in the project folder `tmp_path`."""
    labels = LABELS[str(request.param)]
    boards = tmp_path / ".robosmi" / "platform_repo" / "boards"
    boards.mkdir(parents=True)
    ports = ["PD0", "PD2", "PD3", "PB1", "PB5", "PC0"]
    pins = "".join(
        f'    {{ label = "{label}", port = "{port}", abilities = ["digital"] }},\n'
        for label, port in zip(labels, ports, strict=True)
    )
    ends = "".join(f'{label} = ["{label}"]\n' for label in labels)
    (boards / "maker-own.toml").write_text(
        'name = "maker-own"\ntitle = "Maker Own"\nmcu = "atmega328p"\nf_cpu = 16_000_000\nvolts = 5.0\n'
        f'led = "{labels[4]}"\npins = [\n{pins}]\n\n[[drawn_symbols]]\ncalled = ["maker own*"]\n\n'
        f'[[drawn_as]]\ntool = "mine"\nmodules = ["MO2"]\n\n[drawn_as.connectors]\n{ends}'
    )
    return labels


def test_pins_bear_the_labels_of_the_board_and_need_no_aliases(labels: list[str], tmp_path: Path) -> None:
    drawn = {f"{number}": label for number, label in enumerate(labels)} | {"5": f"{labels[5]}/ADC", "9": "GND"}
    found = drawn_symbol(["Maker_Own"], drawn, tmp_path)
    assert found is not None
    assert found.name == "maker-own"
    assert found.pins == {f"{number}": label for number, label in enumerate(labels)}


@pytest.mark.parametrize(
    ("board", "wanted"),
    [("Arduino Nano", {"RX1": "D0", "TX0": "D1"}), ("Arduino Mega 2560", {"RX1": "D19", "TX0": "D1"})],
)
def test_lines_of_the_only_serial_port_bear_any_number(board: str, wanted: dict[str, str]) -> None:
    drawn = {name: name for name in ("ANALOG_1", "DIGITAL_10(PWM)", "D2", "D3", *wanted)}
    found = drawn_symbol([board], drawn)
    assert found is not None
    assert found.pins == {"ANALOG_1": "A1", "DIGITAL_10(PWM)": "D10", "D2": "D2", "D3": "D3", **wanted}


def test_a_part_of_a_schematic_is_the_board_that_names_its_id(labels: list[str], tmp_path: Path) -> None:
    builder = CircuitBuilder("robot.mine", "mine", tmp_path)
    pins = {pin: pin for pin in (*labels, "GND")}
    drawn = Schematic("robot.mine", "0" * 64, "Mine", "1")
    drawn.parts.append(SchematicPart("u1", "u1", symbol="thing", listed_as="MO2", pins=pins, line=1))
    (board,) = circuit_of(drawn, builder).components
    assert (board.role.name, board.boardName) == ("Board", "maker-own")
