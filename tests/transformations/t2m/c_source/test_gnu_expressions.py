"""GNU C's expressions that standard C does not have: `a ?: b` and `({ ... })`; calls and pins in them are in the model."""

from __future__ import annotations

from pathlib import Path

import pytest

import robosmi
from robosmi.metamodels import ccode
from robosmi.query import all_of_kind
from tests.running import run

CASES = Path(__file__).parent / "gnu"


@pytest.mark.parametrize(
    ("name", "calls", "ports"),
    [
        ("omitted", {"input": 2, "high": 3, "low": 2, "pause": 2, "pick": 1}, {"P0", "P1", "P3", "P5", "P6", "p", "q"}),
        ("statements", {"input": 2, "high": 2, "low": 1, "pause": 4, "toggle": 1}, {"P0", "P1", "P3", "P5"}),
    ],
)
def test_no_call_and_no_pin_is_lost(name: str, calls: dict[str, int], ports: set[str]) -> None:
    assert {"RS101", "RS102"}.isdisjoint(run("analyse", CASES / f"{name}.c", "--json").rules())
    models = robosmi.plan_migration([CASES / f"{name}.c"])
    found = [call.calleeName for call in all_of_kind(models.program, ccode.Call) if call.calleeName]
    assert {name: found.count(name) for name in calls} == calls
    assert ports <= {binding.name for binding in models.plan.portBindings}


@pytest.mark.processes
@pytest.mark.parametrize("name", ["omitted", "statements"])
def test_the_sketch_compiles(name: str, tmp_path: Path) -> None:
    robosmi.migrate([CASES / f"{name}.c"], tmp_path / "out")
    assert run("compile", tmp_path / "out").code == 0
