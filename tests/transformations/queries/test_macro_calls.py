"""Calls in bodies of macros count at each place of use, and wait while a port that they reach is open."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.transformations.chains.migrate import plan_migration
from robosmi.transformations.queries.plan import call_sites
from robosmi.transformations.queries.waiting_calls import CallStates

PROGRAM = Path(__file__).parent / "macro_calls" / "robot.c"
ALL = {"P7": "D2", "BUTTON": "D3", "P26": "D4"}


@pytest.mark.parametrize(
    ("bound", "waiting", "not_wired"),
    [
        ({}, 5, 0),
        ({"P7": "D2"}, 3, 0),
        ({"BUTTON": "D3"}, 4, 0),
        ({"P26": "D4"}, 3, 0),
        (ALL, 0, 0),
        (ALL | {"P26": "none"}, 0, 2),
    ],
)
def test_calls_in_macros_wait_for_the_ports_that_they_reach(bound: dict[str, str], waiting: int, not_wired: int) -> None:
    plan = plan_migration([PROGRAM], bind=bound).plan
    counts = CallStates(plan).counts()
    assert (counts["total"], counts["waits_for_port"], counts["not_wired"]) == (7, waiting, not_wired)
    assert call_sites(plan)["total"] == counts["total"]
