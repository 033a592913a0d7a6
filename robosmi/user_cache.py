"""Files that a run keeps for later runs in the user's cache folder: results that can be recomputed, only more slowly.

A file that another user could have written, or that cannot be read, is ignored; if the folder cannot be written, nothing is
kept. Files are written atomically, so concurrent runs see complete ones. The caller makes a file's name or content depend on
everything that the result depends on.
"""

from __future__ import annotations

import atexit
import marshal
import os
import stat
import sys
import zlib
from collections.abc import Callable
from contextlib import suppress
from typing import BinaryIO, Generic, TypeVar

from robosmi.user_folders import cache_dir

K = TypeVar("K")
V = TypeVar("V")

if sys.platform == "win32":
    _FLAGS = os.O_RDONLY | os.O_BINARY
else:
    _FLAGS = os.O_RDONLY | os.O_NOFOLLOW | os.O_CLOEXEC


def open_kept(name: str) -> BinaryIO | None:
    """The opened file that was kept under a name, or None.

    Args:
        name: path below the cache folder.
    """
    with suppress(OSError):
        file = os.fdopen(os.open(cache_dir() / name, _FLAGS), "rb")
        if _is_ours(os.fstat(file.fileno())):
            return file
        file.close()
    return None


def read_kept(name: str) -> bytes | None:
    """What was kept under a name, or None.

    Args:
        name: path below the cache folder.
    """
    if (file := open_kept(name)) is None:
        return None
    with suppress(OSError), file:
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


class KeptResults(Generic[K, V]):
    """Results of a pure function, kept in one file from one run to the next.

    Keys and results are plain Python values (those that `marshal` accepts). The file is valid for one build of Python and has a
    checksum; a damaged one is ignored. New results are written when the process ends, merged with those that other processes
    have written meanwhile.

    Args:
        name: the file's path below the cache folder.
        form: changes whenever the function gives other results for the same arguments.
        most: limit on the results in the file; beyond it the file is started anew.
    """

    def __init__(self, name: str, form: str, most: int) -> None:
        self._name = f"{name}-{sys.implementation.cache_tag}"
        self._head = f"{form} {sys.version}".replace("\n", " ").encode() + b"\n"
        self._most = most
        self._known: dict[K, V] | None = None
        self._new: dict[K, V] = {}

    def get(self, key: K) -> V | None:
        """What was kept for a key, or None."""
        if self._known is None:
            self._known = self._read()
        return self._known[key] if key in self._known else self._new.get(key)

    def put(self, key: K, result: V) -> None:
        """Keep a result from the end of this process on."""
        if not self._new:
            atexit.register(self._write)
        self._new[key] = result

    def _read(self) -> dict[K, V]:
        data = read_kept(self._name) or b""
        body = data[len(self._head) + 4 :]
        if not body or data[: -len(body)] != self._head + _sum(body):
            return {}
        loads: Callable[[bytes], dict[K, V]] = marshal.loads
        return loads(body)

    def _write(self) -> None:
        whole = {**self._read(), **self._new}
        data = marshal.dumps(whole if len(whole) <= self._most else self._new)
        keep(self._name, self._head + _sum(data) + data)


def _sum(data: bytes) -> bytes:
    return zlib.crc32(data).to_bytes(4, "big")


def _is_ours(found: os.stat_result) -> bool:
    """Whether a file is an ordinary one that only this user (or root) can have written."""
    if not stat.S_ISREG(found.st_mode):
        return False
    if not hasattr(os, "geteuid"):
        return True
    return found.st_uid in (os.geteuid(), 0) and not found.st_mode & (stat.S_IWGRP | stat.S_IWOTH)
