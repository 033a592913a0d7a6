"""Constraints on the move of a program: `moves/RULE_fails.c` has them where its comments say so, `moves/RULE_holds.c` nowhere.

`// RS313: 1 << 20` at the end of a line: that rule, there, about exactly this text. `// RS314` alone: one of the lines that the
finding of the file names.
"""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi import check_model, migrate
from robosmi.diagnostics import Finding, Severity
from robosmi.query import Q
from robosmi.transformations.chains.migrate import plan_migration
from robosmi.transformations.constraints.code_move import MANY, move_findings
from robosmi.transformations.constraints.code_rules import MODULES, moved
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.queries.code import views
from robosmi.transformations.queries.plans.plan import as_findings

FOLDER = Path(__file__).parent / "moves"
RULES = sorted({c.id for context in moved.contexts for c in context.constraints})
MARK = re.compile(r"// (RS\d{3})(?:: (.*?))?(?=\s*(?:// RS|$))")
Place = tuple[int, str]


def found(path: Path) -> list[Finding]:
    """The findings of the constraints about moving a program, without a drawing."""
    models = plan_migration([path], widths="keep")
    return [f for f in as_findings(Q(models.plan.findings), models.places) if f.rule in RULES]


found_once = cache(found)
"""For the programs of `moves`, which stay as they are."""


def marked(path: Path, rule: str) -> list[Place]:
    """Line and text of each place that a program's comments mark with a rule."""
    lines = path.read_text().splitlines()
    return sorted((n, text or "") for n, line in enumerate(lines, 1) for r, text in MARK.findall(line) if r == rule)


def places(path: Path, findings: list[Finding]) -> list[Place]:
    """Line and text of all places of findings."""
    lines = path.read_text().splitlines()
    ranges = []
    for f in findings:
        assert f.location is not None
        one = (f.location.line, f.location.column, f.location.end_line, f.location.end_column)
        given: Any = f.listed("places") or [one]
        ranges += [tuple(p) for p in given]
    assert all(line == end for line, _, end, _ in ranges)
    return sorted((line, lines[line - 1][column - 1 : to - 1]) for line, column, _, to in ranges)


def test_every_rule_has_its_two_programs_and_there_are_no_others() -> None:
    assert {p.stem for p in FOLDER.glob("*.c")} == {f"{r}_{what}" for r in RULES for what in ("fails", "holds")}
    assert len(MODULES) == 9


@pytest.mark.parametrize("rule", [r for r in RULES if r != "RS310"])
def test_a_rule_finds_what_is_wrong_and_exactly_there(rule: str) -> None:
    path = FOLDER / f"{rule}_fails.c"
    wanted = marked(path, rule)
    there = places(path, [f for f in found_once(path) if f.rule == rule])
    assert wanted
    if any(text for _, text in wanted):
        assert there == wanted
    else:
        assert [line for line, _ in there] == [line for line, _ in wanted]


@pytest.mark.parametrize("rule", RULES)
def test_a_rule_says_nothing_where_nothing_is_wrong(rule: str) -> None:
    assert [(f.message, f.location) for f in found(FOLDER / f"{rule}_holds.c") if f.rule == rule] == []


def test_declarations_of_int_are_counted_once_a_file() -> None:
    (finding,) = (f for f in found(FOLDER / "RS310_fails.c") if f.rule == "RS310")
    assert "3 declaration(s)" in finding.message
    assert finding.severity is Severity.info


def test_many_findings_of_a_rule_are_one_with_all_places(tmp_path: Path) -> None:
    path = tmp_path / "many.c"
    lines = "\n".join(f"  pause({n} * 40000);" for n in range(2, MANY + 3))
    path.write_text(f'#include "simpletools.h"\nint a[] = {{{"70000, " * (MANY + 1)}}};\nint main(void)\n{{\n{lines}\n}}\n')
    (finding,) = (f for f in found(path) if f.rule == "RS311")
    assert f"and {MANY} more of this kind in the file (line 2)" in finding.message
    assert len(finding.listed("places")) == MANY + 1
    few = path.read_text().replace("70000, " * (MANY + 1), "70000, " * MANY)
    path.write_text(few)
    assert sum(f.rule == "RS311" for f in found(path)) == MANY


def test_a_value_beyond_several_limits_is_told_the_narrowest(tmp_path: Path) -> None:
    program = tmp_path / "line.c"
    program.write_text(
        '#include "simpletools.h"\n#include "fdserial.h"\n#include "servo.h"\n'
        "int main() { fdserial_open(2, 3, 0, 115200); servo_angle(9, 900); }\n"
    )
    plan = robosmi.plan_migration([program], bind={"P2": "D4", "P3": "D5"}).plan
    assert ["245 to 19,200" in str(finding.message) for finding in plan.findings if finding.rule == "RS334"] == [True]


@pytest.mark.parametrize(("second", "baud", "said"), [("4, 5", 38400, 2), ("4, 5", 9600, 0), ("31, 30", 38400, 0)])
def test_two_fast_lines_are_more_than_the_target_serves_at_a_time(second: str, baud: int, said: int, tmp_path: Path) -> None:
    program = tmp_path / "lines.c"
    program.write_text(
        '#include "simpletools.h"\n#include "fdserial.h"\n'
        f"int main() {{ fdserial_open(2, 3, 0, {baud}); fdserial_open({second}, 0, {baud}); }}\n"
    )
    plan = robosmi.plan_migration([program], bind={"P2": "D4", "P3": "D5"}).plan
    messages = [str(finding.message) for finding in plan.findings if finding.rule == "RS334"]
    assert len(messages) == said
    assert all("a line loses bytes while another one is busy" in message for message in messages)


@pytest.mark.parametrize("rule", RULES)
def test_check_of_the_stored_plan_says_the_same(rule: str, tmp_path: Path) -> None:
    path = FOLDER / f"{rule}_fails.c"
    migrate([path], tmp_path, widths="keep")
    again = [f for f in check_model(tmp_path / "models" / "plan.xmi").findings if f.rule == rule]
    first = [f for f in found_once(path) if f.rule == rule]
    assert {f.message.partition("; and ")[0] for f in first} <= {f.message for f in again}
    assert again


def test_nothing_is_said_of_a_move_to_a_machine_like_the_source() -> None:
    models = plan_migration([FOLDER / "RS313_fails.c"], widths="keep")
    plan = models.plan
    assert plan.source is not None
    assert plan.target is not None
    plan.target.intBits, plan.target.charSigned, plan.target.hasCogs = plan.source.intBits, plan.source.charSigned, True
    assert plan.program is not None
    left = move_findings(plan, views(plan.program, ApiIndex.load(plan.source.name)))
    assert {f.rule for f in left} <= {"RS322", "RS324"}


def test_the_levels_are_the_documented_ones() -> None:
    table = (Path(__file__).parents[3] / "docs" / "reference" / "rules.md").read_text(encoding="utf-8")
    for context in moved.contexts:
        for constraint in context.constraints:
            (levels,) = re.findall(rf"^\| {constraint.id} \| ([\w, ]+) \|", table, re.MULTILINE)
            assert constraint.severity.name == levels.split(", ")[0]
