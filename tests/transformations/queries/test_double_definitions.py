"""What two files of a program define is told where the first of them has it, and nothing that a linker joins."""

from __future__ import annotations

from pathlib import Path

import robosmi

PROGRAM = Path(__file__).parent / "double_definitions" / "first.c"


def test_what_two_files_define_is_told_with_both_places_and_is_left_to_do() -> None:
    lines = PROGRAM.read_text(encoding="utf-8").splitlines()
    told = {number for number, line in enumerate(lines, 1) if line.endswith("// told")}
    plan = robosmi.plan_migration([PROGRAM]).plan
    found = [finding for finding in plan.findings if finding.rule == "RS342"]
    assert {finding.line for finding in found} == told
    assert [finding.message.partition(":")[0] for finding in found] == [
        "'speed' is also defined in second.c",
        "'begin' is also defined in second.c",
    ]
    assert [task.line for task in plan.tasks if task.rule == "RS504"] == [finding.line for finding in found]


def test_the_files_of_one_program_define_each_name_once(tmp_path: Path) -> None:
    alone = tmp_path / "first.c"
    alone.write_bytes(PROGRAM.read_bytes())
    (tmp_path / "shared.h").write_bytes((PROGRAM.parent / "shared.h").read_bytes())
    assert [f for f in robosmi.plan_migration([alone]).plan.findings if f.rule == "RS342"] == []
