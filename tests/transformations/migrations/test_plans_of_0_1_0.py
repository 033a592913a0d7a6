"""Plans that version 0.1.0 stored load in today's metamodels, and what is generated of them is what 0.1.0 generated.

`plans_0_1_0/NAME/` has the models as that version wrote them and the sketch that its `generate` made of them, without its report:
the two case studies, programs in which each kind of change of text occurs, choices by flags, and plans that a person edited.
`output_0_1_0` is an output folder as a whole.
"""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.errors import RobosmiError
from robosmi.metamodels import migration, platform
from robosmi.model.structure import walk
from robosmi.transformations.queries.text_changes import all_changes
from tests.running import run, tree
from tests.transformations.m2t.truth import report_faults

FOLDER = Path(__file__).parent / "plans_0_1_0"
OUTPUT = Path(__file__).parent / "output_0_1_0"
FOUND = {
    "line_follower": ["RS240", "RS250", "RS261", "RS310", "RS320", "RS322", "RS706"],
    "conventions": ["RS240", "RS250", "RS310", "RS322", "RS706"],
}
"""Rules of the findings of version 0.1.0's `check` for these plans."""
ACTIONS = {"retain", "adapt", "drop", "hoist", "rewrite", "unsupported"}
PLANS = sorted(path.name for path in FOLDER.iterdir())


@pytest.fixture
def stored(tmp_path: Path) -> Any:
    """A function that gives a copy of a plan's output folder as it was then."""

    def copied(name: str) -> Path:
        shutil.copytree(FOLDER / name / "models", tmp_path / "out" / "models")
        return tmp_path / "out" / "models" / "plan.xmi"

    return copied


@pytest.mark.parametrize("name", PLANS)
def test_the_sketch_is_byte_for_byte_what_it_was(name: str, stored: Any, tmp_path: Path) -> None:
    made = robosmi.generate_sketch(stored(name), tmp_path / "new")
    assert program(made.sketch) == program(FOLDER / name / "sketch")
    report = (made.sketch / "MIGRATION.md").read_text(encoding="utf-8")  # which has today's form
    told: Any = made.result()["plan"]
    assert report_faults(made.models.plan, told, report) == []


def program(folder: Path) -> dict[str, str]:
    """The files of a sketch but for its report."""
    return {name: digest for name, digest in tree(folder).items() if name != "MIGRATION.md"}


@pytest.mark.parametrize("name", PLANS)
def test_the_loaded_plan_has_all_in_todays_form(name: str, stored: Any) -> None:
    plan = robosmi.load_model(stored(name))
    elements = [*walk(plan), *walk(plan.target.eContainer())]
    assert {str(e.eClass.ePackage.nsURI).rpartition("/")[2] for e in elements} <= {"1", "2"}
    assert {type(e).__module__ for e in elements} <= {f"robosmi.metamodels.{m}" for m in ("migration", "platform", "trace")}
    assert plan.targetDescription.generator == "arduino_sketch"
    assert plan.board.eContainer() is plan.target.eContainer()
    assert [m.boardId for m in plan.target.boardMappings] == ["arduino:avr:uno"]
    assert all(rule and "+" not in rule for d in plan.dispositions for rule in d.rules)
    assert {d.choice for d in plan.dispositions} <= ACTIONS
    assert all(use.result is not None and use.targetName for use in plan.adapterUses)


def test_kept_plans_have_every_rule_that_changes_texts() -> None:
    """The fixtures are worth something: most rules of the table occur in them."""
    plans = [robosmi.load_model(FOLDER / name / "models" / "plan.xmi") for name in PLANS]
    known = [plan for plan in plans if isinstance(plan, migration.MigrationPlan)]
    rules = {change.rule for plan in known for change in all_changes(plan)}
    assert {
        "implicit-int",
        "parameters-behind",
        "rename",
        "replace",
        "convert",
        "hoist-local",
        "hoist-local-split",
        "port",
    } <= rules
    assert len(rules) >= 18, sorted(rules)


def test_generating_in_place_brings_the_stored_models_up_to_date(tmp_path: Path) -> None:
    output = tmp_path / "out"
    shutil.copytree(OUTPUT, output)
    plan = output / "models" / "plan.xmi"
    assert run("generate", plan, "-o", output).code == 0
    assert 'xmlns:migration="http://robosmi.org/migration/2"' in plan.read_text()
    assert program(output / "old") == program(OUTPUT / "old")
    before = tree(output)
    assert run("generate", plan, "-o", output).code == 0
    assert tree(output) == before


def test_the_platform_alone_loads(stored: Any) -> None:
    repository = robosmi.load_model(stored("line_follower").parent / "platform.xmi")
    assert isinstance(repository, platform.PlatformRepository)
    assert [b.name for b in repository.boards] == ["uno"]
    chip = repository.boards[0].microcontroller
    assert chip is not None
    assert chip.name == "atmega328p"


def test_a_plan_without_its_source_is_refused_with_the_file(stored: Any) -> None:
    plan = stored("old_c")
    (plan.parent / "source" / "old.c").unlink()
    with pytest.raises(RobosmiError, match="source cannot be read"):
        robosmi.load_model(plan)


@pytest.mark.parametrize("name", FOUND)
def test_check_finds_what_it_found(name: str, stored: Any) -> None:
    outcome = run("check", stored(name), "--json")
    assert sorted({finding["rule"] for finding in outcome.document["findings"]}) == FOUND[name]
