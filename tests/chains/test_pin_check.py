"""RS345: a wrong pin in a finished program is found in the text itself, whatever made it."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from robosmi.metamodels import migration
from robosmi.transformations.chains.migrate import plan_migration
from robosmi.transformations.chains.stages import completion
from robosmi.transformations.chains.stages.compiler_errors import parsed_program
from robosmi.transformations.chains.stages.models import MigrationModels
from robosmi.transformations.queries.plans.port_pins import PIN_RULE

CASES = Path(__file__).parent / "pin_faults"
PROGRAM = CASES / "robot.c"
FAULTS = tomllib.loads((CASES / "faults.toml").read_text())["fault"]


def fired(models: MigrationModels, old: str = "", new: str = "") -> list[migration.PlanFinding]:
    """What the check finds in the program of a plan in which one place is changed."""
    texts = {file.name: file.after or "" for file in completion.program(models).files}
    main = next(name for name in texts if name.endswith(".ino"))
    if old:
        assert texts[main].count(old) == 1, f"{old!r} is {texts[main].count(old)} times in the program"
        texts[main] = texts[main].replace(old, new)
    return completion.pin_check(models, parsed_program(models.plan, texts))


@pytest.fixture(scope="module")
def models() -> MigrationModels:
    return plan_migration([PROGRAM])


def test_a_right_program_has_no_finding(models: MigrationModels) -> None:
    assert [f.message for f in fired(models)] == []


@pytest.mark.parametrize("fault", FAULTS, ids=[fault["name"] for fault in FAULTS])
def test_each_planted_fault_is_found(fault: dict[str, str], models: MigrationModels) -> None:
    found = fired(models, fault["old"], fault["new"])
    assert found
    assert {f.rule for f in found} == {PIN_RULE}


def test_a_change_that_the_plan_lost_is_found() -> None:
    models = plan_migration([PROGRAM])
    next(b for b in models.plan.portBindings if b.sourcePin == 4).changes.clear()
    assert fired(models)


def test_a_look_up_that_the_plan_lost_is_found() -> None:
    models = plan_migration([PROGRAM])
    next(flow for flow in models.plan.portFlows if flow.changes).changes.clear()
    assert fired(models)
