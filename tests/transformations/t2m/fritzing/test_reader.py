"""Fritzing sketches as circuits: the two case drawings, and one small sketch for each oddity of the format."""

from __future__ import annotations

from pathlib import Path

import networkx as nx
import pytest

from robosmi.diagnostics import Finding
from robosmi.errors import UsageError
from robosmi.metamodels import hardware
from robosmi.transformations.chains.hardware import hardware as hardware_of
from robosmi.transformations.queries.circuits.circuit import circuit_graph
from robosmi.transformations.t2m.fritzing import read_circuit
from robosmi.transformations.t2m.fritzing.container import parse_sketch, read_container
from tests.evaluation.scoring.sketches import labelled_sketches
from tests.evaluation.sources import sketch_file
from tests.transformations.t2m.fritzing.support import CASES, FIXTURES, zipped


def read(name: str) -> tuple[hardware.Circuit, list[Finding]]:
    return read_circuit(FIXTURES / f"{name}.fz")


def component(circuit: hardware.Circuit, title: str) -> hardware.Component:
    return next(c for c in circuit.components if c.title == title)


def net_of(circuit: hardware.Circuit, title: str, connector: str) -> hardware.Net | None:
    return next(c.net for c in component(circuit, title).connectors if c.connectorId == connector)


def rules_of(findings: list[Finding]) -> list[str]:
    return [finding.rule for finding in findings]


@pytest.mark.parametrize("part", ["rpi_pico-tht_1", "Raspberry Pico_c69b8a06ab5c49d608ef9deba0877325_2"])
def test_the_pico_is_known_with_its_pins_and_its_grounds(part: str, tmp_path: Path) -> None:
    """Its connectors are called by numbers; the resistor to ground leads to no other lamp."""
    sketch = tmp_path / "pico.fz"
    sketch.write_text((FIXTURES / "pico.fz").read_text().replace("rpi_pico-tht_1", part))
    result = hardware_of(sketch).result
    assert component(read_circuit(sketch)[0], "Pico").boardName == "pico"
    assert [(m["pin"], m["component"]) for m in result["mappings"]] == [("GP0", "LED1"), ("GP14", "LED2")]
    ground = net_of(read_circuit(sketch)[0], "Pico", "connector2")
    assert ground is not None
    assert (ground.rail, ground.voltage) == (True, "GND")
    assert "RS257" not in rules_of(read_circuit(sketch)[1])


def test_the_nano_rp2040_is_known_with_its_pins(tmp_path: Path) -> None:
    """Of Fritzing's own part: connector0 is TX, and D14 to D19 are what the board calls A0 to A5."""
    sketch = tmp_path / "nano.fz"
    sketch.write_text((FIXTURES / "pico.fz").read_text().replace("rpi_pico-tht_1", "02_Arduino-nano-rp2040-tht_1"))
    circuit = read_circuit(sketch)[0]
    assert component(circuit, "Pico").boardName == "nano-rp2040"
    found = [(m["pin"], m["component"]) for m in hardware_of(sketch).result["mappings"]]
    assert found == [("D1", "LED1"), ("A0", "LED2"), ("A4", "LED2")]


@pytest.mark.parametrize("case", CASES)
def test_case_drawings_read_without_a_finding(case: str) -> None:
    circuit, findings = read_circuit(CASES[case])
    assert findings == []
    assert (circuit.name, circuit.tool, circuit.toolVersion, circuit.view) == (case, "Fritzing", "0.9.6b", "breadboardView")
    assert len(circuit.digest) == 64
    assert not [c.title for c in circuit.components if c.role is hardware.Role.Unknown or not c.roleEvidence]


@pytest.mark.parametrize(
    ("number", "role", "drives"),
    [
        ("3144", "Unknown", False),
        ("US1881", "Unknown", False),
        ("A3144", "Input", False),
        ("TSOP4838", "Input", False),
        ("BC639", "Output", True),
        ("2N2222A", "Output", True),
        ("IRLZ44N", "Output", True),
        ("S8050", "Output", True),
        ("", "Output", True),
    ],
)
def test_a_part_number_that_a_person_typed_says_what_the_part_is(number: str, role: str, drives: bool, tmp_path: Path) -> None:
    text = (FIXTURES / "typed_number.fz").read_text(encoding="utf-8").replace('value="3144"', f'value="{number}"')
    (tmp_path / "a.fz").write_text(text, encoding="utf-8")
    circuit, findings = read_circuit(tmp_path / "a.fz")
    part = component(circuit, "Q1")
    assert (part.role.name, part.driver) == (role, drives)
    assert ("RS203" in rules_of(findings)) == (role == "Unknown")
    assert number in part.partTitle or role == "Output"


def test_line_follower_in_full() -> None:
    circuit, _ = read_circuit(CASES["line_following_robot"])
    roles = {c.title: c.role.name for c in circuit.components}
    assert roles == {
        "Arduino Uno": "Board",
        "Breadboard1": "Passive",
        "Basic Servo1": "Output",
        "Basic Servo2": "Output",
        "HIH4030 1": "Input",
        "HIH4030 2": "Input",
        "VCC1": "Power",
        "R1": "Passive",
        "Red (633nm)-LED1": "Output",
    }
    rails = {net.voltage: net for net in circuit.nets if net.rail}
    assert set(rails) == {"5V", "GND", "9V"}
    assert rails["9V"].railEvidence == "VIN of Arduino Uno, + of VCC1"
    assert rails["5V"].name == "1000.connector40"
    board = component(circuit, "Arduino Uno")
    assert len(board.connectors) == 44
    assert {c.connectorId: c.pin for c in board.connectors if c.pin}["connector52"] == "D9"
    led = component(circuit, "Red (633nm)-LED1")
    assert {p.name: p.value for p in led.properties} == {
        "color": "Red (633nm)",
        "current": "0.030A",
        "leg": "yes",
        "package": "5 mm [THT]",
    }
    assert len(circuit.wires) == 24
    assert all(wire.net is not None and len(wire.ends) == 2 for wire in circuit.wires)


@pytest.mark.parametrize("case", CASES)
def test_breadboards_have_only_the_connectors_that_are_used(case: str) -> None:
    circuit, _ = read_circuit(CASES[case])
    breadboard = component(circuit, "Breadboard1")
    assert 0 < len(breadboard.connectors) < 100
    assert all(connector.net is not None for connector in breadboard.connectors)
    assert all(len({c.net for c in bus.connectors}) == 1 for bus in breadboard.buses)


@pytest.mark.parametrize("path", [*CASES.values(), *sorted(FIXTURES.glob("*.fz"))], ids=lambda p: p.stem)
def test_nets_are_disjoint_and_have_names_of_their_own(path: Path) -> None:
    circuit, _ = read_circuit(path)
    graph = circuit_graph(circuit)
    assert {frozenset([net, *net.connectors]) for net in circuit.nets} == {frozenset(s) for s in nx.connected_components(graph)}
    assert len({net.name for net in circuit.nets}) == len(circuit.nets)
    assert len({c.elementId for c in circuit.components}) == len(circuit.components)


def test_the_graph_with_parts_has_all_components_and_connectors() -> None:
    circuit, _ = read_circuit(CASES["line_following_robot"])
    graph = circuit_graph(circuit, parts=True)
    assert {n for n in graph if isinstance(n, hardware.Component)} == set(circuit.components)
    assert {n for n in graph if isinstance(n, hardware.Connector)} == {k for c in circuit.components for k in c.connectors}
    assert all(k in graph[c] for c in circuit.components for k in c.connectors)


@pytest.mark.parametrize("path", [*CASES.values(), *sorted(FIXTURES.glob("*.fz"))], ids=lambda p: p.stem)
def test_reading_twice_gives_the_same(path: Path) -> None:
    def place(connector: hardware.Connector) -> tuple[str, str]:
        return connector.component.elementId if connector.component else "", connector.connectorId

    def shape(circuit: hardware.Circuit) -> list[object]:
        return [
            [(c.elementId, c.role.name, [k.connectorId for k in c.connectors]) for c in circuit.components],
            [(n.name, n.rail, n.railEvidence, [place(k) for k in n.connectors]) for n in circuit.nets],
            [(w.elementId, [place(k) for k in w.ends]) for w in circuit.wires],
        ]

    (one, first), (two, second) = read_circuit(path), read_circuit(path)
    assert shape(one) == shape(two)
    assert [f.id for f in first] == [f.id for f in second]


@pytest.mark.parametrize("path", [*CASES.values(), *sorted(FIXTURES.glob("*.fz"))], ids=lambda p: p.stem)
def test_nets_are_those_that_a_graph_library_finds(path: Path) -> None:
    """Nets anew from the text of the sketch: all connectors and wires as nodes, connections and buses as edges."""
    circuit, _ = read_circuit(path)
    container = read_container(path)
    graph: nx.Graph[tuple[str, str]] = nx.Graph()
    known = {c.elementId: c for c in circuit.components}
    conducting = {wire.elementId for wire in circuit.wires}
    for instance in parse_sketch(container.sketch, str(path), path.name).instances:
        for own, index, theirs in instance.view(circuit.view).edges:
            ends = ((instance.index, own), (index, theirs))
            if all(i in known or i in conducting for i, _ in ends):
                graph.add_edge(*((i, "" if i in conducting else c) for i, c in ends))
    for component in circuit.components:
        for bus in component.buses:
            nx.add_path(graph, [(component.elementId, c.connectorId) for c in bus.connectors])
    nets = {frozenset((k.component.elementId, k.connectorId) for k in net.connectors if k.component) for net in circuit.nets}
    drawn = {frozenset(n for n in nodes if n[0] not in conducting) for nodes in nx.connected_components(graph)}
    assert nets <= drawn or path.stem in ("net_labels", "stripboard", "dangling")  # joined by more than connections


def test_a_plain_fz_and_its_fzz_give_the_same(tmp_path: Path) -> None:
    plain, _ = read("one_sided")
    archived, findings = read_circuit(zipped(tmp_path, "one_sided"))
    assert findings == []
    assert [n.name for n in plain.nets] == [n.name for n in archived.nets]


def test_a_connection_told_by_one_end_only_counts() -> None:
    circuit, findings = read("one_sided")
    assert findings == []
    assert net_of(circuit, "Arm", "connector2") is net_of(circuit, "Uno", "connector52")


def test_the_schematic_is_read_when_the_breadboard_view_is_empty() -> None:
    circuit, findings = read("schematic_only")
    assert circuit.view == "schematicView"
    assert rules_of(findings) == ["RS201"]
    assert net_of(circuit, "Arm", "connector2") is net_of(circuit, "Uno", "connector52")


def test_views_that_disagree_are_a_finding_and_the_breadboard_view_counts() -> None:
    circuit, findings = read("views_disagree")
    assert rules_of(findings) == ["RS202"]
    assert findings[0].evidence["connectors"] == ["1.connector52", "1.connector53", "2.connector2"]
    assert net_of(circuit, "Arm", "connector2") is net_of(circuit, "Uno", "connector52")


def test_derived_wires_and_instances_without_a_view_are_left_out_and_counted() -> None:
    circuit, findings = read("derived_wires")
    assert rules_of(findings) == ["RS205"]
    assert findings[0].message == "left out: 2 parts without a view, 1 derived wire"
    assert findings[0].evidence == {"without_views": 2, "derived_wires": 1, "foreign_wires": 0}
    assert [w.elementId for w in circuit.wires] == ["100"]
    assert net_of(circuit, "Arm", "connector2") is not net_of(circuit, "Uno", "connector66")


def test_traces_of_the_schematic_and_of_the_pcb_are_no_wires_on_the_breadboard() -> None:
    """Old versions write every wire into every view; the trace of another view is not shown there and joins nothing."""
    circuit, findings = read("traces_of_other_views")
    assert [w.elementId for w in circuit.wires] == ["100"]
    assert net_of(circuit, "Arm", "connector2") is net_of(circuit, "Uno", "connector52")
    for pin in ("connector66", "connector53"):
        assert net_of(circuit, "Arm", "connector2") is not net_of(circuit, "Uno", pin)
    assert rules_of(findings) == ["RS202", "RS205"]
    assert findings[0].evidence["connectors"] == ["1.connector52", "1.connector66", "2.connector2"]  # and its own
    assert findings[1].message == "left out: 2 traces of another view"
    assert findings[1].evidence == {"without_views": 0, "derived_wires": 0, "foreign_wires": 2}


def test_unknown_parts_are_there_with_their_connectors() -> None:
    circuit, findings = read("unknown_part")
    gizmo = component(circuit, "Gizmo")
    assert (gizmo.role, [c.connectorId for c in gizmo.connectors]) == (hardware.Role.Unknown, ["pinX"])
    assert "in the catalogue" in gizmo.roleEvidence
    assert rules_of(findings) == ["RS203", "RS203"]
    assert findings[0].evidence == {"module_id": "no_such_part_1234", "file": "gizmo.fzp"}
    assert findings[0].location is not None
    assert findings[0].location.line == 24


def test_the_user_s_roles_go_before_all_else() -> None:
    circuit, findings = read_circuit(FIXTURES / "unknown_part.fz", roles={"Gizmo": "Power", "#3": "Output"})
    gizmo = component(circuit, "Gizmo")
    assert (gizmo.role.name, gizmo.roleEvidence, component(circuit, "Chip").role.name) == ("Power", "given by the user", "Output")
    assert findings == [f for f in findings if f.severity.name == "info"]
    tied = net_of(circuit, "Gizmo", "pinX")
    assert tied is not None
    assert tied.rail


@pytest.mark.parametrize(
    ("roles", "cause"),
    [
        ({"Gizmo": "Sensor"}, "unknown role 'Sensor'"),
        ({"Gizmos": "Input"}, r"unknown component 'Gizmos' \(did you mean 'Gizmo'\?\)"),
    ],
)
def test_roles_that_cannot_be_given(roles: dict[str, str], cause: str) -> None:
    with pytest.raises(UsageError, match=cause):
        read_circuit(FIXTURES / "unknown_part.fz", roles=roles)


def test_generated_parts_have_the_names_of_this_drawing() -> None:
    circuit, _ = read("unknown_part")
    names = [c.name for c in component(circuit, "Chip").connectors]
    assert len(names) == 14
    assert (names[0], names[1], names[10]) == ("pin 1", "SDA", "CLK")


def test_net_labels_and_ground_symbols_join() -> None:
    circuit, findings = read("net_labels")
    assert findings == []
    assert net_of(circuit, "Lamp", "connector1") is net_of(circuit, "Uno", "connector64")
    ground = net_of(circuit, "Lamp", "connector0")
    assert ground is net_of(circuit, "Uno", "connector88")
    assert ground is not None
    assert (ground.rail, ground.voltage) == (True, "GND")


def test_stripboards_conduct_along_strips_up_to_a_cut() -> None:
    circuit, findings = read("stripboard")
    assert findings == []
    assert net_of(circuit, "Lit", "connector1") is net_of(circuit, "Uno", "connector63")
    assert net_of(circuit, "Cut", "connector1") is not net_of(circuit, "Uno", "connector63")


def test_two_supply_connectors_make_a_rail_and_one_does_not() -> None:
    hidden = net_of(read("hidden_rail")[0], "A", "connector1")
    single = net_of(read("single_vcc")[0], "A", "connector1")
    assert hidden is not None
    assert single is not None
    assert (hidden.rail, hidden.railEvidence) == (True, "vcc of A, vcc of B")
    assert not single.rail


def test_damage_in_the_drawing_is_told_and_nothing_is_dropped() -> None:
    circuit, findings = read("dangling")
    assert sorted(rules_of(findings)) == ["RS206", "RS207", "RS208", "RS208"]
    assert [(c.elementId, c.title) for c in circuit.components] == [("1", "Uno"), ("2", "Arm"), ("2.2", "Twin")]
    lacking = next(f for f in findings if f.rule == "RS208" and "'Uno'" in f.message)
    assert (lacking.severity.name, lacking.evidence["connectors"], bool(lacking.fix)) == ("warning", ["connector999"], True)
    assert "connector999" not in [c.connectorId for c in component(circuit, "Uno").connectors]
    assert net_of(circuit, "Arm", "connector1") is None


def test_what_names_an_index_that_stands_twice_is_left_out(tmp_path: Path) -> None:
    """The board names index 2, which two lamps have; the second one names the board, so that it alone is told."""
    path = tmp_path / "a.fz"
    path.write_text(
        "<module><instances>"
        + "".join(
            f'<instance moduleIdRef="{kind}" modelIndex="{index}" path=""><title>{title}</title><views><breadboardView>'
            f'<geometry z="1" x="0" y="0"/><connectors><connector connectorId="{own}"><connects>{to}</connects></connector>'
            "</connectors></breadboardView></views></instance>"
            for kind, index, title, own, to in (
                ("arduino_Uno_Rev3(fix)", 1, "Uno", "connector64", '<connect connectorId="connector1" modelIndex="2"/>'),
                ("5mmColorLEDModuleID", 2, "One", "connector1", ""),
                ("5mmColorLEDModuleID", 2, "Two", "connector1", '<connect connectorId="connector64" modelIndex="1"/>'),
            )
        )
        + "</instances></module>"
    )
    made = hardware_of(path)
    assert [(m["pin"], m["component"]) for m in made.result["mappings"]] == [("D3", "Two")]
    assert [f.rule for f in made.findings if "occurs twice" in f.message] == ["RS206"]


@pytest.mark.parametrize("part", ["Arm", "Uno"])
def test_a_connection_at_a_pin_that_the_part_lacks_is_no_mapping(part: str, tmp_path: Path) -> None:
    """As in the drawings of all tools; two wires that end there are not joined by it."""
    path = tmp_path / "a.fz"
    text = (FIXTURES / "one_sided.fz").read_text(encoding="utf-8")
    wrong = {"Arm": ("connector2", "connector99"), "Uno": ("connector52", "connector999")}[part]
    assert [m["pin"] for m in hardware_of(FIXTURES / "one_sided.fz").result["mappings"]] == ["D9"]
    path.write_text(text.replace(f'"{wrong[0]}"', f'"{wrong[1]}"'), encoding="utf-8")
    made = hardware_of(path)
    assert made.result["mappings"] == []
    assert [f.message.partition(" is connected at ")[0] for f in made.findings if f.rule == "RS208"] == [f"'{part}'"]


def test_a_drawing_without_a_connection_is_a_finding() -> None:
    circuit, findings = read("nothing_connected")
    assert rules_of(findings) == ["RS212"]
    assert list(circuit.nets) == []


def test_definitions_in_the_file_tell_names_buses_family_and_role(tmp_path: Path) -> None:
    path = zipped(tmp_path, "embedded", ("my_board", "my_button", "my_driver", "my_motor"))
    circuit, findings = read_circuit(path)
    assert findings == []
    assert [c.role.name for c in circuit.components] == ["Board", "Output", "Input", "Output", "Output"]
    board, bridge, key = (component(circuit, title) for title in ("Mine", "Bridge", "Key"))
    assert [c.pin for c in board.connectors] == ["D2", "D3", "D9", "A4", "", ""]
    assert [c.kind.name for c in board.connectors][-2:] == ["ground", "supply"]
    assert (bridge.family, bridge.driver) == ("IC", True)
    assert [[c.connectorId for c in bus.connectors] for bus in key.buses] == [["b1", "b2"], ["b3", "b4"]]
    assert {c.connectorId for c in key.connectors if c.net is not None} == {"b1", "b2"}
    assert [(p.name, p.value) for p in key.properties] == [("variant", "1")]


def test_a_damaged_definition_costs_only_that_part(tmp_path: Path) -> None:
    import zipfile

    path = zipped(tmp_path, "embedded", ("my_board", "my_driver", "my_motor"))
    with zipfile.ZipFile(path, "a") as archive:
        archive.writestr("part.my_button.fzp", "<module moduleId='my_button'><connectors>")
        archive.writestr("part.other.fzp", "<svg/>")
    circuit, findings = read_circuit(path)
    assert rules_of(findings) == ["RS204", "RS204", "RS203"]
    assert component(circuit, "Key").role is hardware.Role.Unknown


def test_every_labelled_sketch_reads() -> None:
    sketches = [path for label in labelled_sketches() if (path := sketch_file(label)) is not None]
    if not sketches:
        pytest.skip("the labelled sketches are not there: make corpus")
    for path in sketches:
        circuit, _ = read_circuit(path)
        assert circuit.components, path.name
        assert any(c.role is hardware.Role.Board for c in circuit.components), path.name
