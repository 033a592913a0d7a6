"""Computed pins: what a program calculates with stays a number of the source, and its sketch uses the pins of the same ports."""

from __future__ import annotations

from pathlib import Path

import pytest

import robosmi
from robosmi.metamodels import ccode
from tests.fuzz.pin_programs import program
from tests.fuzz.pins import compared
from tests.tools import require_tools

PROGRAMS = Path(__file__).parent / "computed_pins"


def test_a_number_that_a_macro_compares_stays() -> None:
    plan = robosmi.plan_migration([PROGRAMS / "macro_compares.c"]).plan
    text = (PROGRAMS / "macro_compares.c").read_text()
    used = text.index("high(pin)") + len("high(")
    changes = [change for flow in plan.portFlows for change in flow.changes]
    assert {(change.rule, change.startOffset) for change in changes} == {("port-look-up", used), ("port-look-up", used + 3)}


@pytest.mark.parametrize("name", ["opened.c", "opened.cpp"])
def test_what_a_program_may_write_otherwise_than_by_name_is_known_only_at_run_time(name: str) -> None:
    program = PROGRAMS / name
    lines = enumerate(program.read_text().splitlines(), 1)
    plan = robosmi.plan_migration([program]).plan
    places = (place for finding in plan.findings if finding.rule == "RS327" for place in finding.elements)
    found = {place.line for place in places if isinstance(place, ccode.Located)}
    assert sorted(found) == [number for number, line in lines if line.endswith("// ?")]


def test_numbers_whose_further_use_is_not_followed_stay() -> None:
    program = PROGRAMS / "kept.cpp"
    plan = robosmi.plan_migration([program]).plan
    numbered = program.read_text().index("enum {"), program.read_text().index("};")
    changes = [change for flow in plan.portFlows for change in flow.changes]
    assert len(changes) >= 8
    assert [change for change in changes if numbered[0] < change.startOffset < numbered[1]] == []


@pytest.mark.exhaustive
@pytest.mark.processes
@pytest.mark.parametrize("seed", range(1, 9))
def test_random_programs_use_their_pins(seed: int, tmp_path: Path) -> None:
    require_tools("gcc")
    text, ending = program(seed)
    assert compared(text, ending, tmp_path).verdict in ("same", "run time", "unsure", "told", "without meaning")
