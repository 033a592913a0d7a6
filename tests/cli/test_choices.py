"""Where a choice comes from: flag, then project file, then history, then a rule above the limit, then open."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from robosmi.project import defaults
from robosmi.recommend.history import History
from tests.running import Outcome, run, tree

SERVO = "Basic Servo1"


def plan_of(outcome: Outcome) -> Any:
    """The plan of a run that went well."""
    assert outcome.code == 0, outcome.err
    return outcome.result["plan"]


def library(plan: Any, component: str) -> Any:
    """The library choice for a component."""
    return next(choice for choice in plan["libraries"] if choice["component"] == component)


def binding(plan: Any, name: str) -> Any:
    """The binding of a port."""
    return next(port for port in plan["bindings"] if port["name"] == name)


def without(project: Path, *words: str) -> None:
    """Take the lines that begin with these words out of a project file."""
    lines = project.read_text().splitlines(keepends=True)
    kept = [line for line in lines if not line.startswith(words)]
    assert len(kept) < len(lines)
    project.write_text("".join(kept))


def test_a_library_of_the_project_file_is_taken(line_follower: Path, tmp_path: Path) -> None:
    choice = library(plan_of(run("migrate", line_follower, "-o", tmp_path / "out", "--json")), SERVO)
    assert (choice["library"], choice["header"], choice["chosen_by"], choice["open"]) == ("Servo", "Servo.h", "person", False)


def test_a_flag_counts_more_than_the_project_file(line_follower: Path, tmp_path: Path) -> None:
    outcome = run(
        "migrate", line_follower, "-o", tmp_path / "out", "--library", f"{SERVO}=ServoEasing", "--bind", "leftQTI=D11", "--json"
    )
    plan = plan_of(outcome)
    assert library(plan, SERVO)["library"] == "ServoEasing"
    assert library(plan, "Basic Servo2")["library"] == "Servo"
    assert (binding(plan, "leftQTI")["pin"], binding(plan, "leftQTI")["connection"]) == ("D11", "HIH40301ReadP1")
    sketch = (tmp_path / "out" / "line_follower" / "line_follower.ino").read_text()
    assert "#include <Servo.h>" in sketch  # the one that the adapters use
    assert "const int32_t leftQTI  = HIH40301ReadP1;" in sketch


def test_the_project_file_counts_more_than_history(line_follower: Path, tmp_path: Path) -> None:
    History().record("3234DBDC80leg", "Basic Servo", "ServoEasing")
    assert library(plan_of(run("migrate", line_follower, "-o", tmp_path / "out", "--json")), SERVO)["library"] == "Servo"


def test_history_chooses_where_nobody_said_anything(line_follower: Path, tmp_path: Path) -> None:
    without(line_follower.parent / "robosmi.toml", f'"{SERVO}"')
    History().record("3234DBDC80leg", "Basic Servo", "ServoEasing")
    choice = library(plan_of(run("migrate", line_follower, "-o", tmp_path / "out", "--json")), SERVO)
    assert (choice["library"], choice["chosen_by"]) == ("ServoEasing", "history")


def test_history_of_a_target_with_other_libraries_does_not_choose(line_follower: Path, tmp_path: Path) -> None:
    without(line_follower.parent / "robosmi.toml", f'"{SERVO}"')
    for target in ("avr-c", "a target that there is no more"):
        History().record("3234DBDC80leg", "Basic Servo", "ServoEasing", target=target)
    plan = plan_of(run("migrate", line_follower, "-o", tmp_path / "out", "--dry-run", "--json"))
    assert library(plan, SERVO)["chosen_by"] == "rule"
    candidates = run("recommend", line_follower.parent / "line_following_robot.fzz", "--json").result["recommendations"]
    assert all(c["candidates"][0]["library"] != "ServoEasing" for c in candidates)
    History().record("3234DBDC80leg", "Basic Servo", "ServoEasing", target="nano")
    plan = plan_of(run("migrate", line_follower, "-o", tmp_path / "other", "--json"))
    assert (library(plan, SERVO)["library"], library(plan, SERVO)["chosen_by"]) == ("ServoEasing", "history")


def test_a_choice_of_one_run_is_history_for_the_next_and_counted_once(line_follower: Path, tmp_path: Path) -> None:
    for _ in range(3):
        assert run("migrate", line_follower, "-o", tmp_path / "out").code == 0
    assert History().choices("3234DBDC80leg", "Basic Servo") == {"Servo": 2}  # two servos are drawn
    project = line_follower.parent / "robosmi.toml"
    without(project, '"Basic Servo')
    choice = library(plan_of(run("migrate", line_follower, "-o", tmp_path / "other", "--json")), SERVO)
    assert (choice["library"], choice["chosen_by"]) == ("Servo", "history")


def test_the_ranking_chooses_where_it_is_sure(line_follower: Path, tmp_path: Path) -> None:
    without(line_follower.parent / "robosmi.toml", '"Basic Servo')
    plan = plan_of(run("migrate", line_follower, "-o", tmp_path / "out", "--json"))
    servo, led, sensor = library(plan, SERVO), library(plan, "Red (633nm)-LED1"), library(plan, "HIH4030 1")
    assert (servo["library"], servo["open"], servo["chosen_by"]) == ("Servo", False, "rule")
    assert servo["confidence"] >= 0.8
    assert (led["decision"], led["library"], led["open"], led["chosen_by"]) == ("none", None, False, "rule")
    assert (sensor["decision"], sensor["library"], sensor["open"]) == ("optional", None, False)
    assert sensor["candidates"][0]["library"] == "HIH4030"
    assert "#include <Servo.h>" in (tmp_path / "out" / "line_follower" / "line_follower.ino").read_text()
    assert History().entries() == [], "what a rule chose is no choice of a person"


def test_what_nobody_chose_stays_open_with_candidates_and_a_task(
    line_follower: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(defaults()["choices"], "limit", 1.01)
    without(line_follower.parent / "robosmi.toml", '"Basic Servo')
    outcome = run("migrate", line_follower, "-o", tmp_path / "out", "--json")
    choice = library(plan_of(outcome), SERVO)
    assert (choice["library"], choice["open"], choice["chosen_by"]) == (None, True, "nobody")
    assert len(choice["candidates"]) >= 5
    assert any(t["rule"] == "RS401" and SERVO in t["message"] for t in outcome.document["tasks"])
    assert "#include <Servo" not in (tmp_path / "out" / "line_follower" / "line_follower.ino").read_text()


def test_none_is_a_choice_too(line_follower: Path, tmp_path: Path) -> None:
    outcome = run("migrate", line_follower, "-o", tmp_path / "out", "--library", f"{SERVO}=none", "--json")
    choice = library(plan_of(outcome), SERVO)
    assert (choice["library"], choice["open"], choice["chosen_by"]) == (None, False, "person")


def test_a_port_is_bound_by_a_person_before_a_rule(line_follower: Path, tmp_path: Path) -> None:
    by_rule = binding(plan_of(run("migrate", line_follower, "-o", tmp_path / "a", "--json")), "LED")
    by_person = binding(plan_of(run("migrate", line_follower, "-o", tmp_path / "b", "--bind", "LED=D13", "--json")), "LED")
    assert (by_rule["pin"], by_rule["chosen_by"]) == ("D12", "rule")
    assert (by_person["pin"], by_person["connection"], by_person["chosen_by"]) == ("D13", None, "person")
    assert "const int32_t LED      = 13;" in (tmp_path / "b" / "line_follower" / "line_follower.ino").read_text()


def test_a_port_may_be_bound_to_a_mapping_by_name(line_follower: Path, tmp_path: Path) -> None:
    outcome = run("migrate", line_follower, "-o", tmp_path / "out", "--bind", "LED=Red633nmLED1WriteP1", "--json")
    assert binding(plan_of(outcome), "LED")["pin"] == "D12"


def test_a_component_may_be_named_by_its_model_index(line_follower: Path, tmp_path: Path) -> None:
    outcome = run("migrate", line_follower, "-o", tmp_path / "out", "--library", "#1014=ServoEasing", "--json")
    choice = library(plan_of(outcome), SERVO)
    assert (choice["component_model_index"], choice["library"]) == ("1014", "ServoEasing")


def test_the_target_of_a_flag_counts_more_than_the_project_file(line_follower: Path, tmp_path: Path) -> None:
    project = line_follower.parent / "robosmi.toml"
    project.write_text(project.read_text().replace('target = "uno"', 'target = "nowhere"'))
    assert run("migrate", line_follower, "-o", tmp_path / "out").code == 2
    assert run("migrate", line_follower, "-o", tmp_path / "out", "--target", "uno").code == 0


def test_the_drawing_of_a_flag_counts_more_than_the_project_file(line_follower: Path, tmp_path: Path, cases: Path) -> None:
    outcome = run("migrate", line_follower, "-o", tmp_path / "out", "--hardware", cases / "no_board.fz")
    assert outcome.code == 3
    assert "no_board.fz" in outcome.err


def test_without_a_drawing_ports_stay_open_and_a_sketch_is_made(cases: Path, tmp_path: Path) -> None:
    outcome = run("migrate", cases / "first_main.c", "-o", tmp_path / "out", "--json")
    assert plan_of(outcome)["libraries"] == []
    assert "RS210" in outcome.rules()
    assert (tmp_path / "out" / "first_main" / "first_main.ino").is_file()
    assert not (tmp_path / "out" / "models" / "hardware.xmi").exists()


def test_a_role_of_the_project_file_counts(line_follower: Path) -> None:
    drawing = next(line_follower.parent.glob("*.fzz"))
    project = line_follower.parent / "robosmi.toml"
    project.write_text(project.read_text() + '\n[roles]\n"#1014" = "Decoration"\n')
    mappings = run("hardware", drawing, "--json").result["mappings"]
    assert SERVO not in {m["component"] for m in mappings}
    assert "Basic Servo2" in {m["component"] for m in mappings}


@pytest.mark.parametrize(
    ("words", "cause", "hint"),
    [
        (["--library", "Basic Servoo1=Servo"], "no component is called 'Basic Servoo1'", "did you mean 'Basic Servo1'?"),
        (["--library", "#9999=Servo"], "no component is called '#9999'", "use one of"),
        (["--library", "Basic Servo1=Sevro"], "unknown library 'Sevro'", "did you mean 'Servo'?"),
        (["--library", "Basic Servo1"], "not of the form NAME=VALUE", "write --library"),
        (["--library", "=Servo"], "not of the form NAME=VALUE", "write --library"),
        (["--library", "Basic Servo1=A", "--library", "Basic Servo1=B"], "two values", "give only one of them"),
        (["--bind", "leftQTl=D10"], "no port of the program", "did you mean 'leftQTI'?"),
        (["--bind", "leftQTI=D77"], "neither a pin of Arduino Uno nor a mapping", "did you mean 'D7'?"),
        (["--target", "unoo"], "unknown target 'unoo'", "did you mean 'uno'?"),
        (["--source-platform", "propellor"], "unknown source platform 'propellor'", "did you mean 'propeller'?"),
        (["--adapters", "some"], "invalid choice", "--help"),
    ],
)
def test_a_choice_that_means_nothing_is_wrong_usage_with_advice(
    words: list[str], cause: str, hint: str, line_follower: Path, tmp_path: Path
) -> None:
    before = tree(tmp_path)
    outcome = run("migrate", line_follower, "-o", tmp_path / "out", *words)
    assert outcome.code == 2
    assert cause in outcome.err
    assert hint in outcome.err
    assert tree(tmp_path) == before


def test_an_ambiguous_title_is_wrong_usage_and_lists_the_indices(cases: Path, tmp_path: Path) -> None:
    outcome = run(
        "migrate", cases / "first_main.c", "--hardware", cases / "two_servos.fz", "-o", tmp_path / "out", "--library", "Arm=Servo"
    )
    assert outcome.code == 2
    assert "2 components are called 'Arm'" in outcome.err
    assert "#2 " in outcome.err
    assert "#3 " in outcome.err
    assert not (tmp_path / "out").exists()


def test_of_two_components_with_one_title_the_index_names_one(cases: Path, tmp_path: Path) -> None:
    plan = plan_of(
        run(
            "migrate",
            cases / "first_main.c",
            "--hardware",
            cases / "two_servos.fz",
            "-o",
            tmp_path / "out",
            "--library",
            "#3=Servo",
            "--json",
        )
    )
    assert {c["component_model_index"]: c["chosen_by"] for c in plan["libraries"]} == {"2": "rule", "3": "person"}


def test_a_library_without_a_drawing_is_wrong_usage(cases: Path, tmp_path: Path) -> None:
    outcome = run("migrate", cases / "first_main.c", "-o", tmp_path / "out", "--library", "Arm=Servo")
    assert outcome.code == 2
    assert "no drawing is given" in outcome.err


def test_an_unknown_ranker_is_wrong_usage(line_follower: Path) -> None:
    outcome = run("recommend", next(line_follower.parent.glob("*.fzz")), "--ranker", "tfdif")
    assert outcome.code == 2
    assert "did you mean 'tfidf'?" in outcome.err
