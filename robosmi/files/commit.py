"""Writes the files of a folder atomically, even if the process is killed in the middle.

First all new contents are written beside their destinations, then a journal lists the moves, then the files are moved. An
interrupted commit is completed (or discarded, if it had no journal yet) by `recovery`, which every run calls first. So each
file is at any time either the old or the new one, and after the next run all are of the same version. A new folder appears in a
single step. Files outside of the folder may be part of a commit (`external_files`). This protects against a killed process, not
against power failure.
"""

from __future__ import annotations

import functools
import os
import stat
from collections.abc import Callable, Collection, Mapping
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import ParamSpec, TypeVar

from robosmi.base.data_text import json_written
from robosmi.diagnostics import Location
from robosmi.errors import ChangedMeanwhileError, InternalError, SourceError, StoppedError
from robosmi.files.directory_fd import DirectoryFd, in_the_way
from robosmi.files.external_files import ExternalFiles, changes, drop, wait
from robosmi.files.files import within
from robosmi.files.recovery import JOURNAL, STAGE, at_work, finish, staging_path, uninterrupted, writing
from robosmi.files.run_lock import alone, bind, forget, own_stage

FileContents = Mapping[str, bytes | None]
"""What a run has read in a folder before its decisions: relative path -> bytes, None for a missing file."""

_RUNS = 5
_Given = ParamSpec("_Given")
_Made = TypeVar("_Made")


def again_when_changed(run: Callable[_Given, _Made]) -> Callable[_Given, _Made]:
    """Decorator: restart a run, up to five times in all, if a file that it has read was changed meanwhile.

    So two concurrent runs into one folder end as if they had run one after the other.
    """

    @functools.wraps(run)
    def repeated(*args: _Given.args, **kwargs: _Given.kwargs) -> _Made:
        for _ in range(_RUNS - 1):
            with suppress(ChangedMeanwhileError):
                return run(*args, **kwargs)
        return run(*args, **kwargs)

    return repeated


def update(
    folder: Path,
    contents: Mapping[str, bytes],
    removed: Collection[str] = (),
    seen: FileContents | None = None,
    elsewhere: ExternalFiles | None = None,
) -> None:
    """Bring files of a folder up to date, all or none. A file that has its bytes already is left untouched.

    Args:
        folder: the folder; made when missing. Files in it that are not named stay as they are.
        contents: relative path -> bytes.
        removed: relative paths of files that go.
        seen: what the run has read there; what it says nothing about is not checked.
        elsewhere: files outside of the folder that belong to the commit.

    Raises:
        SourceError: the folder cannot be written, or something is in the way.
        StoppedError: another run is writing there, somebody has changed a file since it was read, or a file is read-only.
        InternalError: a path leads out of the folder.
    """
    for name in contents:
        if not within(name):
            raise InternalError(f"'{name}' would be written outside the output folder '{folder}'")
    with at_work(folder):
        if folder.is_dir():
            with writing(folder), DirectoryFd(folder) as held:
                contents = {name: data for name, data in contents.items() if not held.has(name, data)}
        commit(folder, contents, removed, seen, elsewhere)


def commit(
    folder: Path,
    contents: Mapping[str, bytes],
    removed: Collection[str] = (),
    seen: FileContents | None = None,
    elsewhere: ExternalFiles | None = None,
) -> None:
    """Write and remove files of a folder, all or none.

    Args:
        folder: the folder; made when missing. Files in it that are not named stay as they are.
        contents: relative path -> bytes. The paths were checked (see `places`).
        removed: relative paths of files that go.
        seen: what the run has read there; what it says nothing about is not checked.
        elsewhere: files outside of the folder that belong to the commit: what each holds, and what it is to hold.

    Raises:
        SourceError: a folder cannot be written, or something is in the way.
        StoppedError: another run is writing there, somebody has changed a file since it was read, or a file is read-only.
    """
    elsewhere = changes(elsewhere or {})
    if not contents and not removed and not elsewhere:
        return
    if folder.exists() and not folder.is_dir():
        raise SourceError("the output path is a file", location=Location(str(folder)), fix="give another output folder")
    for name in (*contents, *removed):
        if not within(name) or name.partition("/")[0].casefold().startswith(STAGE):
            raise InternalError(f"'{name}' would be written outside the output folder '{folder}', or where files wait")
    with writing(folder), ExitStack() as others:
        folder.parent.mkdir(parents=True, exist_ok=True)
        others.enter_context(at_work(folder))
        for around in sorted({path.parent for path in elsewhere}):
            others.enter_context(alone(around))
        if folder.exists():
            with DirectoryFd(folder) as held, held.locked():
                _write(held, contents, removed, seen or {}, elsewhere)
        else:
            _appear(folder, contents, elsewhere)


def _appear(folder: Path, contents: Mapping[str, bytes], elsewhere: ExternalFiles) -> None:
    """Create a new folder: written beside its destination and moved in one step; its journal lists the files elsewhere."""
    beside = staging_path(folder)
    _no_file_is_a_folder(folder, contents)
    with DirectoryFd(folder.parent) as above:
        try:
            above.make_folder(beside.name)
        except FileExistsError as error:
            message = "another run is creating this folder"
            raise StoppedError(message, location=Location(str(folder)), fix="wait for it, then run again") from error
        try:  # an interruption before is as a kill: the folder is empty, and goes with the next run
            with above.inner(beside.name) as stage, stage.locked():
                own_stage(beside, stage.identity())
                for name, data in contents.items():
                    stage.write(name, data)
                if elsewhere:
                    run, journal = _journal({}, ())
                    stage.write(JOURNAL, journal)
                    wait(folder, run, elsewhere)
                    _untouched_elsewhere(elsewhere)
                    bind(folder, journal)
                with uninterrupted():
                    above.move(beside.name, folder.name)  # from here on the new files win
                    forget(beside)
        except BaseException:  # the user's interruption, too
            with suppress(OSError), uninterrupted():
                drop(folder)
                above.remove_folder(beside.name)
                forget(beside)
            raise
    if elsewhere:
        with DirectoryFd(folder) as held, held.locked(), uninterrupted():
            finish(held)


def _no_file_is_a_folder(folder: Path, names: Collection[str]) -> None:
    """Make sure that no file is to be made in another one.

    Raises:
        SourceError: one is.
    """
    parents = {parent.as_posix() for name in names for parent in Path(name).parents}
    for name in names:
        if name in parents:
            raise in_the_way(f"{folder}/{name}", "a file and a folder would have the same name")


def _untouched(held: DirectoryFd, names: Collection[str], seen: FileContents) -> None:
    """Make sure that no file that is about to be replaced or removed has an edit that the run does not know, or is protected.

    Raises:
        StoppedError: somebody has changed a file since the run has read it, or made it read-only.
    """
    for name in names:
        found = held.look(name)
        if found is None and seen.get(name) is None:
            continue
        plain = found is not None and stat.S_ISREG(found.st_mode)
        if found is not None and plain and not found.st_mode & 0o222:
            message, fix, kind = "the file is read-only and would be changed", "make it writable, or move it away", StoppedError
        elif name in seen and (held.read(name) if plain else None) != seen[name]:
            message, fix, kind = "the file was changed during the run", "run again", ChangedMeanwhileError
        else:
            continue
        raise kind(f"{message}; nothing was written", location=Location(f"{held.path}/{name}"), fix=fix)


def _untouched_elsewhere(files: ExternalFiles) -> None:
    """The same of files outside of the folder."""
    for path, (old, _) in files.items():
        with DirectoryFd(path.parent) as around:
            _untouched(around, [path.name], {path.name: old})


def _journal(moved: Mapping[str, str], removed: Collection[str]) -> tuple[str, bytes]:
    """A name for the run, and its journal."""
    run = os.urandom(16).hex()
    return run, json_written({"run": run, "move": moved, "remove": sorted(removed)}).encode()


def _write(
    held: DirectoryFd, contents: Mapping[str, bytes], removed: Collection[str], seen: FileContents, elsewhere: ExternalFiles
) -> None:
    places = {name: f"new/{number}" for number, name in enumerate(contents)}
    _no_file_is_a_folder(held.path, contents)
    for name in contents:  # once the journal is there, every file must be moved
        held.free_for_file(name)
    for name in removed:
        held.may_go(name)
    held.make_folder(STAGE)
    try:
        with held.inner(STAGE) as stage:
            own_stage(held.path / STAGE, stage.identity())
            for name, place in places.items():
                there = held.look(name)
                stage.write(place, contents[name], stat.S_IMODE(there.st_mode) if there is not None else None)
            run, journal = _journal({place: name for name, place in places.items()}, removed)
            stage.write("journal", journal)
            if elsewhere:
                wait(held.path, run, elsewhere)
                _untouched_elsewhere(elsewhere)
            _untouched(held, [*contents, *removed], seen)
    except BaseException:  # the user's interruption, too
        with suppress(OSError), uninterrupted():
            drop(held.path)
            held.remove_folder(STAGE)
            forget(held.path / STAGE)
        raise
    with uninterrupted():
        bind(held.path, journal)
        held.move(f"{STAGE}/journal", JOURNAL)  # from here on the new files win
        finish(held)
