"""Calls in bodies of macros count at each place of use, and wait while a port that they reach is open."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from robosmi.metamodels import ccode
from robosmi.transformations.chains.analyse import analyse
from robosmi.transformations.chains.migrate import plan_migration
from robosmi.transformations.m2t.first_screen import works
from robosmi.transformations.queries.macros.expansion import MacroTexts
from robosmi.transformations.queries.plans.plan import call_sites, plan_json
from robosmi.transformations.queries.plans.waiting_calls import CallStates
from robosmi.transformations.queries.reports.work import Work

PROGRAM = Path(__file__).parent / "macro_calls" / "robot.c"
DRIVE = PROGRAM.with_name("drive.c")
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
    assert works(plan, work) == "1 call in unreadable text not counted"
    assert work.to_json()["unread_calls"] == 1
    assert {"RS102", "RS104", "RS327"} <= {f.rule for f in plan.findings}
    assert plan_migration([program], bind={"P4": "D2"}).plan.portBindings[0].sourcePin == 4


def test_analyse_and_migrate_count_the_same_calls() -> None:
    units: Any = analyse([DRIVE]).result["units"]
    counted = {c["name"]: (c["count"], c["macro_count"], c["in_macro"]) for u in units for c in u["platform_calls"]}
    assert counted == {
        "drive_speed": (0, 2, True), "high": (0, 1, True), "low": (0, 1, True), "pause": (1, 1, False), "ping_cm": (0, 2, True),
    }  # fmt: skip
    assert units[0]["user_calls"] == [{"name": "LAMP", "count": 1, "lines": [11]}]
    plan = plan_migration([DRIVE]).plan
    assert call_sites(plan)["total"] == sum(count + made for count, made, _ in counted.values())
    adapters: Any = plan_json(plan)["adapters"]
    assert {a["name"]: (a["calls"], a["macro_calls"]) for a in adapters} == {
        name: (count, made) for name, (count, made, _) in counted.items()
    }


def test_a_drive_that_only_macros_use_has_its_servos() -> None:
    plan = plan_migration([DRIVE]).plan
    assert [b.name for b in plan.portBindings] == ["P8", "P5", "abdrive.left_servo", "abdrive.right_servo"]
    counts = CallStates(plan).counts()
    assert (counts["total"], counts["waits_for_port"]) == (8, 6)


@pytest.mark.parametrize(
    ("encoders", "not_wired", "warned"), [(("none", "none"), 2, 2), (("none", "D3"), 0, 2), (("D2", "D3"), 0, 0)]
)
def test_functions_that_need_encoders_are_not_ready_without_them(encoders: tuple[str, str], not_wired: int, warned: int) -> None:
    bound = {"left_servo": "D9", "right_servo": "D10", "left_encoder": encoders[0], "right_encoder": encoders[1]}
    plan = plan_migration([DRIVE.with_name("goto.c")], bind={f"abdrive.{name}": pin for name, pin in bound.items()}).plan
    assert CallStates(plan).counts()["not_wired"] == not_wired
    assert len([f for f in plan.findings if f.rule == "RS730"]) == warned


def test_arguments_for_dots_and_of_pasted_functions_are_moved_like_others() -> None:
    plan = plan_migration([PROGRAM.with_name("variadic.c")]).plan
    assert {b.sourcePin for b in plan.portBindings} == {4, 6, 7, 8, 9, 10, 11}
    text = PROGRAM.with_name("variadic.c").read_bytes()
    moved = [text[c.startOffset : c.endOffset] for b in plan.portBindings for c in b.changes]
    assert {b"7", b"8", b"9", b"10"} <= set(moved)
    asked = [(text[c.startOffset : c.startOffset + 5], c.replacement) for flow in plan.portFlows for c in flow.changes]
    assert {(b"i + 1", "port("), (b"11, 1", "port(")} <= set(asked)
    assert (b"6, 1)", "port(") in asked  # in the body of SOMETIMES
    assert not any(f.rule == "RS327" for f in plan.findings)
    pasted = plan_migration([PROGRAM.with_name("pasted.c")]).plan
    assert [(b.name, b.sourcePin) for b in pasted.portBindings if b.sourcePin == 12] == [("PIN", 12)]
    assert {b.sourcePin for b in pasted.portBindings} == {10, 12, 13, 14, 15}
    assert {c.replacement[:3] for b in pasted.portBindings if b.sourcePin in (10, 13, 14) for c in b.changes} == {"255"}


def test_calls_in_macros_with_what_is_no_port_are_not_ready() -> None:
    plan = plan_migration([PROGRAM.with_name("no_port.c")]).plan
    counts = CallStates(plan).counts()
    assert (counts["total"], counts["waits_for_port"]) == (5, 5)
    assert {"RS326", "RS327"} <= {f.rule for f in plan.findings}
    assert any("-6" in f.message and "-5" in f.message for f in plan.findings if f.rule == "RS326")


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("CAT(1, 2)", "12"),
        ("CAT(, x) + CAT(y, )", "x + y"),
        ("SHOW(a)", "print ( f , a )"),
        ("SHOW()", "print ( f )"),
        ("GNU(1, 2)", "low ( 1 , 2 )"),
        ("CAT(G, NU)(3)", "low ( 3 )"),
    ],
)
def test_macros_stand_for_what_the_preprocessor_makes(text: str, meant: str) -> None:
    macros = {
        "CAT": ccode.Macro(name="CAT", functionLike=True, parameters=["a", "b"], body="a##b"),
        "SHOW": ccode.Macro(name="SHOW", functionLike=True, parameters=["..."], body="print(f, ##__VA_ARGS__)"),
        "GNU": ccode.Macro(name="GNU", functionLike=True, parameters=["args..."], body="low(args)"),
    }
    assert (MacroTexts(macros).expanded(text) or "").split() == meant.split()
