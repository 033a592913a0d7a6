"""What is settled for the drawings of all tools, in those that draw symbols: contacts, jumpers, headers, values, chained parts.

The same for Wokwi is in `wokwi/test_reader.py`, of boards in `without_board`, of sheets and labels with the tool that has them.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from robosmi.diagnostics import Finding
from robosmi.transformations.chains.hardware import HardwareAnalysis, hardware
from tests.transformations.t2m.eagle import support as eagle
from tests.transformations.t2m.fritzing.support import FIXTURES
from tests.transformations.t2m.kicad import support as kicad

Wires = dict[str, list[str]]
"""Nets: the pins on them, as PART.PIN."""
Draw = Callable[[Path, dict[str, tuple[str, list[str], str]], Wires], Path]
"""A drawing of an Arduino Uno U1 and of parts: name -> symbol, names of its pins, value."""

CHIP = [f"PB{n}" for n in range(6)] + [f"PC{n}" for n in range(7)] + [f"PD{n}" for n in range(8)] + ["VCC", "GND"]


def in_eagle(folder: Path, parts: dict[str, tuple[str, list[str], str]], wires: Wires) -> Path:
    """The drawing in EAGLE; pins have their names."""
    kinds = {symbol: names for symbol, names, _ in parts.values()}
    libraries = [eagle.device(kind, [(name, "io") for name in names]) for kind, names in kinds.items()]
    listed = [eagle.part(name, symbol, value) for name, (symbol, _, value) in parts.items()]
    return eagle.schematic(folder, libraries, listed, [eagle.net(name, *ends) for name, ends in wires.items()])


def in_kicad(folder: Path, parts: dict[str, tuple[str, list[str], str]], wires: Wires) -> Path:
    """The drawing in KiCad; the pins' labels are the nets' names."""
    library = [kicad.symbol(f"Lib:{symbol}", names) for symbol, names, _ in parts.values()]
    entries = [kicad.placed(f"Lib:{s}", name, 1000 * n, 0, value) for n, (name, (s, _, value)) in enumerate(parts.items())]
    places = {
        f"{name}.{pin}": (1000 * n, 10 * row)
        for n, (name, (_, pins, _)) in enumerate(parts.items())
        for row, pin in enumerate(pins)
    }
    labels = [kicad.label(net, *places[end]) for net, ends in wires.items() for end in ends]
    return kicad.schematic(folder / "a.kicad_sch", *entries, *labels, library=library)


UNO = ("ARDUINO_UNO", [*(f"D{n}" for n in range(14)), "A0", "5V", "GND"], "")
TOOLS = pytest.mark.parametrize("draw", [in_eagle, in_kicad])


def mapped(made: HardwareAnalysis) -> dict[str, list[str]]:
    """The components on each pin."""
    found: dict[str, list[str]] = {}
    for mapping in made.result["mappings"]:
        found.setdefault(mapping["pin"], []).append(mapping["component"])
    return found


def said(made: HardwareAnalysis, rule: str) -> list[Finding]:
    """The findings of a rule; each says what to do."""
    found = [finding for finding in made.findings if finding.rule == rule]
    assert all(finding.fix for finding in found)
    return found


@TOOLS
@pytest.mark.parametrize(
    ("symbol", "names"), [("TACT_SWITCH", ["1", "2", "3", "4"]), ("SPST_TACT", ["P", "P1", "S", "S1"])]
)  # fmt: skip
def test_a_switch_across_one_contact_ties_the_pin_and_is_no_mapping(
    draw: Draw, symbol: str, names: list[str], tmp_path: Path
) -> None:
    one, same, other, _ = names
    parts = {"U1": UNO, "S1": (symbol, names, ""), "S2": (symbol, names, "")}
    wires = {"A": ["U1.D2", f"S1.{one}"], "B": ["U1.D3", f"S2.{one}"], "GND": ["U1.GND", f"S1.{same}", f"S2.{other}"]}
    made = hardware(draw(tmp_path, parts, wires))
    assert mapped(made) == {"D3": ["S2"]}
    assert ["'S1'" in finding.message and "D2" in finding.message for finding in said(made, "RS228")] == [True]


@TOOLS
def test_a_pin_behind_the_other_end_of_a_contact_is_on_its_net(draw: Draw, tmp_path: Path) -> None:
    parts = {"U1": UNO, "S1": ("TACT_SWITCH", ["1", "2", "3", "4"], ""), "R1": ("R-US_", ["1", "2"], "10k")}
    wires = {"A": ["U1.D2", "S1.1"], "B": ["S1.2", "R1.1"], "5V": ["U1.5V", "R1.2"], "GND": ["U1.GND", "S1.3"]}
    made = hardware(draw(tmp_path, parts, wires))
    assert mapped(made) == {"D2": ["S1"]}
    assert said(made, "RS256") == []  # R1 holds the pin, through the contact


@TOOLS
def test_a_contact_to_ground_that_nothing_holds_is_said(draw: Draw, tmp_path: Path) -> None:
    parts = {"U1": UNO, "S1": ("SW_PUSH", ["1", "2"], "")}
    made = hardware(draw(tmp_path, parts, {"A": ["U1.D2", "S1.1"], "GND": ["U1.GND", "S1.2"]}))
    assert ["D2" in finding.message for finding in said(made, "RS256")] == [True]


@TOOLS
def test_a_change_over_switch_between_two_rails_always_joins_its_pin_to_one(draw: Draw, tmp_path: Path) -> None:
    parts = {"U1": UNO, "S1": ("SLIDE_SWITCH", ["1", "2", "3"], "")}
    made = hardware(draw(tmp_path, parts, {"A": ["U1.D2", "S1.2"], "GND": ["U1.GND", "S1.1"], "5V": ["U1.5V", "S1.3"]}))
    assert mapped(made) == {"D2": ["S1"]}
    assert said(made, "RS256") == []


@TOOLS
def test_a_solder_jumper_is_not_crossed_and_a_resistor_is(draw: Draw, tmp_path: Path) -> None:
    parts = {"U1": UNO, "JP1": ("SOLDERJUMPER", ["1", "2"], ""), "R1": ("R-US_", ["1", "2"], "220")}
    parts |= {name: ("LED", ["A", "K"], "") for name in ("LED1", "LED2")}
    wires = {"A": ["U1.D2", "JP1.1"], "B": ["JP1.2", "LED1.A"], "C": ["U1.D3", "R1.1"], "D": ["R1.2", "LED2.A"]}
    made = hardware(draw(tmp_path, parts, wires))
    assert mapped(made) == {"D3": ["LED2"]}
    assert len(said(made, "RS217")) == 1


def test_a_solder_jumper_of_fritzing_is_not_crossed(tmp_path: Path) -> None:
    text = (FIXTURES / "two_passives.fz").read_text(encoding="utf-8")
    assert mapped(hardware(FIXTURES / "two_passives.fz"))
    path = tmp_path / "jumper.fz"
    path.write_text(text.replace("ResistorModuleID", "SparkFun-Passives-SOLDERJUMPER-NO"), encoding="utf-8")
    made = hardware(path)
    assert mapped(made) == {}
    assert said(made, "RS217")


@TOOLS
def test_what_repeats_an_input_hands_it_on(draw: Draw, tmp_path: Path) -> None:
    names = ["DIN", "CS", "CLK", "DOUT", "CS.2" if draw is in_kicad else "CS@2"]
    parts = {"U1": UNO, "M1": ("MAX7219_MATRIX", names, ""), "M2": ("MAX7219_MATRIX", names, "")}
    wires = {"A": ["U1.D10", "M1.CS"], "B": [f"M1.{names[4]}", "M2.CS"], "C": ["U1.D11", "M1.DIN"], "D": ["M1.DOUT", "M2.DIN"]}
    if draw is in_eagle:  # PART.PIN is parted at the dot
        assert "." not in names[4]
    assert mapped(hardware(draw(tmp_path, parts, wires))) == {"D10": ["M1", "M2"], "D11": ["M1"]}


@TOOLS
def test_the_value_decides_over_the_symbol(draw: Draw, tmp_path: Path) -> None:
    parts = {
        "IC1": ("ATMEGA168", CHIP, "ATMEGA328P"),
        "J1": ("PINHD-1X4", ["1", "2", "3", "4"], "HC-SR04"),
        "Q1": ("LED", ["1", "2"], "TMP36"),
    }
    made = hardware(draw(tmp_path, parts, {"A": ["IC1.PD2", "J1.2"], "B": ["IC1.PC0", "Q1.1"], "C": ["IC1.PB5", "J1.3"]}))
    assert mapped(made) == {"D2": ["J1"], "D13": ["J1"], "A0": ["Q1"]}
    roles = {component["title"]: component["role"] for component in made.result["components"]}
    assert roles == {"IC1": "Board", "J1": "Input", "Q1": "Input"}
    assert ["ATMEGA328P" in finding.message for finding in said(made, "RS215")] == [True]


@TOOLS
def test_a_header_with_nothing_behind_it_is_unknown_and_not_walked_through(draw: Draw, tmp_path: Path) -> None:
    parts = {
        "U1": UNO,
        "J1": ("PINHD-1X2", ["1", "2"], ""),
        "LED1": ("LED", ["A", "K"], ""),
        "J2": ("PINHD-1X2", ["1", "2"], "Gripper"),
    }
    made = hardware(draw(tmp_path, parts, {"ARM": ["U1.D2", "J1.1"], "B": ["J1.2", "LED1.A"], "C": ["U1.D4", "J2.1"]}))
    assert mapped(made) == {"D2": ["J1"], "D4": ["J2"]}
    told = {component["title"]: (component["role"], component["part_title"]) for component in made.result["components"]}
    assert (told["J1"][0], told["J2"]) == ("Unknown", ("Unknown", "Gripper"))
    assert told["J1"][1].startswith("ARM")
