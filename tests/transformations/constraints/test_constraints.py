"""Each constraint: an example that satisfies it, one that does not, its entry in the documentation, its fix."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from robosmi.metamodels import ccode, hardware, migration
from robosmi.plugins import registry
from robosmi.report.rules import finding_rules
from robosmi.transformations.constraints.code import code
from robosmi.transformations.constraints.hardware import circuit
from robosmi.transformations.constraints.plan import plan
from robosmi.transformations.constraints.plan_edits import edits
from robosmi.transformations.constraints.plan_ports import by_words, ports
from robosmi.transformations.queries.plans.plan import binding_json
from robosmi.transformations.queries.plans.port_pins import bound_pin, port_text
from robosmi.validate import EVL, Constraint, Validation
from tests.transformations.constraints.examples import EXAMPLES

SETS: dict[type, EVL] = {migration.MigrationPlan: plan, ccode.Program: code, hardware.Circuit: circuit}
ALL: list[Constraint] = [
    c for one in (*SETS.values(), edits, ports, by_words) for context in one.contexts for c in context.constraints
]
ROOT = Path(__file__).parents[3]


def checked(model: Any, **options: Any) -> Validation:
    return SETS[type(model)].run(model, **options)


def rules(result: Validation) -> list[str]:
    return [u.constraint.id for u in result.unsatisfied]


def test_every_constraint_has_its_examples_and_no_other() -> None:
    ids = [c.id for c in ALL]
    assert len(ids) == len(set(ids))
    assert set(ids) == set(EXAMPLES)


@pytest.mark.parametrize("rule", EXAMPLES)
def test_the_passing_example_satisfies_all_constraints(rule: str) -> None:
    assert rules(checked(EXAMPLES[rule][0]())) == []


@pytest.mark.parametrize("rule", EXAMPLES)
def test_the_failing_example_gives_that_finding_alone(rule: str) -> None:
    result = checked(EXAMPLES[rule][1]())
    assert rules(result) == [rule]
    (finding,) = result.findings()
    assert finding.message
    assert finding.element
    assert finding.fix


@pytest.mark.parametrize("constraint", ALL, ids=lambda c: c.id)
def test_the_severity_is_the_documented_one(constraint: Constraint) -> None:
    table = (ROOT / "docs" / "reference" / "rules.md").read_text(encoding="utf-8")
    (level,) = re.findall(rf"^\| {constraint.id} \| (\w+) \|", table, re.MULTILINE)
    assert constraint.severity.name == level


@pytest.mark.parametrize("rule", ["RS704", "RS705"])
def test_a_fix_mends_what_it_is_for(rule: str) -> None:
    model = EXAMPLES[rule][1]()
    assert [a.error for a in checked(model, fix="first").fixed] == [None]
    assert rules(checked(model)) == []


OF = {"plan": (plan, edits, ports, by_words), "code": (code,), "hardware": (circuit,)}


@pytest.mark.parametrize(("subject", "sets"), OF.items(), ids=list(OF))
def test_the_meaning_of_a_rule_on_models_begins_with_its_model(subject: str, sets: tuple[EVL, ...]) -> None:
    known = finding_rules(ROOT)
    ids = [c.id for one in sets for context in one.contexts for c in context.constraints if c.id[:3] == "RS7"]
    assert ids
    assert [i for i in ids if not known[i].meaning.startswith(f"{subject}: ")] == []


def test_the_sets_are_registered_by_the_name_of_their_metamodel() -> None:
    for root, constraints in SETS.items():
        assert registry().get("constraints", root.eClass.ePackage.name) is constraints  # type: ignore[attr-defined]


def test_a_name_that_is_defined_twice_is_judged_anew_in_another_model() -> None:
    bad, good = EXAMPLES["RS713"][1](), EXAMPLES["RS713"][0]()
    assert rules(checked(bad)) == ["RS713"]
    bad.units[0].declarations[0].name = "other"
    assert rules(checked(bad)) == []
    assert rules(checked(good)) == []


def test_where_pin_and_connection_differ_all_follow_the_connection_whose_name_the_sketch_has() -> None:
    model = EXAMPLES["RS704"][1]()
    (binding,) = [b for b in model.portBindings if b.connection is not None and b.pin is not b.connection.pin]
    assert bound_pin(binding) is binding.connection.pin
    assert binding_json(binding)["pin"] == (binding.connection.pin.label if binding.connection.pin is not None else None)
    assert port_text(binding) == binding.connection.name
