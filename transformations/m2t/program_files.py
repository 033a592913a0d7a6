"""The files of a program for any target, as rules of EGX: the program's units, its adapters, and its report by itself.

A generator names its templates and gives the values for its project file. Each rule makes a file from a template; values that a
template needs beyond the plan are prepared by the module of that file. Templates name their parts, so that every generated line
is traced to its elements and to the step of the method that made it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from msgspec import Struct

from robosmi.data_text import Json
from robosmi.errors import UsageError
from robosmi.generate import Gen, Generation
from robosmi.metamodels import ccode, migration
from robosmi.transformations.m2t.adapters import adapter_pieces, adapters, made_apart, with_own_types
from robosmi.transformations.m2t.bench_sketch import bench
from robosmi.transformations.m2t.first_screen import Counted
from robosmi.transformations.m2t.port_table import port_table
from robosmi.transformations.m2t.program_text import file_name, own_header, program_text
from robosmi.transformations.m2t.task_list import report
from robosmi.transformations.queries.circuit import pin_literal
from robosmi.transformations.queries.plan import target_of
from robosmi.transformations.queries.source_text import ADAPTERS_FILE, SourceText, is_header
from robosmi.transformations.queries.text_changes import all_changes

BENCH = "bench"
"""The folder beside the program that contains the sketch for testing components on the bench."""
REPORT = "MIGRATION.md"
"""The name of the report in the program's folder."""


class ProgramTemplates(Struct, frozen=True):
    """The templates of a target's files.

    Attributes:
        unit: template of a unit that is compiled.
        header: template of an own header.
        adapters: template of the adapters.
        project: template of the project file.
        project_file: name of the project file.
        more: further project files for other tools: name -> template.
        bench: template of the sketch that tests components on the bench; empty for a target without one.
    """

    unit: str
    header: str
    adapters: str
    project: str
    project_file: str
    more: Mapping[str, str] = {}
    bench: str = ""


def program_files(
    plan: migration.MigrationPlan, sources: Mapping[str, bytes], templates: ProgramTemplates, project: Mapping[str, Any]
) -> Generation:
    """The files of a program, their paths relative to the output folder; nothing is written.

    Args:
        plan: a plan with its decisions.
        sources: path of a unit -> its bytes.
        templates: of the target's files.
        project: what the project file shows beyond the plan.

    Raises:
        RuleError: a template is wrong.
        UsageError: a sketch for the bench is wanted, and the target has none.
    """
    if plan.bench and not templates.bench:
        name = target_of(plan).name
        fix = "leave out --bench, or choose a board as the target, as in --target uno -o OTHER"
        raise UsageError(f"the target '{name}' has no sketch for the bench", fix=fix)
    g = Gen()
    assert plan.program is not None
    late, changes = with_own_types(plan), all_changes(plan)
    texts = {unit: SourceText(unit, sources[unit.path], changes) for unit in plan.program.units}

    @g.rule(
        domain=plan.program.units,
        template=lambda u: templates.header if is_header(u) else templates.unit,
        target=lambda u: f"{plan.name}/{file_name(u, plan)}",
    )
    def Program(unit: ccode.SourceUnit) -> dict[str, Any]:
        text = texts[unit]
        return (
            own_header(plan, text)
            if is_header(unit)
            else {"plan": plan, "literal": pin_literal, **program_text(plan, text, late, texts)}
        )

    @g.rule(template=templates.adapters, target=f"{plan.name}/{ADAPTERS_FILE}")
    def Adapters() -> dict[str, Any]:
        listed = adapters(plan, made_apart(plan))
        return {
            "plan": plan,
            **adapter_pieces(plan),
            "ports": port_table(plan),
            "adapters": [a for a in listed if a.use not in late],
            "renamed": [use for use in plan.adapterUses if use.targetName not in ("", use.name)],
        }

    @g.rule(template=templates.project, target=f"{plan.name}/{templates.project_file}")
    def Project() -> Mapping[str, Json]:
        return {"plan": plan, **project}

    @g.rule(domain=list(templates.more), template=lambda name: templates.more[name], target=lambda name: f"{plan.name}/{name}")
    def Tools(_: str) -> Mapping[str, Json]:
        return {"plan": plan, **project}

    trial = f"{plan.name}_bench"
    benches = [trial] if plan.bench else []
    suffix = target_of(plan).fileSuffix

    @g.rule(domain=benches, template=templates.bench, target=f"{BENCH}/{trial}/{trial}{suffix}")
    def Bench(_: str) -> dict[str, Any]:
        return {"plan": plan, **bench(plan)}

    @g.rule(domain=benches, template=templates.project, target=f"{BENCH}/{trial}/{templates.project_file}")
    def BenchProject(_: str) -> Mapping[str, Json]:
        return {"plan": plan, **project, "libraries": [], "chosen": []}

    return g.make()


def report_file(plan: migration.MigrationPlan, sources: Mapping[str, bytes], known: Counted) -> Generation:
    """The report of a migration, its path relative to the output folder; nothing is written.

    Args:
        plan: a complete plan.
        sources: path of a unit -> its bytes.
        known: what was counted of the plan.

    Raises:
        RuleError: the template is wrong.
    """
    g = Gen()

    @g.rule(template="report/migration.md.j2", target=f"{plan.name}/{REPORT}")
    def Report() -> dict[str, Any]:
        return {"plan": plan, **report(plan, sources, known)}

    return g.make()
