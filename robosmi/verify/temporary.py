"""Folders for passing files, of which none stays: those of a process that was killed are removed by the next one.

A process that ends in order, or by a signal that it hears, removes its own. One that is killed outright cannot; so the name of a
folder tells whose it is, and the first folder that a process makes sweeps out those of processes that are no more.
"""

from __future__ import annotations

import os
import re
import shutil
import tempfile
from contextlib import suppress
from functools import cache
from pathlib import Path
from time import time

_NAME = re.compile(r"robosmi-[a-z]+-(\d+)-\w+")
_LEAST_AGE_S = 3600.0
"""A younger folder stays: its process may run where this one cannot see it, such as in another container."""


def temporary_folder(what: str) -> tempfile.TemporaryDirectory[str]:
    """A folder that is removed when the context ends.

    Args:
        what: a word in lower case that tells what it is for.
    """
    _sweep_once(os.getpid())
    return tempfile.TemporaryDirectory(prefix=f"robosmi-{what}-{os.getpid()}-", ignore_cleanup_errors=True)


@cache
def _sweep_once(process: int) -> None:
    sweep(Path(tempfile.gettempdir()))


def sweep(place: Path) -> None:
    """Remove the folders in a place whose processes are no more, of this user, an hour old at least.

    Args:
        place: the folder for temporary files.
    """
    with suppress(OSError):
        for path in place.glob("robosmi-*"):
            named = _NAME.fullmatch(path.name)
            with suppress(OSError):
                if named is not None and not _runs(int(named[1])) and _is_own_and_old(path):
                    shutil.rmtree(path, ignore_errors=True)


def _is_own_and_old(path: Path) -> bool:
    found = path.lstat()
    own = not path.is_symlink() and path.is_dir() and found.st_uid == os.getuid()
    return own and time() - found.st_mtime > _LEAST_AGE_S


def _runs(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):
        return True
    return True
