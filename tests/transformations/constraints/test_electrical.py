"""Electrical constraints: for each an example that fails it alone, one that holds all, and the documented severity."""

from __future__ import annotations

import json
import re
import tomllib
from pathlib import Path

import pytest

from robosmi.diagnostics import Finding
from robosmi.errors import PlatformDataError
from robosmi.plugins import registry
from robosmi.project import Project
from robosmi.query.run import Run
from robosmi.transformations.chains.check import check
from robosmi.transformations.chains.hardware import hardware
from robosmi.transformations.chains.migrate import migrate, plan_migration
from robosmi.transformations.constraints.electrical import electrical, electrical_findings
from robosmi.transformations.constraints.electrical_plan import by_index, plan_faults, together
from robosmi.transformations.constraints.plan_ports import port_faults
from robosmi.transformations.knowledge.electrical_facts import FILE, ElectricalFacts, electrical as facts
from robosmi.transformations.m2t.first_screen import terminal_lines
from robosmi.transformations.queries.circuits.electrical import stated_volts, wiring
from robosmi.transformations.queries.plans.plan import as_findings
from robosmi.transformations.t2m.fritzing import read_circuit
from robosmi.validate import Constraint
from tests.evaluation.scoring.sketches import labelled_sketches
from tests.evaluation.sources import sketch_file
from tests.running import run
from tests.transformations.constraints.draw import drawings
from tests.transformations.t2m.fritzing.support import CASES

HERE = Path(__file__).parent
ROOT = HERE.parents[2]
DRAWINGS, PLANS = HERE / "drawings", HERE / "plans"
OF_DRAWINGS = [c for module in electrical.modules() for context in module.contexts for c in context.constraints]
MEASURES = '#include "simpletools.h"\nint main(void) {\n  high(5);\n  print("%d", rc_time(5, 1));\n}\n'
OF_PLANS = [c for context in (*together.contexts, *by_index.contexts) for c in context.constraints]


def example(name: str) -> Path:
    """A drawing with an example: Fritzing's, or Wokwi's where Fritzing has no such board; a pin table for a rule on tables."""
    places = (DRAWINGS / f"{name}.fz", DRAWINGS / name / "diagram.json", DRAWINGS / f"{name}.csv")
    return next(path for path in places if path.is_file())


def planned(folder: Path) -> list[Finding]:
    plan = plan_migration([folder / "robot.c"], hardware=next(folder.glob("wiring.*"))).plan
    return [f for f in plan_faults(plan) if f.rule in {c.id for c in OF_PLANS}]


def test_every_constraint_has_its_two_examples_and_no_other() -> None:
    wanted = [f"{c.id}_{end}" for c in OF_DRAWINGS for end in ("fails", "holds")]
    assert sorted(p.stem for p in DRAWINGS.glob("RS*") if p.is_dir() or p.suffix in (".fz", ".csv")) == sorted(wanted)
    wanted = [f"{c.id}_{end}" for c in OF_PLANS for end in ("fails", "holds")]
    assert sorted(p.name for p in PLANS.iterdir()) == sorted(wanted)


@pytest.mark.parametrize("constraint", OF_DRAWINGS, ids=lambda c: c.id)
def test_the_failing_drawing_gives_that_finding_alone(constraint: Constraint) -> None:
    path = example(f"{constraint.id}_fails")
    found = hardware(path).findings
    assert {(f.rule, f.severity) for f in found} == {(constraint.id, constraint.severity)}
    for finding in found:
        assert finding.message
        assert finding.fix
        assert finding.element
        assert finding.location is not None
        assert finding.location.path == str(path)
        assert finding.evidence["model_index"] or path.suffix == ".json"


@pytest.mark.parametrize("constraint", OF_DRAWINGS, ids=lambda c: c.id)
def test_the_other_drawing_holds_all(constraint: Constraint) -> None:
    assert hardware(example(f"{constraint.id}_holds")).findings == []


@pytest.mark.parametrize("constraint", OF_PLANS, ids=lambda c: c.id)
def test_the_failing_plan_gives_that_finding_alone(constraint: Constraint) -> None:
    (finding,) = planned(PLANS / f"{constraint.id}_fails")
    assert (finding.rule, finding.severity) == (constraint.id, constraint.severity)
    assert finding.message
    assert finding.fix
    assert finding.location is not None


@pytest.mark.parametrize("constraint", OF_PLANS, ids=lambda c: c.id)
def test_the_other_plan_holds_all(constraint: Constraint) -> None:
    assert planned(PLANS / f"{constraint.id}_holds") == []


@pytest.mark.parametrize("constraint", [*OF_DRAWINGS, *OF_PLANS], ids=lambda c: c.id)
def test_the_severity_is_the_documented_one(constraint: Constraint) -> None:
    table = (ROOT / "docs" / "reference" / "rules.md").read_text(encoding="utf-8")
    (level,) = re.findall(rf"^\| {constraint.id} \| (\w+) \|", table, re.MULTILINE)
    assert constraint.severity.name == level


def test_the_drawings_are_those_of_their_table() -> None:
    written = {p.stem: p.read_text(encoding="utf-8") for p in DRAWINGS.glob("*.fz")}
    assert written == drawings()
    for folder in PLANS.glob("RS268_*"):
        assert (folder / "wiring.fz").read_text(encoding="utf-8") == written["joined_pins"]


# ---- where the findings appear


@pytest.mark.parametrize(
    ("case", "wanted"),
    [("line_following_robot", ["RS240", "RS240", "RS250"]), ("environmental_monitoring_robot", ["RS250"])],
)
def test_the_case_drawings_give_warnings_and_nothing_worse(case: str, wanted: list[str]) -> None:
    found = hardware(CASES[case]).findings
    assert [(f.rule, f.severity.name) for f in found] == [(rule, "warning") for rule in wanted]
    assert {f.rule for f in check(CASES[case]).findings} == set(wanted)


def test_a_plan_keeps_the_findings_with_their_components() -> None:
    folder = PLANS / "RS260_fails"
    models = plan_migration([folder / "robot.c"], hardware=folder / "wiring.csv")
    (kept,) = [f for f in models.plan.findings if f.rule == "RS260"]
    assert kept.path == "source/wiring.csv"
    from robosmi.query import Q

    (finding,) = [f for f in as_findings(Q(models.plan.findings), models.places) if f.rule == "RS260"]
    assert (finding.evidence["component"], finding.evidence["model_index"]) == ("Warmth", "2")
    assert finding.location is not None
    assert finding.location.path == str(folder / "wiring.csv")


def test_the_pins_of_a_library_that_nothing_uses_are_free(tmp_path: Path) -> None:
    (tmp_path / "robot.c").write_text('#include "simpletools.h"\nint main(void) { pause(1); }\n')
    rows = ["D10,MFRC522 RFID reader,cards,SDA", "D9,MFRC522 RFID reader,cards,RST", "D12,Green LED,green,anode"]
    (tmp_path / "wiring.csv").write_text("\n".join(["pin,part,title,connector", *rows, ""]))
    plan = plan_migration([tmp_path / "robot.c"], hardware=tmp_path / "wiring.csv").plan
    assert [c.chosen.name for c in plan.libraryChoices if c.chosen is not None] == ["MFRC522"]
    assert "RS265" not in {f.rule for f in plan.findings}
    assert "  libraries: MFRC522 (not used, not included)" in terminal_lines(plan, {}, tmp_path, made=True)
    chosen = plan_migration([tmp_path / "robot.c"], hardware=tmp_path / "wiring.csv", libraries={"cards": "MFRC522"}).plan
    assert "RS265" in {f.rule for f in chosen.findings}


def test_a_chosen_library_works_on_the_architecture_of_the_board(tmp_path: Path) -> None:
    (tmp_path / "robot.c").write_text('#include "simpletools.h"\nint main(void) { pause(1); }\n')
    (tmp_path / "wiring.csv").write_text("pin,part,title,connector\nIO25,Servo,arm,signal\n")

    def found(library: str) -> list[str]:
        hardware, libraries = tmp_path / "wiring.csv", {"arm": library}
        plan = plan_migration([tmp_path / "robot.c"], target="esp32", hardware=hardware, libraries=libraries).plan
        return [str(finding.message) for finding in plan.findings if finding.rule == "RS274"]

    (message,) = found("Servo")
    assert message.startswith("Servo, chosen for 'arm', does not list the architecture esp32")
    assert "ESP32Servo" in message
    assert found("ESP32Servo") == []


def test_a_plan_without_a_drawing_is_asked_nothing_of_it() -> None:
    folder = PLANS / "RS267_fails"
    plan = plan_migration([folder / "robot.c"], project=Project()).plan
    assert [f.rule for f in plan.findings if f.rule.startswith("RS2")] == ["RS210"]
    assert plan_faults(plan) == []


def test_the_constraints_belong_to_the_sets_that_check_runs() -> None:
    assert set(electrical.modules()) < set(registry().get("constraints", "hardware").modules())
    assert together in registry().get("constraints", "migration").modules()


def test_components_of_one_title_are_told_apart(tmp_path: Path) -> None:
    drawing = tmp_path / "two.fz"
    text = (DRAWINGS / "RS232_holds.fz").read_text(encoding="utf-8").replace("TMP36_2", "TMP36_1")
    drawing.write_text(text.replace('connectorId="connector2"', 'connectorId="connector9"'), encoding="utf-8")
    messages = [f.message for f in hardware(drawing).findings if f.rule == "RS235"]
    assert messages == ["no ground is wired to 'TMP36_1 #1'", "no ground is wired to 'TMP36_1 #3'"]


# ---- public drawings


ERRORS = {"tank_wifi_l9110": ["RS253"]}
"""Development sketches with an error: there a module for 3.3 V gets 5 V."""


def test_errors_in_public_drawings_are_faults_of_the_drawings() -> None:
    sketches = {label["name"]: path for label in labelled_sketches() if (path := sketch_file(label)) is not None}
    if not sketches:
        pytest.skip("the labelled sketches are not there: make corpus")
    found = {
        n: [f.rule for f in electrical_findings(read_circuit(p)[0]) if f.severity.name == "error"] for n, p in sketches.items()
    }
    assert {name: rules for name, rules in found.items() if rules} == {n: r for n, r in ERRORS.items() if n in sketches}


# ---- the facts


@pytest.mark.parametrize(
    ("label", "volts"),
    [
        ("5V", 5.0),
        ("+5V", 5.0),
        ("3V3", 3.3),
        ("3.3V", 3.3),
        ("3,3V", 3.3),
        ("9 V", 9.0),
        ("5V2", 5.0),
        ("VIN", None),
        ("", None),
    ],
)
def test_labels_state_volts(label: str, volts: float | None) -> None:
    assert stated_volts(label) == volts


def test_a_user_s_own_facts_go_before_the_built_in_ones(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    drawing = DRAWINGS / "RS250_fails.fz"
    own = tmp_path / ".robosmi" / "platform_repo" / FILE
    own.parent.mkdir(parents=True)
    own.write_text('[[device]]\nkind = "small servo"\nwords = ["basic servo"]\npeak_ma = 150\n', encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    assert hardware(drawing).findings == []


def test_the_first_entry_that_fits_and_is_not_forbidden_counts() -> None:
    table = """
        [[device]]
        kind = "driver"
        words = ["motor driver*"]
        [[device]]
        kind = "motor"
        words = ["motor*"]
        not = ["mount"]
        [[device]]
        kind = "mount"
        families = ["mount*"]
    """
    data = ElectricalFacts(tomllib.loads(table), "x.toml")
    circuit, _ = read_circuit(DRAWINGS / "RS251_fails.fz")
    motor = next(c for c in circuit.components if c.title == "Motor")
    kinds = []
    for title, family in (("Motor driver L1", "x"), ("Motor", "x"), ("Motor mount", "mounts"), ("Wheel", "x")):
        motor.title, motor.partTitle, motor.family = "M", title, family
        found = data.find(motor)
        kinds.append(found.kind if found is not None else None)
    assert kinds == ["driver", "motor", "mount", None]


@pytest.mark.parametrize(
    ("entry", "said"),
    [
        ('kind = "a"\nwords = ["a"]\nvolt = [1, 2]', "'volt' is not a key of a device (did you mean 'volts'?)"),
        ('kind = "a"\nwords = ["a"]\nvolts = [1]', "'volts' has the value [1]"),
        ('kind = "a"\nwords = ["a"]\ninductive = "yes"', "'inductive' has the value 'yes'"),
        ('kind = "a"', "its kind or the keys that find it are missing"),
    ],
)
def test_a_damaged_entry_is_named(entry: str, said: str) -> None:
    with pytest.raises(PlatformDataError, match=re.escape(said)):
        ElectricalFacts(tomllib.loads(f"[[device]]\n{entry}\n"), "x.toml")


def test_every_device_of_the_built_in_table_is_meant_for_something() -> None:
    table = tomllib.loads((ROOT / "platform_repo" / FILE).read_text(encoding="utf-8"))
    assert all(low <= high for device in table["device"] for low, high in [device.get("volts", (0, 0))])
    assert all(0x03 <= address <= 0x77 for device in table["device"] for address in device.get("i2c", ()))
    assert (5.0, 400) in facts().supply_limits
    assert all(abs(volts - 9.0) > 1 for volts, _ in facts().supply_limits)


def test_names_of_parts_do_not_make_a_supply_of_ground() -> None:
    """A chip drawn the wrong way round has its ground connector on 5 V; what the board says counts."""
    circuit, _ = read_circuit(DRAWINGS / "RS239_fails.fz")
    with Run():
        w = wiring(circuit)
        sensor = next(c for c in circuit.components if c.title == "TMP36")
        volts = {connector.name: w.volts(net) for connector, net in w.nets(sensor)}
    assert json.loads(json.dumps(volts)) == {"VCC": 0.0, "VOUT": None, "GND": 5.0}


@pytest.mark.parametrize(
    ("part", "connector", "board", "found"),
    [
        ("RFID RC522", "SDA", "uno", True),
        ("RFM95 LoRa Radio", "MOSI", "uno", True),
        ("Nokia 5110 LCD", "DIN", "mega", True),
        ("CC1101 Radio Module", "SI", "leonardo", True),
        ("ESP8266 WiFi Module", "RX", "nano", True),
        ("RFID RC522", "SDA", "fio", False),  # a board of 3.3 V
        ("RFM95 LoRa Radio Breakout", "MOSI", "uno", False),  # which shifts the levels
        ("nRF24L01 Module", "MOSI", "uno", False),  # whose inputs bear 5 V
        ("LIS3DH Breakout", "SDI", "uno", False),
    ],
)
def test_parts_of_3_3_volts_on_pins_of_5_volts_are_found_where_nothing_shifts_the_levels(
    part: str, connector: str, board: str, found: bool, tmp_path: Path
) -> None:
    table = tmp_path / "wiring.csv"
    table.write_text(f"pin,part,title,connector,board\nD10,{part},it,{connector},{board}\nD9,{part},it,RST,{board}\n")
    said = [finding for finding in run("hardware", table, "--json").document["findings"] if finding["rule"] == "RS255"]
    assert len(said) == int(found)
    if found:
        assert said[0]["message"].startswith("D10 drives " + connector)


def test_the_serial_port_of_the_board_itself_needs_nothing_drawn(tmp_path: Path) -> None:
    """A regression: a program that opens its own console was told to draw what is on its pins."""
    (tmp_path / "robot.c").write_text(
        '#include "simpletools.h"\n#include "fdserial.h"\nint main(void) {\n'
        "  fdserial *pc = fdserial_open(31, 30, 0, 115200);\n  fdserial_txChar(pc, 'a');\n  high(5);\n}\n"
    )
    (tmp_path / "wiring.csv").write_text("pin,part,title,connector\nD12,Green LED,green,anode\n")
    plan = plan_migration([tmp_path / "robot.c"], hardware=tmp_path / "wiring.csv").plan
    assert sorted(b.choice for b in plan.portBindings if b.name in ("P30", "P31")) == ["D0", "D1"]
    assert "RS262" not in {f.rule for f in plan.findings}


@pytest.mark.parametrize(
    ("row", "says"),
    [
        ("TEMT6000 ambient light sensor,light,SIG", "is a voltage divider without one"),
        ("LM35,warmth,VOUT", "drives its output"),
        ("QTI sensor,line,R", ""),  # with a capacitor of its own
    ],
)
def test_a_capacitor_is_missed_where_a_part_gives_a_voltage(row: str, says: str, tmp_path: Path) -> None:
    (tmp_path / "robot.c").write_text(MEASURES)
    (tmp_path / "wiring.csv").write_text(f"pin,part,title,connector\nA1,{row}\n")
    plan = plan_migration([tmp_path / "robot.c"], hardware=tmp_path / "wiring.csv", bind={"P5": "A1"}).plan
    said = [f.message for f in plan.findings if f.rule == "RS270"]
    assert len(said) == bool(says)
    assert all(message.endswith(says) for message in said)


@pytest.mark.parametrize("rails", [{"GND": "GND.1"}, {"GND": "GND.1", "VCC": "5V"}], ids=["a resistor that is set", "a divider"])
def test_a_potentiometer_between_two_rails_gives_a_voltage(rails: dict[str, str], tmp_path: Path) -> None:
    (tmp_path / "robot.c").write_text(MEASURES)
    parts = [{"type": "wokwi-arduino-uno", "id": "uno"}, {"type": "wokwi-potentiometer", "id": "dial"}]
    wires = [["uno:A1", "dial:SIG", "", []], *([f"uno:{at}", f"dial:{end}", "", []] for end, at in rails.items())]
    (tmp_path / "diagram.json").write_text(json.dumps({"version": 1, "parts": parts, "connections": wires}))
    plan = plan_migration([tmp_path / "robot.c"], hardware=tmp_path / "diagram.json", bind={"P5": "A1"}).plan
    assert ("RS270" in {f.rule for f in plan.findings}) == (len(rails) > 1)


def test_another_board_is_something_at_a_pin(tmp_path: Path) -> None:
    """A regression: a drawn Pico was called nothing by one finding, and a host that bears 3.6 V by the other."""
    (tmp_path / "robot.c").write_text('#include "simpletools.h"\nint main(void) {\n  high(7);\n}\n')
    parts = [{"type": f"wokwi-{kind}", "id": kind} for kind in ("arduino-uno", "pi-pico")]
    wire = ["arduino-uno:7", "pi-pico:GP3", "green", []]
    (tmp_path / "diagram.json").write_text(json.dumps({"version": 1, "parts": parts, "connections": [wire]}))
    plan = plan_migration(
        [tmp_path / "robot.c"],
        hardware=tmp_path / "diagram.json",
        bind={"P7": "D7"},
        project=Project(roles={"#arduino-uno": "Board"}),
    ).plan
    assert {f.rule for f in plan.findings} & {"RS262", "RS272"} == {"RS272"}


@pytest.mark.parametrize(("board", "pins"), [("pico", "254, 254"), ("nucleo-f401re", "254, 254"), ("esp32", "3, 1")])
def test_the_console_is_usb_where_that_takes_no_pins(board: str, pins: str, tmp_path: Path) -> None:
    """A regression: a Pico's console was bound to free pins, and silent."""
    (tmp_path / "robot.c").write_text(
        '#include "simpletools.h"\n#include "fdserial.h"\nint main(void) {\n'
        "  fdserial *pc = fdserial_open(31, 30, 0, 115200);\n  fdserial_txChar(pc, 'a');\n}\n"
    )
    made = migrate([tmp_path / "robot.c"], tmp_path / "out", target=board)
    plan = made.models.plan
    assert not any(b.open for b in plan.portBindings)
    assert not {"RS334", "RS345"} & {f.rule for f in [*plan.findings, *plan.tasks]}
    text = re.sub(r" /\*.*?\*/", "", (made.sketch / "robot.ino").read_text())
    assert f"fdserial_open({pins}, 0, 115200)" in text


def test_each_part_on_the_serial_pins_is_named(tmp_path: Path) -> None:
    (tmp_path / "robot.c").write_text('#include "simpletools.h"\nint main(void) {\n  print("hello\\n");\n}\n', encoding="utf-8")
    (tmp_path / "wiring.csv").write_text("pin,part,title,connector\nD0,Button,Start,1\nD1,Red LED,Lamp,anode\n", encoding="utf-8")
    found = [f for f in planned(tmp_path) if f.rule == "RS266"]
    assert sorted(str(f.evidence["pin"]) for f in found) == ["D0", "D1"]


def test_two_parts_at_one_port_of_the_source_are_named() -> None:
    plan = plan_migration(
        [PLANS.parent / "one_port_two_parts" / "robot.c"], hardware=PLANS.parent / "one_port_two_parts" / "wiring.csv"
    ).plan
    (finding,) = [f for f in port_faults(plan) if f.rule == "RS731"]
    assert "'side lamp'" in finding.message
    assert "'right servo'" in finding.message
