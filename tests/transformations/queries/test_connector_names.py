"""Connectors of one name on a component are told apart wherever a person reads them, whatever tool drew them."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest

from robosmi.transformations.chains.hardware import hardware
from robosmi.transformations.queries.circuits.connector_names import displayed_name, wire_name
from tests.running import run
from tests.transformations.t2m.eagle import support as eagle
from tests.transformations.t2m.kicad import support as kicad

UNITS = ["+", "-", "OUT", "+", "-", "OUT", "VCC", "GND"]


def gates(folder: Path) -> Path:
    """An amplifier of two gates, whose pins have one name, on two pins of a board."""
    libraries = [eagle.device("ARDUINO_UNO", eagle.UNO), eagle.device("LM358", [("OUT", "out"), ("IN", "in")], "sensor", gates=2)]
    refs = [
        f'<net name="N${n}"><segment><pinref part="U1" gate="A" pin="D{n}"/><pinref part="IC1" gate="{gate}" pin="OUT"/>'
        "</segment></net>"
        for n, gate in ((2, "A"), (3, "B"))
    ]
    return eagle.schematic(folder, libraries, [eagle.part("U1", "ARDUINO_UNO"), eagle.part("IC1", "LM358")], refs)


def units(folder: Path) -> Path:
    """The same as two units of a symbol."""
    pins = "".join(
        f'(symbol "LM358_{unit}_1" '
        + "".join(f'(pin passive line (at 0 {-10 * n} 0) (name "{p}") (number "{first + n}"))' for n, p in enumerate(UNITS[:3]))
        + ")"
        for unit, first in ((1, 1), (2, 4))
    )
    library = [*kicad.LIBRARY, f'(symbol "Amp:LM358" {pins})']
    entries = [kicad.uno(), kicad.placed("Amp:LM358", "U1", 300, 0), kicad.placed("Amp:LM358", "U1", 400, 0, unit=2)]
    labels = [kicad.label("A", 100, 20), kicad.label("A", 300, 20), kicad.label("B", 100, 30), kicad.label("B", 400, 20)]
    return kicad.schematic(folder / "a.kicad_sch", *entries, *labels, library=library)


@pytest.mark.parametrize(
    ("drawn", "told"), [(gates, {"D2": "A.OUT", "D3": "B.OUT"}), (units, {"D2": "OUT@3", "D3": "OUT@6"})], ids=["eagle", "kicad"]
)
def test_pins_of_one_name_in_several_gates_are_told_apart(drawn: object, told: dict[str, str], tmp_path: Path) -> None:
    assert callable(drawn)
    path = drawn(tmp_path)
    outcome = run("hardware", path, "--json", "--write-table", tmp_path / "wiring.csv", "--svg", tmp_path / "a.svg")
    assert {m["pin"]: m["connectors"][0]["name"] for m in outcome.document["result"]["mappings"]} == told
    ends = [(e["component"], e["name"]) for net in outcome.document["result"]["nets"] for e in net["connectors"]]
    assert len(ends) == len({*ends}) == 4
    shown = run("hardware", path).out
    table = {row["pin"]: row["connector"] for row in csv.DictReader((tmp_path / "wiring.csv").read_text().splitlines())}
    assert table == told
    assert all(f"({name})" in shown and name in (tmp_path / "a.svg").read_text() for name in told.values())


def test_what_is_joined_is_one_pin_and_keeps_its_name(tmp_path: Path) -> None:
    libraries = [eagle.device("ARDUINO_UNO", eagle.UNO), eagle.device("R", [("OUT@1", "io"), ("OUT@2", "io")])]
    nets = [eagle.net("A", "U1.D2", "R1.OUT@1", "R1.OUT@2"), eagle.net("GND", "U1.GND@1")]
    circuit = hardware(
        eagle.schematic(tmp_path, libraries, [eagle.part("U1", "ARDUINO_UNO"), eagle.part("R1", "R")], nets)
    ).circuit
    names = {displayed_name(c) for component in circuit.components for c in component.connectors}
    assert {"OUT", "GND"} <= names
    assert not any("@" in name for name in names)
    assert wire_name(circuit.components[1].connectors) == "OUT"
    assert wire_name([]) == "a wire"


def test_a_net_has_the_title_that_the_drawing_gives_it(tmp_path: Path) -> None:
    libraries = [eagle.device("ARDUINO_UNO", eagle.UNO), eagle.device("LED", eagle.TWO)]
    nets = [eagle.net("LAMP", "U1.D2", "LED1.1"), eagle.net("N$4", "U1.D3", "LED1.2")]
    path = eagle.schematic(tmp_path, libraries, [eagle.part("U1", "ARDUINO_UNO"), eagle.part("LED1", "LED")], nets)
    assert [net["title"] for net in run("hardware", path, "--json").document["result"]["nets"]] == ["LAMP", ""]


def test_a_net_of_fritzing_has_the_text_of_its_label() -> None:
    path = Path(__file__).parents[1] / "t2m" / "fritzing" / "fixtures" / "net_labels.fz"
    assert [net["title"] for net in run("hardware", path, "--json").document["result"]["nets"]] == ["", "lamp"]
