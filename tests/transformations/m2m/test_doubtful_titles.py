"""Titles that mislead are no evidence: letters of another alphabet in a word, letters without width, negations."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.metamodels import hardware, migration
from robosmi.transformations.chains.migrate import plan_migration
from robosmi.transformations.queries.circuits.component_kinds import misleading_title

CASES = Path(__file__).parent / "doubtful_titles"


@pytest.mark.parametrize(("table", "bound"), [("lookalike.csv", {"leftServo": "D9"}), ("notleft.csv", {})])
def test_a_servo_with_a_doubtful_title_is_bound_by_no_rule(table: str, bound: dict[str, str]) -> None:
    plan = plan_migration([CASES / "two.c"], hardware=CASES / table).plan
    servos = [b for b in plan.portBindings if b.name != "LED"]
    assert {b.name: b.pin.label for b in servos if b.pin is not None} == bound
    reasons = [reason for b in servos if b.open for option in b.options for reason in option.reasons]
    assert any("its title" in reason for reason in reasons)


@pytest.mark.parametrize(
    ("title", "doubtful"),
    [
        ("left servo", False), ("l\u0435ft servo", True), ("le\u200bft servo", True), ("not the left one", True),
        ("ohne Servo links", True), ("левый servo", False), ("Thermistor 10kΩ", False), ("No 1 LED", False), ("knot", False),
    ],
)  # fmt: skip
def test_which_titles_are_doubtful(title: str, doubtful: bool) -> None:
    connection = migration.Connection(name="P1", component=hardware.Component(title=title))
    assert bool(misleading_title(connection)) is doubtful
