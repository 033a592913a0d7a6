"""The state of an output folder before the last run, and the way back to it.

A run that changes files of its output folder first puts what they held into a record among the user's own data. `undo` puts
it all back (and the project file, where the run wrote a choice there), and the state that it replaces into the record, so that a
second `undo` takes the first one back. A file that was
changed since stops it before anything is written. Files that no run has made are never touched. The record is found again after
the folder was moved within its file system; a copy, or a folder that was sent, has no way back.
"""

from __future__ import annotations

import base64
import zlib
from collections.abc import Collection, Mapping
from pathlib import Path

from msgspec import Struct

from robosmi.base.data_text import Json, as_list, as_table, as_text, as_texts, json_of, json_written
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, StoppedError
from robosmi.files.commit import update
from robosmi.files.external_files import ExternalFiles, changes as file_changes
from robosmi.files.files import digest, within
from robosmi.files.recovery import at_work
from robosmi.files.run_lock import STATE, note_place, place_of, stored, stored_before_move
from robosmi.generate.manifest import NAME as MANIFEST, Manifest
from robosmi.generate.output_paths import Places
from robosmi.inputs import OUTPUT, SETTINGS, Kind, read_bytes

SCHEMA = "robosmi-undo/1"
_BASE64 = ":"
"""What a text in Base64 begins with; those of earlier versions are in Base85, which takes much longer and has no colon."""


class Undone(Struct):
    """The result of an undo.

    Attributes:
        restored: files with their earlier content, by path.
        removed: files that did not exist before.
    """

    restored: list[str] = []
    removed: list[str] = []


def save_previous(
    folder: Path,
    places: Places,
    contents: Mapping[str, bytes],
    removed: Collection[str] = (),
    outside: ExternalFiles | None = None,
    *,
    amending: bool = False,
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
    state: dict[str, Json] = {"schema": SCHEMA, "files": files}
    if elsewhere:
        state["outside"] = elsewhere
    if amending:
        amended = _amended(folder, files, before)
        if amended is None:
            return outside or {}
        state = amended
    place = place_of(folder, STATE)
    return {**(outside or {}), place: (_bytes(place, OUTPUT), f"{json_written(state, indent=1, sort_keys=True)}\n".encode())}


def _amended(folder: Path, files: Mapping[str, list[str | None]], before: Mapping[str, bytes | None]) -> dict[str, Json] | None:
    """The record of the state before the last run, with what a further run changes; None without a record.

    A file that a person has changed since the last run keeps its entry, so that `undo` still stops before the edit is lost.
    """
    try:
        known = as_table(json_of(_record(folder)))
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


def _packed(data: bytes | None) -> str | None:
    return None if data is None else _BASE64 + base64.b64encode(zlib.compress(data, 1)).decode()


def _unpacked(text: str | None) -> bytes | None:
    if text is None:
        return None
    packed = base64.b64decode(text.removeprefix(_BASE64)) if text.startswith(_BASE64) else base64.b85decode(text)
    return zlib.decompress(packed)


def undo(folder: Path) -> Undone:
    """Put the files of an output folder back as they were before the last run.

    Raises:
        SourceError: there is no record of an earlier state, it is damaged, or the folder cannot be written.
        StoppedError: a file was changed since the last run.
    """
    with at_work(folder):
        places, manifest = Places(folder), Manifest.load(folder)
        before, after, outside = _read(folder)
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
        if MANIFEST in contents:
            noted = as_table(json_of(contents[MANIFEST].decode()))
            choices = sorted({*as_texts(noted.get("choices", ())), *manifest.choices})  # what was counted stays counted
            beside = as_text(noted.get("beside_choices", ""))
            files = {name: as_text(made) for name, made in as_table(noted["files"]).items()}
            contents[MANIFEST] = Manifest(files, choices, beside_choices=beside).to_bytes()
            manifest.note(folder, contents[MANIFEST])
        put_back = {path: (there[path], old) for path, (old, _) in outside.items()}
        update(folder, contents, removed, places.seen, save_previous(folder, places, contents, removed, put_back))
        if folder.is_dir():
            note_place(folder)
    restored = [str(path) for path, (_, old) in put_back.items() if old is not None]
    gone = [str(path) for path, (_, old) in put_back.items() if old is None]
    return Undone([*_shown(contents), *restored], [*_shown(removed), *gone])


def _record(folder: Path) -> str:
    """The record of a folder, which may have been moved.

    Raises:
        OSError: there is none.
        ValueError: it is no text.
    """
    try:
        return stored(folder, STATE)
    except FileNotFoundError:
        return stored_before_move(folder, STATE)


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
    """The names of files that concern a person, without records."""
    return sorted(name for name in names if not name.startswith(".robosmi"))


def _pair(entry: Json) -> tuple[str | None, str | None]:
    """An entry as (compressed earlier content, digest of the written content); None for a file that did or does not exist."""
    old, new = as_list(entry)
    return None if old is None else as_text(old), None if new is None else as_text(new)


Outside = dict[Path, tuple[bytes | None, str | None]]


def _read(folder: Path) -> tuple[dict[str, bytes | None], dict[str, str | None], Outside]:
    """What each file held before the last run, and the digest of what that wrote there; the same of files outside of the folder.

    Raises:
        SourceError: there is no such record, or it is damaged.
    """
    damaged = SourceError(
        "the record of the state before the last run is damaged", location=Location(str(folder)),
        fix="generate the sketch again with migrate or generate",
    )  # fmt: skip
    try:
        known = as_table(json_of(_record(folder)))
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
