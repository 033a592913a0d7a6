"""Files that a run keeps for the next in the user's cache folder: what can be made again, and only is quicker when it is there.

A file that another user could have written, or that cannot be read, is passed over; where the folder cannot be written nothing
is kept. Files are written in one step, so that runs beside each other see a whole one. What a file is made of is part of its name
or its content, which is up to who keeps it.
"""

from __future__ import annotations

import os
import stat
from contextlib import suppress

from robosmi.inputs import flags
from robosmi.user_folders import cache_dir


def read_kept(name: str) -> bytes | None:
    """What was kept under a name, or None.

    Args:
        name: path below the cache folder.
    """
    with suppress(OSError):
        opened = os.open(cache_dir() / name, os.O_RDONLY | flags("O_NOFOLLOW", "O_CLOEXEC", "O_BINARY"))
        with os.fdopen(opened, "rb") as file:
            if _is_ours(os.fstat(opened)):
                return file.read()
    return None


def keep(name: str, data: bytes) -> None:
    """Keep bytes under a name, in place of what was kept there.

    Args:
        name: path below the cache folder.
        data: what the file will hold.
    """
    import tempfile  # slow to load, and wanted only when something is new

    place = cache_dir() / name
    with suppress(OSError):
        place.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
        handle, temporary = tempfile.mkstemp(dir=place.parent, prefix=".")
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(data)
            os.replace(temporary, place)
        except OSError:
            os.unlink(temporary)


def _is_ours(found: os.stat_result) -> bool:
    """Whether a file is a plain one that nobody but this user (or root) can have written."""
    if not stat.S_ISREG(found.st_mode):
        return False
    if not hasattr(os, "geteuid"):
        return True
    return found.st_uid in (os.geteuid(), 0) and not found.st_mode & (stat.S_IWGRP | stat.S_IWOTH)
