"""What need not be decided or checked: libraries that would change nothing, and ports that nothing uses on the target."""

from __future__ import annotations

from pathlib import Path

import robosmi
from robosmi.metamodels import migration
from robosmi.transformations.queries.reports.board_needs import board_needs

CASES = Path(__file__).parent / "idle"


def planned(name: str, **bind: str) -> migration.MigrationPlan:
    """The plan of a case."""
    plan: migration.MigrationPlan = robosmi.plan_migration(
        [CASES / f"{name}.c"], hardware=CASES / f"{name}.csv", bind={key.replace("__", "."): pin for key, pin in bind.items()}
    ).plan
    return plan


def test_a_part_whose_calls_need_no_library_has_none() -> None:
    plan = planned("buttons", START="D2", P26="D6")
    told = {str(c.component.title): c for c in plan.libraryChoices if c.component is not None}
    assert (told["start"].choice, told["start"].open) == ("none", False)
    assert told["start"].chosenBy is migration.ChosenBy.rule
    assert told["start"].options
    assert told["start"].evidence == ["the functions used here need none: input"]
    assert (told["other"].choice, told["other"].open) == ("none", False)
    assert told["other"].evidence == ["no function that the program calls needs one"]


def test_a_part_without_a_port_is_asked_for_while_a_body_may_use_its_library() -> None:
    (other,) = planned("unwritten").libraryChoices
    assert other.open
    assert other.options


def test_a_port_that_nothing_uses_here_is_told_and_not_checked() -> None:
    bound, free = planned("speed", abdrive__left_encoder="D6", abdrive__right_encoder="D7"), planned("speed")
    said = [str(task.message) for task in bound.tasks if task.rule == "RS331"]
    assert said == [
        f"port 'abdrive.{side}_encoder' is bound to {pin}, but no called function uses it here"
        for side, pin in (("left", "D6"), ("right", "D7"))
    ]
    assert not any("encoder" in str(check.message) for check in bound.checks)
    assert board_needs(bound).pins.used == board_needs(free).pins.used == 2


def test_a_port_that_is_used_is_checked() -> None:
    plan = planned("way", abdrive__left_encoder="D6", abdrive__right_encoder="D7")
    assert [task for task in plan.tasks if task.rule == "RS331"] == []
    assert sum("encoder" in str(check.message) for check in plan.checks) == 2
