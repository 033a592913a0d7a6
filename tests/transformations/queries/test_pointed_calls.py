"""The functions that calls through pointers may reach, as the comments of a program say, and the stack that they take."""

from __future__ import annotations

from pathlib import Path

from robosmi.metamodels import ccode
from robosmi.query import all_contents
from robosmi.transformations.chains.migrate import plan_migration
from robosmi.transformations.queries.flows.pointed_calls import is_pointed, pointed_calls
from robosmi.transformations.queries.reports.board_needs import board_needs, needs_in_words
from robosmi.transformations.queries.resources.memory import memory

PROGRAM = Path(__file__).parent / "pointed_calls" / "tables.c"
MARK = "// reaches:"
LARGE = 500
"""Bytes of the array in the function that only a table leads to."""


def test_each_call_through_a_pointer_reaches_the_functions_that_its_line_names() -> None:
    lines = PROGRAM.read_text(encoding="utf-8").splitlines()
    wanted = {n: sorted(line.partition(MARK)[2].split()) for n, line in enumerate(lines, 1) if MARK in line}
    plan = plan_migration([PROGRAM]).plan
    assert plan.program is not None
    elements = list(all_contents(plan.program))
    reached = pointed_calls(elements)
    calls = [each for each in elements if isinstance(each, ccode.Call) and is_pointed(each)]
    assert {int(call.line): sorted(str(f.name) for f in reached[id(call)]) for call in calls} == wanted


def test_the_stack_has_what_a_table_leads_to_and_names_what_is_not_known() -> None:
    plan = plan_migration([PROGRAM]).plan
    assert memory(plan).depth > LARGE
    (line,) = memory(plan).unfollowed
    assert f", without calls through pointers (line {line})" in needs_in_words(board_needs(plan))
