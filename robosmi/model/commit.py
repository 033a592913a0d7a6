"""Files of a folder written together or not at all, also when the process is killed in the middle.

All new contents are put beside their places first, then a journal says what goes where, then they are moved; what was begun is
finished (or thrown away, if there was no journal yet) by `recover`, which every run calls first. So each file is the old or
the new one, whole, at any time, and after the next run all are of one kind. A folder that is new appears in one step.
A journal that no run of this user made for this folder (see `runs`) is reported and not carried out.
This holds when a process is killed; nothing is promised for a machine that loses power.
"""

from __future__ import annotations

import errno
import json
import os
import secrets
import shutil
import stat
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from robosmi.data_text import json_of
from robosmi.diagnostics import Location
from robosmi.errors import InternalError, SourceError, StoppedError
from robosmi.inputs import OUTPUT, RECORD, read_bytes
from robosmi.model.files import within
from robosmi.model.runs import alone, bind, forget, is_bound, is_own_stage, own_stage, release

STAGE = ".robosmi-commit"
"""Folder with what is about to be moved into place; in the output folder, or beside one that is new (with its name behind)."""
_JOURNAL = "journal.json"
_FIX = "give another output folder, or check its permissions and the space on the disk"


Seen = Mapping[str, bytes | None]
"""What a run has read in a folder before it decided: relative path -> bytes, None where no file was."""


def update(folder: Path, contents: Mapping[str, bytes], removed: Collection[str] = (), seen: Seen | None = None) -> None:
    """Bring files of a folder up to date, all or none. A file that has its bytes already is left untouched.

    Args:
        folder: the folder; made when missing. Files in it that are not named stay as they are.
        contents: relative path -> bytes.
        removed: relative paths of files that go.
        seen: what the run has read there; what it says nothing about is not checked.

    Raises:
        SourceError: the folder cannot be written, or something is in the way.
        StoppedError: another run is writing there, somebody has changed a file since it was read, or a file is read-only.
        InternalError: a path leads out of the folder.
    """
    for name in contents:
        if not within(name):
            raise InternalError(f"'{name}' would be written outside of the output folder '{folder}'")
    with at_work(folder):
        commit(folder, {name: data for name, data in contents.items() if not _has(folder / name, data)}, removed, seen)


@contextmanager
def at_work(folder: Path) -> Iterator[None]:
    """From the recovery of an output folder to the end of a run: no other run of this user gets in between. May be nested.

    Raises:
        StoppedError: another run is at work, or an interrupted one must be looked at (see `recover`).
        SourceError: the folder cannot be written.
    """
    with alone(folder):
        recover(folder)
        yield


def _has(path: Path, data: bytes) -> bool:
    return path.is_file() and path.stat().st_size == len(data) and read_bytes(path, OUTPUT) == data


def commit(folder: Path, contents: Mapping[str, bytes], removed: Collection[str] = (), seen: Seen | None = None) -> None:
    """Write and remove files of a folder, all or none.

    Args:
        folder: the folder; made when missing. Files in it that are not named stay as they are.
        contents: relative path -> bytes. The paths were checked (see `places`).
        removed: relative paths of files that go.
        seen: what the run has read there; what it says nothing about is not checked.

    Raises:
        SourceError: the folder cannot be written, or something is in the way.
        StoppedError: another run is writing there, somebody has changed a file since it was read, or a file is read-only.
    """
    if not contents and not removed:
        return
    if folder.exists() and not folder.is_dir():
        raise SourceError("the output path is a file", location=Location(str(folder)), fix="give another output folder")
    for name in (*contents, *removed):
        if not within(name) or name.partition("/")[0].casefold().startswith(STAGE):
            raise InternalError(f"'{name}' would be written outside of the output folder '{folder}', or where files wait")
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with at_work(folder):
            _commit(folder, contents, removed, seen or {})
    except OSError as error:
        named = str(error.filename or folder)
        place = Location(str(folder) if STAGE in named else named)
        raise SourceError(f"cannot write here: {error.strerror or error}", location=place, fix=_FIX) from error


def _commit(folder: Path, contents: Mapping[str, bytes], removed: Collection[str], seen: Seen) -> None:
    if folder.exists():
        with _locked(folder):
            _write(folder, contents, removed, seen)
    else:
        _appear(folder, contents)


def recover(folder: Path) -> None:
    """Finish what a killed run had begun to write, or throw it away where it had not begun.

    Raises:
        StoppedError: that run is still at work, or its journal is not of this user, or was made for another folder.
        SourceError: the folder cannot be written.
    """
    beside = _beside(folder)
    if not os.path.lexists(beside) and not os.path.lexists(folder / STAGE):
        return
    try:
        with alone(folder):
            for stage in (beside, folder / STAGE):
                if os.path.lexists(stage) and (stage.is_symlink() or not stage.is_dir()):
                    raise _in_the_way(str(stage), "a link or file has the name of the folder where files wait to be written")
            if beside.is_dir():
                with _locked(beside):
                    _throw_away(beside)
            if (folder / STAGE).is_dir():
                with _locked(folder):
                    _finish(folder)
    except OSError as error:
        place = Location(str(error.filename or folder))
        raise SourceError(f"cannot write here: {error.strerror or error}", location=place, fix=_FIX) from error


def look_only(folder: Path) -> None:
    """Make sure that nothing is to be finished in a folder that is only read, as in a dry run, which finishes nothing.

    Raises:
        StoppedError: a run was interrupted there, or is at work.
    """
    if os.path.lexists(folder / STAGE):
        raise StoppedError(
            "a run is at work in this folder, or was interrupted there", location=Location(str(folder)),
            fix="wait for it; if there is none, run again without a dry run, which finishes it first",
        )  # fmt: skip


def interrupted(folder: Path) -> bool:
    """Whether a killed run has left something to finish."""
    return (folder / STAGE / _JOURNAL).is_file()


def _beside(folder: Path) -> Path:
    return folder.parent / f"{STAGE}-{folder.name}"


def _appear(folder: Path, contents: Mapping[str, bytes]) -> None:
    """A new folder: made beside its place, moved there in one step."""
    beside = _beside(folder)
    try:
        _no_file_is_a_folder(folder, contents)
        beside.mkdir()
        own_stage(beside)
        with _locked(beside):
            _put(beside, contents)
            os.rename(beside, folder)
        forget(beside)
    except FileExistsError as error:
        message = "another run is making this folder"
        raise StoppedError(message, location=Location(str(folder)), fix="wait for it, then run again") from error
    except (OSError, SourceError):
        shutil.rmtree(beside, ignore_errors=True)
        raise


def _put(folder: Path, contents: Mapping[str, bytes]) -> None:
    made: set[str] = set()
    folder.mkdir(parents=True, exist_ok=True)
    for name, data in contents.items():
        target = f"{folder}/{name}"
        parent = target.rpartition("/")[0]
        if parent not in made:
            made.add(parent)
            os.makedirs(parent, exist_ok=True)
        with open(target, "wb") as file:
            file.write(data)


def _check(folder: Path, contents: Mapping[str, bytes]) -> None:
    """Make sure that every file can be moved to its place: once the journal is there, it must be.

    Raises:
        SourceError: something is in the way.
        OSError: a folder cannot be written.
    """
    for parent in sorted(_no_file_is_a_folder(folder, contents)):
        if os.path.isdir(parent):
            if not os.access(parent, os.W_OK):
                raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), parent)
        elif os.path.lexists(parent):
            raise _in_the_way(parent, "a file stands where a folder is to be made")
    _inside(folder, contents)
    for name in contents:
        target = f"{folder}/{name}"
        try:
            is_folder = stat.S_ISDIR(os.lstat(target).st_mode)
        except FileNotFoundError:
            is_folder = False
        if is_folder:
            raise _in_the_way(target, "a folder stands where a file is to be written")


def _inside(folder: Path, names: Collection[str]) -> None:
    """Make sure that no link leads out of the folder.

    Raises:
        SourceError: one does.
    """
    root = os.path.realpath(folder)
    for parent in {f"{folder}/{name}".rpartition("/")[0] for name in names}:
        real = os.path.realpath(parent)
        if os.path.commonpath([real, root]) != root:
            raise _in_the_way(parent, "a link leads out of the output folder")


def _in_the_way(path: str, message: str) -> SourceError:
    return SourceError(message, location=Location(path), fix="move it away, or give another output folder")


def _no_file_is_a_folder(folder: Path, contents: Mapping[str, bytes]) -> set[str]:
    """The folders of the files; none of them may be a file itself."""
    parents = {f"{folder}/{name}".rpartition("/")[0] for name in contents}
    pending = set(parents)
    while pending:  # their own folders too
        pending = {parent.rpartition("/")[0] for parent in pending if len(parent) > len(str(folder))} - parents
        parents |= pending
    for name in contents:
        if f"{folder}/{name}" in parents:
            raise _in_the_way(f"{folder}/{name}", "a file and a folder of one name are made")
    return parents


def _untouched(folder: Path, names: Collection[str], seen: Seen) -> None:
    """Make sure that no file that is about to be replaced or removed has an edit that the run does not know, or is protected.

    Raises:
        StoppedError: somebody has changed a file since the run has read it, or made it read-only.
    """
    for name in names:
        path = folder / name
        try:
            mode = path.stat().st_mode
        except (FileNotFoundError, NotADirectoryError):
            if seen.get(name) is None:
                continue
            mode = 0
        if stat.S_ISREG(mode) and not mode & 0o222:
            message, fix = "the file is read-only and would be changed", "make it writable, or move it away"
        elif name in seen and (read_bytes(path, OUTPUT) if stat.S_ISREG(mode) else None) != seen[name]:
            message, fix = "the file was changed while the run was at work", "run again"
        else:
            continue
        raise StoppedError(f"{message}; nothing was written", location=Location(str(path)), fix=fix)


def _write(folder: Path, contents: Mapping[str, bytes], removed: Collection[str], seen: Seen) -> None:
    stage = folder / STAGE
    names = {name: f"new/{number}" for number, name in enumerate(contents)}
    try:
        _check(folder, contents)
        _inside(folder, removed)
        stage.mkdir()
        own_stage(stage)
        _put(stage, {names[name]: data for name, data in contents.items()})
        for name, place in names.items():
            if os.path.exists(f"{folder}/{name}"):
                shutil.copymode(f"{folder}/{name}", stage / place)
        moved = {place: name for name, place in names.items()}
        journal = json.dumps({"run": secrets.token_hex(16), "move": moved, "remove": sorted(removed)}).encode()
        (stage / "journal").write_bytes(journal)
        _untouched(folder, [*contents, *removed], seen)
        bind(folder, journal)
    except (OSError, SourceError, StoppedError):
        shutil.rmtree(stage, ignore_errors=True)
        raise
    os.replace(stage / "journal", stage / _JOURNAL)  # from here on the new files win
    _finish(folder)


def _finish(folder: Path) -> None:
    """Move what the journal says; throw away what has no journal."""
    stage = folder / STAGE
    journal = stage / _JOURNAL
    if os.path.lexists(journal):
        moves, removed = _journal(folder, journal)
        made: set[str] = set()
        for place, name in moves.items():
            target = f"{folder}/{name}"
            parent = target.rpartition("/")[0]
            if parent not in made:
                made.add(parent)
                _inside(folder, [name])
                os.makedirs(parent, exist_ok=True)
            try:
                os.replace(f"{stage}/{place}", target)
            except FileNotFoundError:
                if not os.path.exists(target):
                    raise  # moved already by the run that was killed
        for name in removed:
            _inside(folder, [name])
            Path(folder, name).unlink(missing_ok=True)
            _tidy(folder, Path(folder, name).parent)
        journal.unlink()
        release(folder)
        shutil.rmtree(stage)
        forget(stage)
    elif stage.is_dir():
        _throw_away(stage)


def _throw_away(stage: Path) -> None:
    """Remove a folder of waiting files that a killed run has left before it had a journal, or one that is empty.

    Raises:
        StoppedError: no run of this user has made it: what is in it may be a person's.
    """
    if is_own_stage(stage):
        shutil.rmtree(stage)
        forget(stage)
    elif any(stage.iterdir()):
        raise StoppedError(
            "a folder has the name of that where files wait to be written, and no run of yours has made it; nothing was written",
            location=Location(str(stage)), fix="look at what is in it, move it away or remove it, then run again",
        )  # fmt: skip
    else:
        stage.rmdir()


def _journal(folder: Path, path: Path) -> tuple[dict[str, str], list[str]]:
    """What a journal of this user's own says: place in the stage -> relative path, and the relative paths that go.

    Raises:
        StoppedError: no run of this user made it for this folder, or a path of it leads out of the folder.
    """
    why = "by another user, or in another place, or it came with the folder"
    try:
        data = read_bytes(path, RECORD, follow=False)
        if is_bound(folder, data):
            found = json_of(data.decode())
            moves, removed = dict(found["move"]), list(found["remove"])
            if all(within(name) for name in (*moves, *moves.values(), *removed)):
                return moves, removed
            why = "and names files outside of the folder"
    except (OSError, ValueError, KeyError, TypeError) as error:
        why = f"and cannot be read ({error})"
    raise StoppedError(
        f"the record of an interrupted run is here that was made {why}; nothing of it was done, and nothing was written",
        location=Location(str(path)),
        fix=f"let that user run again in that place, or compare the files with '{STAGE}/new', remove '{STAGE}', run again",
    )


def _tidy(folder: Path, parent: Path) -> None:
    """Remove folders that a removed file leaves empty."""
    while parent != folder and parent.is_dir() and not any(parent.iterdir()):
        parent.rmdir()
        parent = parent.parent


@contextmanager
def _locked(folder: Path) -> Iterator[None]:
    """Keep other runs out of the folder. The system lets go of the lock when the process ends, however it ends."""
    try:
        import fcntl
    except ImportError:  # no such locks on this system
        yield
        return
    handle = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        yield
    except BlockingIOError:
        raise StoppedError(
            "another run is writing into this folder", location=Location(str(folder)), fix="wait for it, then run again"
        ) from None
    finally:
        os.close(handle)
