"""One truth of choices: what is chosen stands in the plan, in the project file and in the sketch, and later runs keep it."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.errors import StoppedError, UsageError
from robosmi.files.files import digest
from robosmi.generate.undo import undo
from robosmi.metamodels import migration
from robosmi.recommend.history import History
from robosmi.transformations.chains.choose import choose
from robosmi.transformations.chains.stages.models import load_models
from robosmi.transformations.queries.plans.choices import available_choices, choices_json
from tests.chains.conftest import copied
from tests.running import run, tree


@pytest.fixture
def program(examples: Path, restored: Callable[[str, Callable[[Path], None]], Path]) -> Path:
    """The line follower without the engineer's choices, migrated to `out` beside its folder."""

    def fill(folder: Path) -> None:
        source = copied(examples, "line_follower", folder)
        (source.parent / "robosmi.toml").write_text('# mine\n[migrate]\nhardware = "line_following_robot.fzz"  # drawn\n')
        robosmi.migrate([source], folder / "out")

    return restored("line_follower without choices", fill) / "input" / "line_follower.c"


@pytest.fixture
def out(program: Path) -> Path:
    """The output folder of its migration."""
    return program.parents[1] / "out"


def chosen(out: Path, name: str) -> Any:
    """A choice of the plan in an output folder."""
    return next(c for c in choices_json(plan_in(out)) if c["id"] == name)


def test_a_choice_is_in_the_plan_in_the_project_file_and_in_the_sketch(out: Path, program: Path) -> None:
    done = choose(out, {"leftQTI": "D10"}, why="it looks to the left")
    left = chosen(out, "port:leftQTI")
    assert (left["chosen"], left["by"], left["why"]) == ("HIH40302ReadP1", "person", "it looks to the left")
    assert left["at"].endswith("Z")
    text = (program.parent / "robosmi.toml").read_text()
    assert text == '# mine\n[migrate]\nhardware = "line_following_robot.fzz"  # drawn\n\n[bind]\nleftQTI = "D10"\n'
    assert "leftQTI  = HIH40302ReadP1;" in (out / "line_follower" / "line_follower.ino").read_text()
    assert "+const int32_t leftQTI  = HIH40302ReadP1;" in done.diff
    assert done.command.startswith("robosmi choose ")
    assert done.command.endswith("port:leftQTI=D10 --why 'it looks to the left'")


def test_a_person_reads_the_answers_and_the_changes_of_the_sketch_and_more_only_on_request(out: Path) -> None:
    done = choose(out, {"leftQTI": "D10"})
    short, long = done.lines(), done.lines(every_file=True)
    assert short[0] == "port:leftQTI = D10"
    assert "--- a/line_follower/line_follower.ino" in short
    assert not any(line.startswith("---") and "MIGRATION.md" in line for line in short)
    assert "line_follower/MIGRATION.md" in short[-1]
    assert "--- a/line_follower/MIGRATION.md" in long
    assert "\n".join(long).endswith(done.diff)


def test_options_stay_after_a_choice_and_a_port_is_offered_free_pins_and_none(out: Path) -> None:
    before = [o["value"] for o in chosen(out, "port:leftQTI")["options"]]
    assert before[-1] == "none"
    assert {"D2", "A0"} < set(before)
    assert not {"D8", "D12"} & set(before)  # something is drawn there
    choose(out, {"port:leftQTI": "none"})
    assert [o["value"] for o in chosen(out, "port:leftQTI")["options"]] == before


def test_a_connection_is_stored_with_its_drawing_without_which_it_means_nothing(tmp_path: Path) -> None:
    program, parts, out = tmp_path / "lamp.c", tmp_path / "parts.csv", tmp_path / "out"
    program.write_text('#include "simpletools.h"\nint main() { high(3); }\n')
    parts.write_text("pin;part;title\nD5;LED;one\nD6;LED;two\n")
    robosmi.migrate([program], out, hardware=parts)
    assert run("choose", out, "port:P3=D6").code == 0
    assert "hardware" not in (tmp_path / "robosmi.toml").read_text()
    wire = next(c.name for c in robosmi.load_model(out / "models" / "plan.xmi").connections if c.pin.label == "D5")
    assert run("choose", out, f"port:P3={wire}").code == 0
    assert 'hardware = "parts.csv"' in (tmp_path / "robosmi.toml").read_text()
    assert run("migrate", program, "-o", tmp_path / "new").code == 0
    (tmp_path / "robosmi.toml").write_text(f'[bind]\nP3 = "{wire}"\n')
    said = run("migrate", program, "-o", tmp_path / "other")
    assert said.code == 2
    assert "no drawing is given" in said.err
    assert "--hardware" in said.err


def test_one_undo_puts_plan_project_file_and_sketch_back_and_again_forth(out: Path, program: Path) -> None:
    project = program.parent / "robosmi.toml"
    states = [(tree(out), project.read_text())]
    choose(out, {"leftQTI": "D10"})
    states.append((tree(out), project.read_text()))
    assert states[0] != states[1]
    assert str(project) in undo(out).restored
    assert (tree(out), project.read_text()) == states[0]
    undo(out)
    assert (tree(out), project.read_text()) == states[1]


def test_undo_stops_at_a_project_file_that_was_changed_since(out: Path, program: Path) -> None:
    choose(out, {"leftQTI": "D10"})
    (program.parent / "robosmi.toml").write_text("# otherwise\n")
    before = tree(out)
    with pytest.raises(StoppedError, match=r"robosmi\.toml"):
        undo(out)
    assert tree(out) == before


def test_migrate_adopts_what_the_plan_says_and_changes_nothing(out: Path, program: Path) -> None:
    answers = {
        "leftQTI": "D10", "rightQTI": "D11", "abdrive.left_servo": "BasicServo2WriteP1", "abdrive.right_servo": "D9",
        "Basic Servo1": "ServoEasing",
    }  # fmt: skip
    choose(out, answers, why="so it is built")
    (program.parent / "robosmi.toml").write_text('[migrate]\nhardware = "line_following_robot.fzz"\n')  # the plan alone knows
    before = chosen(out, "port:leftQTI")
    outcome = run("migrate", program, "-o", out, "--json")
    assert outcome.code == 0, outcome.err
    assert outcome.result["plan"]["open_choices"] == 0
    after = chosen(out, "port:leftQTI")
    assert [after[key] for key in ("chosen", "by", "at", "why")] == [before[key] for key in ("chosen", "by", "at", "why")]
    first = tree(out)
    assert run("migrate", program, "-o", out).code == 0
    assert tree(out) == first


def test_an_edit_of_a_choice_in_the_plan_is_no_hand_edit_and_any_other_is(out: Path, program: Path) -> None:
    plan = out / "models" / "plan.xmi"
    text = plan.read_text()
    edited = text.replace('open="true" name="leftQTI"', 'connection="//@connections.2" name="leftQTI"')
    assert edited != text
    plan.write_text(edited)
    assert run("generate", plan, "-o", out).code == 0
    outcome = run("migrate", program, "-o", out, "--json")
    assert outcome.code == 0, outcome.err
    assert next(b for b in outcome.result["plan"]["bindings"] if b["name"] == "leftQTI")["chosen_by"] == "person"
    plan.write_text(plan.read_text().replace('name="line_follower"', 'name="other"'))
    assert run("migrate", program, "-o", out).code == 5


def test_flag_project_file_and_plan_count_in_this_order_and_a_finding_says_so(out: Path, program: Path) -> None:
    project = program.parent / "robosmi.toml"
    choose(out, {"leftQTI": "D10"})
    project.write_text(project.read_text().replace('"D10"', '"D11"'))
    outcome = run("migrate", program, "-o", out, "--json")
    assert next(b for b in outcome.result["plan"]["bindings"] if b["name"] == "leftQTI")["pin"] == "D11"
    (said,) = [f["message"] for f in outcome.document["findings"] if f["rule"] == "RS413"]
    assert "D11 from robosmi.toml" in said
    assert "HIH40302ReadP1" in said
    outcome = run("migrate", program, "-o", out, "--json", "--bind", "P6=D4")
    assert next(b for b in outcome.result["plan"]["bindings"] if b["name"] == "leftQTI")["pin"] == "D4"
    assert "D4 from the command line" in next(f["message"] for f in outcome.document["findings"] if f["rule"] == "RS413")


def test_the_plan_counts_more_than_history(out: Path, program: Path) -> None:
    choose(out, {"Basic Servo1": "none"})
    (program.parent / "robosmi.toml").write_text('[migrate]\nhardware = "line_following_robot.fzz"\n')
    History().record("3234DBDC80leg", "Basic Servo", "ServoEasing")
    outcome = run("migrate", program, "-o", out, "--json")
    by = {c["subject"]: (c["chosen"], c["by"]) for c in outcome.result["plan"]["choices"] if c["kind"] == "library"}
    assert (by["Basic Servo1"], by["Basic Servo2"]) == (("none", "person"), ("ServoEasing", "history"))


def test_a_choice_that_does_not_fit_any_more_is_said_and_left_out(out: Path, program: Path) -> None:
    choose(out, {"leftQTI": "D10"})
    (program.parent / "robosmi.toml").write_text('[migrate]\nhardware = "line_following_robot.fzz"\n')
    program.write_text(program.read_text().replace("leftQTI", "eye"))
    outcome = run("migrate", program, "-o", out, "--json")
    assert outcome.code == 0, outcome.err
    assert ["the port 'leftQTI'" in f["message"] for f in outcome.document["findings"] if f["rule"] == "RS414"] == [True]


@pytest.mark.parametrize("how", ["moved", "changed"])
def test_without_its_source_a_choice_stays_in_the_plan_and_that_is_said(
    how: str, out: Path, program: Path, tmp_path: Path
) -> None:
    project = program.parent / "robosmi.toml"
    before = project.read_text()
    if how == "moved":
        shutil.move(out, tmp_path / "elsewhere")
        out = tmp_path / "elsewhere"
    else:
        program.write_text(program.read_text() + "\n// more\n")
    outcome = run("choose", out, "leftQTI=D10", "--json")
    assert outcome.code == 0, outcome.err
    assert outcome.rules() >= {"RS415"}
    assert outcome.result["project_file"] is None
    assert project.read_text() == before
    assert chosen(out, "port:leftQTI")["chosen"] == "HIH40302ReadP1"
    if how == "moved":
        outcome = run("choose", out, "rightQTI=D11", "--source", program, "--json")
        assert outcome.result["project_file"] == str(project)
        assert 'rightQTI = "D11"' in project.read_text()


def test_a_choice_can_be_left_open_again(out: Path, program: Path) -> None:
    before = tree(out)
    choose(out, {"leftQTI": "D10"})
    assert run("choose", out, "--reopen", "leftQTI").code == 0
    assert chosen(out, "port:leftQTI")["chosen"] is None
    assert "leftQTI" not in (program.parent / "robosmi.toml").read_text()
    assert tree(out)["line_follower/line_follower.ino"] == before["line_follower/line_follower.ino"]


def test_a_rule_gives_way_and_a_person_is_told_of_two_ports_on_one_pin(out: Path) -> None:
    choose(out, {"leftQTI": "D12"})
    assert chosen(out, "port:LED")["chosen"] is None
    done = choose(out, {"LED": "D12"})
    assert "RS702" in {finding.rule for finding in done.findings}


def test_a_plan_that_was_changed_since_it_was_seen_is_not_chosen_in(out: Path) -> None:
    seen = digest((out / "models" / "plan.xmi").read_bytes())
    choose(out, {"leftQTI": "D10"}, seen=seen)
    before = tree(out)
    with pytest.raises(StoppedError, match="changed elsewhere"):
        choose(out, {"rightQTI": "D11"}, seen=seen)
    assert tree(out) == before


@pytest.mark.parametrize(("answer", "said"), [("leftQTI=D99", "'D99' is neither"), ("leftEye=D2", "choice 'leftEye'")])
def test_what_does_not_exist_cannot_be_chosen(answer: str, said: str, out: Path) -> None:
    before = tree(out)
    outcome = run("choose", out, answer)
    assert outcome.code == 2
    assert said in outcome.err
    assert tree(out) == before
    with pytest.raises(UsageError):
        choose(out, {"Basic Servo1": "Sevro"})


def test_a_dry_run_chooses_nothing(out: Path, program: Path) -> None:
    before = tree(program.parent), tree(out)
    outcome = run("choose", out, "leftQTI=D10", "--dry-run", "--json")
    assert "leftQTI  = HIH40302ReadP1;" in outcome.result["diff"]
    assert (tree(program.parent), tree(out)) == before


def test_a_role_is_chosen_by_migrating_again_as_before(tmp_path: Path) -> None:
    folder = tmp_path / "robot"
    folder.mkdir()
    (folder / "robot.c").write_text('#include "simpletools.h"\nint eye = 3;\nint main() { while (1) { high(eye); pause(5); } }\n')
    (folder / "parts.csv").write_text("pin;part;title\nD3;Gizmo;thing\n")
    robosmi.migrate([folder / "robot.c"], folder / "out", hardware=folder / "parts.csv", target="nano")
    (role,) = [c for c in available_choices(plan_in(folder / "out")) if c.kind == "role"]
    assert (role.subject, role.chosen, role.by) == ("thing", "Input", "defaultValue")
    before = tree(folder)
    choose(folder / "out", {role.id: "Output"})
    assert '[roles]\nthing = "Output"' in (folder / "robosmi.toml").read_text()
    plan = plan_in(folder / "out")
    assert plan.targetDescription is not None
    assert (plan.connections[0].signal.name, plan.targetDescription.name) == ("write", "nano")
    (after,) = [c for c in available_choices(plan) if c.kind == "role"]
    assert (after.chosen, after.by, after.options) == ("Output", "person", role.options)
    undo(folder / "out")
    assert tree(folder) == before
    shutil.move(folder / "out", tmp_path / "moved")
    outcome = run("choose", tmp_path / "moved", f"{role.id}=Output")
    assert outcome.code == 3
    assert "write under [roles] in robosmi.toml" in outcome.err


def plan_in(out: Path) -> migration.MigrationPlan:
    """The plan in an output folder."""
    return load_models(out / "models" / "plan.xmi").plan


def test_ports_of_the_run_are_told_until_one_is_bound_that_the_text_does_not_give(tmp_path: Path) -> None:
    program, out = tmp_path / "asked.c", tmp_path / "out"
    program.write_text('#include "simpletools.h"\nint main() {\n  DIRA |= 1 << 4;\n  while (1) OUTA ^= 1 << rand();\n}\n')

    def told() -> list[str]:
        return [f.severity.name for f in plan_in(out).findings if f.rule == "RS327"]

    robosmi.migrate([program], out)
    assert told() == ["warning"]
    choose(out, {"P4": "D5"})
    assert told() == ["warning"]
    page = (out / "asked" / "MIGRATION.md").read_text()
    robosmi.migrate([program], out)
    assert (out / "asked" / "MIGRATION.md").read_text() == page
    robosmi.migrate([program], out, bind={"P7": "D6"})
    assert told() == ["info"], "other numbers do nothing"
