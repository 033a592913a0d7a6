"""C that C++ refuses and that no edit mends is told, line by line, and what C++ takes is not."""

from __future__ import annotations

from pathlib import Path

import robosmi
from robosmi.transformations.m2t.first_screen import written
from robosmi.transformations.queries.reports.work import Work

CALLS = Path(__file__).parent / "refused_forms" / "main_as_function.c"
PROGRAM = Path(__file__).parent / "refused_forms" / "refused_forms.c"

CASTS = Path(__file__).parent / "programs" / "cast_values.c"


def test_each_form_that_cpp_refuses_is_told_where_it_stands_and_no_other() -> None:
    lines = PROGRAM.read_text(encoding="utf-8").splitlines()
    told = {number for number, line in enumerate(lines, 1) if line.endswith("// told")}
    plan = robosmi.plan_migration([PROGRAM]).plan
    found = [finding for finding in plan.findings if finding.rule == "RS312"]
    assert {finding.line for finding in found} == told
    assert [finding for finding in found if not finding.fix] == []
    work = Work(plan)
    assert [task.line for task in plan.tasks if task.rule == "RS504"] == [finding.line for finding in found]
    assert written(work).startswith(f"{len(work.write)} of {len(work.write)} left")


def test_calls_of_main_and_references_to_it_are_told_where_cpp_forbids_them() -> None:
    plan = robosmi.plan_migration([CALLS]).plan
    assert [finding.line for finding in plan.findings if finding.rule == "RS312"] == [3, 4]
    plain = robosmi.plan_migration([CALLS], target="avr-c").plan
    assert [finding for finding in plain.findings if finding.rule == "RS312"] == []


def test_a_local_whose_value_gets_a_cast_moves_to_the_top_without_it(tmp_path: Path) -> None:
    made = robosmi.migrate([CASTS], tmp_path / "out")
    sketch = made.sketch.joinpath("cast_values.ino").read_text(encoding="utf-8")
    for line in ("Cell *first;", "Cell *second ;", "unsigned char *third, *fourth;"):
        assert line in sketch.splitlines()
    assert not [finding for finding in made.models.plan.findings if finding.rule == "RS337"]
