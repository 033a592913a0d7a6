"""Dispositions as rules of ETL: each rule has a program in which it speaks, and the trace is that of the transformation."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.metamodels import ccode, migration
from robosmi.query import all_contents, all_of_kind, all_of_type
from robosmi.transform import Trace
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.platforms.target_platform import target_facts
from robosmi.transformations.m2m.partition.dispositions import Known, dispositions
from robosmi.transformations.queries.code import views
from robosmi.transformations.queries.program_model import ProgramModel

PROGRAMS = Path(__file__).parent / "programs"
SOURCES = {
    "every_verdict": [PROGRAMS / "every_verdict" / name for name in ("every_verdict.c", "wheel.c")],
    "whole_main": [PROGRAMS / "whole_main.c"],
    "left_main": [PROGRAMS / "left_main.c"],
    "own_header": [Path(__file__).parents[2] / "cli" / "own_header" / "signal.c"],
}


@pytest.fixture(params=[pytest.param(name, marks=pytest.mark.processes) if name == "own_header" else name for name in SOURCES])
def plan(request: pytest.FixtureRequest) -> migration.MigrationPlan:
    """The plan of each program."""
    made: migration.MigrationPlan = planned(request.param)
    return made


@cache
def planned(name: str) -> Any:
    """The plan of a program, which no test changes."""
    return robosmi.plan_migration(SOURCES[name]).plan


def judged(plan: migration.MigrationPlan) -> list[tuple[str, migration.Disposition]]:
    """Rule and disposition of each trace link that leads to a disposition."""
    assert plan.trace is not None
    return [(k.rule, d) for k in plan.trace.links for d in k.targets if isinstance(d, migration.Disposition)]


@pytest.mark.processes
def test_every_rule_speaks_in_one_of_the_programs() -> None:
    spoken = {rule for name in SOURCES for rule, _ in judged(planned(name))}
    program = planned("every_verdict").program
    code = ProgramModel(views(program, ApiIndex.load("propeller")))
    rules = dispositions(code, Known(code._views[0].api, target_facts("uno"), (), (), ()))
    assert spoken == {rule.name for module in rules.modules() for rule in module.rules}


@pytest.mark.parametrize(
    ("line", "rule", "verdict"),
    [
        (2, "PlatformInclude", "drop platform-include"),
        (3, "StandardInclude", "retain standard-include"),
        (5, "ConditionalInclude", "retain conditional-include"),
        (7, "MissingInclude", "unsupported posix-include"),
        (8, "UnknownInclude", "unsupported unknown-include"),
        (9, "OwnHeader", "retain own-header"),
        (12, "MainPrototype", "drop main-prototype"),
        (24, "HoistedLocal", "hoist hoist-local"),
        (25, "SplitLocal", "hoist hoist-local-split"),
        (29, "MainRepeated", "retain main-repeated"),
        (33, "Unreachable", "drop unreachable"),
    ],
)
def test_the_verdict_on_a_line(line: int, rule: str, verdict: str) -> None:
    found = [
        (r, d) for r, d in judged(planned("every_verdict")) if isinstance(d.element, ccode.Located) and d.element.line == line
    ]
    assert (rule, verdict) in [(r, f"{d.action.name} {'+'.join(d.rules)}") for r, d in found]


@pytest.mark.parametrize(
    ("line", "rule", "verdict", "function"),
    [
        (6, "SplitLocal", "hoist hoist-local-split", ""),
        (6, "LocalBeside", "hoist hoist-local-beside", ""),
        (7, "EndOfMain", "rewrite end-of-main", "end_of_main"),
        (9, "LeaveMainLoop", "rewrite leave-main-loop", "after_loop"),
        (10, "EndOfMain", "rewrite value-and-end-of-main", "end_of_main"),
        (13, "MainAfter", "retain main-after", ""),
        (14, "EndOfMain", "rewrite end-of-main", "end_of_main"),
    ],
)
def test_what_leaves_the_loop_goes_on_in_a_function(line: int, rule: str, verdict: str, function: str) -> None:
    found = [(r, d) for r, d in judged(planned("left_main")) if isinstance(d.element, ccode.Located) and d.element.line == line]
    assert (rule, verdict, function) in [(r, f"{d.action.name} {'+'.join(d.rules)}", d.goesOnIn) for r, d in found]
    after = [d for _, d in found if isinstance(d.element, ccode.Located) and d.element.line > 12]
    assert [d.runsIn for d in after] == ["after_loop"] * (line > 12)


def test_each_disposition_has_one_link_from_its_element(plan: migration.MigrationPlan) -> None:
    assert plan.trace is not None
    trace = Trace.of_model(plan.trace)
    for disposition in plan.dispositions:
        (link,) = trace.links_to(disposition)
        assert link.sources == (disposition.element,)
        assert link.step == "code"
        assert trace.equivalents(disposition.element, migration.Disposition)[0] is disposition


def test_dispositions_stand_in_the_order_of_the_model(plan: migration.MigrationPlan) -> None:
    assert plan.program is not None
    places = {id(element): place for place, element in enumerate(all_contents(plan.program))}
    rules = {id(d): rule for rule, d in judged(plan)}
    order = [places[id(d.element)] for d in plan.dispositions if rules[id(d)] != "Rewritten"]
    assert order == sorted(order)
    assert [rules[id(d)] == "Rewritten" for d in plan.dispositions] == sorted(
        rules[id(d)] == "Rewritten" for d in plan.dispositions
    )


@pytest.mark.parametrize("kind", [ccode.Include, ccode.Statement, ccode.Declaration, ccode.Program, ccode.Located])
def test_the_model_for_rules_has_the_extents_of_the_program(kind: Any) -> None:
    program = planned("every_verdict").program
    code = ProgramModel(views(program, ApiIndex.load("propeller")))
    assert list(code.all_contents()) == list(all_contents(program))
    assert list(code.all_of_kind(kind)) == list(all_of_kind(program, kind))
    assert list(code.all_of_type(kind)) == list(all_of_type(program, kind))
    for element in list(code.all_of_kind(kind))[:5]:
        assert code.owns(element)
        assert code.element(code.id_of(element)) is element
    assert not code.owns(ccode.Include(header="x"))


def test_a_header_of_functions_with_adapters_is_no_task(tmp_path: Path) -> None:
    """The target has neither header; what the first two declare has adapters."""
    source = tmp_path / "sleeper.c"
    source.write_text("#include <unistd.h>\n#include <sys/time.h>\n#include <fcntl.h>\nint main() { sleep(1); }\n")
    plan = robosmi.plan_migration([source]).plan
    said = {d.element.header: d.rules[0] for _, d in judged(plan) if isinstance(d.element, ccode.Include)}
    assert said == {"unistd.h": "platform-include", "sys/time.h": "platform-include", "fcntl.h": "posix-include"}
    assert [task.message.split(" was ")[0] for task in plan.tasks if task.rule == "RS503"] == ["'fcntl.h'"]
