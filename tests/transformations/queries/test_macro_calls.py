"""Calls in bodies of macros count at each place of use, and wait while a port that they reach is open."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.transformations.chains.migrate import plan_migration
from robosmi.transformations.m2t.first_screen import works
from robosmi.transformations.queries.plan import call_sites
from robosmi.transformations.queries.waiting_calls import CallStates
from robosmi.transformations.queries.work import Work

PROGRAM = Path(__file__).parent / "macro_calls" / "robot.c"
NESTED = PROGRAM.with_name("nested.c")
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


def test_a_macro_within_a_macro_gives_calculated_ports() -> None:
    plan = plan_migration([NESTED], bind={"P1": "D2", "P7": "D3", "P8": "D4"}).plan
    assert [b.name for b in plan.portBindings] == ["P1", "P2", "P7", "P8", "P15"]
    counts = CallStates(plan).counts()
    assert (counts["total"], counts["waits_for_port"]) == (5, 2)  # those at P2 and P15
    bound = plan_migration([NESTED], bind={"P1": "D2", "P2": "none", "P7": "D3", "P8": "D4", "P15": "D5"}).plan
    assert CallStates(bound).counts()["not_wired"] == 1


@pytest.mark.parametrize("name", ["eight_levels.c", "eight_blocks.c"])
def test_eight_doubling_macros_are_256_calls(name: str) -> None:
    plan = plan_migration([NESTED.parent / name]).plan
    assert [b.sourcePin for b in plan.portBindings] == list(range(32))
    counts = CallStates(plan).counts()
    assert (counts["total"], counts["waits_for_port"]) == (256, 256)  # 224 of them have a number that no port has
    assert {f.rule for f in plan.findings} & {"RS102", "RS104"} == set()
    assert any(f.rule == "RS326" and "and 220 more" in f.message for f in plan.findings)


def test_macros_that_become_too_much_are_said_not_to_be_counted(tmp_path: Path) -> None:
    text = NESTED.with_name("eight_levels.c").read_text(encoding="utf-8")
    more = "".join(f"#define B{n}(x) B{n - 1}(x); B{n - 1}(x + {2 ** (n - 1)})\n" for n in range(9, 17))
    program = tmp_path / "program.c"
    program.write_text(text.replace("\nint main", f"{more}\nint main").replace("B8(0)", "B16(0)"), encoding="utf-8")
    plan = plan_migration([program]).plan
    work = Work(plan)
    assert works(plan, work) == "nothing is known: 1 call in text that could not be read is not counted"
    assert work.to_json()["unread_calls"] == 1
    assert {"RS102", "RS104", "RS327"} <= {f.rule for f in plan.findings}
    assert plan_migration([program], bind={"P4": "D2"}).plan.portBindings[0].sourcePin == 4
