"""Files in the user's cache folder: results that can be computed again, only more slowly.

A file that another user could have written, or that cannot be read, is ignored; if the folder cannot be written, nothing is
cached. Files are written atomically, so concurrent runs see complete ones. The caller makes a file's name or content depend on
everything that the result depends on.
"""

from __future__ import annotations

import atexit
import errno
import hashlib
import os
import stat
import sys
import tempfile
import threading
import zlib
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path
from typing import Generic, TypeVar

import msgspec

import robosmi
from robosmi import inputs
from robosmi.base.user_folders import cache_dir
from robosmi.inputs import Kind

T = TypeVar("T")

if sys.platform == "win32":
    _FLAGS = os.O_RDONLY | os.O_BINARY
else:
    _FLAGS = os.O_RDONLY | os.O_NOFOLLOW | os.O_CLOEXEC


def read_cached(name: str) -> bytes | None:
    """The content of a cached file; None if there is none.

    Args:
        name: path below the cache folder.
    """
    with suppress(OSError), os.fdopen(os.open(cache_dir() / name, _FLAGS), "rb") as file:
        if _is_ours(os.fstat(file.fileno())):
            return file.read()
    return None


def read_own(path: Path, kind: Kind) -> bytes:
    """The content of a file that says what this user has done or allowed.

    Args:
        path: the file.
        kind: what it is, which says how many bytes it may have.

    Raises:
        OSError: it is not there, cannot be read, or another user could have written it.
    """
    with inputs.open_file(path, follow=False) as file:
        if not _is_ours(os.fstat(file.fileno())):
            raise PermissionError(errno.EPERM, "another user could have written it", str(path))
        data = inputs.read_whole(file, kind)
    if data is None:
        raise OSError(errno.EFBIG, f"it is larger than {kind.limit}", str(path))
    return data


def write_own(path: Path, text: str) -> None:
    """Replace a file that says what this user has done or allowed, in a folder that is there.

    Raises:
        OSError: it cannot be written.
    """
    beside = path.with_name(f"{path.name}.{os.getpid()}.{threading.get_ident()}")
    beside.touch(mode=0o600)
    beside.write_text(text, encoding="utf-8")
    os.replace(beside, path)


def is_own(path: Path) -> bool:
    """Whether a path is an ordinary file, and no link, that only this user (or root) can have written."""
    try:
        return _is_ours(path.lstat())
    except OSError:
        return False


def write_cached(name: str, data: bytes) -> None:
    """Write or replace a cached file.

    Args:
        name: path below the cache folder.
        data: its content.
    """
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


def code_version(*modules: str) -> str:
    """A text that changes whenever the source of one of these modules does; nothing is imported but their packages.

    Raises:
        ModuleNotFoundError: there is no module of that full name.
    """
    stamps = [robosmi.__version__]
    for name in modules:
        spec = find_spec(name)
        if spec is None:
            raise ModuleNotFoundError(f"no module named {name!r}", name=name)
        stamps.append(name)
        with suppress(OSError):  # a module in a zip archive
            found = os.stat(spec.origin or "")
            stamps.append(f"{found.st_mtime_ns} {found.st_size}")
    return hashlib.sha256("\n".join(stamps).encode()).hexdigest()[:16]


class CachedResults(Generic[T]):
    """Results of a pure function of a text, cached in one JSON file.

    The file begins with the version and a checksum; a file of another version and a damaged one are ignored. New results are
    written when the process ends, merged with those that other processes have written meanwhile.

    Args:
        name: the file's path below the cache folder.
        version: changes whenever the function gives other results for the same text.
        kind: type of the results, as `msgspec` decodes it.
        most: maximum number of results in the file; beyond it the file is started anew.
    """

    def __init__(self, name: str, version: str, kind: type[T], most: int) -> None:
        self._name = name
        self._head = f"{version}\n".encode()
        self._decoder = msgspec.json.Decoder(kind)
        self._most = most
        self._known: dict[str, msgspec.Raw] | None = None
        self._new: dict[str, msgspec.Raw] = {}

    def get(self, text: str) -> T | None:
        """The result for a text, a new copy each time; None if it is not cached."""
        if self._known is None:
            self._known = self._read()
        key = _digest(text)
        found = self._new.get(key) or self._known.get(key)
        with suppress(msgspec.MsgspecError):  # cached by a program whose type has other fields
            return self._decoder.decode(found) if found is not None else None
        return None

    def put(self, text: str, result: T) -> None:
        """Cache the result for a text, unless JSON cannot represent it exactly (dates, infinity)."""
        written = msgspec.Raw(msgspec.json.encode(result))
        with suppress(msgspec.MsgspecError):
            if self._decoder.decode(written) == result:
                if not self._new:
                    atexit.register(self._write)
                self._new[_digest(text)] = written

    def _read(self) -> dict[str, msgspec.Raw]:
        data = read_cached(self._name) or b""
        body = data[len(self._head) + 4 :]
        if not body or data[: -len(body)] != self._head + _checksum(body):
            return {}
        with suppress(msgspec.MsgspecError):
            return msgspec.json.decode(body, type=dict[str, msgspec.Raw])
        return {}

    def _write(self) -> None:
        whole = {**self._read(), **self._new}
        body = msgspec.json.encode(whole if len(whole) <= self._most else self._new)
        write_cached(self._name, self._head + _checksum(body) + body)


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()


def _checksum(data: bytes) -> bytes:
    return zlib.crc32(data).to_bytes(4, "big")


def _is_ours(found: os.stat_result) -> bool:
    """Whether a file is an ordinary one that only this user (or root) can have written."""
    if not stat.S_ISREG(found.st_mode):
        return False
    if not hasattr(os, "geteuid"):
        return True
    return found.st_uid in (os.geteuid(), 0) and not found.st_mode & (stat.S_IWGRP | stat.S_IWOTH)
