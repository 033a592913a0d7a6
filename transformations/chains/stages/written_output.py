"""What a run writes into its output folder: checked against what is there, written all or none, shown as a diff.

No edit is lost: files of the program were merged before (`completion`), any other file that was changed since the last run stops
this one.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path

from msgspec import Struct

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import StoppedError
from robosmi.files.commit import update
from robosmi.files.external_files import ExternalFiles
from robosmi.files.files import free_name
from robosmi.files.run_lock import note_place
from robosmi.generate.manifest import NAME as MANIFEST, Guarded, Manifest, hidden, reformed_file, retained_file
from robosmi.generate.output_paths import Places
from robosmi.generate.undo import save_previous
from robosmi.metamodels import migration
from robosmi.transformations.chains.stages.completion import Completed
from robosmi.transformations.chains.stages.edited_plan import STORED, digest_without_choices, only_choices_differ
from robosmi.transformations.chains.stages.models import FOLDER, LAST, MigrationModels
from robosmi.transformations.chains.stages.program import sketch_name_of
from robosmi.transformations.m2t.program_files import BENCH, REPORT


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


def checked(done: Completed, inputs: Mapping[str, bytes | None], unchanged: Mapping[str, bytes]) -> Writing:
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
    kept.findings += [*_told(output, guarded), *replaced_programs(output, models.plan.name, going, contents)]
    return Writing(contents, kept.records, kept.old | _with_comments(output, inputs, contents, kept.findings), going)


def refuse_others(done: Completed, new: Writing) -> None:
    """Make sure that nothing but the report, the models and the records is about to be written.

    Raises:
        StoppedError: another file is.
    """
    places, own = done.folder.places, f"{done.models.plan.name}/{REPORT}"
    named = [name for name in new.contents if name != own and not name.startswith(f"{FOLDER}/")]
    others = [*(name for name in named if places.look(name) != new.contents[name]), *new.old, *sorted(new.going)]
    if others:
        raise StoppedError(f"generating would also change {', '.join(others)}; nothing was written")


def commit(
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
    record = Manifest.of(new.contents | new.records, {*chosen_by_persons(done.models.plan), *manifest.choices})
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


def chosen_by_persons(plan: migration.MigrationPlan) -> dict[str, migration.LibraryChoice]:
    """The libraries that persons chose, by what the manifest calls these choices."""
    person = migration.ChosenBy.person
    return {_key(c): c for c in plan.libraryChoices if c.chosenBy is person and c.chosen is not None}


def _key(choice: migration.LibraryChoice) -> str:
    component = choice.component
    return f"{component.elementId if component is not None else ''} {choice.choice}"


def shown_changes(places: Places, writing: Writing, word: str) -> dict[str, str]:
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


def replaced_programs(output: Path, name: str, going: Iterable[str], contents: Iterable[str]) -> list[Finding]:
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
