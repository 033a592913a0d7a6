"""The state of an output folder before the last run, and the way back to it.

A run that changes files of its output folder first puts what they held into a record among the user's own data. `undo` puts
it all back (and the project file, where the run wrote a choice there), and the state that it replaces into the record, so that a
second `undo` takes the first one back. The records of the runs before it are kept beside it, so that several runs can be taken
back at once. A file that was
changed since stops it before anything is written. Files that no run has made are never touched. The record is found again after
the folder was moved within its file system; a copy, or a folder that was sent, has no way back.
"""

from __future__ import annotations

import base64
import zlib
from collections.abc import Collection, Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path

from msgspec import Struct

from robosmi.base.data_text import Json, as_list, as_table, as_text, as_texts, json_of, json_written
from robosmi.base.quantities import quantity
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, StoppedError
from robosmi.files.commit import update
from robosmi.files.external_files import ExternalFiles, changes as file_changes
from robosmi.files.files import digest, within
from robosmi.files.recovery import at_work
from robosmi.files.run_lock import STATE, note_place, place_of, stored_of
from robosmi.generate.manifest import NAME as MANIFEST, Manifest
from robosmi.generate.output_paths import Places
from robosmi.inputs import OUTPUT, SETTINGS, Kind, read_bytes

SCHEMA = "robosmi-undo/1"
_BASE64 = ":"
"""What a text in Base64 begins with; those of earlier versions are in Base85, which takes much longer and has no colon."""


REDO = "redo"
"""The key that marks the record of an undo, which a second one takes back."""
_STEPS, _LARGEST = 20, 4_000_000
"""Limits on the records that are kept of the runs before the last one: their number, and the sum of their contents."""
Record = dict[str, Json]
"""What a run has changed: `files` and `outside`, each with what it held before (compressed) and the digest of the new content."""


class UndoStep(Struct, frozen=True):
    """A run that can be taken back.

    Attributes:
        number: how many runs are taken back with it; 0 for what the last undo has taken back.
        at: when it wrote, in ISO 8601; empty for a run of an earlier version.
        files: what it changed.
        run: its command or choice; empty for a run of an earlier version.
    """

    number: int
    at: str
    files: tuple[str, ...]
    run: str = ""


class Undone(Struct):
    """The result of an undo.

    Attributes:
        restored: files with their earlier content, by path.
        removed: files that did not exist before.
        runs: the commands or choices that were taken back, the last one first.
    """

    restored: list[str] = []
    removed: list[str] = []
    runs: list[str] = []


def save_previous(
    folder: Path,
    places: Places,
    contents: Mapping[str, bytes],
    removed: Collection[str] = (),
    outside: ExternalFiles | None = None,
    *,
    amending: bool = False,
    run: str = "",
    undone: Undoing | None = None,
) -> ExternalFiles:
    """What a run that is about to write and remove these files is to write elsewhere, so that it can be taken back.

    That is what it writes elsewhere anyway, and the record of the state before: it belongs to the same commit, so that the way
    back is the one of the last run which came to its end, wherever one after it was killed.

    Args:
        folder: the output folder.
        places: what is in it.
        contents: what is about to be written, relative path -> bytes.
        removed: paths of files that go.
        outside: files elsewhere that the run writes, too, such as the project file: what each holds and what it is about to hold.
        amending: whether the run only adds to what the last one did, so that the way back is still the one before that.
        run: the command or choice that a list of runs names.
        undone: what an undo takes back; None for a run.

    Returns:
        `outside`, with the record where anything is changed.

    Raises:
        SourceError: there is no place for the record, or it cannot be read.
    """
    after: dict[str, bytes | None] = {**contents, **dict.fromkeys(removed)}
    before = {name: places.look(name) for name in sorted(after)}
    changed = [name for name in before if before[name] != after[name]]
    beyond = {str(path): pair for path, pair in file_changes(outside or {}).items()}
    if not changed and not beyond:
        return outside or {}
    files = {name: [_packed(before[name]), digest(new) if (new := after[name]) is not None else None] for name in changed}
    elsewhere = {path: [_packed(old), digest(new) if new is not None else None] for path, (old, new) in beyond.items()}
    state: Record = {"schema": SCHEMA, "at": _now(), "run": run, "files": files}
    if elsewhere:
        state["outside"] = elsewhere
    if undone is not None:
        state = undone.opposite(state)
    elif not amending and places.look(MANIFEST) is not None:  # without one, records are of another folder that was here
        state["earlier"] = _kept(_runs(_records(folder)))
    if amending:
        amended = _amended(folder, files, before)
        if amended is None:
            return outside or {}
        state = amended
    place = place_of(folder, STATE)
    return {**(outside or {}), place: (_bytes(place, OUTPUT), f"{json_written(state, indent=1, sort_keys=True)}\n".encode())}


def _amended(folder: Path, files: Mapping[str, list[str | None]], before: Mapping[str, bytes | None]) -> dict[str, Json] | None:
    """The record of the state before the last run, with what a further run changes; None without a record.

    A file that the user has changed since the last run keeps its entry, so that `undo` still stops before the edit is lost.
    """
    try:
        known = as_table(json_of(stored_of(folder, STATE)))
        listed = as_table(known["files"])
        merged = {**listed}
        for name, entry in files.items():
            if name not in listed:
                merged[name] = entry
                continue
            old, made = _pair(listed[name])
            data = before[name]
            if made == (digest(data) if data is not None else None):
                merged[name] = [old, entry[1]]
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return None
    return {**known, "files": merged}


def _now() -> str:
    return datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")


def _records(folder: Path) -> list[Record]:
    """The records of a folder, the last one first; none where it has none, or a damaged one."""
    try:
        last = as_table(json_of(stored_of(folder, STATE)))
        return [last, *(as_table(each) for each in as_list(last.get("earlier", [])))]
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return []


def _runs(records: Sequence[Record]) -> list[Record]:
    """The records of runs, without that of an undo."""
    return [each for each in records if not each.get(REDO)]


def _kept(records: Sequence[Record]) -> list[Json]:
    """What is kept of earlier records, the latest first."""
    kept: list[Json] = []
    size = 0
    for record in records[:_STEPS]:
        own: Record = {key: value for key, value in record.items() if key not in ("schema", "earlier")}
        size += len(json_written(own))
        if size > _LARGEST:
            break
        kept.append(own)
    return kept


class Undoing(Struct):
    """What an undo takes back.

    Attributes:
        taken: the records that it takes back, the last one first.
        left: those of the runs before.
        redone: the record of an undo before it, which it adds to; None if it takes that one back, or there is none.
    """

    taken: list[Record]
    left: list[Record]
    redone: Record | None = None

    @classmethod
    def of(cls, folder: Path, count: int | None) -> Undoing:
        """What is to be taken back: so many runs, or with None the last run or undo.

        Raises:
            SourceError: there are fewer.
        """
        records = _records(folder)
        runs = _runs(records)
        redo = records[0] if records and records[0].get(REDO) else None
        if count is None:
            return cls(records[:1], runs if redo is not None else runs[1:])
        if count > len(runs):
            known = f"it has {quantity(len(runs), 'earlier state')}"
            fix = "see: robosmi undo OUT --list"
            raise SourceError(f"{quantity(count, 'run')} cannot be taken back: {known}", location=Location(str(folder)), fix=fix)
        return cls(runs[:count], runs[count:], redo)

    def names(self) -> list[str]:
        """What the records call the runs that are taken back."""
        return [name for each in self.taken if (name := as_text(each.get("run", "")))]

    def merged(self) -> Record:
        """The records as one: what was there before the first run, and what the last one wrote."""
        return {kind: _over([as_table(each.get(kind, {})) for each in self.taken]) for kind in ("files", "outside")}

    def opposite(self, state: Record) -> Record:
        """The record that takes the undo back, made of what the undo writes."""
        if self.redone is not None:
            pairs = [(as_table(state.get(kind, {})), as_table(self.redone.get(kind, {}))) for kind in ("files", "outside")]
            state |= {kind: _over([now, then]) for kind, (now, then) in zip(("files", "outside"), pairs, strict=True)}
        run = self.taken[0].get(REDO)
        before = as_text(self.redone.get("run", "")) if self.redone is not None else ""
        name = "; ".join([*self.names(), *([before] if before else [])])
        return {
            **state,
            "at": self.taken[0].get("at", ""),
            "run": name,
            "earlier": _kept(self.left),
            **({} if run else {REDO: True}),
        }


def _over(changes: Sequence[Mapping[str, Json]]) -> Record:
    """Changes of files one before the other, the last one first, as one change."""
    made: Record = {}
    for change in changes:
        for name, entry in change.items():
            made[name] = [_pair(entry)[0], _pair(made.get(name, entry))[1]]
    return made


def steps(folder: Path) -> list[UndoStep]:
    """What can be taken back, the last run or undo first.

    Raises:
        SourceError: there is no record of an earlier state, or it is damaged.
    """
    _read(folder, Undoing.of(folder, None))
    found: list[UndoStep] = []
    for record in _records(folder):
        number = 0 if record.get(REDO) else sum(step.number > 0 for step in found) + 1
        files = (*_shown(as_table(record["files"])), *sorted(as_table(record.get("outside", {}))))
        found.append(UndoStep(number, as_text(record.get("at", "")), files, as_text(record.get("run", ""))))
    return found


def _packed(data: bytes | None) -> str | None:
    return None if data is None else _BASE64 + base64.b64encode(zlib.compress(data, 1)).decode()


def _unpacked(text: str | None) -> bytes | None:
    if text is None:
        return None
    packed = base64.b64decode(text.removeprefix(_BASE64)) if text.startswith(_BASE64) else base64.b85decode(text)
    return zlib.decompress(packed)


def undo(folder: Path, count: int | None = None, *, staying: str = "") -> Undone:
    """Put the files of an output folder back as they were before the last run, or before the last undo.

    Args:
        folder: the output folder.
        count: how many runs are taken back; None for what was done last.
        staying: a file of the folder that the caller works with; empty for none.

    Raises:
        SourceError: there is no record of an earlier state, it is damaged, or the folder cannot be written.
        StoppedError: a file was changed since the last run, or `staying` would be removed.
    """
    with at_work(folder):
        places, manifest = Places(folder), Manifest.load(folder)
        undoing = Undoing.of(folder, count)
        before, after, outside = _read(folder, undoing)
        found = {name: places.look(name) for name in before}
        edited = [name for name, data in found.items() if (digest(data) if data is not None else None) != after[name]]
        there = {path: _bytes(path) for path in outside}
        edited += [str(p) for p, (_, new) in outside.items() if (digest(d) if (d := there[p]) is not None else None) != new]
        if edited:
            raise StoppedError(
                f"changed since the last run: {', '.join(sorted(edited))}; nothing was restored",
                location=Location(str(folder / sorted(edited)[0])), fix="move your changes elsewhere, then undo again",
            )  # fmt: skip
        contents = {name: data for name, data in before.items() if data is not None}
        removed = [name for name, data in before.items() if data is None]
        if staying in removed:
            message = f"only the run is left that made {staying}; nothing was restored"
            raise StoppedError(message, location=Location(str(folder)), fix=f"to remove it, too: robosmi undo {folder}")
        if MANIFEST in contents:
            noted = as_table(json_of(contents[MANIFEST].decode()))
            choices = sorted({*as_texts(noted.get("choices", ())), *manifest.choices})  # what was counted stays counted
            beside = as_text(noted.get("beside_choices", ""))
            files = {name: as_text(made) for name, made in as_table(noted["files"]).items()}
            contents[MANIFEST] = Manifest(files, choices, beside_choices=beside).to_bytes()
            manifest.note(folder, contents[MANIFEST])
        put_back = {path: (there[path], old) for path, (old, _) in outside.items()}
        record = save_previous(folder, places, contents, removed, put_back, undone=undoing)
        update(folder, contents, removed, places.seen, record)
        if folder.is_dir():
            note_place(folder)
    restored = [str(path) for path, (_, old) in put_back.items() if old is not None]
    gone = [str(path) for path, (_, old) in put_back.items() if old is None]
    return Undone([*_shown(contents), *restored], [*_shown(removed), *gone], undoing.names())


def _bytes(path: Path, kind: Kind = SETTINGS) -> bytes | None:
    try:
        return read_bytes(path, kind, follow=False)
    except FileNotFoundError:
        return None
    except OSError as error:
        raise SourceError(
            f"cannot be read: {error.strerror}", location=Location(str(path)), fix="check its permissions"
        ) from error


def _shown(names: Collection[str]) -> list[str]:
    """The names of files that concern the user, without records."""
    return sorted(name for name in names if not name.startswith(".robosmi"))


def _pair(entry: Json) -> tuple[str | None, str | None]:
    """An entry as (compressed earlier content, digest of the written content); None for a file that did or does not exist."""
    old, new = as_list(entry)
    return None if old is None else as_text(old), None if new is None else as_text(new)


Outside = dict[Path, tuple[bytes | None, str | None]]


def _read(folder: Path, undoing: Undoing) -> tuple[dict[str, bytes | None], dict[str, str | None], Outside]:
    """What each file held before, and the digest of what was written there; the same of files outside of the folder.

    Raises:
        SourceError: there is no such record, or it is damaged.
    """
    damaged = SourceError(
        "the record of the state before the last run is damaged", location=Location(str(folder)),
        fix="generate the sketch again with migrate or generate",
    )  # fmt: skip
    try:
        as_table(as_table(json_of(stored_of(folder, STATE)))["files"])
        if not undoing.taken:
            raise damaged
        known = undoing.merged()
        files = {name: _pair(entry) for name, entry in as_table(known["files"]).items()}
        before = {name: _unpacked(packed) for name, (packed, _) in files.items()}
        after = {name: written for name, (_, written) in files.items()}
        pairs = {Path(path): _pair(entry) for path, entry in as_table(known.get("outside", {})).items()}
        outside = {path: (_unpacked(old), new) for path, (old, new) in pairs.items()}
    except FileNotFoundError as error:
        raise SourceError(
            "this folder has no earlier state", location=Location(str(folder)),
            fix="give the output folder of a run that changed something, and no copy of it",
        ) from error  # fmt: skip
    except (OSError, ValueError, KeyError, TypeError, AttributeError, zlib.error) as error:
        raise damaged from error
    if not all(within(name) for name in before):
        raise damaged
    return before, after, outside
