"""From completed models to the output folder: generates the report, compares with the last run, and writes atomically.

Shared by `migrate`, `generate` and `choose`. The result has the data that a report needs.

What a run writes is checked against what is there, written all or none, and shown as a diff. No edit is lost: files of the
program were merged before (`completion`), any other file that was changed since the last run stops this one.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from contextlib import nullcontext
from datetime import date
from pathlib import Path
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from robosmi.base.data_text import Json
from robosmi.base.quantities import quantity
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import RobosmiError, StoppedError
from robosmi.files.commit import update
from robosmi.files.external_files import ExternalFiles
from robosmi.files.files import free_name
from robosmi.files.recovery import at_work, look_only
from robosmi.files.run_lock import note_place
from robosmi.generate.manifest import NAME as MANIFEST, Guarded, Manifest, hidden, reformed_file, retained_file
from robosmi.generate.output_paths import Places
from robosmi.generate.result import FileChange, Generation, TextLink
from robosmi.generate.text_form import read
from robosmi.generate.undo import save_previous
from robosmi.metamodels import migration, trace
from robosmi.model.elements.strict import Element
from robosmi.query import Q
from robosmi.recommend.history import History, HistoryEntry
from robosmi.report.notebook import Findings, findings_html, quoted
from robosmi.transformations.chains.stages.completion import Completed, completion_chain
from robosmi.transformations.chains.stages.edited_plan import STORED, digest_without_choices, only_choices_differ
from robosmi.transformations.chains.stages.models import FOLDER, LAST, MigrationModels
from robosmi.transformations.chains.stages.program import sketch_name_of
from robosmi.transformations.m2t.first_screen import Counted, counted, terminal_lines
from robosmi.transformations.m2t.program_files import BENCH, REPORT, report_file
from robosmi.transformations.queries.plans.plan import as_findings, move_json, open_choices, plan_json
from robosmi.transformations.queries.reports.work import work_json
from robosmi.transformations.verification.judgement.stored_verdict import SEVERITIES

KINDS = {
    **dict.fromkeys((".ino", ".cpp", ".c"), "sketch"),
    ".h": "adapters",
    ".yaml": "project",
    ".md": "report",
    ".xmi": "model",
}


class Generated(Struct):
    """What a migration made.

    Attributes:
        models: its models, the plan among them.
        output: the output folder.
        contents: every file made, relative path -> bytes.
        written: whether they were written (not in a dry run).
        new_choices: libraries that the user chose and that no earlier run into this folder has counted.
        notes: findings of this run that are not the plan's.
        verification: the verdict of comparing it with the original, as JSON values, and its exit code; None where nobody asked.
        changes: relative path -> how the file changed, or would in a dry run; empty unless that was asked for.
        counted: what was counted of the plan for its report.
        program: the files of the program as generated, without edits.
    """

    models: MigrationModels
    output: Path
    contents: dict[str, bytes]
    written: bool
    new_choices: list[migration.LibraryChoice] = []
    notes: list[Finding] = []
    verification: tuple[dict[str, Json], int] | None = None
    changes: dict[str, str] = {}
    counted: Counted | None = None
    program: Generation | None = None

    @property
    def diff(self) -> str:
        """All changes as one text."""
        return "\n".join(self.changes.values())

    @property
    def sketch(self) -> Path:
        """The sketch's folder."""
        return self.output / self.models.plan.name

    @property
    def open_choices(self) -> int:
        """How many choices are left to the user."""
        return len(open_choices(self.models.plan))

    @property
    def findings(self) -> list[Finding]:
        """The plan's findings, and those of this run alone.

        What an earlier comparison found out about the sketch is a warning at most: this run did not fail.
        """
        planned = as_findings(Q(self.models.plan.findings), self.models.places)
        if self.verification is None:
            planned = [
                replace(each, severity=min(each.severity, Severity.warning)) if each.rule in SEVERITIES else each
                for each in planned
            ]
        return Findings([*planned, *self.models.notes, *self.notes])

    def tasks(self) -> list[Finding]:
        """The plan's tasks."""
        return Findings(as_findings(Q(self.models.plan.tasks), self.models.places))

    def _repr_html_(self) -> str:
        from robosmi.model.elements.show import element_html  # for notebooks only

        made = "".join(f"<li>{quoted(self.output / name)}</li>" for name in sorted(self.contents))
        done = "made" if self.written else "to generate"
        view = f"{element_html(self.models.plan)}{findings_html(self.findings)}"
        return f"{view}<details><summary>{quantity(len(self.contents), 'file')} {done}</summary><ul>{made}</ul></details>"

    def result(self) -> dict[str, Any]:
        """The contract's result."""
        made: dict[str, Any] = {
            "plan": plan_json(self.models.plan) | work_json(self.models.plan, self.models.files),
            "sketch": str(self.sketch),
            "written": self.written,
        }
        if (moved := move_json(self.models.plan)) is not None:
            made["moved"] = moved
        if not self.written:
            made["diff"] = self.diff
        return made if self.verification is None else made | {"verification": self.verification[0]}

    def artifacts(self) -> list[dict[str, str]]:
        """The files, as the contract lists them; empty in a dry run."""
        if not self.written:
            return []
        return [{"path": str(self.output / name), "kind": _kind(name)} for name in self.contents]

    def lines(self) -> list[str]:
        """What the user reads."""
        compiles: bool | None = None
        if self.verification is not None:
            from robosmi.verify.traces.verdict import NOT_COMPILED  # only a run that verifies needs it

            compiles = self.verification[0]["verdict"] != NOT_COMPILED
        lines = terminal_lines(
            self.models.plan, self.models.files, self.sketch, made=self.written, known=self.counted, compiles=compiles
        )
        return [*lines, *self.diff.splitlines()]


def _kind(name: str) -> str:
    if name.startswith(f"{LAST}/"):
        return "record"
    if name.startswith(f"{BENCH}/"):
        return "bench"
    if Path(name).name in ("Makefile", "platformio.ini"):
        return "project"
    return "source" if name.startswith(f"{FOLDER}/source/") else KINDS.get(Path(name).suffix, "record")


def produce(
    models: MigrationModels,
    output: Path,
    *,
    inputs: Mapping[str, bytes | None] | None = None,
    outside: ExternalFiles | None = None,
    dry_run: bool = False,
    strict: bool = False,
    diff: bool = False,
    unchanged: Mapping[str, bytes] | None = None,
    program: Generation | None = None,
    report_only: bool = False,
    run: str = "generate",
) -> Generated:
    """Generate the program of a decided plan and put it, with its report and the models, into the output folder.

    Args:
        models: the models of a decided plan, which is completed.
        output: the output folder.
        inputs: files in it that this run has read, whose edits are therefore in what it makes, with their bytes.
        outside: files elsewhere that belong to the run, such as the project file: what each holds, and what it is to hold.
        dry_run: write nothing.
        strict: stop when a choice is open.
        diff: say what is changed, as a dry run does.
        unchanged: models beside the plan that are as they are stored, with their bytes.
        program: the program, if it was generated from these decisions already.
        report_only: write no other file than the report and the models, as part of the last run, which `undo` takes back.
        run: what `undo --list` calls the run.

    Raises:
        StoppedError: a choice is open under `strict`, or the user's edit would be lost.
        ModelError: the models are not closed.
        SourceError: the folder cannot be written.
    """
    if strict:
        _refuse_open(models.plan)
    if dry_run:
        look_only(output)
    with nullcontext() if dry_run else at_work(output):
        done = completion_chain(program).start(models=models, output=output).value("completed", Completed)
        known = _add_report(done)
        writing = _checked(done, inputs or {}, unchanged or {})
        if report_only:
            _refuse_others(done, writing)
        if not dry_run:
            _commit(done, writing, inputs or {}, outside, amending=report_only, run=run)
    changes = _shown_changes(done.folder.places, writing, "would change" if dry_run else "changed") if dry_run or diff else {}
    new = [choice for key, choice in _chosen_by_persons(models.plan).items() if key not in done.folder.manifest.choices]
    return Generated(
        models, output, writing.every, not dry_run, new, done.kept.findings, changes=changes, counted=known, program=done.program
    )


def _refuse_open(plan: migration.MigrationPlan) -> None:
    """Make sure that every choice is made.

    Raises:
        StoppedError: one is open.
    """
    if left := open_choices(plan):
        names = ", ".join(sorted({_called(d) for d in left}))
        raise StoppedError(
            f"open choices ({len(left)}): {names}",
            fix="decide with --bind and --library or in robosmi.toml, or omit --strict",
        )


def _add_report(done: Completed) -> Counted:
    """Generate the report, end the merge with it, and record in the plan where each line of the files comes from."""
    plan, kept = done.models.plan, done.kept
    known = counted(plan, done.models.files)
    report = [file for file in report_file(plan, done.models.files, known).files if file.name not in kept.made]
    kept.add({file.name: file.after or "" for file in report}, done.edits.base)
    kept.finish()
    kept.findings += done.edits.findings
    _trace_texts(plan, [*done.program.files, *report], kept.files)
    return known


def _trace_texts(plan: migration.MigrationPlan, made: Iterable[FileChange], files: Mapping[str, bytes]) -> None:
    """Set the plan's text traces: the lines of each template part in the files as written."""
    if plan.trace is None:
        plan.trace = trace.Trace()
    links = [
        link
        for file in made
        for link in replace(file, after=read(files[file.name], errors="surrogateescape").text).links()
        if link.part
    ]
    texts = list(plan.trace.texts)
    if len(texts) == len(links) and all(_traces(text, links[at]) for at, text in enumerate(texts)):
        return  # making them anew takes ten times as long
    plan.trace.texts.clear()
    plan.trace.texts.extend(
        trace.TextTrace(path=k.path, line=k.line, endLine=k.end_line, step=k.step, rule=k.part, elements=_elements(k))
        for k in links
    )


def _elements(link: TextLink) -> list[Element]:
    return [element for element in link.elements if isinstance(element, Element)]


def _traces(text: trace.TextTrace, link: TextLink) -> bool:
    """Whether a stored trace equals a link of this run."""
    said = (text.line, text.endLine, text.rule, text.path, text.step)
    if said != (link.line, link.end_line, link.part, link.path, link.step):
        return False
    return len(text.elements) == len(link.elements) and all(e is link.elements[at] for at, e in enumerate(text.elements))


def _called(decision: migration.Decision) -> str:
    if isinstance(decision, (migration.PortBinding, migration.PortFlow)) and decision.name:
        return decision.name
    component = decision.component if isinstance(decision, migration.LibraryChoice) else None
    return f"library for {component.title}" if component is not None else "library"


def remember(made: Generated, place: str | None = None) -> None:
    """Count in the history the libraries that persons chose (paper 3.3); if it cannot be written, that is a finding only."""
    try:
        target = made.models.plan.targetDescription
        History(place).record_all(
            HistoryEntry(
                component.partId,
                component.partTitle or component.title,
                choice.choice,
                1,
                date.today().isoformat(),
                choice.chosen.version if choice.chosen is not None else "",
                target.name if target is not None else "",
                component.title,
            )
            for choice in (made.new_choices if made.written else [])
            if (component := choice.component) is not None
        )
    except RobosmiError as error:
        made.notes.append(
            Finding(
                "RS410",
                Severity.warning,
                f"the choice was not saved in the history: {error.message}",
                error.location,
                fix=error.fix,
            )
        )


class Writing(Struct):
    """What a run is about to write into its folder.

    Attributes:
        contents: the files that it makes, relative path -> bytes.
        records: the texts as they were generated.
        old: old files that are kept beside new ones.
        going: the files that it removes.
    """

    contents: dict[str, bytes]
    records: dict[str, bytes]
    old: dict[str, bytes]
    going: set[str]

    @property
    def every(self) -> dict[str, bytes]:
        """All files."""
        return {**self.contents, **self.records, **self.old}


def _checked(done: Completed, inputs: Mapping[str, bytes | None], unchanged: Mapping[str, bytes]) -> Writing:
    """What is to be written, once it is sure that no edit is lost by it; findings are added to the merge's.

    Raises:
        StoppedError: an edit, or a file that the migration was made from, would be lost.
        ModelError: the models are not closed.
        SourceError: a link or a folder is where a file was made.
    """
    models, kept, output = done.models, done.kept, done.folder.path
    manifest, places = done.folder.manifest, done.folder.places
    contents = kept.files | {f"{FOLDER}/{name}": data for name, data in models.to_files(unchanged).items()}
    known = {**{name: places.look(name) for name in sorted(kept.merged | kept.orphans)}, **inputs}
    _no_input(models, output, contents)
    guarded = manifest.guard(places, contents | kept.records, inputs=known)
    obsolete = guarded.obsolete | kept.obsolete
    going = {name for name in obsolete if manifest.may_remove(name) and _made_by_runs(name)}
    kept.findings += [retained_file(output / name) for name in sorted(obsolete - going) if not name.startswith(f"{LAST}/")]
    kept.findings += [*_told(output, guarded), *_replaced_programs(output, models.plan.name, going, contents)]
    return Writing(contents, kept.records, kept.old | _with_comments(output, inputs, contents, kept.findings), going)


def _refuse_others(done: Completed, new: Writing) -> None:
    """Make sure that nothing but the report, the models and the records is about to be written.

    Raises:
        StoppedError: another file is.
    """
    places, own = done.folder.places, f"{done.models.plan.name}/{REPORT}"
    named = [name for name in new.contents if name != own and not name.startswith(f"{FOLDER}/")]
    others = [*(name for name in named if places.look(name) != new.contents[name]), *new.old, *sorted(new.going)]
    if others:
        raise StoppedError(f"generating would also change {', '.join(others)}; nothing was written")


def _commit(
    done: Completed,
    new: Writing,
    inputs: Mapping[str, bytes | None],
    outside: ExternalFiles | None,
    *,
    amending: bool = False,
    run: str = "",
) -> None:
    """Write the files, and the record of them, all or none; `amending` and `run` as for `save_previous`."""
    manifest, places, output = done.folder.manifest, done.folder.places, done.folder.path
    record = Manifest.of(new.contents | new.records, {*_chosen_by_persons(done.models.plan), *manifest.choices})
    # An edited input keeps the digest of the run that made it, so that making it anew stops before the edit is lost;
    # not one in which choices alone were edited, which the next run makes, too.
    # A manifest that came with the folder is not trusted further, or the next run would remove the files that it lists.
    edited = [name for name, data in inputs.items() if not only_choices_differ(manifest, name, data)]
    staying = [
        *(name for name in edited if manifest.own or name in new.contents),
        *(done.kept.orphans if manifest.own else ()),
    ]
    record.files |= {name: manifest.files[name] for name in staying if name in manifest.files}
    record.beside_choices = manifest.beside_choices if STORED in staying else digest_without_choices(new.contents[STORED])
    writing = {**new.every, MANIFEST: record.to_bytes()}
    elsewhere = save_previous(output, places, writing, new.going, outside, amending=amending, run=run)
    manifest.note(output, writing[MANIFEST])
    update(output, writing, new.going, places.seen, elsewhere)
    note_place(output)


def _chosen_by_persons(plan: migration.MigrationPlan) -> dict[str, migration.LibraryChoice]:
    """The libraries that persons chose, by what the manifest calls these choices."""
    person = migration.ChosenBy.person
    return {_key(c): c for c in plan.libraryChoices if c.chosenBy is person and c.chosen is not None}


def _key(choice: migration.LibraryChoice) -> str:
    component = choice.component
    return f"{component.elementId if component is not None else ''} {choice.choice}"


def _shown_changes(places: Places, writing: Writing, word: str) -> dict[str, str]:
    """The changes to each file that the user reads, as a unified diff; models are only listed, with the given word."""
    from difflib import unified_diff  # few runs show changes

    changes: dict[str, str] = {}
    after: dict[str, bytes | None] = {**writing.contents, **dict.fromkeys(writing.going)}
    for name in sorted(after):
        old, new = places.look(name), after[name]
        if old == new or name.startswith(".robosmi"):
            continue
        if name.startswith(f"{FOLDER}/"):
            changes[name] = f"{'model' if name.endswith('.xmi') else 'copy'} {name} {word}"
            continue
        a, b = ((data or b"").decode("utf-8", "replace").split("\n") for data in (old, new))
        left, right = f"a/{name}" if old is not None else "/dev/null", f"b/{name}" if new is not None else "/dev/null"
        changes[name] = "\n".join(unified_diff(a, b, left, right, lineterm=""))
    return changes


def _made_by_runs(name: str) -> bool:
    """Whether a migration can have written a file with this path: in the sketch's or models' folder, or among the last texts."""
    inner = name.removeprefix(f"{LAST}/")
    return "/" in inner and not hidden(inner)


def _no_input(models: MigrationModels, output: Path, contents: Mapping[str, bytes]) -> None:
    """Make sure that no file is made over what the migration was made from.

    Raises:
        StoppedError: one would be.
    """
    read_from = {os.path.realpath(place): models.files[name] for name, place in models.places.items() if name in models.files}
    root = os.path.realpath(output)
    for name, data in contents.items():
        if read_from.get(os.path.join(root, name), data) != data:
            raise StoppedError(
                "the program's source would be overwritten; nothing was written",
                location=Location(str(output / name)), fix="give another output folder",
            )  # fmt: skip


def _told(output: Path, guarded: Guarded) -> list[Finding]:
    """Findings about files that are generated again, or anew with their own line ends."""
    deleted = [
        Finding("RS517", Severity.info, "the file was deleted and is generated again", Location(str(output / name)))
        for name in guarded.deleted
    ]
    return deleted + [reformed_file(output / name) for name in guarded.reformed]


def _with_comments(
    output: Path, inputs: Mapping[str, bytes | None], contents: Mapping[str, bytes], findings: list[Finding]
) -> dict[str, bytes]:
    """Copies of models with the user's comments that are about to be overwritten, under the names of the copies."""
    old: dict[str, bytes] = {}
    for name, data in inputs.items():
        if data is None or name not in contents:
            continue
        from robosmi.model.xmi.xml_comments import comments_lost, lost_comments  # a first run has no models to write anew

        lost = comments_lost(data, contents[name])
        if not lost:
            continue
        beside = free_name(output, f"{name}.orig")
        old[beside] = data
        place = Location(str(output / name), lost[0])
        message = lost_comments(lost, Path(beside).name)
        findings.append(Finding("RS524", Severity.warning, message, place, fix="put such notes outside the models"))
    return old


def _replaced_programs(output: Path, name: str, going: Iterable[str], contents: Iterable[str]) -> list[Finding]:
    """Findings about sketches of other programs in this folder, whose files are removed or replaced."""
    staying = {Path(path).name for path in contents}
    sources = sorted(Path(path).name for path in going if path.startswith(f"{FOLDER}/source/"))
    same = [each for each in sources if each.endswith(".c") and each not in staying and sketch_name_of(Path(each)) == name]
    others = {path.partition("/")[0] for path in going} - {name, FOLDER, LAST.partition("/")[0]}
    tried = [
        Finding(
            "RS526", Severity.warning, "the bench sketch is removed because this run has no --bench",
            Location(str(output / BENCH)), fix="migrate with --bench to keep it",
        )
        for _ in others & {BENCH}
    ]  # fmt: skip
    tried += [
        Finding(
            "RS526", Severity.warning,
            f"this program replaces '{each}' in the sketch '{name}', including its edits",
            Location(str(output / name)),
            fix="give each program an output folder of its own; `robosmi undo` restores the other",
        )
        for each in same
    ]  # fmt: skip
    return tried + [
        Finding(
            "RS526", Severity.warning, f"the sketch '{other}' of an earlier run is removed: this run generates '{name}' here",
            Location(str(output / other)), fix="give each program an output folder of its own",
        )
        for other in sorted(others - {BENCH})
    ]  # fmt: skip
