"""The first screen of a report: folders of a program with what its MIGRATION.md begins with; and that all its numbers add up.

A case is a folder with a program, perhaps a wiring and a `robosmi.toml`, and `expected.md`: the report as far as the findings.
"""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.metamodels import migration
from robosmi.transformations.m2t.first_screen import LINES
from robosmi.transformations.queries.plans.plan import open_choices
from robosmi.transformations.queries.plans.verdicts import VERDICTS, constructs
from tests.running import run, tree
from tests.tools import require_tools
from tests.transformations.m2t.truth import report_faults

CASES = sorted(path for path in (Path(__file__).parent / "reports").iterdir() if path.is_dir())


def made(case: Path, output: Path) -> Any:
    """The migration of a case."""
    return robosmi.migrate(sorted(case.glob("*.c")), output)


def text_of(result: Any) -> str:
    """Its report."""
    return str(result.contents[f"{result.models.plan.name}/MIGRATION.md"].decode())


@pytest.fixture(scope="module", params=CASES, ids=lambda case: str(case.name))
def case(request: pytest.FixtureRequest) -> Path:
    """Each case."""
    return Path(request.param)


@pytest.fixture(scope="module")
def result(case: Path, tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Each case, migrated."""
    return made(case, tmp_path_factory.mktemp(case.name) / "out")


def test_the_first_screen_is_what_a_person_plans_with(case: Path, result: Any) -> None:
    first = text_of(result).partition("## Findings")[0]
    assert first == (case / "expected.md").read_text()


def test_the_first_screen_has_room_on_a_screen(result: Any) -> None:
    begun = re.split(r"^## (?:Findings|\w+, continued)$", text_of(result), maxsplit=1, flags=re.MULTILINE)[0]
    assert len(begun.rstrip().splitlines()) <= LINES


def test_the_numbers_of_report_json_and_plan_are_the_same(result: Any) -> None:
    assert report_faults(result.models.plan, result.result()["plan"], text_of(result)) == []


def test_each_list_is_whole_and_each_task_in_one(result: Any) -> None:
    ticks = Counter(re.findall(r"^- \[ \] (.*)$", text_of(result), re.MULTILINE))
    assert set(ticks.values()) <= {1}
    plan = result.models.plan
    assert len(ticks) == len(plan.tasks) + len(plan.checks)


def test_what_is_bound_works_and_what_is_open_waits(tmp_path: Path) -> None:
    case = next(case for case in CASES if case.name == "open_ports")
    before = made(case, tmp_path / "before").result()["plan"]["work"]
    assert (before["calls"]["working"], before["calls"]["waits_for_port"]) == (1, 5)  # pause alone needs no pin
    flags = {answer["subject"]: answer["flag"] for answer in before["decide"]["answers"]}
    assert flags["lamp"] == "--bind lamp=PIN"
    pins = {subject: f"D{number}" for number, subject in enumerate(flags, 2)}
    after: Any = robosmi.migrate(sorted(case.glob("*.c")), tmp_path / "after", bind=pins).result()["plan"]
    assert after["work"]["calls"]["working"] == after["work"]["calls"]["total"] == 6
    assert after["work"]["decide"]["open"] == after["open_choices"] == 0
    assert after["verdicts"]["needs_you"] == 0


def test_what_the_first_screen_says_to_type_is_taken_by_the_project_file(tmp_path: Path) -> None:
    case = next(case for case in CASES if case.name == "open_ports")
    folder = tmp_path / "project"
    folder.mkdir()
    (folder / "robot.c").write_bytes((case / "robot.c").read_bytes())
    plan: Any = robosmi.migrate([folder / "robot.c"], tmp_path / "out").result()["plan"]
    answers = plan["work"]["decide"]["answers"]
    lines = [a["robosmi_toml"]["line"].replace("PIN", f"D{number}") for number, a in enumerate(answers, 2)]
    assert {a["robosmi_toml"]["table"] for a in answers} == {"bind"}
    (folder / "robosmi.toml").write_text("[bind]\n" + "\n".join(lines) + "\n")
    again = robosmi.migrate([folder / "robot.c"], tmp_path / "out")
    assert not open_choices(again.models.plan)


def test_a_check_that_was_ticked_stays_ticked(tmp_path: Path) -> None:
    case = next(case for case in CASES if case.name == "wired")
    output = tmp_path / "out"
    report = output / "robot" / "MIGRATION.md"
    made(case, output)
    report.write_text(report.read_text().replace("- [ ] 'eye'", "- [x] 'eye'") + "\nThe eye looks down a bit.\n")
    again = made(case, output)
    assert [task.done for task in again.models.plan.checks if "'eye'" in task.message] == [True]
    assert "- [x] 'eye'" in report.read_text()
    assert report.read_text().endswith("The eye looks down a bit.\n")
    assert again.result()["plan"]["work"]["check"]["done"] == 1


def test_the_worst_that_is_known_of_a_construct_is_its_verdict(tmp_path: Path) -> None:
    case = next(case for case in CASES if case.name == "missing_hardware")
    result = made(case, tmp_path / "out")
    found = {c.title: c for c in constructs(result.models.plan, result.models.files)}
    assert found["function badge_setup"].verdict == "not_supported"
    assert found["name LARGE"].verdict == "adapted"
    assert (found["function gauge_open"].verdict, found["function gauge_open"].effort) == ("needs_you", "small")
    assert found['#include "sys/unknown_thing.h"'].verdict == "needs_you"
    assert found['#include "badgetools.h"'].verdict == "adapted"
    assert found['oledprint("Hello");'].verdict == "retained"
    assert {c.verdict for c in found.values()} <= set(VERDICTS)


def test_a_warning_about_a_place_makes_its_construct_one_with_care(tmp_path: Path) -> None:
    case = next(case for case in CASES if case.name == "open_ports")
    result = made(case, tmp_path / "out")
    plan, files = result.models.plan, result.models.files
    unit = plan.program.units[0]
    pause = next(
        d.element
        for d in plan.dispositions
        if "pause" in files[unit.path][d.element.startOffset : d.element.endOffset].decode()[:5]
    )
    warning = migration.PlanFinding(
        rule="RS311", severity=migration.SeverityLevel.warning, message="too wide", path=unit.path, line=pause.line
    )
    plan.findings.append(warning)
    found = next(c for c in constructs(plan, files) if c.element is pause)
    assert (found.verdict, found.reason) == ("adapted_with_care", "too wide")


def test_a_compiled_program_says_what_it_takes_until_it_changes(tmp_path: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr")
    folder, output = tmp_path / "project", tmp_path / "out"
    folder.mkdir()
    source = folder / "robot.c"
    source.write_bytes((Path(__file__).parent / "reports" / "open_ports" / "robot.c").read_bytes())
    robosmi.migrate([source], output)
    compiled = run("compile", output, "--json").result
    plan: Any = robosmi.migrate([source], output).result()["plan"]
    needs = plan["needs"]
    assert (needs["compiled"]["flash_bytes"], needs["compiled"]["ram_bytes"]) == (compiled["flash_bytes"], compiled["ram_bytes"])
    report = (output / "robot" / "MIGRATION.md").read_text()
    assert f"flash {compiled['flash_bytes']} of {compiled['flash_limit']} bytes, RAM {compiled['ram_bytes']}" in report
    before = tree(output)
    robosmi.migrate([source], output)
    robosmi.generate_sketch(output / "models" / "plan.xmi", output)
    assert tree(output) == before
    source.write_text(source.read_text().replace("pause(50)", "pause(60)"))
    again: Any = robosmi.migrate([source], output).result()["plan"]
    assert again["needs"]["compiled"] is None
    assert "compiled" not in (output / "robot" / "MIGRATION.md").read_text().partition("## ")[0]
