"""The start of every writing run: gets exclusive access to the output folder, and completes what a killed run had begun there.

New files wait in a folder of their own until a journal lists the moves (`commit`). An interrupted commit is completed, or
discarded if there was no journal yet. A journal that no run of this user made for this folder (see `run_lock`) is reported and
not executed.
"""

from __future__ import annotations

import os
import signal
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from robosmi.base.data_text import as_table, as_text, as_texts, json_of
from robosmi.base.ending_signals import ending_signals
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, StoppedError
from robosmi.files.directory_fd import DirectoryFd, in_the_way
from robosmi.files.external_files import drop, take_places
from robosmi.files.files import within
from robosmi.files.run_lock import alone, forget, is_bound, is_own_stage, release
from robosmi.inputs import RECORD

STAGE = ".robosmi-commit"
"""Name of the folder of files waiting to be moved: in the output folder, or beside a new one (with its name appended)."""
JOURNAL = f"{STAGE}/journal.json"
_FIX = "give another output folder, or check its permissions and the space on the disk"


@contextmanager
def at_work(folder: Path) -> Iterator[None]:
    """Context manager of a run, from recovery to its end: excludes other runs of this user. May be nested.

    Raises:
        StoppedError: another run is at work, or an interrupted one must be looked at (see `recover`).
        SourceError: the folder cannot be written.
    """
    with alone(folder):
        recover(folder)
        yield


def recover(folder: Path) -> None:
    """Complete a killed run's commit, or discard it if it had not begun to move files.

    Raises:
        StoppedError: that run is still at work, or its journal is not of this user, or was made for another folder.
        SourceError: the folder cannot be written.
    """
    beside = staging_path(folder)
    if not os.path.lexists(beside) and not os.path.lexists(folder / STAGE):
        return
    with alone(folder), writing(folder):
        if os.path.lexists(beside):
            with DirectoryFd(folder.parent) as above:
                _throw_away(above, beside.name, folder)
        if os.path.lexists(folder / STAGE):
            with DirectoryFd(folder) as held, held.locked(), uninterrupted():
                finish(held)


@contextmanager
def writing(folder: Path) -> Iterator[None]:
    """Context manager: report system errors of writing into a folder as `SourceError`.

    Raises:
        SourceError: the system refused something.
    """
    try:
        yield
    except OSError as error:
        named = str(error.filename or folder)
        place = Location(str(folder) if STAGE in named else named)
        raise SourceError(f"cannot write here: {error.strerror or error}", location=place, fix=_FIX) from error


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Context manager: delay interruptions by the user, and requests to terminate, until all files are in place."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, ending_signals())
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def look_only(folder: Path) -> None:
    """Make sure that no commit is pending in a folder that is only read, as in a dry run, which completes none.

    Raises:
        StoppedError: a run was interrupted there, or is at work.
    """
    if os.path.lexists(folder / STAGE):
        raise StoppedError(
            "a run is active in this folder, or was interrupted", location=Location(str(folder)),
            fix="wait for it; if none is active, run again without --dry-run, which finishes it first",
        )  # fmt: skip


def interrupted(folder: Path) -> bool:
    """Whether a killed run has left a commit to complete."""
    return (folder / JOURNAL).is_file()


def staging_path(folder: Path) -> Path:
    """The path where the files of a new folder wait until it is moved to its destination."""
    return folder.parent / f"{STAGE}-{folder.name}"


def finish(held: DirectoryFd) -> None:
    """Perform the moves in a folder's journal, or discard the waiting files if there is no journal.

    Raises:
        StoppedError: the journal is not of this user, or was made for another folder.
        SourceError: a link leads out of the folder.
        OSError: the folder cannot be written.
    """
    with _stage(held, STAGE):
        pass
    if held.look(JOURNAL) is None:
        _throw_away(held, STAGE, held.path)
        return
    moves, removed, run = _journal(held)
    for place, name in moves.items():
        try:
            held.move(f"{STAGE}/{place}", name)
        except FileNotFoundError:
            if held.look(name) is None:
                raise  # moved already by the run that was killed
    for name in removed:
        held.remove(name)
    take_places(held.path, run)
    held.remove(JOURNAL)
    release(held.path)
    drop(held.path)
    if held.look(STAGE) is not None:  # the journal may have been all that was left
        held.remove_folder(STAGE)
    forget(held.path / STAGE)


def _stage(above: DirectoryFd, name: str) -> DirectoryFd:
    """The folder of waiting files.

    Raises:
        SourceError: a link or a file has its name.
    """
    found = above.look(name)
    if found is not None and not stat.S_ISDIR(found.st_mode):
        message = "a link or file has the name of the folder where files wait to be written"
        raise in_the_way(f"{above.path}/{name}", message)
    return above.inner(name)


def _throw_away(above: DirectoryFd, name: str, folder: Path) -> None:
    """Remove a folder of waiting files that a killed run has left before it had a journal, or one that is empty.

    Args:
        above: where it is.
        name: its name.
        folder: the output folder that the files were for.

    Raises:
        StoppedError: a run is at work there, or no run of this user has made it: what is in it may be the user's.
        SourceError: a link or a file has its name.
    """
    path = above.path / name
    with _stage(above, name) as stage, stage.locked():
        if is_own_stage(path, stage.identity()):
            drop(folder)
            above.remove_folder(name)
            forget(path)
        elif not stage.is_empty():
            raise StoppedError(
                "a folder has the name of that where files wait to be written, and no run of yours has made it; "
                "nothing was written",
                location=Location(str(path)), fix="check its content, move it away or remove it, then run again",
            )  # fmt: skip
        else:
            above.remove_folder(name)


def _journal(held: DirectoryFd) -> tuple[dict[str, str], list[str], object]:
    """The content of a journal of this user's run: path in the stage -> relative path, the paths to remove, the run's name.

    Raises:
        StoppedError: no run of this user made it for this folder, or a path of it leads out of the folder.
    """
    why = "by another user, or in another place, or it came with the folder"
    try:
        data = held.read(JOURNAL, RECORD)
        if is_bound(held.path, data):
            found = as_table(json_of(data.decode()))
            moves = {place: as_text(name) for place, name in as_table(found["move"]).items()}
            removed = as_texts(found["remove"])
            if all(within(name) for name in (*moves, *moves.values(), *removed)):
                return moves, removed, found.get("run")
            why = "and names files outside of the folder"
    except (OSError, ValueError, KeyError, TypeError) as error:
        why = f"and cannot be read ({error})"
    raise StoppedError(
        f"the record of an interrupted run is here that was made {why}; nothing of it was done, and nothing was written",
        location=Location(str(held.path / JOURNAL)),
        fix=f"let that user run again in that place, or compare the files with '{STAGE}/new', remove '{STAGE}', run again",
    )
