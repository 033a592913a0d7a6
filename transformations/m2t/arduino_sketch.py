"""The sketch folder of a migration plan: the generator registered for Arduino targets (paper 3.4, its EGL template).

It reads the plan, the models it refers to and the stored sources, and nothing else; it decides nothing. Each file is
made by a module of its own; here they are put together and every generated line is traced to its elements and to the
step of the method that made it.
"""

from __future__ import annotations

from collections.abc import Mapping

from robosmi.generate.text import GeneratedFile
from robosmi.metamodels import migration, trace
from robosmi.transformations.m2t.adapters import adapters_file
from robosmi.transformations.m2t.program_text import program_files
from robosmi.transformations.m2t.sketch_project import sketch_yaml
from robosmi.transformations.m2t.task_list import migration_report


def generate(plan: migration.MigrationPlan, sources: Mapping[str, bytes]) -> list[GeneratedFile]:
    """The files of the sketch, and the plan's text traces anew.

    Args:
        plan: a complete plan; its `trace.texts` are replaced.
        sources: path of a unit -> its bytes.

    Returns:
        The files, paths relative to the output folder.
    """
    files = [*program_files(plan, sources), adapters_file(plan), sketch_yaml(plan), migration_report(plan)]
    if plan.trace is None:
        plan.trace = trace.Trace()
    plan.trace.texts.clear()
    plan.trace.texts.extend(
        trace.TextTrace(path=file.path, line=first, endLine=last, step=part.step, rule=part.rule, elements=part.elements)
        for file in files
        for first, last, part in file.lines()
    )
    return files
