"""Temporary folders that are always removed in the end: those of a killed process by the next process.

A process that ends normally, or by a signal that it handles, removes its own folders. One that is killed cannot; so a folder's
name contains the process id, and the first folder that a process makes triggers the removal of those whose processes are gone.
A process locks each of its folders, and the lock disappears with the process; it protects the folders of a process that is not
visible here, such as one in another container.
"""

from __future__ import annotations

import atexit
import errno
import os
import re
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path
from secrets import token_hex
from time import time

from robosmi.base.file_locks import LOCKS, lock_now, unlock
from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.inputs import flags

MAKE_SPACE = "free space there, or set TMPDIR to a folder with more"
"""What to do if the folder for temporary files is full."""
_NAME = re.compile(r"robosmi-[a-z]+-(\d+)-(held_)?\w+")
_LEAST_AGE_S = 3600.0
"""A younger folder without a lock stays: its process may run where this one cannot see it, such as in another container."""
_MADE_S = 10.0
"""So long at most a folder may be there before it is locked."""


_NO_SPACE = (errno.ENOSPC, errno.EDQUOT)
_LEAST_SPACE = 2**16
"""A disk with less bytes is full: what was written in part may have been removed again."""


_OPEN: set[Path] = set()
"""The folders of this process that are still there: an interruption may come while one is made or removed."""


@contextmanager
def temporary_folder(what: str) -> Iterator[str]:
    """A folder that is removed when the context ends, or when the process does if that is interrupted.

    Args:
        what: a word in lower case that tells what it is for.

    Raises:
        SourceError: there is no space for the folder, or for a file in it.
    """
    _sweep_once(os.getpid())
    path = Path(tempfile.gettempdir()) / f"robosmi-{what}-{os.getpid()}-{'held_' if LOCKS else ''}{token_hex(6)}"
    _OPEN.add(path)  # before it is there: nobody else knows its name
    lock: int | None = None
    try:
        path.mkdir(mode=0o700)
        lock = _locked(path)
        yield str(path)
    except OSError as error:
        if error.errno not in _NO_SPACE or not _is_about(error, path):
            raise
        raise SourceError(
            f"a file cannot be written in the temporary folder: {error.strerror}", location=Location(str(path.parent)),
            fix=MAKE_SPACE,
        ) from error  # fmt: skip
    finally:
        _remove(path)
        if lock is not None:
            unlock(lock)


def _is_about(error: OSError, folder: Path) -> bool:
    """Whether an error is about a file in a temporary folder: by its name, else (a write has none) by the space that is left."""
    if isinstance(error.filename, str):
        return Path(error.filename).is_relative_to(folder)
    return shutil.disk_usage(folder.parent).free < _LEAST_SPACE


def _locked(path: Path) -> int | None:
    """An open folder on which this process holds a lock; None where another has it, or there are no locks."""
    return lock_now(path, os.O_RDONLY | flags("O_DIRECTORY", "O_NOFOLLOW"))


def _remove(path: Path) -> None:
    shutil.rmtree(path, ignore_errors=True)
    if not path.exists():  # a process that is just being ended may have written into it
        _OPEN.discard(path)


@atexit.register
def _remove_what_is_left() -> None:
    for path in sorted(_OPEN):
        if f"-{os.getpid()}-" in path.name:  # not those of the process that this one was forked from
            _remove(path)


@cache
def _sweep_once(process: int) -> None:
    sweep(Path(tempfile.gettempdir()))


def sweep(place: Path) -> None:
    """Remove the folders in a place whose processes are no more, of this user: whose lock is free, else an hour old at least.

    Args:
        place: the folder for temporary files.
    """
    with suppress(OSError):
        for path in place.glob("robosmi-*"):
            named = _NAME.fullmatch(path.name)
            with suppress(OSError):
                if named is not None and not _runs(int(named[1])) and _is_own(path) and _is_left(path, bool(named[2])):
                    shutil.rmtree(path, ignore_errors=True)


def _is_own(path: Path) -> bool:
    return not path.is_symlink() and path.is_dir() and path.lstat().st_uid == os.getuid()


def _is_left(path: Path, held: bool) -> bool:
    """Whether a folder whose process is not visible here is no longer in use."""
    age_s = time() - path.lstat().st_mtime
    if age_s > _LEAST_AGE_S or not held:
        return age_s > _LEAST_AGE_S
    lock = _locked(path) if age_s > _MADE_S else None
    if lock is not None:
        unlock(lock)
    return lock is not None


def _runs(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):
        return True
    return True
