"""`generate`: the sketch follows a stored plan, edited or not, and needs nothing but the plan and the models beside it."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.metamodels import migration
from tests.running import run, tree


def rewritten(plan: Path, change: Any) -> None:
    """Load a plan, change it as a tool that edits models would, and store it over the old one."""
    root = robosmi.load_model(plan)
    change(root)
    others = {"code.xmi": root.program, "hardware.xmi": root.circuit, "platform.xmi": root.target.eContainer()}
    robosmi.save_model(root, plan, others)


def binding(plan: Any, name: str) -> Any:
    """The binding of a port."""
    return next(port for port in plan.portBindings if port.name == name)


def sketch_of(output: Path) -> str:
    """The text of the .ino."""
    return (output / "line_follower" / "line_follower.ino").read_text()


def report_of(output: Path) -> str:
    """The text of the report."""
    return (output / "line_follower" / "MIGRATION.md").read_text()


def test_a_moved_folder_without_the_originals_gives_the_same_bytes(
    case_study: Path, migrated_study: Path, tmp_path: Path
) -> None:
    before = tree(migrated_study)
    shutil.rmtree(case_study.parent)
    moved = tmp_path / "elsewhere" / "sent by mail"
    moved.parent.mkdir()
    migrated_study.rename(moved)
    assert run("generate", moved / "models" / "plan.xmi", "-o", tmp_path / "again").code == 0
    again = tree(tmp_path / "again")
    assert {n: d for n, d in again.items() if n != ".robosmi.json"} == {n: d for n, d in before.items() if n != ".robosmi.json"}
    assert run("generate", moved / "models" / "plan.xmi", "-o", moved).code == 0
    assert {n: d for n, d in tree(moved).items() if n != ".robosmi.json"} == {
        n: d for n, d in before.items() if n != ".robosmi.json"
    }


@pytest.mark.parametrize("again", ["migrate", "generate"])
def test_a_second_run_changes_no_byte_and_touches_no_file(again: str, case_study: Path, tmp_path: Path) -> None:
    output = tmp_path / "out"
    robosmi.migrate([case_study], output)
    before = tree(output)
    times = {path: path.stat().st_mtime_ns for path in output.rglob("*") if path.is_file()}
    if again == "migrate":
        robosmi.migrate([case_study], output)
    else:
        robosmi.generate_sketch(output / "models" / "plan.xmi", output)
    assert tree(output) == before
    assert {path: path.stat().st_mtime_ns for path in output.rglob("*") if path.is_file()} == times


def test_a_port_that_nobody_gives_a_function_is_no_fault_of_the_plan(tmp_path: Path) -> None:
    source = tmp_path / "library.c"
    source.write_text(
        '#include "simpletools.h"\nint ask(int pin) { low(pin); return pulse_in(pin, 1); }\nint main() { pause(1); }\n'
    )
    robosmi.migrate([source], tmp_path / "out")
    plan = tmp_path / "out" / "models" / "plan.xmi"
    [flow] = robosmi.load_model(plan).portFlows
    assert ([call.calleeName for call in flow.calls], list(flow.bindings), flow.anything) == (["low", "pulse_in"], [], False)
    assert run("generate", plan, "-o", tmp_path / "again").code == 0
    assert (tmp_path / "again" / "library" / "library.ino").read_text() == (
        tmp_path / "out" / "library" / "library.ino"
    ).read_text()


def test_two_migrations_into_two_folders_are_equal(case_study: Path, migrated_study: Path, tmp_path: Path) -> None:
    robosmi.migrate([case_study], tmp_path / "a")
    assert tree(tmp_path / "a") == tree(migrated_study)


def test_the_sketch_follows_an_edited_binding(migrated: Path) -> None:
    plan = migrated / "models" / "plan.xmi"

    def swap(root: Any) -> None:
        left, right = binding(root, "leftQTI"), binding(root, "rightQTI")
        left.connection, right.connection = right.connection, left.connection

    rewritten(plan, swap)
    assert run("generate", plan, "-o", migrated).code == 0
    assert "const int32_t leftQTI  = HIH40301ReadP1;" in sketch_of(migrated)
    assert "const int32_t rightQTI = HIH40302ReadP1;" in sketch_of(migrated)
    assert "| D11 | HIH4030 1 | OUT |  | `HIH40301ReadP1` | leftQTI |" in report_of(migrated)
    after = binding(robosmi.load_model(plan), "leftQTI")
    assert (after.choice, after.pin.label, after.chosenBy.name) == ("HIH40301ReadP1", "D11", "person")


def test_the_sketch_follows_a_binding_edited_as_text(migrated: Path) -> None:
    plan = migrated / "models" / "plan.xmi"
    text = plan.read_text()
    edited, count = re.subn(r'(name="leftQTI"[^>]*connection="//@connections\.)2"', r'\g<1>4"', text)
    assert count == 1
    plan.write_text(edited)
    assert run("generate", plan, "-o", migrated).code == 0
    assert "const int32_t leftQTI  = Red633nmLED1WriteP1;" in sketch_of(migrated)


def test_a_port_that_was_open_is_closed_by_an_edit(migrated: Path) -> None:
    plan = migrated / "models" / "plan.xmi"

    def unbind(root: Any) -> None:
        binding(root, "LED").connection = binding(root, "LED").pin = None

    def bind(root: Any) -> None:
        pins = {pin.label: pin for pin in root.board.pins}
        binding(root, "LED").pin = pins["D2"]

    rewritten(plan, unbind)
    outcome = run("generate", plan, "-o", migrated, "--json")
    assert any("'LED'" in task["message"] for task in outcome.document["tasks"])
    rewritten(plan, bind)
    outcome = run("generate", plan, "-o", migrated, "--json")
    port = next(b for b in outcome.result["plan"]["bindings"] if b["name"] == "LED")
    assert (port["pin"], port["open"], port["chosen_by"]) == ("D2", False, "person")
    assert not any("the port 'LED'" in task["message"] for task in outcome.document["tasks"])
    assert "const int32_t LED      = 2;" in sketch_of(migrated)


def test_the_sketch_follows_adapters_that_were_taken_out_of_the_plan(migrated: Path) -> None:
    """What nothing needs any more goes with them, and the library that they used."""
    plan = migrated / "models" / "plan.xmi"

    def take_out(root: Any) -> None:
        next(use for use in root.adapterUses if use.name == "drive_speed").adapter = None

    rewritten(plan, take_out)
    outcome = run("generate", plan, "-o", migrated, "--json")
    adapters = (migrated / "line_follower" / "adapters.h").read_text()
    assert "inline void high(int32_t pin)" in adapters
    assert "void drive_speed(int32_t left, int32_t right) {\n  // TODO: complete method" in adapters
    assert "servo_slot" not in adapters
    assert "#include <Servo.h>" not in sketch_of(migrated) + adapters
    assert "- Servo (" not in (migrated / "line_follower" / "sketch.yaml").read_text()
    sites = outcome.result["plan"]["call_sites"]
    assert (sites["with_body"], sites["todo"]) == (9, 4)
    assert sites["by_header"]["abdrive.h"] == {"total": 4, "with_body": 0, "todo": 4}
    assert [t["rule"] for t in outcome.document["tasks"] if "drive_speed" in t["message"]] == ["RS501"]


def test_a_library_choice_that_is_taken_back_is_open_again(migrated: Path) -> None:
    plan = migrated / "models" / "plan.xmi"

    def forget(root: Any) -> None:
        for choice in root.libraryChoices:
            choice.chosen = None

    rewritten(plan, forget)
    outcome = run("generate", plan, "-o", migrated, "--json")
    is_open = {choice["component"]: choice["open"] for choice in outcome.result["plan"]["libraries"]}
    assert {name for name, value in is_open.items() if value} == {"Basic Servo1", "Basic Servo2"}
    assert len(is_open) == 5, "that the others need none was not taken back"
    assert "#include <Servo.h>" not in sketch_of(migrated)
    assert len([t for t in outcome.document["tasks"] if t["rule"] == "RS401"]) == 2


def test_a_plan_in_which_one_port_has_two_bindings_is_refused_and_the_sketch_stays(migrated: Path) -> None:
    plan = migrated / "models" / "plan.xmi"

    def double(root: Any) -> None:
        binding(root, "rightQTI").sourcePin = binding(root, "leftQTI").sourcePin

    before = sketch_of(migrated)
    rewritten(plan, double)
    outcome = run("generate", plan, "-o", migrated)
    assert outcome.code == 3
    assert "has two bindings in the plan" in outcome.err
    assert "remove one of them" in outcome.err
    assert sketch_of(migrated) == before


@pytest.mark.parametrize(
    ("edit", "rule", "advice"),
    [
        (('choice="Red633nmLED1WriteP1" name="LED"', 'choice="D5" name="LED"'), "RS716", "--bind"),
        (('choice="Red633nmLED1WriteP1" name="LED"', 'choice="none" name="LED"'), "RS716", "--bind"),
        (('sourcePin="7"', 'sourcePin="77"'), "RS719", "correct its number"),
        (('startOffset="', 'startOffset="-'), "RS709", "correct the offsets"),
        (('name="high" signature', 'name="drive_speed" signature'), "RS718", "one of them"),
    ],
)
def test_nonsense_in_a_plan_is_refused_and_the_sketch_stays(
    migrated: Path, edit: tuple[str, str], rule: str, advice: str
) -> None:
    plan = migrated / "models" / "plan.xmi"
    text = plan.read_text()
    assert edit[0] in text
    plan.write_text(text.replace(*edit, 1))
    before = tree(migrated)
    assert rule in run("check", plan, "--json").rules()
    outcome = run("generate", plan, "-o", migrated)
    assert outcome.code == 3
    assert f"[{rule}]" in outcome.err
    assert advice in outcome.err
    assert tree(migrated) == before


def test_generating_from_an_edited_plan_twice_changes_nothing(migrated: Path) -> None:
    plan = migrated / "models" / "plan.xmi"

    def unbind(root: Any) -> None:
        binding(root, "LED").connection = None
        binding(root, "LED").pin = None

    rewritten(plan, unbind)
    assert run("generate", plan, "-o", migrated).code == 0
    assert "const int32_t LED      = 255 /* P8 is not wired yet */;" in sketch_of(migrated)
    before = tree(migrated)
    assert run("generate", plan, "-o", migrated).code == 0
    assert tree(migrated) == before


def test_an_edit_of_the_text_in_the_plan_is_kept(migrated: Path) -> None:
    plan = migrated / "models" / "plan.xmi"
    source = (migrated / "models" / "source" / "line_follower.c").read_bytes()

    def add(root: Any) -> None:
        start = source.index(b"pause(1000)")
        root.edits.append(
            migration.TextChange(
                unit=root.program.units[0],
                startOffset=start + 6,
                endOffset=start + 10,
                replacement="500",
                reason="faster",
                step=migration.Step.code,
            )
        )

    rewritten(plan, add)
    assert run("generate", plan, "-o", migrated).code == 0
    assert "pause(500);" in sketch_of(migrated)


def test_an_edit_of_a_decisions_own_change_is_kept(migrated: Path) -> None:
    plan = migrated / "models" / "plan.xmi"

    def add(root: Any) -> None:
        (change,) = binding(root, "leftQTI").changes
        change.replacement += " + 0"

    rewritten(plan, add)
    assert run("generate", plan, "-o", migrated).code == 0
    assert "const int32_t leftQTI  = HIH40302ReadP1 + 0;" in sketch_of(migrated)


def test_a_port_follows_its_connection_though_the_recorded_choice_was_edited_with_it(migrated: Path) -> None:
    plan = migrated / "models" / "plan.xmi"

    def swap(root: Any) -> None:
        left, right = binding(root, "leftQTI"), binding(root, "rightQTI")
        left.connection, right.connection = right.connection, left.connection
        left.choice, right.choice = right.choice, left.choice

    rewritten(plan, swap)
    assert run("generate", plan, "-o", migrated).code == 0
    assert "const int32_t leftQTI  = HIH40301ReadP1;" in sketch_of(migrated)
    assert "const int32_t rightQTI = HIH40302ReadP1;" in sketch_of(migrated)


def test_an_edit_within_what_another_change_takes_away_has_no_effect_and_is_a_finding(migrated: Path) -> None:
    plan = migrated / "models" / "plan.xmi"
    source = (migrated / "models" / "source" / "line_follower.c").read_bytes()
    before = sketch_of(migrated)

    def add(root: Any) -> None:
        start = source.index(b"simpletools.h")
        unit = root.program.units[0]
        root.edits.append(migration.TextChange(unit=unit, startOffset=start, endOffset=start + 6, replacement="complex"))

    rewritten(plan, add)
    assert "RS708" in run("check", plan, "--json").rules()
    assert run("generate", plan, "-o", migrated).code == 0
    assert sketch_of(migrated) == before


def test_the_plan_of_the_api_is_the_plan_that_is_stored(case_study: Path, migrated_study: Path) -> None:
    planned = robosmi.plan_migration([case_study])
    stored = robosmi.load_model(migrated_study / "models" / "plan.xmi")
    assert [(b.name, b.choice) for b in planned.plan.portBindings] == [(b.name, b.choice) for b in stored.portBindings]
    assert [c.choice for c in planned.plan.libraryChoices] == [c.choice for c in stored.libraryChoices]
