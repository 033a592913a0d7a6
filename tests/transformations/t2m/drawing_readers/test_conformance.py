"""What every reader of drawings holds: a reader is in this suite by being registered, and passes with a folder of its own here.

A folder `READER/` has two drawings of that tool's: `robot.*`, the line follower of docs/examples, whose pins are in `robot.json`
for all tools, and `unknown.*`, an Arduino Uno with a part titled Gizmo on D5 that nobody knows. A reader of several forms has
both of each form, told apart by their endings, or by folders of its own where forms have one ending. What a reader has to do
is in docs/how-to/add-a-drawing-reader.md.
"""

from __future__ import annotations

import hashlib
import json
import random
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

from robosmi.diagnostics import Severity
from robosmi.errors import SourceError, UsageError
from robosmi.metamodels import hardware as hw
from robosmi.model import load_model, save_model
from robosmi.plugins import content, registry
from robosmi.project import Project
from robosmi.transformations.chains.hardware import hardware
from robosmi.transformations.chains.migrate import plan_migration
from robosmi.transformations.chains.stages import readers
from robosmi.transformations.chains.stages.readers import DRAWING, HEAD, RECOGNISER, is_drawing, reader_for

HERE = Path(__file__).resolve().parent
READERS = registry().names(DRAWING)
FORMS = [
    pytest.param(reader, path, id=f"{reader}-{path.relative_to(HERE / reader)}")
    for reader in READERS
    for path in sorted((HERE / reader).rglob("robot.*"))
]
"""Reader and robot of each form that it reads."""
PROGRAM = HERE.parents[3] / "docs" / "examples" / "line_follower" / "line_follower.c"
ROBOT: dict[str, list[Any]] = json.loads((HERE / "robot.json").read_text(encoding="utf-8"))


def unknown(robot: Path) -> Path:
    """The drawing with the unknown part that lies beside a robot: of the same ending, or the only one."""
    found = sorted(robot.parent.glob("unknown.*"))
    same = [path for path in found if path.suffix == robot.suffix] or found
    assert len(same) == 1, f"{robot.parent} needs one file unknown{robot.suffix}"
    return same[0]


def pins(path: Path) -> dict[str, list[Any]]:
    """The components on each pin: component, name of its connector, role, signal, parts in between."""
    return {
        m["pin"]: [m["component"], _named(m["connectors"][0]["name"]), m["role"], m["signal"], [v["title"] for v in m["via"]]]
        for m in hardware(path).result["mappings"]
    }


def _named(connector: str) -> list[str]:
    """The names of a connector in the robots of all tools: each tool has its own."""
    return next((told[1] for told in ROBOT.values() if connector in told[1]), [connector])


def test_there_are_readers() -> None:
    assert {"fritzing", "pin_table"} <= {*READERS}
    assert [reader for reader in READERS if not any(form.values[0] == reader for form in FORMS)] == []


@pytest.mark.parametrize(("reader", "robot"), FORMS)
def test_the_robot_has_the_same_pins_in_every_tool(reader: str, robot: Path) -> None:
    assert pins(robot) == ROBOT


@pytest.mark.parametrize(("reader", "robot"), FORMS)
@pytest.mark.parametrize("name", ["robot", "unknown"])
def test_a_program_can_be_moved_to_the_board_of_a_drawing(reader: str, robot: Path, name: str) -> None:
    """The tool's Arduino Uno is the repository's: its `drawn_as` tables say so."""
    plan = plan_migration([PROGRAM], project=Project(), hardware=robot if name == "robot" else unknown(robot)).plan
    assert plan.board is not None
    assert plan.board.name == "uno"
    assert plan.boardComponent is not None
    assert all(c.pin is not None for c in plan.connections)


@pytest.mark.parametrize(("reader", "robot"), FORMS)
def test_the_circuit_says_where_it_comes_from_and_every_element_is_told_apart(reader: str, robot: Path) -> None:
    path = robot
    circuit, findings = content(DRAWING, reader)(path)
    assert [f for f in findings if f.severity is Severity.error] == []
    assert circuit.name == path.stem
    assert circuit.path == str(path)
    assert circuit.tool.lower().replace(" ", "_") == reader
    assert circuit.digest == hashlib.sha256(path.read_bytes()).hexdigest()
    identities = Counter(c.elementId for c in circuit.components)
    assert max(identities.values()) == 1
    assert "" not in identities
    assert all(c.roleEvidence for c in circuit.components)
    assert max(Counter(net.name for net in circuit.nets).values()) == 1
    for component in circuit.components:
        ids = [connector.connectorId for connector in component.connectors]
        assert len(ids) == len(set(ids)), component.title
        if component.role is not hw.Role.Board:
            assert [c.pin for c in component.connectors if c.pin] == []


@pytest.mark.parametrize(("reader", "robot"), FORMS)
def test_a_connector_is_in_one_net_and_every_net_has_connectors_of_this_circuit(reader: str, robot: Path) -> None:
    circuit, _ = content(DRAWING, reader)(robot)
    own = {id(connector) for component in circuit.components for connector in component.connectors}
    joined = [connector for net in circuit.nets for connector in net.connectors]
    assert all(len(net.connectors) for net in circuit.nets)
    assert {id(connector) for connector in joined} <= own
    assert max(Counter(id(connector) for connector in joined).values()) == 1
    assert all(net.railEvidence for net in circuit.nets if net.rail)


@pytest.mark.parametrize(("reader", "robot"), FORMS)
def test_the_same_drawing_gives_the_same_model_and_it_is_stored_whole(reader: str, robot: Path, tmp_path: Path) -> None:
    for name in ("a.xmi", "b.xmi"):
        save_model(content(DRAWING, reader)(robot)[0], tmp_path / name)
    assert (tmp_path / "a.xmi").read_bytes() == (tmp_path / "b.xmi").read_bytes()
    again = load_model(tmp_path / "a.xmi")
    assert isinstance(again, hw.Circuit)
    save_model(again, tmp_path / "c.xmi")
    assert (tmp_path / "c.xmi").read_bytes() == (tmp_path / "a.xmi").read_bytes()


@pytest.mark.parametrize(("reader", "robot"), FORMS)
def test_a_part_that_nobody_knows_is_there_and_said(reader: str, robot: Path) -> None:
    path = unknown(robot)
    circuit, findings = content(DRAWING, reader)(path)
    gizmo = next(c for c in circuit.components if c.title == "Gizmo")
    assert gizmo.role is hw.Role.Unknown
    told = [f for f in findings if f.rule == "RS203" and "Gizmo" in f.message]
    assert [(f.severity, f.location is not None and f.location.path == str(path), bool(f.fix)) for f in told] == [
        (Severity.warning, True, True)
    ]
    assert pins(path)["D5"][0] == "Gizmo"


@pytest.mark.parametrize(("reader", "robot"), FORMS)
def test_a_role_that_a_person_gives_goes_before_all_else(reader: str, robot: Path) -> None:
    path, read = unknown(robot), content(DRAWING, reader)
    circuit, findings = read(path, roles={"Gizmo": "Output"})
    gizmo = next(c for c in circuit.components if c.title == "Gizmo")
    assert (gizmo.role, gizmo.roleEvidence) == (hw.Role.Output, "given by the user")
    assert not [f for f in findings if f.rule == "RS203" and "Gizmo" in f.message and f.severity is Severity.warning]
    by_identity, _ = read(path, roles={f"#{gizmo.elementId}": "Both"})
    assert next(c for c in by_identity.components if c.title == "Gizmo").role is hw.Role.Both
    for roles in ({"Gizmo": "Gadget"}, {"Gismo": "Output"}):
        with pytest.raises(UsageError, match=r"did you mean|no role|unknown role"):
            read(path, roles=roles)


@pytest.mark.parametrize(("reader", "robot"), FORMS)
@pytest.mark.parametrize("damage", ["missing", "folder", "empty", "blank", "zeros", "prose"])
def test_what_is_no_drawing_is_refused_with_place_cause_and_advice(reader: str, robot: Path, damage: str, tmp_path: Path) -> None:
    path = tmp_path / robot.name
    contents = {"empty": b"", "blank": b" \n\n", "zeros": bytes(2000), "prose": b"Dear reader, this is a letter.\n" * 20}
    if damage == "folder":
        path.mkdir()
    elif damage in contents:
        path.write_bytes(contents[damage])
    with pytest.raises(SourceError) as refused:
        content(DRAWING, reader)(path)
    assert refused.value.location is not None
    assert refused.value.location.path == str(path)
    assert refused.value.message
    assert refused.value.fix


@pytest.mark.parametrize(("reader", "robot"), FORMS)
def test_a_damaged_drawing_is_refused_or_never_gives_a_wrong_pin(reader: str, robot: Path, tmp_path: Path) -> None:
    """Cut off at forty places: refused with its place, or read with what is left, whose pins are the robot's."""
    source = robot
    data, path = source.read_bytes(), tmp_path / source.name
    whole = {(pin, told[0]) for pin, told in ROBOT.items()}
    refused = []
    for length in sorted(random.Random(21).sample(range(1, len(data) - 1), 40)):
        path.write_bytes(data[:length])
        try:
            found = pins(path)
        except SourceError as error:
            refused.append(error.location.path if error.location is not None else "no place")
            continue
        last = data[:length].rsplit(b"\n", 1)[-1]  # a row of a table may be cut within a name; what it still says is taken
        wrong = {(pin, told[0]) for pin, told in found.items()} - whole
        assert all(pin.encode() in last and title.encode() in last for pin, title in wrong)
    assert {*refused} == {str(path)}


@pytest.mark.parametrize(("reader", "robot"), FORMS)
def test_a_drawing_is_recognised_by_what_it_begins_with_and_by_no_other_reader(reader: str, robot: Path, tmp_path: Path) -> None:
    for path in (robot, unknown(robot)):
        head = path.read_bytes()[:HEAD]
        assert [other for other in registry().names(RECOGNISER) if content(RECOGNISER, other)(head)] == [reader]
        renamed = tmp_path / f"{path.name}.drawing"
        renamed.write_bytes(path.read_bytes())
        assert is_drawing(renamed)
        assert reader_for(renamed, DRAWING) is content(DRAWING, reader)
    assert not any(
        content(RECOGNISER, reader)(head) for head in (b"", b"\0" * 100, b"<xml/>", b"{}", b"PK\x03\x04rest", b"a,b\n1,2")
    )


def test_an_ending_of_several_readers_is_decided_by_content(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(readers, "defaults", lambda: {"readers": {".sch": ["fritzing", "pin_table"]}})
    for reader in ("fritzing", "pin_table"):
        path = tmp_path / reader / "robot.sch"
        path.parent.mkdir()
        path.write_bytes(next((HERE / reader).glob("robot.*")).read_bytes())
        assert reader_for(path, DRAWING) is content(DRAWING, reader)
    neither = tmp_path / "neither.sch"
    neither.write_text("EESchema Schematic File Version 4\n")
    with pytest.raises(SourceError):  # the first of the readers says what is wrong with it
        reader_for(neither, DRAWING)(neither)
    with pytest.raises(SourceError, match=r"no drawing reader for '\.pcb' files"):
        reader_for(tmp_path / "x.pcb", DRAWING)
