"""The chain `completion`: generates the program of a decided plan, and completes the plan with what follows from its text.

The program is generated once, from the decisions alone. Which lines a compiler refuses, what the user has written and whether
the last build is still that of this program depend on its text: these are inputs of the last step, which adds findings, tasks
and sizes to the plan. Nothing is written here. `migrate`, `generate` and `choose` share this chain; `output` generates the
report from the completed plan and writes everything.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from msgspec import Struct

from robosmi.chain import Chain
from robosmi.generate import Generation
from robosmi.generate.last_generated import MergedTexts
from robosmi.generate.manifest import Manifest
from robosmi.generate.merge_edits import CONFLICT
from robosmi.generate.output_paths import Places
from robosmi.generate.record import Record
from robosmi.generate.result import FileChange
from robosmi.metamodels import migration
from robosmi.plugin_contracts import wrong_result
from robosmi.plugins import content
from robosmi.transformations.chains.stages.build_sizes import stored_build_sizes
from robosmi.transformations.chains.stages.compiler_errors import (
    RULE as REFUSED,
    compiler_errors,
    parsed_program,
    source_place,
)
from robosmi.transformations.chains.stages.conflicts import conflicts
from robosmi.transformations.chains.stages.models import LAST, MigrationModels
from robosmi.transformations.chains.stages.pin_check import pin_findings
from robosmi.transformations.chains.stages.user_edits import UserEdits, find_user_edits
from robosmi.transformations.chains.stages.user_includes import set_own_libraries
from robosmi.transformations.m2m.plan_tasks import settle_tasks
from robosmi.transformations.queries.plans.plan import target_of
from robosmi.transformations.queries.plans.port_pins import PIN_RULE
from robosmi.transformations.queries.reports.written_bodies import task_key
from robosmi.transformations.t2m.c_source.parsing.generated_program import GeneratedProgram
from robosmi.transformations.verification.judgement.stored_verdict import StoredVerdict, set_verdict, stored_verdict


class OutputFolder(Struct):
    """The output folder as it is before a run writes into it.

    Attributes:
        path: the folder.
        manifest: what the last run wrote there.
        places: its files.
    """

    path: Path
    manifest: Manifest
    places: Places


class Completed(Struct):
    """A completed migration, of which nothing is written yet.

    Attributes:
        models: the models; their plan is complete but for the lines of the written files in its trace.
        folder: the output folder.
        program: the files of the program, as generated.
        edits: the user's edits in the program that is there.
        kept: the merge of the program with these edits; the report is still to be added.
    """

    models: MigrationModels
    folder: OutputFolder
    program: Generation
    edits: UserEdits
    kept: MergedTexts


def completion_chain(made: Generation | None = None) -> Chain:
    """The steps from the models of a decided plan, `models`, and an output folder, `output`, to the value `completed`.

    Args:
        made: the program, if it was generated from these decisions already.
    """
    chain = Chain(None, "completion")
    chain.given("models", "output")
    chain.call(folder, makes="folder", step="look at the output folder")
    chain.call(program, makes="program", step="generate the program")
    chain.call(parsed, makes="parsed", step="parse the program")
    chain.call(compiler_findings, makes="compiler_findings", step="find what a compiler refuses")
    chain.call(pin_check, makes="pin_check", step="follow the pins through the program")
    chain.call(user_edits, makes="user_edits", step="find what the user has written")
    chain.call(whole_program, makes="whole_program", step="list the libraries that the user has included")
    chain.call(merged, makes="merged", step="merge the program with the user's edits")
    chain.call(build_sizes, makes="build_sizes", step="find the sizes of the last build")
    chain.call(verdict, makes="verdict", step="find the verdict of the last comparison")
    chain.call(completed, makes="completed", step="complete the plan")
    if made is not None:
        chain.replace("generate the program", lambda: made)
    return chain


def folder(output: Path) -> OutputFolder:
    """The output folder with the record of the last run.

    Raises:
        SourceError: the record is damaged, or there can be no folder.
    """
    return OutputFolder(output, Manifest.load(output), Places(output))


def program(models: MigrationModels) -> Generation:
    """The files of the program, as the generator of its target makes them.

    Raises:
        RobosmiError: the generator, a plug-in's perhaps, returned something else.
    """
    return _generated(models)


def _generated(models: MigrationModels) -> Generation:
    generator = content("generator", str(target_of(models.plan).generator))
    made: object = generator(models.plan, models.files)
    if isinstance(made, Generation) and all(isinstance(file, FileChange) for file in made.files):
        return made
    raise wrong_result(generator, made, "a Generation")


def parsed(models: MigrationModels, program: Generation) -> GeneratedProgram:
    """The program as a compiler of the target reads it."""
    return parsed_program(models.plan, _texts(program))


def compiler_findings(models: MigrationModels, parsed: GeneratedProgram) -> list[migration.PlanFinding]:
    """RS337: the lines of the program that a compiler of the target refuses."""
    return compiler_errors(models.plan, parsed, models.files)


def pin_check(models: MigrationModels, parsed: GeneratedProgram) -> list[migration.PlanFinding]:
    """RS345: the places of the program whose pin is not the plan's, or cannot be followed."""
    return pin_findings(models.plan, parsed, source_place(models.plan, parsed, models.files), models.files)


def user_edits(models: MigrationModels, program: Generation, folder: OutputFolder) -> UserEdits:
    """What the user has written into the program that is there, and ticked in its report."""
    record = Record(folder.path, LAST, folder.manifest.files)
    return find_user_edits(models.plan, folder.places, _texts(program), record)


def whole_program(models: MigrationModels, program: Generation, user_edits: UserEdits) -> Generation:
    """The files of the program, with the libraries that the user's code includes in its project files and in the plan."""
    return _generated(models) if set_own_libraries(models.plan, user_edits.own_includes) else program


def merged(whole_program: Generation, folder: OutputFolder, user_edits: UserEdits) -> MergedTexts:
    """The program's files with the user's edits.

    Raises:
        SourceError: a link or a folder is where a file was made.
    """
    kept = MergedTexts(folder.places, LAST, folder.manifest.files)
    kept.add(_texts(whole_program), user_edits.base)
    return kept


def build_sizes(models: MigrationModels, folder: OutputFolder, merged: MergedTexts) -> migration.Build | None:
    """The sizes of the last build of the program; None if it is not a build of these files."""
    return stored_build_sizes(folder.path, models.plan.name, merged.files)


def verdict(models: MigrationModels, folder: OutputFolder, merged: MergedTexts) -> StoredVerdict | None:
    """The verdict of the last comparison with the original; None if it was not about these files."""
    return stored_verdict(folder.path, models.plan.name, merged.files)


def completed(
    models: MigrationModels,
    folder: OutputFolder,
    whole_program: Generation,
    user_edits: UserEdits,
    merged: MergedTexts,
    compiler_findings: Sequence[migration.PlanFinding],
    pin_check: Sequence[migration.PlanFinding],
    build_sizes: migration.Build | None,
    verdict: StoredVerdict | None,
) -> Completed:
    """The models with the findings, tasks and sizes that follow from the program's text; decisions stay as they are."""
    plan = models.plan
    _replace_findings(plan, REFUSED, compiler_findings)
    _replace_findings(plan, PIN_RULE, pin_check)
    set_verdict(plan, verdict)
    for use in plan.adapterUses:
        use.written = use.adapter is None and (use.targetName or use.name) in user_edits.names
    settle_tasks(plan)
    for task in (*plan.tasks, *plan.checks):
        given = any(isinstance(e, migration.SymbolUse) and e.name in user_edits.values for e in task.elements)
        task.done = given or task_key(task.rule, task.message) in user_edits.done
    others = [task for task in plan.tasks if task.rule != CONFLICT]
    plan.tasks.clear()
    plan.tasks.extend([*conflicts(merged.files, merged.made), *others])
    plan.build = build_sizes
    return Completed(models, folder, whole_program, user_edits, merged)


def _replace_findings(plan: migration.MigrationPlan, rule: str, new: Sequence[migration.PlanFinding]) -> None:
    """Replace the plan's findings of a rule; equal ones stay where they are."""
    before = [finding for finding in plan.findings if finding.rule == rule]
    if [(f.message, f.path, f.line) for f in before] == [(f.message, f.path, f.line) for f in new]:
        return
    for finding in before:
        plan.findings.remove(finding)
    plan.findings.extend(new)


def _texts(program: Generation) -> dict[str, str]:
    return {file.name: file.after or "" for file in program.files}
