"""RS109 of a function that the program declares says the declaration, and speaks of no inference."""

from __future__ import annotations

from pathlib import Path

from robosmi.transformations.chains.migrate import plan_migration

PROGRAM = Path(__file__).parents[1] / "m2t" / "cases" / "declared_elsewhere" / "input" / "declared.c"


def test_a_function_that_is_only_declared_is_said_as_the_program_declares_it() -> None:
    said = [str(f.message) for f in plan_migration([PROGRAM]).plan.findings if f.rule == "RS109"]
    assert "the program declares the function kick as void kick(void), but no file defines it" in said
    assert not any("inferred" in message for message in said)
