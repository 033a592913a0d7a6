"""Without a drawing a plan's picture shows the target's board and what the program uses, by the names in the program."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import pytest

import robosmi
from robosmi.metamodels import hardware, migration
from robosmi.transformations.m2t.circuits.circuit_picture import plan_svg
from robosmi.transformations.queries.circuits.drawn_symbols import symbol_of
from robosmi.transformations.queries.plans.presumed_circuit import presumed_circuit
from tests.running import run

PROGRAMS = Path(__file__).parent / "presumed_circuits"


@pytest.fixture(scope="module")
def sketch() -> migration.MigrationPlan:
    return robosmi.plan_migration([PROGRAMS / "robot.ino"], target="pico").plan


@pytest.fixture(scope="module")
def program() -> migration.MigrationPlan:
    return robosmi.plan_migration([PROGRAMS / "driver.c"], bind={"P5": "D9", "lamp": "D4"}).plan


def parts(circuit: hardware.Circuit | None) -> dict[str, tuple[str, str, list[str]]]:
    """Title of each part -> what drives it, its role, and the pins of the board that it is wired to."""
    assert circuit is not None
    found = {}
    for part in circuit.components:
        if part.role is not hardware.Role.Board:
            nets = [c.net for c in part.connectors if c.net is not None]
            found[part.title] = part.partTitle, part.role.name, [c.pin for net in nets for c in net.connectors if c.pin]
    return found


def test_what_an_object_takes_is_one_part(sketch: migration.MigrationPlan) -> None:
    found = parts(presumed_circuit(sketch))
    assert found["lcd"] == ("LiquidCrystal", "Both", ["GP12", "GP11", "GP5", "GP4", "GP3", "GP2"])
    assert found["arm"] == ("Servo", "Output", ["GP10"])
    assert found["echo"] == ("pinMode, pulseIn", "Input", ["GP8"])
    assert set(found) == {"lcd", "arm", "trig", "echo", "D13", "A0"}


def test_a_port_without_a_pin_is_a_part_without_a_wire(program: migration.MigrationPlan) -> None:
    assert parts(presumed_circuit(program)) == {
        "lamp": ("high", "Output", ["D4"]),
        "P5": ("servo_angle", "Output", ["D9"]),
        "P7": ("input", "Input", []),
    }


def test_the_picture_has_all_of_them_and_the_pins(program: migration.MigrationPlan) -> None:
    text = plan_svg(program)
    drawn = ElementTree.fromstring(text)
    assert {each.get("data-pin") for each in drawn.iter() if each.get("data-port")} == {"D4", "D9"}
    words = {str(each.text) for each in drawn.iter() if each.text}
    assert {"Arduino Uno", "lamp", "P5", "P7", "D4 = lamp", "D9 = P5"} <= words


@pytest.mark.parametrize(
    ("name", "drawn"),
    [
        ("tones.c", {"P4": "speaker", "P11": "led", "P10": "button", "P26": "led", "P6": "light_sensor"}),
        (
            "robot.ino",
            {"lcd": "display", "arm": "servo", "trig": "ranger", "echo": "ranger", "D13": "led", "A0": "potentiometer"},
        ),
    ],
)
def test_parts_are_drawn_as_what_their_functions_are_usually_used_with(name: str, drawn: dict[str, str]) -> None:
    circuit = presumed_circuit(robosmi.plan_migration([PROGRAMS / name], target="uno").plan)
    assert circuit is not None
    symbols = {part.title: symbol_of(part) for part in circuit.components if part.role is not hardware.Role.Board}
    assert {title: symbol for title, (symbol, _) in symbols.items()} == drawn
    if "P11" in symbols:
        assert symbols["P11"][1] != symbols["P26"][1], "infrared light is dark"


def test_a_plan_with_a_drawing_presumes_nothing(examples: Path) -> None:
    folder = examples / "line_follower"
    plan = robosmi.plan_migration([folder / "line_follower.c"], hardware=folder / "line_following_robot.fzz").plan
    assert presumed_circuit(plan) is None


def test_a_program_without_ports_has_no_picture(tmp_path: Path) -> None:
    (tmp_path / "nothing.c").write_text("int main() { return 0; }\n")
    assert plan_svg(robosmi.plan_migration([tmp_path / "nothing.c"]).plan) == ""


def test_the_exported_picture_says_that_there_is_no_drawing(tmp_path: Path) -> None:
    robosmi.migrate([PROGRAMS / "driver.c"], tmp_path / "out")
    outcome = run("wiring", "--json", tmp_path / "out", "--as", "svg", "-o", tmp_path / "made.svg")
    assert outcome.code == 0
    assert "RS210" in outcome.rules()
    assert "P7" in (tmp_path / "made.svg").read_text()
