"""The state of an output folder before the last run, and the way back to it.

A run that changes files of its output folder puts what they held into one record, in the same step; `undo` puts all of it back,
and the state that it replaces into the record, so that a second `undo` takes the first one back. A file that was changed since
stops it before anything is written. Files that no run has made are never touched.
"""

from __future__ import annotations

import base64
import json
import zlib
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from robosmi import inputs
from robosmi.data_text import json_of
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, StoppedError
from robosmi.generate.manifest import NAME as MANIFEST
from robosmi.generate.manifest import Manifest
from robosmi.generate.places import Places
from robosmi.model.commit import update
from robosmi.model.files import digest, within
from robosmi.model.recovery import at_work

NAME = ".robosmi/undo"
SCHEMA = "robosmi-undo/1"


@dataclass
class Undone:
    """What was put back.

    Attributes:
        restored: files that have again what they held, by their paths.
        removed: files that were not there before.
    """

    restored: list[str] = field(default_factory=list)
    removed: list[str] = field(default_factory=list)


def state_before(places: Places, contents: Mapping[str, bytes], removed: Collection[str] = ()) -> bytes | None:
    """The record for a run that is about to write and remove these files; None where it changes nothing.

    Args:
        places: the output folder.
        contents: what is about to be written, relative path -> bytes.
        removed: paths of files that go.
    """
    after: dict[str, bytes | None] = {**contents, **dict.fromkeys(removed)}
    before = {name: places.look(name) for name in sorted(after)}
    changed = [name for name in before if before[name] != after[name]]
    if not changed:
        return None
    files = {name: [_packed(before[name]), digest(new) if (new := after[name]) is not None else None] for name in changed}
    return (json.dumps({"schema": SCHEMA, "files": files}, indent=1, sort_keys=True) + "\n").encode()


def _packed(data: bytes | None) -> str | None:
    return None if data is None else base64.b85encode(zlib.compress(data)).decode()


def _unpacked(text: str | None) -> bytes | None:
    return None if text is None else zlib.decompress(base64.b85decode(text))


def undo(folder: Path) -> Undone:
    """Put the files of an output folder back as they were before the last run.

    Raises:
        SourceError: there is no record of an earlier state, it is damaged or came with the folder, or the folder cannot be
            written.
        StoppedError: a file was changed since the last run.
    """
    with at_work(folder):
        places, manifest = Places(folder), Manifest.load(folder)
        before, after = _read(folder)
        if not manifest.own:
            raise SourceError(
                "the record of the last run came with the folder, and is not followed", location=Location(str(folder / NAME)),
                fix="make the sketch anew with migrate or generate",
            )  # fmt: skip
        found = {name: places.look(name) for name in before}
        edited = [name for name, data in found.items() if (digest(data) if data is not None else None) != after[name]]
        if edited:
            raise StoppedError(
                f"changed since the last run: {', '.join(sorted(edited))}; nothing was put back",
                location=Location(str(folder / sorted(edited)[0])), fix="move your changes elsewhere, then undo again",
            )  # fmt: skip
        contents = {name: data for name, data in before.items() if data is not None}
        removed = [name for name, data in before.items() if data is None]
        if MANIFEST in contents:
            kept = json_of(contents[MANIFEST].decode())
            choices = sorted({*kept.get("choices", ()), *manifest.choices})  # what was counted stays counted
            contents[MANIFEST] = Manifest(kept["files"], choices).to_bytes()
            manifest.note(folder, contents[MANIFEST])
        record = state_before(places, contents, removed)
        update(folder, {**contents, **({NAME: record} if record is not None else {})}, removed, places.seen)
    return Undone(_shown(contents), _shown(removed))


def _shown(names: Collection[str]) -> list[str]:
    """The names that are a person's business: not those of records."""
    return sorted(name for name in names if not name.startswith(".robosmi"))


def _read(folder: Path) -> tuple[dict[str, bytes | None], dict[str, str | None]]:
    """What each file held before the last run, and the digest of what that wrote there.

    Raises:
        SourceError: there is no such record, or it is damaged.
    """
    path = folder / NAME
    damaged = SourceError(
        "the record of the state before the last run is damaged", location=Location(str(path)),
        fix="make the sketch anew with migrate or generate",
    )  # fmt: skip
    try:
        files = json_of(inputs.read_bytes(path, inputs.OUTPUT, follow=False))["files"]
        before = {name: _unpacked(packed) for name, (packed, _) in files.items()}
        after = {name: written for name, (_, written) in files.items()}
    except FileNotFoundError as error:
        raise SourceError(
            "there is no earlier state of this folder", location=Location(str(folder)),
            fix="give the output folder of a run that has changed something",
        ) from error  # fmt: skip
    except (OSError, ValueError, KeyError, TypeError, AttributeError, zlib.error) as error:
        raise damaged from error
    if not all(within(name) for name in before):
        raise damaged
    return before, after
