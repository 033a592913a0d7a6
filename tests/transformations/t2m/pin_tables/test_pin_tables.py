"""Pin tables: read as a circuit like a drawing's, written from one, and what is wrong with a table told by line."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from robosmi.api import load_hardware
from robosmi.errors import SourceError, UsageError
from robosmi.transformations.chains.hardware import hardware
from robosmi.transformations.knowledge.electrical_facts import electrical
from robosmi.transformations.m2t.pin_table import pin_table
from tests.evaluation.scoring.sketches import labelled_sketches
from tests.evaluation.sources import sketch_file
from tests.transformations.t2m.fritzing.support import CASES

HERE = Path(__file__).resolve().parent
KEPT = ("pin", "role", "driver", "signal", "name")


def mappings(path: Path, roles: dict[str, str] | None = None) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = hardware(path, roles=roles or {}).result["mappings"]
    return found


@pytest.mark.parametrize("name", ["robot.csv", "robot.toml"])
def test_a_table_is_hardware(name: str) -> None:
    done = hardware(HERE / name)
    assert done.findings == []
    assert [b["module_id"] for b in done.result["boards"]] == ["uno"]
    found = [(m["pin"], m["name"], m["role"], m["driver"], [v["title"] for v in m["via"]]) for m in mappings(HERE / name)]
    assert found == [
        ("D2", "eyeWriteP1", "Input", False, []),
        ("D3", "eyeReadP2", "Input", False, []),
        ("D5", "WobblerWriteP1", "Output", False, []),
        ("D6", "L293DWriteP1", "Output", True, []),
        ("D8", "rightWriteP1", "Output", False, []),
        ("D9", "leftWriteP1", "Output", False, []),
        ("D12", "RedLEDWriteP1", "Output", False, ["R1"]),
        ("D12", "PiezoWriteP1", "Output", False, ["R1"]),
        ("A4", "imuBusP1", "Input", False, []),
        ("A5", "imuBusP2", "Input", False, []),
    ]


def test_csv_and_toml_say_the_same() -> None:
    assert mappings(HERE / "robot.csv") == mappings(HERE / "robot.toml")


def test_roles_of_the_project_file_go_first() -> None:
    found = mappings(HERE / "robot.csv", {"Wobbler": "Input", "#3": "Both"})
    assert {m["component"]: m["role"] for m in found if m["component"] in ("Wobbler", "left")} == {
        "Wobbler": "Input",
        "left": "Both",
    }
    with pytest.raises(UsageError, match="unknown component 'Wobler'"):
        mappings(HERE / "robot.csv", {"Wobler": "Input"})


def test_a_part_that_nothing_tells_of_is_a_finding(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text("pin;part\nD3;Gizmo\nD4;LED\nD5;LED\n")
    done = hardware(path)
    assert [f.rule for f in done.findings] == ["RS203", "RS220", "RS273", "RS273"]
    assert done.findings[0].location is not None
    assert done.findings[0].location.line == 2
    assert [m["name"] for m in done.result["mappings"]] == ["GizmoReadP1", "LEDWriteP1", "LED2WriteP1"]


@pytest.mark.parametrize("part", ["Battery divider", "9V battery monitor", "Ground probe", "Resistor", "Arduino Nano"])
def test_no_name_hides_a_part_that_is_on_a_pin(part: str, tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text(f"pin,part,title\nA0,{part},lone\nD13,LED,lamp\n")
    done = hardware(path)
    assert [(m["pin"], m["component"]) for m in done.result["mappings"]] == [("D13", "lamp"), ("A0", "lone")]
    assert "RS203" in [f.rule for f in done.findings]


def test_a_role_that_the_table_gives_still_hides_a_part(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text("pin,part,role\nA0,Battery,Power\nD13,LED,\n")
    assert [m["pin"] for m in mappings(path)] == ["D13"]


@pytest.mark.parametrize("ending", [".csv", ".toml"])
@pytest.mark.parametrize("case", CASES)
def test_a_drawing_s_table_gives_the_same_connections(case: str, ending: str, tmp_path: Path) -> None:
    drawn = hardware(CASES[case])
    path = tmp_path / f"table{ending}"
    path.write_text(drawn.pin_table(path))
    assert json.dumps(shape(mappings(path))) == json.dumps(shape(drawn.result["mappings"]))
    assert hardware(path).pin_table(path) == path.read_text()


def test_tables_of_the_labelled_sketches_give_the_same_connections(tmp_path: Path) -> None:
    sketches = [path for label in labelled_sketches() if (path := sketch_file(label)) is not None]
    if not sketches:
        pytest.skip("the labelled sketches are not there: make corpus")
    compared = 0
    for sketch in sketches:
        drawn = hardware(sketch)
        titles = [m["component"] for m in drawn.result["mappings"]]
        components = {m["component_model_index"] for m in drawn.result["mappings"]}
        if len(drawn.result["boards"]) > 1 or len(set(titles)) != len(components) or not drawn.board_models:
            continue  # titles that are not unique cannot tell components apart in a table
        path = tmp_path / f"{sketch.stem}.csv"
        path.write_text(drawn.pin_table(path))
        kept = [k for k in KEPT if k != "signal"]  # what a chip is by what is behind it is not in a table
        assert [[m[k] for k in kept if k != "name"] for m in shape(mappings(path))] == [
            [m[k] for k in kept if k != "name"] for m in shape(drawn.result["mappings"])
        ], sketch.name
        compared += 1
    assert compared > len(sketches) // 2


def shape(found: list[dict[str, Any]]) -> list[dict[str, Any]]:
    rows = [{k: m[k] for k in KEPT} | {"via": [v["title"] for v in m["via"]]} for m in found]
    return sorted(rows, key=lambda row: (row["pin"], row["name"]))


@pytest.mark.parametrize(
    ("name", "text", "cause", "line"),
    [
        ("a.csv", "pin,part,colour\nD3,LED,red\n", "unknown column 'colour'", 1),
        ("a.csv", "pin,role\nD3,Input\n", "the column 'part' is missing", 1),
        ("a.csv", "pin,part\nD3,LED\nD4,\n", "a row has no part", 3),
        ("a.csv", "pin,part\n,LED\n", "a row has no pin", 2),
        ("a.csv", "pin,part,role\nD3,LED,Sensor\n", "'Sensor' is no role", 2),
        ("a.csv", "pin,part,rest\nD3,Relay module,up\n", "rest is 'up'", 2),
        ("a.csv", "pin,part,volts\nD3,HC-SR04,VCC\n", "volts is 'VCC'", 2),
        ("a.csv", "pin,part,driver\nD3,L293D,perhaps\n", "driver is 'perhaps'", 2),
        ("a.csv", "pin,part\nD3,LED,red,bright\n", "a row has 4 cells, but the header has 2", 2),
        ("a.csv", 'pin,part\nD3,"LED\n', "not valid CSV", 2),
        ("a.csv", "pin,part,board\nD3,LED,uno\nD3,LED,mega\n", "the rows name 2 boards", None),
        ("a.toml", "pins = []\n", "the table has no row", None),
        ("a.csv", "# nothing\n", "the column 'pin' is missing", 1),
        ("a.csv", "\n \n", "the file is empty", None),
        ("a.toml", "[[pin]\n", "not valid TOML", 1),
        ("a.toml", "pin = 3\n", "'pin' is not a list of tables", None),
        ("a.toml", "board = 3\n[[pin]]\npin = 3\npart = 'LED'\n", "'board' is not a text", None),
        ("a.toml", "[[pin]]\npin = 3\npart = ''\n", "a row has no part", 1),
        ("a.csv", f"pin,part,through\nD3,LED,\nD4,LED,{'R1;' * 101}\n", "the signal goes through 101 parts one after another", 3),
        ("a.csv", "pin,part\n" + "D3,LED\n" * 2001, "the table has more than 2,000 parts", 2002),
    ],
)
def test_what_is_wrong_with_a_table(name: str, text: str, cause: str, line: int | None, tmp_path: Path) -> None:
    path = tmp_path / name
    path.write_text(text)
    with pytest.raises(SourceError) as caught:
        hardware(path)
    assert cause in caught.value.message
    assert caught.value.fix
    assert caught.value.location is not None
    assert (caught.value.location.path, caught.value.location.line) == (str(path), line)


@pytest.mark.parametrize("ending", [".csv", ".toml"])
@pytest.mark.parametrize("board", ["", "mega"])
def test_a_table_of_a_drawing_without_a_wired_pin_is_read_again(ending: str, board: str, tmp_path: Path) -> None:
    path = tmp_path / f"a{ending}"
    path.write_text(pin_table([], board, path, {}, {}))
    drawn = hardware(path)
    assert [found["module_id"] for found in drawn.result["boards"]] == [board or "uno"]
    assert drawn.result["mappings"] == []
    assert [finding.rule for finding in drawn.findings] == ["RS212"]


def test_a_board_that_nobody_knows_and_a_table_for_no_such_file(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text("pin,part,board\nD3,LED,unno\n")
    with pytest.raises(UsageError, match="unknown board 'unno'"):
        hardware(path)
    with pytest.raises(UsageError, match=r"a pin table cannot be a '\.txt' file"):
        hardware(HERE / "robot.csv").pin_table(tmp_path / "a.txt")


def test_a_pin_that_the_board_has_not(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text("pin,part,through\nD99,LED,R1\n")
    assert [f.rule for f in hardware(path).findings] == ["RS223"]


def test_a_cell_between_quotation_marks_may_go_over_lines(tmp_path: Path) -> None:
    table = tmp_path / "t.csv"
    table.write_text('pin,part,title\n# note\nD3,Red LED,"the ""left""\n# lamp"\nD5,Pushbutton,start\n')
    assert [found["pin"] for found in mappings(table)] == ["D3", "D5"]
    table.write_text('pin,part\nD5,Pushbutton\n\nD3,"Red LED\nD4,Green LED\n')
    with pytest.raises(SourceError, match="unexpected end of data") as caught:
        mappings(table)
    assert caught.value.location is not None
    assert caught.value.location.line == 4


@pytest.mark.parametrize("ending", [".csv", ".toml"])
def test_the_level_at_which_a_relay_rests_is_in_a_table(ending: str, tmp_path: Path) -> None:
    """Wokwi's relay says by an attribute which level switches it, and its name alone says another thing."""
    path, table = tmp_path / "diagram.json", tmp_path / f"a{ending}"
    path.write_text(
        '{"editor": "wokwi", "parts": [{"type": "wokwi-arduino-uno", "id": "uno"}, {"type": "wokwi-relay-module", "id": "r2"},'
        ' {"type": "wokwi-relay-module", "id": "r1", "attrs": {"transistor": "pnp"}}], "connections":'
        ' [["uno:13", "r1:IN", "", []], ["uno:12", "r2:IN", "", []]]}'
    )
    table.write_text(hardware(path).pin_table(table))
    for drawn in (path, table):
        found = {c.title: c for c in load_hardware(drawn).components}
        rests = {title: facts.rest for title in ("r1", "r2") if (facts := electrical().facts(found[title])) is not None}
        assert rests == {"r1": "high", "r2": "low"}


def test_a_table_without_a_board_is_for_the_target_that_is_given(tmp_path: Path) -> None:
    table = tmp_path / "lamp.csv"
    table.write_text("pin,part,through\nD30,Red LED,R1\n")
    assert [b["module_id"] for b in hardware(table, target="mega").result["boards"]] == ["mega"]
    assert load_hardware(table, target="mega").components[0].boardName == "mega"
    assert [f.rule for f in hardware(table, target="mega").findings if "D30" in f.message] == []
    assert [f.rule for f in hardware(table).findings if "D30" in f.message] == ["RS223"]  # the Uno has no such pin
    assert [b["module_id"] for b in hardware(HERE / "robot.csv", target="uno").result["boards"]] == ["uno"]


def test_a_target_with_another_board_than_the_table_s_is_refused(tmp_path: Path) -> None:
    table = tmp_path / "lamp.csv"
    table.write_text("pin,part,board\nD9,Red LED,nano\n")
    with pytest.raises(SourceError, match="the target is 'mega'") as told:
        hardware(table, target="mega")
    assert "--target nano" in str(told.value.fix)
    with pytest.raises(UsageError, match="did you mean 'mega'"):
        hardware(table, target="mgea")
