"""The sketch folder of a migration plan: the generator registered for Arduino targets, as rules of EGX (paper 3.4).

It reads the plan, the models it refers to and the stored sources, and nothing else; it decides nothing. Each rule makes a
file by a template; what a template shows beyond the plan is prepared by the module of that file. Templates name their parts,
so that every generated line is traced to its elements and to the step of the method that made it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from robosmi.generate import Gen, Generation
from robosmi.metamodels import ccode, migration
from robosmi.transformations.m2t.adapters import adapters, made_apart, with_own_types
from robosmi.transformations.m2t.program_text import file_name, own_header, program_text
from robosmi.transformations.m2t.sketch_project import project
from robosmi.transformations.m2t.task_list import report
from robosmi.transformations.queries.circuit import pin_literal
from robosmi.transformations.queries.source_text import SourceText, is_header
from robosmi.transformations.queries.text_changes import all_changes


def generate(plan: migration.MigrationPlan, sources: Mapping[str, bytes]) -> Generation:
    """The files of the sketch, their paths relative to the output folder; nothing is written.

    Args:
        plan: a complete plan.
        sources: path of a unit -> its bytes.

    Raises:
        RuleError: a template is wrong.
    """
    g = Gen()
    assert plan.program is not None
    late, changes = with_own_types(plan), all_changes(plan)
    texts = {unit: SourceText(unit, sources[unit.path], changes) for unit in plan.program.units}

    @g.rule(
        domain=plan.program.units,
        template=lambda u: "arduino/own_header.h.j2" if is_header(u) else "arduino/sketch.ino.j2",
        target=lambda u: f"{plan.name}/{file_name(u, plan)}",
    )
    def Program(unit: ccode.SourceUnit) -> dict[str, Any]:
        text = texts[unit]
        return own_header(text) if is_header(unit) else {"plan": plan, "literal": pin_literal, **program_text(plan, text, late)}

    @g.rule(template="arduino/adapters.h.j2", target=f"{plan.name}/adapters.h")
    def Adapters() -> dict[str, Any]:
        listed = adapters(plan, made_apart(plan))
        return {
            "plan": plan,
            "adapters": [a for a in listed if a.use not in late],
            "renamed": [a for a in listed if a.name not in ("", a.use.name)],
        }

    @g.rule(template="arduino/sketch.yaml.j2", target=f"{plan.name}/sketch.yaml")
    def Project() -> dict[str, Any]:
        return {"plan": plan, **project(plan)}

    @g.rule(template="report/migration.md.j2", target=f"{plan.name}/MIGRATION.md")
    def Report() -> dict[str, Any]:
        return {"plan": plan, **report(plan)}

    return g.make()
