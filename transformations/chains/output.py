"""From complete models to the output folder: generates, compares with the last run, and writes atomically.

Shared by the chains `migrate` and `generate`. The result has the data that a report needs.
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

from robosmi.data_text import Json
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import RobosmiError, StoppedError
from robosmi.generate import Generation
from robosmi.generate.kept_texts import keep_texts
from robosmi.generate.manifest import NAME as MANIFEST
from robosmi.generate.manifest import Guarded, Manifest, held_back, hidden, reformed_file
from robosmi.generate.places import Places, free_name
from robosmi.generate.record import Record
from robosmi.generate.result import FileChange, TextLink
from robosmi.generate.text_form import read
from robosmi.generate.undo import keep_before
from robosmi.metamodels import migration, trace
from robosmi.model.commit import update
from robosmi.model.elsewhere import Elsewhere
from robosmi.model.recovery import at_work, look_only
from robosmi.model.strict import Element
from robosmi.plugin_contracts import wrong_result
from robosmi.plugins import content
from robosmi.query import Q
from robosmi.recommend.history import History, HistoryEntry
from robosmi.report.notebook import Findings
from robosmi.transformations.chains.built import built
from robosmi.transformations.chains.by_hand import by_hand
from robosmi.transformations.chains.conflicts import show_conflicts
from robosmi.transformations.chains.edited_plan import STORED, beside_choices, only_choices_differ
from robosmi.transformations.chains.models import FOLDER, LAST, MigrationModels
from robosmi.transformations.chains.refused import tell_refused
from robosmi.transformations.chains.replaced_programs import replaced_programs
from robosmi.transformations.m2t.first_screen import Counted
from robosmi.transformations.m2t.program_files import BENCH, ProgramGeneration
from robosmi.transformations.m2t.terminal_text import terminal_lines
from robosmi.transformations.queries.plan import open_choices, plan_json, said, target_of
from robosmi.transformations.queries.work import work_json

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
        new_choices: libraries that a person chose and that no earlier run into this folder has counted.
        notes: findings of this run that are not the plan's.
        verification: the verdict of comparing it with the original, as JSON values, and its exit code; None where nobody asked.
        diff: what a dry run would change, or what was changed where that was asked for; else empty.
        counted: what was counted of the plan when its files were made; None where the generator counts nothing.
    """

    models: MigrationModels
    output: Path
    contents: dict[str, bytes]
    written: bool
    new_choices: list[migration.LibraryChoice] = []
    notes: list[Finding] = []
    verification: tuple[dict[str, Json], int] | None = None
    diff: str = ""
    counted: Counted | None = None

    @property
    def sketch(self) -> Path:
        """The sketch's folder."""
        return self.output / self.models.plan.name

    @property
    def findings(self) -> list[Finding]:
        """The plan's findings, and those of this run alone."""
        return Findings([*said(Q(self.models.plan.findings), self.models.places), *self.models.notes, *self.notes])

    def tasks(self) -> list[Finding]:
        """The plan's tasks."""
        return Findings(said(Q(self.models.plan.tasks), self.models.places))

    def _repr_html_(self) -> str:
        from robosmi.model.show import element_html  # for notebooks only
        from robosmi.report.notebook import findings_html, quoted

        made = "".join(f"<li>{quoted(self.output / name)}</li>" for name in sorted(self.contents))
        done = "made" if self.written else "to be made"
        view = f"{element_html(self.models.plan)}{findings_html(self.findings)}"
        return f"{view}<details><summary>{len(self.contents)} files {done}</summary><ul>{made}</ul></details>"

    def result(self) -> dict[str, Any]:
        """The contract's result."""
        made: dict[str, Any] = {
            "plan": plan_json(self.models.plan) | work_json(self.models.plan, self.models.files),
            "sketch": str(self.sketch),
            "written": self.written,
        }
        if not self.written:
            made["diff"] = self.diff
        return made if self.verification is None else made | {"verification": self.verification[0]}

    def artifacts(self) -> list[dict[str, str]]:
        """The files, as the contract lists them; empty in a dry run."""
        if not self.written:
            return []
        return [{"path": str(self.output / name), "kind": _kind(name)} for name in self.contents]

    def lines(self) -> list[str]:
        """What a person reads."""
        lines = terminal_lines(self.models.plan, self.models.files, self.sketch, made=self.written, known=self.counted)
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
    outside: Elsewhere | None = None,
    dry_run: bool = False,
    strict: bool = False,
    diff: bool = False,
    unchanged: Mapping[str, bytes] | None = None,
) -> Generated:
    """Generate the sketch of a plan and put it, with the models, into the output folder.

    Args:
        models: complete models.
        output: the output folder.
        inputs: files in it that this run has read, whose edits are therefore in what it makes, with their bytes.
        outside: files elsewhere that belong to the run, such as the project file: what each holds, and what it is to hold.
        dry_run: write nothing.
        strict: stop when a choice is open.
        diff: say what is changed, as a dry run does.
        unchanged: models beside the plan that are as they are stored, with their bytes.

    Raises:
        StoppedError: a choice is open under `strict`, or a person's edit would be lost.
        ModelError: the models are not closed.
        SourceError: the folder cannot be written.
    """
    plan = models.plan
    if strict and (open_ := open_choices(plan)):
        names = ", ".join(sorted({_called(d) for d in open_}))
        raise StoppedError(
            f"{len(open_)} choice(s) are open: {names}",
            fix="decide with --bind and --library or in robosmi.toml, or leave out --strict",
        )
    generator = content("generator", str(target_of(plan).generator))

    def generate() -> Generation:
        made: object = generator(plan, models.files)
        if isinstance(made, Generation) and all(isinstance(file, FileChange) for file in made.files):
            return made
        raise wrong_result(generator, made, "a Generation")

    if dry_run:
        look_only(output)
    with nullcontext() if dry_run else at_work(output):
        manifest, places = Manifest.load(output), Places(output)
        made = generate()
        if tell_refused(plan, {file.name: file.after or "" for file in made.files}, models.files):
            made = generate()
        hand = by_hand(
            plan, places, {file.name: file.after or "" for file in made.files}, Record(places.folder, LAST, manifest.files)
        )
        if hand.names or hand.done or hand.values:
            made = generate()
        texts = {file.name: file.after or "" for file in made.files}
        kept = keep_texts(places, LAST, texts, manifest.files, hand.base)
        before, plan.build = plan.build, built(output, plan.name, kept.files)
        if show_conflicts(plan, kept.files, texts) or plan.build is not None or before is not None:
            made = generate()
            hand.findings.clear()
            texts = {file.name: file.after or "" for file in made.files}
            kept = keep_texts(places, LAST, texts, manifest.files, hand.base)
        kept.findings += hand.findings
        _trace_texts(plan, made, kept.files)
        contents = kept.files | {f"{FOLDER}/{name}": data for name, data in models.to_files(unchanged or {}).items()}
        exempt = inputs or {}
        known = {**{name: places.look(name) for name in sorted(kept.merged | kept.orphans)}, **exempt}
        _no_input(models, output, contents)
        guarded = manifest.guard(places, contents | kept.records, inputs=known)
        obsolete = guarded.obsolete | kept.obsolete
        going = {name for name in obsolete if manifest.may_remove(name) and _made_by_runs(name)}
        kept.findings += [held_back(output / name) for name in sorted(obsolete - going) if not name.startswith(f"{LAST}/")]
        kept.findings += [*_told(output, guarded), *replaced_programs(output, plan.name, going, contents)]
        kept.old |= _with_comments(output, exempt, contents, kept.findings)
        by_person = {_key(c): c for c in plan.libraryChoices if c.chosenBy is migration.ChosenBy.person and c.chosen is not None}
        if not dry_run:
            record = Manifest.of(contents | kept.records, {*by_person, *manifest.choices})
            # An edited input keeps the digest of the run that made it, so that making it anew stops before the edit is lost;
            # not one in which choices alone were edited, which the next run makes, too.
            # A manifest that came with the folder is not trusted further, or the next run would remove the files that it lists.
            edited = [name for name, data in exempt.items() if not only_choices_differ(manifest, name, data)]
            staying = [*(name for name in edited if manifest.own or name in contents), *(kept.orphans if manifest.own else ())]
            record.files |= {name: manifest.files[name] for name in staying if name in manifest.files}
            record.beside_choices = manifest.beside_choices if STORED in staying else beside_choices(contents[STORED])
            writing = {**contents, **kept.records, **kept.old, MANIFEST: record.to_bytes()}
            elsewhere = keep_before(output, places, writing, going, outside)
            manifest.note(output, writing[MANIFEST])
            update(output, writing, going, places.seen, elsewhere)
    new = [c for key, c in by_person.items() if key not in manifest.choices]
    changes = _diff(places, contents, going, "would change" if dry_run else "changed") if dry_run or diff else ""
    everything = {**contents, **kept.records, **kept.old}
    told = made.counted if isinstance(made, ProgramGeneration) else None
    return Generated(models, output, everything, not dry_run, new, kept.findings, diff=changes, counted=told)


def _diff(places: Places, contents: Mapping[str, bytes], going: Iterable[str], word: str) -> str:
    """The changes to files that a person reads, as a unified diff; models are only listed, with the given word."""
    from difflib import unified_diff  # few runs show changes

    lines: list[str] = []
    after: dict[str, bytes | None] = {**contents, **dict.fromkeys(going)}
    for name in sorted(after):
        old, new = places.look(name), after[name]
        if old == new or name.startswith(".robosmi"):
            continue
        if name.startswith(f"{FOLDER}/"):
            lines.append(f"{'model' if name.endswith('.xmi') else 'copy'} {name} {word}")
            continue
        a, b = ((data or b"").decode("utf-8", "replace").split("\n") for data in (old, new))
        left, right = f"a/{name}" if old is not None else "/dev/null", f"b/{name}" if new is not None else "/dev/null"
        lines += unified_diff(a, b, left, right, lineterm="")
    return "\n".join(lines)


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
                "the program is read from a file that would be made anew; nothing was written",
                location=Location(str(output / name)), fix="give another output folder",
            )  # fmt: skip


def _told(output: Path, guarded: Guarded) -> list[Finding]:
    """Findings about files that are generated again, or anew with their own line ends."""
    deleted = [
        Finding("RS517", Severity.info, "the file was deleted; it is made again", Location(str(output / name)))
        for name in guarded.deleted
    ]
    return deleted + [reformed_file(output / name) for name in guarded.reformed]


def _with_comments(
    output: Path, inputs: Mapping[str, bytes | None], contents: Mapping[str, bytes], findings: list[Finding]
) -> dict[str, bytes]:
    """Copies of models with a person's comments that are about to be overwritten, under the names of the copies."""
    old: dict[str, bytes] = {}
    for name, data in inputs.items():
        if data is None or name not in contents:
            continue
        from robosmi.model.xml_comments import comments_lost, told  # a first run has no models to write anew

        lost = comments_lost(data, contents[name])
        if not lost:
            continue
        beside = free_name(output, f"{name}.orig")
        old[beside] = data
        place = Location(str(output / name), lost[0])
        message = told(lost, Path(beside).name)
        findings.append(Finding("RS524", Severity.warning, message, place, fix="keep such notes outside of the models"))
    return old


def _trace_texts(plan: migration.MigrationPlan, made: Generation, files: Mapping[str, bytes]) -> None:
    """Set the plan's text traces: the lines of each template part in the files as written."""
    if plan.trace is None:
        plan.trace = trace.Trace()
    links = [
        link
        for file in made.files
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


def _key(choice: migration.LibraryChoice) -> str:
    component = choice.component
    return f"{component.elementId if component is not None else ''} {choice.choice}"


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
            Finding("RS410", Severity.warning, f"the choice was not remembered: {error.message}", error.location, fix=error.fix)
        )
