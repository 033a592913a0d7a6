"""Variables that a missing header declares: arrays of several dimensions, of records, of pointers, and pointers."""

from __future__ import annotations

from pathlib import Path

import robosmi
from tests.running import run

PROGRAM = Path(__file__).parent / "missing_header" / "robot.c"


def test_each_variable_is_in_the_model_and_has_a_task() -> None:
    plan = robosmi.plan_migration([PROGRAM]).plan
    made = {use.name: use.placeholder for use in plan.symbolUses}
    assert set(made) == {"grid", "pts", "rows", "total", "speed", "cube"}
    assert "[4][4]" in made["grid"]
    assert "[4][4][4]" in made["cube"]
    assert {"RS101", "RS102"}.isdisjoint(run("analyse", PROGRAM, "--json").rules())
