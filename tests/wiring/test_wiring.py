"""`robosmi wiring` writes the wiring of a migration; read again, it has the same pins."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from robosmi.cli.main import main
from robosmi.resources import built_in
from robosmi.transformations.chains.hardware import hardware
from robosmi.transformations.t2m.wokwi.document import read_diagram
from tests.transformations.t2m.kicad import support as kicad
from tests.wiring.elements import wokwi_elements

ROOT = Path(__file__).resolve().parents[2]
LINE_FOLLOWER = ROOT / "docs" / "examples" / "line_follower" / "line_follower.c"
MONITORING = ROOT / "docs" / "examples" / "environmental_monitoring" / "environmental_monitoring.c"
BLINK = Path(__file__).with_name("blink.c")
READERS = ROOT / "tests" / "transformations" / "t2m" / "drawing_readers"
TABLES = ROOT / "tests" / "transformations" / "t2m" / "pin_tables"
ROBOT = (LINE_FOLLOWER, LINE_FOLLOWER.parent / "line_following_robot.fzz")
CASES = [
    pytest.param(*ROBOT, id="line-follower"),
    pytest.param(MONITORING, MONITORING.parent / "environmental_monitoring_robot.fzz", id="environmental-monitoring"),
    pytest.param(LINE_FOLLOWER, READERS / "wokwi" / "robot.json", id="wokwi"),
    pytest.param(LINE_FOLLOWER, READERS / "pin_table" / "robot.csv", id="pin-table"),
    *(pytest.param(BLINK, path, id=path.name) for path in sorted(TABLES.glob("robot.*"))),
]
Made = Callable[[Path, Path], Path]


@pytest.fixture
def made(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Made:
    """A function that migrates a program to the board of a drawing and returns the output folder."""

    def move(program: Path, drawing: Path) -> Path:
        out = tmp_path / "out"
        assert main(["migrate", str(program), "--hardware", str(drawing), "-o", str(out), "--yes", "--fail-on", "never"]) == 0
        capsys.readouterr()
        return out

    return move


def handed(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, dict[str, Any]]:
    """The exit code and the JSON document of `robosmi wiring`."""
    code = main(["wiring", *words, "--json"])
    document: dict[str, Any] = json.loads(capsys.readouterr().out)
    return code, document


def pin_map(drawing: Path) -> dict[tuple[str, str], tuple[str, ...]]:
    """Pin and component -> the parts between them."""
    return {(m["pin"], m["component"]): tuple(via["title"] for via in m["via"]) for m in hardware(drawing).result["mappings"]}


@pytest.mark.parametrize(("program", "drawing"), CASES)
def test_our_own_wokwi_file_gives_the_same_pins(
    program: Path, drawing: Path, made: Made, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = made(program, drawing)
    code, document = handed(capsys, str(out), "--as", "wokwi", "-o", str(tmp_path / "wokwi"))
    assert code == 0
    listed = {part["component"]: part for part in document["result"]["not_drawn"]}
    wanted = {
        key: tuple(via for via in ways if via not in listed) for key, ways in pin_map(drawing).items() if key[1] not in listed
    }
    assert wanted
    assert pin_map(tmp_path / "wokwi" / "diagram.json") == wanted
    for (pin, component), _ in pin_map(drawing).items():
        assert component not in listed or pin in listed[component]["pins"]
    said = [f["message"] for f in document["findings"] if f["rule"] == "RS536"]
    assert len(said) == len(listed)
    assert (tmp_path / "wokwi" / "not-drawn.txt").is_file() == bool(listed)


@pytest.mark.parametrize(("program", "drawing"), CASES)
def test_every_part_and_pin_that_is_drawn_is_one_of_wokwis_elements(
    program: Path, drawing: Path, made: Made, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    elements = wokwi_elements()
    out = made(program, drawing)
    handed(capsys, str(out), "--as", "wokwi", "-o", str(tmp_path / "wokwi"))
    diagram = read_diagram(tmp_path / "wokwi" / "diagram.json")
    kinds = {part.identity: part.kind for part in diagram.parts}
    assert len(kinds) == len(diagram.parts)
    assert {*kinds.values()} <= {*elements}
    ends = [end.rpartition(":") for connection in diagram.connections for end in connection.ends]
    assert [f"{identity}:{pin}" for identity, _, pin in ends if pin not in elements[kinds[identity]]] == []


def test_every_type_that_may_be_drawn_is_an_element_with_the_pins_that_are_named() -> None:
    elements = wokwi_elements()
    entries = tomllib.loads((built_in("platform_repo") / "parts" / "wokwi_types.toml").read_text("utf-8"))["type"]
    for entry in entries:
        pins = elements[entry["type"]]
        named = [*entry.get("returns", ()), *entry.get("feeds", ()), *(pin for group in entry.get("order", ()) for pin in group)]
        named += [pin for pin in entry.get("pins", ()) if "[" not in pin]
        if not entry.get("attrs"):  # with attributes an element has other pins
            assert [pin for pin in named if pin not in pins and f"{pin}.1" not in pins] == [], entry["type"]


def test_the_project_has_the_sketch_and_its_libraries(made: Made, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = made(*ROBOT)
    code, document = handed(capsys, str(out), "--as", "wokwi", "-o", str(tmp_path / "wokwi"))
    names = {Path(artifact["path"]).name: artifact["kind"] for artifact in document["artifacts"]}
    assert code == 0
    assert names == {
        "diagram.json": "wiring", "sketch.ino": "sketch", "adapters.h": "sketch", "libraries.txt": "wiring",
        "not-drawn.txt": "wiring",
    }  # fmt: skip
    sketch = out / "line_follower"
    assert (tmp_path / "wokwi" / "sketch.ino").read_bytes() == (sketch / "line_follower.ino").read_bytes()
    assert (tmp_path / "wokwi" / "adapters.h").read_bytes() == (sketch / "adapters.h").read_bytes()
    lines = (tmp_path / "wokwi" / "libraries.txt").read_text().splitlines()
    assert [line.partition("@")[0] for line in lines if not line.startswith("#")] == ["Servo"]
    assert {part["component"] for part in document["result"]["not_drawn"]} == {"HIH4030 1", "HIH4030 2", "VCC1"}


def test_what_a_signal_goes_through_is_drawn_with_its_value(
    made: Made, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A pin table names the parts between pin and component by a reference or a value alone."""
    table = tmp_path / "table.csv"
    rows = ["D3,LED,Lamp,anode,R1", "D5,Pushbutton,Knob,,R_pull; 4k7", "D6,LED,Two,anode,220 ohm", "D9,Servo,Arm,pulse,C1"]
    table.write_text("\n".join(["pin,part,title,connector,through", *rows]) + "\n")
    out = made(BLINK, table)
    code, document = handed(capsys, str(out), "--as", "wokwi", "-o", str(tmp_path / "wokwi"))
    assert code == 0
    assert [part["component"] for part in document["result"]["not_drawn"]] == ["C1"]  # Wokwi has no capacitor
    resistors = [p for p in read_diagram(tmp_path / "wokwi" / "diagram.json").parts if p.kind == "wokwi-resistor"]
    assert {p.identity: p.attributes.get("value") for p in resistors} == {
        "R1": None, "R_pull": None, "4k7": "4700", "220 ohm": "220",
    }  # fmt: skip
    assert pin_map(tmp_path / "wokwi" / "diagram.json") == {
        ("D3", "Lamp"): ("R1",), ("D5", "Knob"): ("R_pull", "4k7"), ("D6", "Two"): ("220 ohm",), ("D9", "Arm"): (),
    }  # fmt: skip


def test_parts_of_a_pin_table_are_supplied_and_those_with_one_wire_are_told(
    made: Made, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """An LED connected by its cathode has its anode at the supply; the other connection of a button is unknown."""
    table = tmp_path / "table.csv"
    rows = ["D3,LED,Lamp,cathode,R1", "D4,LED,Two,anode,R2", "D5,Pushbutton,Knob,", "D6,Pushbutton,Other,", "D9,Servo,Arm,pulse,"]
    table.write_text("\n".join(["pin,part,title,connector,through", *rows]) + "\n")
    code, document = handed(capsys, str(made(BLINK, table)), "--as", "wokwi", "-o", str(tmp_path / "wokwi"))
    assert code == 0
    told = [finding["message"] for finding in document["findings"] if finding["rule"] == "RS538"]
    assert told == ["only one wire in the diagram: Knob, Other; the pin table does not list their other connections"]
    wires = json.loads((tmp_path / "wokwi" / "diagram.json").read_text())["connections"]
    ends = {wire[1]: wire[0] for wire in wires}
    assert (ends["Lamp:A"], ends["Two:C"]) == ("Arduino Uno:5V", "Arduino Uno:GND.1")
    assert "Lamp:C" in ends or "Lamp:C" in ends.values()


def test_a_pin_that_a_symbol_ties_to_a_supply_stays_tied(made: Made, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    lamps = [kicad.led("D1", 300, 0), kicad.led("D2", 400, 0), kicad.placed("power:+5V", "#PWR1", 100, 60)]
    labels = [kicad.label("A", 100, 60), kicad.label("A", 300, 0), kicad.label("B", 100, 80), kicad.label("B", 400, 0)]
    drawing = kicad.schematic(tmp_path / "a.kicad_sch", kicad.uno(), *lamps, *labels)
    out = made(BLINK, drawing)
    assert pin_map(drawing) == {("D8", "D2"): ()}
    handed(capsys, str(out), "--as", "wokwi", "-o", str(tmp_path / "wokwi"))
    assert pin_map(tmp_path / "wokwi" / "diagram.json") == pin_map(drawing)


def test_the_table_and_the_picture_are_files(made: Made, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    program, drawing = ROBOT
    out = made(program, drawing)
    for form, kind in (("csv", "pin table"), ("svg", "picture")):
        path = tmp_path / f"wiring.{form}"
        code, document = handed(capsys, str(out), "--as", form, "-o", str(path))
        assert code == 0
        assert document["artifacts"] == [{"path": str(path), "kind": kind}]
    assert pin_map(tmp_path / "wiring.csv") == pin_map(drawing)
    assert "<svg" in (tmp_path / "wiring.svg").read_text()


def test_what_a_person_has_changed_is_not_written_over(made: Made, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out, place = made(*ROBOT), tmp_path / "wokwi"
    assert handed(capsys, str(out), "--as", "wokwi", "-o", str(place))[0] == 0
    assert handed(capsys, str(out), "--as", "wokwi", "-o", str(place))[0] == 0
    (place / "diagram.json").write_text("{}")
    (place / "libraries.txt").unlink()
    code, document = handed(capsys, str(out), "--as", "wokwi", "-o", str(place))
    assert code == 5
    assert document["findings"][0]["location"]["path"] == str(place / "diagram.json")
    assert (place / "diagram.json").read_text() == "{}"
    assert not (place / "libraries.txt").exists()


def test_what_has_no_wiring_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "out"
    assert main(["migrate", str(BLINK), "-o", str(out), "--yes", "--fail-on", "never"]) == 0
    capsys.readouterr()
    (tmp_path / "empty").mkdir()
    assert handed(capsys, str(tmp_path / "empty"), "--as", "csv", "-o", str(tmp_path / "x.csv"))[0] == 3
    assert not (tmp_path / "x.csv").exists()
    assert main(["wiring", str(out), "--as", "fax", "-o", str(tmp_path / "x")]) == 2


@pytest.mark.parametrize("form", ["wokwi", "csv"])
def test_a_plan_without_a_drawing_has_no_wiring(form: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["migrate", str(BLINK), "-o", str(tmp_path / "out"), "--yes", "--fail-on", "never"]) == 0
    capsys.readouterr()
    code, document = handed(capsys, str(tmp_path / "out"), "--as", form, "-o", str(tmp_path / "wiring"))
    assert code == 3
    assert "no drawing" in document["findings"][0]["message"]
    assert not (tmp_path / "wiring").exists()


def test_wokwi_lacks_the_board(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table = tmp_path / "robot.csv"
    table.write_text("pin,part,title,connector,board\nD9,Servo,Arm,pulse,leonardo\n")
    out = tmp_path / "out"
    words = ["migrate", str(BLINK), "--hardware", str(table), "--target", "leonardo", "-o", str(out), "--yes"]
    assert main([*words, "--fail-on", "never"]) == 0
    capsys.readouterr()
    code, document = handed(capsys, str(out), "--as", "wokwi", "-o", str(tmp_path / "wokwi"))
    assert code == 3
    assert "Wokwi has no board 'Arduino Leonardo'" in document["findings"][0]["message"]
    assert "uno" in document["findings"][0]["fix"]
