"""Algorithm 1: the two case drawings give what the labels say in every field, and each decision has a small drawing."""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from robosmi.diagnostics import Finding
from robosmi.errors import SourceError, UsageError
from robosmi.metamodels import migration
from robosmi.transformations.knowledge.board_models import load_board, load_mapping
from robosmi.transformations.m2m.circuits.connector_mapping import algorithm_1_as_printed, identifier, map_connectors
from robosmi.transformations.queries.circuits.circuit import boards, component_named, hardware_report, port_interfaces, the_board
from robosmi.transformations.t2m.fritzing import read_circuit
from robosmi.transformations.t2m.pin_table import read_circuit as read_table
from tests.evaluation.scoring.sketches import LEVELS, SketchScore, labelled_sketches
from tests.evaluation.sources import sketch_file
from tests.growing import DRAWINGS, drawing
from tests.new_objects import only_new_objects
from tests.transformations.t2m.fritzing.support import CASES, FIXTURES, LABELS, zipped

UNO = load_mapping("arduino", load_board("uno"))


def report(path: Path) -> tuple[dict[str, Any], list[Finding]]:
    circuit, found = read_circuit(path)
    uno = {board.elementId: load_board("uno") for board in boards(circuit)}
    connections, odd = map_connectors(circuit, uno)
    return hardware_report(circuit, connections), found + odd


def mapped(name: str) -> tuple[list[tuple[str, str, list[str]]], list[str]]:
    """Pin, name and connectors of each mapping of a fixture, and the rules of the mapping's findings."""
    circuit, _ = read_circuit(FIXTURES / f"{name}.fz")
    connections, findings = map_connectors(circuit)
    mappings = hardware_report(circuit, connections)["mappings"]
    return [(m["pin"], m["name"], [c["name"] for c in m["connectors"]]) for m in mappings], [f.rule for f in findings]


@pytest.mark.parametrize("case", CASES)
def test_the_cases_equal_their_labels_in_every_field(case: str) -> None:
    label = json.loads((LABELS / f"{case}.expected.json").read_text())
    result, findings = report(CASES[case])
    assert findings == []
    assert result["boards"] == [{k: b[k] for k in ("title", "model_index", "module_id")} for b in label["boards"]]
    by_index = {c["model_index"]: c for c in result["components"]}
    assert len(result["mappings"]) == len(label["mappings"])
    for got, want in zip(result["mappings"], label["mappings"], strict=True):
        same = (
            "board",
            "board_model_index",
            "pin",
            "board_connectors",
            "component",
            "component_model_index",
            "connectors",
            "signal",
            "via",
        )
        assert {k: got[k] for k in same} == {k: want[k] for k in same}
        assert (got["role"], got["driver"], got["drives"], got["senses"]) == (
            want["type"],
            want["role"] in ("driver", "ic"),
            [],
            [],
        )
        assert got["name"] == want["paper_name"].replace("-", "")
        part = by_index[got["component_model_index"]]
        assert (part["module_id"], part["part_title"]) == (want["module_id"], want["part_title"])


@pytest.mark.parametrize("case", CASES)
def test_port_interfaces_are_the_paper_s_map(case: str) -> None:
    label = json.loads((LABELS / f"{case}.expected.json").read_text())
    circuit, _ = read_circuit(CASES[case])
    connections, _ = map_connectors(circuit, {the_board(circuit).elementId: load_board("uno")})
    wanted = {name.replace("-", ""): str(pin) for name, pin in label["paper_map"].items()}
    assert port_interfaces(connections, UNO) == wanted
    assert list(port_interfaces(connections, UNO)) == sorted(wanted, key=lambda name: (int(wanted[name]), name))


def test_line_follower_as_the_paper_prints_it() -> None:
    circuit, _ = read_circuit(CASES["line_following_robot"])
    assert port_interfaces(map_connectors(circuit)[0], UNO) == {
        "BasicServo2WriteP1": "8",
        "BasicServo1WriteP1": "9",
        "HIH40302ReadP1": "10",
        "HIH40301ReadP1": "11",
        "Red633nmLED1WriteP1": "12",
    }


@pytest.mark.parametrize(("case", "right", "wrong"), [("line_following_robot", 5, 20), ("environmental_monitoring_robot", 9, 47)])
def test_the_printed_algorithm_finds_all_and_reports_too_much(case: str, right: int, wrong: int) -> None:
    label = json.loads((LABELS / f"{case}.expected.json").read_text())
    wanted = {(m["pin"], m["component_model_index"]) for m in label["mappings"]}
    circuit, _ = read_circuit(CASES[case])
    printed = algorithm_1_as_printed(the_board(circuit))
    found = {(c.pin, d.component.elementId) for c, d in printed if c.pin and d.component is not None}
    assert (len(found & wanted), len(found - wanted)) == (right, wrong)
    assert any(not c.pin for c, _ in printed)  # supply pins too


def test_the_score_of_the_labelled_sketches(record_property: Callable[[str, object], None]) -> None:
    score = SketchScore()
    for label in labelled_sketches():
        if (path := sketch_file(label)) is not None:
            score.add(label, report(path)[0]["mappings"])
    if not score.sketches:
        pytest.skip("the labelled sketches are not there: make corpus")
    record_property("sketches", score)
    assert (score.precision, score.recall, score.wrong) == (1.0, 1.0, {})
    assert score.levels == dict.fromkeys(LEVELS, score.mappings)


def test_a_sketch_of_five_hundred_components_maps_in_half_a_second(tmp_path: Path) -> None:
    path = tmp_path / "large.fz"
    path.write_text(large_sketch(500))
    circuit, _ = read_circuit(path)
    assert len(circuit.components) == 501
    with only_new_objects():  # what other tests have made would be looked at by each collection of garbage
        started = time.process_time()
        connections, findings = map_connectors(circuit)
        assert time.process_time() - started < 0.5
    assert (len(connections), findings) == (250, [])


def large_sketch(components: int) -> str:
    """An Uno with lamps and their resistors, as many on each pin as it takes."""
    pins = [f"connector{number}" for number in (51, 52, 53, 54, 55, 63, 64, 65, 66, 67, 68)]
    uno: dict[str, list[tuple[int, str]]] = {}
    text = ""
    for number in range(components // 2):
        resistor, lamp = 2 * number + 2, 2 * number + 3
        pin = pins[number % len(pins)]
        uno.setdefault(pin, []).append((resistor, "connector0"))
        uno.setdefault("connector88", []).append((lamp, "connector0"))
        text += _instance(
            "ResistorModuleID", resistor, f"R{number}", {"connector0": [(1, pin)], "connector1": [(lamp, "connector1")]}
        )
        ends = {"connector1": [(resistor, "connector1")], "connector0": [(1, "connector88")]}
        text += _instance("5mmColorLEDModuleID", lamp, f"LED{number}", ends)
    text += _instance("arduino_Uno_Rev3(fix)", 1, "Uno", uno)
    return f'<module fritzingVersion="0.9.6"><instances>{text}</instances></module>'


def _instance(module: str, index: int, title: str, ends: dict[str, list[tuple[int, str]]]) -> str:
    connectors = "".join(
        f'<connector connectorId="{own}"><connects>'
        + "".join(f'<connect connectorId="{theirs}" modelIndex="{other}"/>' for other, theirs in to)
        + "</connects></connector>"
        for own, to in ends.items()
    )
    view = f"<breadboardView><connectors>{connectors}</connectors></breadboardView>"
    return f'<instance moduleIdRef="{module}" modelIndex="{index}"><title>{title}</title><views>{view}</views></instance>'


@pytest.mark.parametrize(
    ("pin", "module", "signal", "role"),
    [
        ("connector0", "8abf6496b5d466c7a1893c17a296a676", "read", "Input"),  # a piezo on A0
        ("connector51", "8abf6496b5d466c7a1893c17a296a676", "write", "Output"),  # and on D8
        ("connector0", "5mmColorLEDModuleID", "write", "Output"),  # a lamp is one everywhere
    ],
)
def test_a_part_that_can_be_either_is_what_its_pin_makes_it(
    pin: str, module: str, signal: str, role: str, tmp_path: Path
) -> None:
    own = "connector1"
    path = tmp_path / "either.fz"
    path.write_text(
        '<module fritzingVersion="0.9.6"><instances>'
        + _instance("arduino_Uno_Rev3(fix)", 1, "Uno", {pin: [(2, own)]})
        + _instance(module, 2, "Thing", {own: [(1, pin)]})
        + "</instances></module>"
    )
    (mapping,) = report(path)[0]["mappings"]
    assert (mapping["signal"], mapping["role"]) == (signal, role)
    assert mapping["name"] == f"Thing{signal.title()}P1"


@pytest.mark.parametrize(
    ("board", "pin", "part", "signal"),
    [
        ("uno", "A0", "Piezo", "read"),  # a knock sensor
        ("leonardo", "D4", "Piezo", "write"),  # which is A6, too, and not used as that
        ("leonardo", "D4", "Piezo Speaker", "write"),
        ("uno", "A0", "Piezo Buzzer", "write"),
    ],
)
def test_a_piezo_is_read_on_a_pin_labelled_analog_unless_it_is_a_buzzer(
    board: str, pin: str, part: str, signal: str, tmp_path: Path
) -> None:
    path = tmp_path / "table.csv"
    path.write_text(f"pin,part,title,board\n{pin},{part},thing,{board}\n")
    circuit, _ = read_table(path)
    connections, _ = map_connectors(circuit, {the_board(circuit).elementId: load_board(board)})
    assert [connection.signal.name for connection in connections] == [signal]


@pytest.mark.parametrize(
    ("load", "signal", "role"),
    [("2010BBCD20113PhotocellModuleID", "read", "Input"), ("1000FADF10011leg", "write", "Output")],
    ids=["a photocell", "a motor"],
)
def test_an_amplifier_is_told_by_what_is_behind_it(load: str, signal: str, role: str, tmp_path: Path) -> None:
    amplifier = "a59353bd0db0225dc22770e292c622f3"
    path = tmp_path / "amplifier.fz"
    path.write_text(
        '<module fritzingVersion="0.9.6"><instances>'
        + _instance("arduino_Uno_Rev3(fix)", 1, "Uno", {"connector0": [(2, "connector0")]})
        + _instance(amplifier, 2, "Amp", {"connector0": [(1, "connector0")], "connector2": [(3, "connector0")]})
        + _instance(load, 3, "Behind", {"connector0": [(2, "connector2")]})
        + "</instances></module>"
    )
    (mapping,) = report(path)[0]["mappings"]
    assert (mapping["driver"], mapping["signal"], mapping["role"]) == (True, signal, role)


def test_a_passive_part_leads_on_but_not_into_a_rail() -> None:
    assert mapped("two_passives") == ([("D2", "LampWriteP1", ["anode"])], [])
    circuit, _ = read_circuit(FIXTURES / "two_passives.fz")
    assert [c.title for c in map_connectors(circuit)[0][0].via] == ["R1", "R2"]


def test_a_passive_part_does_not_lead_to_another_pin_of_the_board() -> None:
    assert mapped("blocked_passive")[0] == [("D2", "OneWriteP1", ["anode"]), ("D4", "TwoWriteP1", ["anode"])]


def test_a_supply_that_is_not_drawn_ends_a_path() -> None:
    assert [pin for pin, _, _ in mapped("hidden_rail")[0]] == ["D9", "D10"]
    assert mapped("single_vcc")[0] == [("D9", "AWriteP1", ["vcc"])]


def test_several_boards_each_have_their_mappings() -> None:
    circuit, _ = read_circuit(FIXTURES / "two_boards.fz")
    connections, findings = map_connectors(circuit)
    assert [(m["board"], m["pin"], m["name"]) for m in hardware_report(circuit, connections)["mappings"]] == [
        ("Uno", "D2", "ArmWriteP1"),
        ("Duo", "D4", "ArmWriteP2"),
    ]
    assert {f.rule for f in findings} == {"RS221", "RS226"}


@pytest.mark.parametrize(
    ("count", "said"),
    [
        (1, "{pin} of the board 'Board0'"),
        (2, "{pin} of the board 'Board0' and {pin} of the board 'Board1'"),
        (30, "{pin} of the board 'Board0', {pin} of the board 'Board1', {pin} of the board 'Board2' and more"),
    ],
)
def test_a_wire_among_boards_is_one_finding_of_each_pin(count: int, said: str, tmp_path: Path) -> None:
    circuit, _ = read_circuit(drawing(tmp_path, DRAWINGS["boards"][0](count)))
    found = [f.message for f in map_connectors(circuit)[1] if f.rule == "RS226" and "of 'Uno'" in f.message]
    assert found == [f"{pin} of 'Uno' is wired to {said.format(pin='A0')}" for pin in ("A0", "A5")]


def test_names_are_identifiers_and_unique() -> None:
    mappings, rules = mapped("titles")
    names = [name for _, name, _ in mappings]
    assert names == ["L1WriteP1", "L1_3WriteP1", "RedLED5mmWriteP1", "_2farWriteP1", "IkWriteP1", "RedLED5mm_7WriteP1"]
    assert all(name.isidentifier() and name.isascii() for name in names)
    assert rules == ["RS227", "RS227"]


def test_connectors_are_counted_in_their_order() -> None:
    mappings, rules = mapped("odd_pins")
    assert mappings == [("D2", "BuzzWriteP1", ["pin1"]), ("D3", "BuzzWriteP2", ["pin2"]), ("D11", "ArmWriteP1", ["pulse"])]
    assert sorted(rules) == ["RS221", "RS224"]


def test_unknown_parts_end_a_path_and_are_told() -> None:
    mappings, rules = mapped("unknown_part")
    assert [(pin, name) for pin, name, _ in mappings] == [("D5", "GizmoReadP1"), ("D6", "ChipBusP1"), ("D7", "ChipReadP2")]
    assert rules == ["RS220"] * 3


def test_what_a_driver_drives_is_told_and_has_no_mapping(tmp_path: Path) -> None:
    result, _ = report(zipped(tmp_path, "embedded", ("my_board", "my_button", "my_driver", "my_motor")))
    assert [(m["pin"], m["name"], m["driver"], [d["title"] for d in m["drives"]]) for m in result["mappings"]] == [
        ("D2", "KeyReadP1", False, []),
        ("D3", "BridgeWriteP1", True, ["Wheel"]),
        ("D9", "ArmWriteP1", False, []),
    ]


def test_a_pin_that_the_target_has_not() -> None:
    circuit, _ = read_circuit(FIXTURES / "one_sided.fz")
    uno = load_board("uno")
    uno.pins.remove(next(pin for pin in uno.pins if pin.label == "D9"))
    connections, findings = map_connectors(circuit, {"1": uno})
    assert [f.rule for f in findings] == ["RS223"]
    assert connections[0].pin is None
    assert port_interfaces(connections, UNO) == {"ArmWriteP1": "9"}


def test_connections_refer_to_the_board_s_pins() -> None:
    circuit, _ = read_circuit(CASES["line_following_robot"])
    uno = load_board("uno")
    connections, _ = map_connectors(circuit, {"1000": uno})
    assert [c.pin.label for c in connections if c.pin is not None] == ["D8", "D9", "D10", "D11", "D12"]
    assert all(c.pin in list(uno.pins) for c in connections)
    assert connections[0].signal is migration.Signal.write


def test_the_board_is_one() -> None:
    assert the_board(read_circuit(FIXTURES / "one_sided.fz")[0]).title == "Uno"
    with pytest.raises(SourceError, match="no board") as none:
        the_board(read_circuit(FIXTURES / "no_board.fz")[0])
    with pytest.raises(SourceError, match=r"2 boards: 'Uno' \(#1\), 'Duo' \(#2\)") as two:
        the_board(read_circuit(FIXTURES / "two_boards.fz")[0])
    for caught in (none, two):
        assert caught.value.location is not None
        assert caught.value.fix


def test_components_by_name() -> None:
    circuit, _ = read_circuit(CASES["line_following_robot"])
    assert component_named(circuit, "Basic Servo1").elementId == "1014"
    assert component_named(circuit, "#1014").title == "Basic Servo1"
    with pytest.raises(UsageError, match=r"no component is called 'Basic Servo' \(did you mean 'Basic Servo"):
        component_named(circuit, "Basic Servo")
    with pytest.raises(UsageError, match="no component is called '#7'"):
        component_named(circuit, "#7")
    circuit.components[2].title = "Basic Servo2"
    with pytest.raises(UsageError, match="2 components are called 'Basic Servo2'") as caught:
        component_named(circuit, "Basic Servo2")
    assert caught.value.fix == "use one of: #1014 (Basic Servo), #1021 (Basic Servo)"


@pytest.mark.parametrize(
    ("title", "wanted"),
    [("Red (633nm)-LED1", "Red633nmLED1"), ("HIH4030 1", "HIH40301"), ("7 Seg", "_7Seg"), ("灯", ""), ("a_b", "a_b")],
)
def test_identifiers(title: str, wanted: str) -> None:
    assert identifier(title) == wanted


def test_a_wire_by_which_a_driven_part_tells_something_is_read(tmp_path: Path) -> None:
    """A pin that drives the feedback of a servo destroys it."""
    table = tmp_path / "servo.csv"
    table.write_text("pin,part,title,connector\nD9,Feedback 360 Servo,wheel,pulse\nD2,Feedback 360 Servo,wheel,feedback\n")
    circuit, _ = read_table(table)
    made, _ = map_connectors(circuit)
    assert {c.connectors[0].name: (c.signal.name, c.name) for c in made} == {
        "pulse": ("write", "wheelWriteP1"),
        "feedback": ("read", "wheelReadP2"),
    }
