"""The chain `completion`: generates the program of a decided plan, and completes the plan with what follows from its text.

The program is generated once, from the decisions alone. Which lines a compiler refuses, what the user has written and whether
the last build is still that of this program depend on its text: these are inputs of the last step, which adds findings, tasks
and sizes to the plan. Nothing is written here. `migrate`, `generate` and `choose` share this chain; `output` generates the
report from the completed plan and writes everything.

The user's work in the program that was generated before is taken over (`UserEdits`): a body written into a placeholder counts
as filled, a ticked task as done. Text written for a function that is no longer called stays in its file, disabled and with a
comment, so that neither it nor a tick causes a merge conflict.

Edits that could not be merged become tasks, so that the report shows them. The merge marks a conflict in the file
(`generate.merge_edits`); the marks are read back, including those of earlier runs, which remain until the user resolves them.

`compile` stores the memory use in its record beside the program. The report shows it only while every compiled file is
unchanged.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path, PurePosixPath

from msgspec import Struct

from robosmi.chain import Chain
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import RobosmiError
from robosmi.generate import Generation
from robosmi.generate.manifest import Manifest
from robosmi.generate.merge_edits import BASE, CONFLICT, GENERATED, MIDDLE, YOURS, MergedTexts
from robosmi.generate.output_paths import Places
from robosmi.generate.record import Record
from robosmi.generate.result import FileChange
from robosmi.generate.text_form import read as read_text
from robosmi.metamodels import migration
from robosmi.plugin_contracts import wrong_result
from robosmi.plugins import content
from robosmi.transformations.chains.stages.compiler_errors import (
    RULE as REFUSED,
    compiler_errors,
    parsed_program,
    source_place,
)
from robosmi.transformations.chains.stages.models import LAST, MigrationModels
from robosmi.transformations.chains.stages.pin_check import pin_findings
from robosmi.transformations.chains.stages.user_includes import (
    libraries_for,
    needed_still,
    own_includes,
    set_own_libraries,
    without_includes,
)
from robosmi.transformations.m2m.plan_tasks import settle_tasks
from robosmi.transformations.m2t.program_files import REPORT
from robosmi.transformations.queries.plans.plan import target_of
from robosmi.transformations.queries.plans.port_pins import PIN_RULE
from robosmi.transformations.queries.reports.written_bodies import (
    AS_BYTES,
    VALUE_TODO,
    Body,
    bodies,
    task_key,
    ticks,
    with_ticks,
    written,
)
from robosmi.transformations.queries.source_text import HEADERS
from robosmi.transformations.t2m.c_source.parsing.generated_program import GeneratedProgram
from robosmi.transformations.verification.judgement.stored_verdict import StoredVerdict, set_verdict, stored_verdict
from robosmi.verify.toolchains.build_record import FOLDER, record_at

_MARKS = tuple(mark.strip().encode() for mark in (YOURS, BASE, GENERATED))
_ORDER = (BASE, MIDDLE, GENERATED)

_SIZES = {"flashBytes": "flash_bytes", "flashLimit": "flash_limit", "ramBytes": "ram_bytes", "ramLimit": "ram_limit",
          "stackBytes": "stack_bytes"}  # fmt: skip

_CODE = (*HEADERS, ".ino", ".cpp", ".c")
_AWAY = "#if 0  // what you wrote for '{}', which nothing calls any more"


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
    return _find_user_edits(models.plan, folder.places, _texts(program), record)


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
    return _stored_build_sizes(folder.path, models.plan.name, merged.files)


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
    plan.tasks.extend([*_conflicts(merged.files, merged.made), *others])
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


def _conflicts(files: Mapping[str, bytes], made: Mapping[str, str]) -> list[migration.PlanTask]:
    """The conflicts that are marked in files.

    Args:
        files: relative path -> bytes of the files as they are to be written.
        made: relative path -> text, as it was made without regard to what is there.
    """
    return [
        task
        for name, data in files.items()
        if any(mark in data for mark in _MARKS)
        for task in _tasks(name, data.decode("utf-8", "replace"), made.get(name, ""))
    ]


def _tasks(name: str, text: str, made: str) -> Iterator[migration.PlanTask]:
    """The conflicts marked in a text, without marks that are part of the program itself."""
    if any(mark in made for mark in (YOURS, *_ORDER)):
        return
    lines = text.replace("\r\n", "\n").splitlines(keepends=True)
    marked = [number for number, line in enumerate(lines) if line.strip().encode() in _MARKS]
    if marked and YOURS not in lines:  # somebody has damaged the marks
        message = "a conflict's markers are damaged: decide which lines stay"
        fix = "remove its remaining markers from the file, then migrate again"
        error, line = migration.SeverityLevel.error, marked[0] + 1
        yield migration.PlanTask(rule=CONFLICT, severity=error, message=message, path=name, line=line, effort="small", fix=fix)
    at = 0
    while at < len(lines):
        if lines[at] != YOURS:
            at += 1
            continue
        first, parts = at, list[str]()
        for mark in _ORDER:
            begin = at + 1
            at = next(
                (number for number in range(begin, len(lines)) if lines[number].rstrip("\n") == mark.rstrip("\n")), len(lines)
            )
            parts.append("".join(lines[begin:at]).rstrip("\n"))
        yield migration.PlanTask(
            rule=CONFLICT,
            severity=migration.SeverityLevel.error,
            message="your edit and the newly generated text change the same lines: decide which stay",
            path=name,
            line=first + 1,
            effort="small",
            fix="both texts are listed under Conflicts; remove the markers from the file, then migrate again",
            texts=parts,
        )


def _stored_build_sizes(output: Path, name: str, files: Mapping[str, bytes]) -> migration.Build | None:
    """The sizes of a program, or None if it has not been compiled in its current state.

    Args:
        output: the output folder.
        name: of the program, which is its folder's, too.
        files: relative path -> bytes of what is made there.
    """
    try:
        record = record_at(output / FOLDER / f"{name}.build.json")
    except RobosmiError:
        return None  # a damaged record says nothing; `compile` and `upload` report it
    if record is None or not record.sizes or not _same(record.sources, name, files):
        return None
    return migration.Build(board=record.board, **{feature: record.sizes.get(key, 0) for feature, key in _SIZES.items()})


def _same(compiled: Mapping[str, str], name: str, files: Mapping[str, bytes]) -> bool:
    """Whether the compiled files equal the generated ones; the user's own additional files are ignored."""
    made = {path.removeprefix(f"{name}/"): data for path, data in files.items() if path.startswith(f"{name}/")}
    there = {path: hashlib.sha256(data).hexdigest() for path, data in made.items() if not path.endswith(".md")}
    return all(compiled.get(path) == digest for path, digest in there.items())


class UserEdits:
    """The user's work in an output folder.

    Attributes:
        names: the functions whose bodies they have written.
        values: the names whose placeholders they have defined.
        done: the tasks that they have ticked, by their subjects.
        includes: headers that are no longer generated and that their code uses, with the names used from each.
        own_includes: all headers that their code needs and that no decision of the plan brings.
        findings: messages about bodies that are no longer called, and about such headers.
    """

    def __init__(self) -> None:
        self.names: set[str] = set()
        self.values: set[str] = set()
        self.done: set[tuple[str, ...]] = set()
        self.includes: dict[str, list[str]] = {}
        self.own_includes: list[str] = []
        self.findings: list[Finding] = []

    def base(self, name: str, last: str, there: str, made: str, path: Path) -> tuple[str, str]:
        """The previously generated text and the existing one, adapted so that the merge sees no change in the person's work.

        Args:
            name: of the file, relative to the output folder.
            last: the text that was made last.
            there: the text that is there.
            made: the text that is made anew.
            path: of the file, for findings.
        """
        if PurePosixPath(name).name == REPORT:
            return with_ticks(last, {tick.key for tick in ticks(there) if tick.done}), there
        if PurePosixPath(name).suffix not in _CODE or there == last:
            return last, there
        last, kept_headers = without_includes(last, self.includes, made)
        for header in kept_headers:
            used = ", ".join(f"'{each}'" for each in self.includes[header][:3])
            message = f"the include of {header} stays because your code uses {used}; no generated code needs it"
            fix = "install its library where you compile, or remove the include and the code that uses it"
            self.findings.append(Finding("RS512", Severity.info, message, Location(str(path)), fix=fix))
        new, before = bodies(made), bodies(last)
        gone = [body for body in written(there, last).values() if body.name not in new or not new[body.name].open]
        for body in sorted(gone, key=lambda each: each.first, reverse=True):
            last, there = _without(last, before[body.name]), _without(there, body)
            before = bodies(last)
        kept = [body for body in gone if body.name not in new or _plain(new[body.name]) != _plain(body)]
        for body in kept:
            message = f"'{body.name}' is no longer called or has another body; your body is disabled at the end of the file"
            fix = "remove it, or save it for other programs (robosmi adapters save) before you change the program"
            self.findings.append(Finding("RS527", Severity.warning, message, Location(str(path)), fix=fix))
        away = [f"{_AWAY.format(body.name)}\n{body.text}\n#endif" for body in kept]
        return last, "\n\n".join([there.rstrip("\n"), *away]) + "\n" if away else there


def _plain(body: Body) -> list[str]:
    """A body in normal form, equal for a program in one file and in several."""
    return [word for word in body.code if word not in ("static", "inline")]


def _without(text: str, body: Body) -> str:
    """A text without a function and the blank line after it."""
    lines = text.split("\n")
    last = body.last + (body.last < len(lines) - 1 and not lines[body.last].strip())
    return "\n".join([*lines[: body.first], *lines[last:]])


def _find_user_edits(plan: migration.MigrationPlan, places: Places, made: Mapping[str, str], record: Record) -> UserEdits:
    """Find what the user has done in an output folder.

    Args:
        plan: the plan, which stays as it is.
        places: the output folder.
        made: relative path -> text of the program, as it is made without regard to what is there.
        record: the texts that were made last.
    """
    found, code = UserEdits(), dict[str, tuple[str, str, str]]()
    report = places.look(f"{plan.name}/{REPORT}")
    found.done = {tick.key for tick in ticks(read_text(report or b"", errors=AS_BYTES).text) if tick.done}
    for name, text in made.items():
        raw = places.look(name)
        there, last = (read_text(each or b"", errors=AS_BYTES).text for each in (raw, record.last(name, raw)[0]))
        if PurePosixPath(name).suffix in _CODE and there:
            found.names |= written(there, text, last).keys()
            found.values |= {str(symbol.name) for symbol in plan.symbolUses if _given(symbol, there, text)}
            code[name] = last, there, text
    found.includes = needed_still(code, libraries_for(plan))
    found.own_includes = list(dict.fromkeys([*own_includes(code), *found.includes]))
    return found


def _given(symbol: migration.SymbolUse, there: str, made: str) -> bool:
    """Whether the user has replaced a generated placeholder by a definition of the same name."""
    if symbol.status is not migration.AdapterStatus.todo:
        return False
    shown = str(symbol.placeholder).rpartition("\n")[2]
    lines = {line for line in made.split("\n") if line.startswith(shown) and VALUE_TODO in line}
    return bool(lines) and lines.isdisjoint(there.split("\n")) and re.search(rf"\b{re.escape(symbol.name)}\b", there) is not None
