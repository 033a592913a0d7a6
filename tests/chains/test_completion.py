"""The plan is completed before its report is generated, and each command generates the program and the report once."""

from __future__ import annotations

import hashlib
import shutil
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from robosmi.metamodels import migration
from robosmi.plugin_contracts import ContentKind
from robosmi.plugins import content
from robosmi.transformations.chains.migrate import plan_migration
from robosmi.transformations.chains.page import PlanPage
from robosmi.transformations.chains.stages import completion, output
from robosmi.transformations.chains.stages.completion import Completed, completion_chain
from robosmi.transformations.m2t.program_files import report_file
from robosmi.verify.toolchains.build_record import BuildRecord
from tests.running import run
from tests.tools import require_verification

ONCE = {"program": 1, "report": 1}
PROGRAM = Path(__file__).parents[1] / "transformations" / "t2m" / "c_source" / "refused_text" / "robot.c"


@pytest.fixture
def runs(monkeypatch: pytest.MonkeyPatch) -> Counter[str]:
    """How often the program and the report were generated."""
    counts = Counter[str]()

    def counted(kind: ContentKind, name: str) -> Callable[..., Any]:
        function = content(kind, name)

        def generate(*given: Any) -> Any:
            counts["program"] += 1
            return function(*given)

        return generate

    def reported(*given: Any) -> Any:
        counts["report"] += 1
        return report_file(*given)

    monkeypatch.setattr(completion, "content", counted)
    monkeypatch.setattr(output, "report_file", reported)
    return counts


def compiled(out: Path, name: str) -> None:
    """Store the record that `compile` writes beside a program."""
    files = [path for path in (out / name).iterdir() if path.suffix != ".md"]
    sources = {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in files}
    sizes = {"flash_bytes": 4321, "flash_limit": 32256, "ram_bytes": 321, "ram_limit": 2048}
    (out / "build").mkdir()
    (out / "build" / f"{name}.build.json").write_bytes(BuildRecord("uno", True, (), sources, "", sizes).to_bytes())


def commands(program: Path, out: Path) -> Iterator[tuple[str, tuple[Any, ...]]]:
    """Commands on one output folder, each after something was done to it."""
    migrate, plan = ("migrate", program, "-o", out), out / "models" / "plan.xmi"
    yield "first run", migrate
    yield "second run", migrate
    name = program.stem
    sketch, adapters, report = (out / name / each for each in (f"{name}.ino", "adapters.h", "MIGRATION.md"))
    sketch.write_text(sketch.read_text().replace("void loop() {\n", "void loop() {\n  mine();\n"))
    yield "an edited statement", migrate
    adapters.write_text(adapters.read_text().replace("  // TODO: complete method\n", "  int mine = 1;\n", 1))
    yield "a written body", migrate
    report.write_text(report.read_text().replace("- [ ]", "- [x]", 1))
    yield "a ticked task", migrate
    compiled(out, name)
    yield "a build", migrate
    yield "generate", ("generate", plan, "-o", out)
    yield "dry run", (*migrate, "--dry-run")
    yield "elsewhere", ("generate", plan, "-o", out.parent / "elsewhere")


@pytest.mark.parametrize("adapters", ["filled", "placeholders"])
def test_each_command_generates_program_and_report_once(
    adapters: str, line_follower: Path, tmp_path: Path, runs: Counter[str]
) -> None:
    found = {}
    for what, command in commands(line_follower, tmp_path / "out"):
        more = ("--adapters", adapters) if command[0] == "migrate" else ()
        outcome = run(*command, *more, "--json")
        assert outcome.code in (0, 1), outcome.err
        found[what] = dict(runs)
        runs.clear()
    assert found == dict.fromkeys(found, ONCE)
    report = (tmp_path / "out" / "line_follower" / "MIGRATION.md").read_text()
    assert "4321" in report, "the last build is not in the report"
    assert ("you wrote" in report) == (adapters == "placeholders")


def test_a_program_with_lines_that_a_compiler_refuses_is_generated_once(tmp_path: Path, runs: Counter[str]) -> None:
    outcome = run("migrate", PROGRAM, "-o", tmp_path / "out", "--json")
    assert "RS337" in outcome.rules()
    assert dict(runs) == ONCE


def test_a_conflict_and_its_report_are_generated_once(migrated: Path, line_follower: Path, runs: Counter[str]) -> None:
    sketch = migrated / "line_follower" / "line_follower.ino"
    sketch.write_text(sketch.read_text().replace("drive_speed(0, 0)", "drive_speed(2, 2)"))
    line_follower.write_text(line_follower.read_text().replace("drive_speed(0, 0)", "drive_speed(1, 1)"))
    assert "RS511" in run("migrate", line_follower, "-o", migrated, "--json").rules()
    assert dict(runs) == ONCE
    before = {path: path.read_bytes() for path in migrated.rglob("*") if path.is_file()}
    run("generate", migrated / "models" / "plan.xmi", "-o", migrated)
    assert {path: path.read_bytes() for path in migrated.rglob("*") if path.is_file()} == before


def test_what_is_chosen_or_ticked_on_the_page_is_generated_once(robot: Path, runs: Counter[str]) -> None:
    page = PlanPage(robot / "out")
    assert page.act("choose", {"id": "port:eye", "value": "D4", "plan": page.now()})["state"] == "saved"
    assert dict(runs) == ONCE
    runs.clear()
    report = (robot / "out" / "blink" / "MIGRATION.md").read_text()
    assert "`RS340`" in report
    page.document(live=True, nonce="n")
    tick = page.sections["check"].split('data-tick="')[1].split('"')[0].replace("&#x27;", "'").replace("&#39;", "'")
    assert page.act("tick", {"tick": tick, "done": True, "plan": page.now()})["state"] == "saved"
    assert dict(runs) == ONCE
    runs.clear()
    assert run("choose", robot / "out", "port:eye=D5", "--json").code in (0, 1)
    assert dict(runs) == ONCE


def test_a_verdict_is_added_to_the_report_of_the_same_program(tmp_path: Path, runs: Counter[str]) -> None:
    require_verification()
    shutil.copytree(PROGRAM.parents[3] / "verification" / "programs", tmp_path / "in")
    outcome = run("migrate", tmp_path / "in" / "button.c", "-o", tmp_path / "out", "--verify", "--json")
    assert {"RS850", "RS851", "RS852"} & outcome.rules()
    assert dict(runs) == {"program": 1, "report": 2}


def test_completing_changes_no_decision_and_writes_nothing(line_follower: Path, tmp_path: Path) -> None:
    models = plan_migration([line_follower])
    plan = models.plan
    decisions = [*plan.portBindings, *plan.libraryChoices, *plan.dispositions, *plan.portFlows]
    before = [(d.choice, d.chosenBy, d.open, d.confidence) for d in decisions]
    done = completion_chain().start(models=models, output=tmp_path / "out").value("completed", Completed)
    assert done.models is models
    assert [(d.choice, d.chosenBy, d.open, d.confidence) for d in decisions] == before
    assert not (tmp_path / "out").exists()
    tasks = [(task.rule, task.message) for task in plan.tasks]
    again = completion_chain().start(models=models, output=tmp_path / "out").value("completed", Completed)
    assert [(task.rule, task.message) for task in again.models.plan.tasks] == tasks
    assert again.kept.files == done.kept.files


def test_a_step_of_the_completion_can_be_another_one(tmp_path: Path) -> None:
    chain = completion_chain()
    chain.replace("find what a compiler refuses", _nothing)
    done = chain.start(models=plan_migration([PROGRAM]), output=tmp_path / "out").value("completed", Completed)
    assert "RS337" not in {finding.rule for finding in done.models.plan.findings}


def _nothing() -> list[migration.PlanFinding]:
    return []
