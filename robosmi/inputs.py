"""The only module that opens files for reading: ordinary files only, up to a maximum size for their kind.

A named pipe, a device or a socket can block a reader forever, and an endless file exhausts the memory. So a path is checked
before it is opened, opened without blocking, and the opened file is checked again, since the path may lead to another file by
then. Files are written by `robosmi.files.files` and `commit`.
"""

from __future__ import annotations

import codecs
import errno
import os
import re
import stat
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import BinaryIO

from msgspec import Struct

_MB = 1024 * 1024


def flags(*names: str) -> int:
    """The combined flags of `os.open` with these names, without those that the system lacks."""
    number: int = 0
    for name in names:
        number |= getattr(os, name, 0)
    return number


_FLAGS = os.O_RDONLY | flags("O_NONBLOCK", "O_NOCTTY", "O_CLOEXEC", "O_BINARY")
_NO_LINK = flags("O_NOFOLLOW")
_ODD = {stat.S_IFIFO: "a named pipe", stat.S_IFCHR: "a device", stat.S_IFBLK: "a device", stat.S_IFSOCK: "a socket"}


class Kind(Struct, frozen=True):
    """A kind of file: what it is called in messages, and how many bytes it may have."""

    name: str
    most: int

    @property
    def limit(self) -> str:
        """The limit as the user writes it, as `8 MB`."""
        return f"{self.most // _MB} MB"


SOURCE = Kind("source file", 8 * _MB)
DRAWING = Kind("drawing", 64 * _MB)
MODEL = Kind("model", 1024 * _MB)
TABLE = Kind("table", 64 * _MB)
SETTINGS = Kind("file of settings", 1 * _MB)
"""`robosmi.toml`, a chain, a pin table, the description of a board, a part or a library."""
RECORD = Kind("record of earlier runs", 16 * _MB)
"""A journal, a manifest, the state of a chain."""
HISTORY = Kind("exported history", 64 * _MB)
DATA = Kind("file of platform data", 64 * _MB)
"""What is in the platform repository, or was imported into it."""
OUTPUT = Kind("file of an output folder", MODEL.most)
"""What a run made, or is about to write over."""


class InputRejectedError(OSError):
    """A file is not ordinary, or is larger than its kind may be. `strerror` is the cause, `fix` says what to do."""

    def __init__(self, number: int, cause: str, path: object, fix: str) -> None:
        super().__init__(number, cause, path)
        self.fix = fix


def fix_of(error: OSError, otherwise: str) -> str:
    """What to do about a file that cannot be read.

    Args:
        error: what reading it raised.
        otherwise: the advice where the error has none of its own.
    """
    return error.fix if isinstance(error, InputRejectedError) else otherwise


def open_file(path: str | os.PathLike[str], *, follow: bool = True, dir_fd: int | None = None) -> BinaryIO:
    """Open an ordinary file for reading, without ever waiting for it.

    Args:
        path: the file.
        follow: whether the path itself may be a link; links among its folders are always followed.
        dir_fd: descriptor of the folder that the path is relative to; None for the current one.

    Raises:
        InputRefusedError: it is a named pipe, a device or a socket, or no file can have such a name.
        OSError: it does not exist, is a folder or may not be read.
    """
    try:
        _check(os.stat(path, follow_symlinks=follow, dir_fd=dir_fd), path)  # opening a device can already act on it
        handle = os.open(path, _FLAGS | (0 if follow else _NO_LINK), dir_fd=dir_fd)
    except ValueError as error:  # a null character, or half a character
        raise InputRejectedError(errno.EINVAL, f"no file can have such a name ({error})", path, "check the path") from None
    try:
        _check(os.fstat(handle), path)
        return os.fdopen(handle, "rb")
    except BaseException:
        os.close(handle)
        raise


def check_ordinary(path: str | os.PathLike[str]) -> None:
    """Make sure that a path may be given to a library that opens it by itself, as SQLite does.

    The file is not opened here: closing it again would let go of the locks that the process has on it.

    Raises:
        InputRefusedError: it is no ordinary file, or no file can have such a name.
        OSError: it does not exist, is a folder or may not be looked at.
    """
    try:
        _check(os.stat(path), path)
    except ValueError as error:
        raise InputRejectedError(errno.EINVAL, f"no file can have such a name ({error})", path, "check the path") from None


def _check(found: os.stat_result, path: object) -> None:
    kind = stat.S_IFMT(found.st_mode)
    if kind == stat.S_IFLNK:  # the path itself may be none
        raise OSError(errno.ELOOP, os.strerror(errno.ELOOP), path)
    if kind == stat.S_IFDIR:
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), path)
    if kind in _ODD:
        cause = f"it is {_ODD[kind]}, not an ordinary file"
        raise InputRejectedError(errno.EINVAL, cause, path, "give an ordinary file; copy into one what is to be read")


_READ: ContextVar[dict[str, bytes] | None] = ContextVar("read", default=None)


@contextmanager
def read_once() -> Iterator[None]:
    """Context manager, and decorator: a source file, drawing, table, settings file or file of platform data that is read again
    has the content of the first time.

    So all steps of one run see the same bytes, and each file is opened once. The contents are dropped at the end.
    """
    token = _READ.set({}) if _READ.get() is None else None
    try:
        yield
    finally:
        if token is not None:
            _READ.reset(token)


@contextmanager
def provided(path: str | os.PathLike[str], data: bytes) -> Iterator[None]:
    """Context manager: a file that is not written yet is read with these bytes; the rest is as with `read_once`."""
    with read_once():
        kept = _READ.get()
        assert kept is not None
        kept[os.path.abspath(path)] = data
        yield


_CHECK: ContextVar[Callable[[str | os.PathLike[str], bytes], None] | None] = ContextVar("check", default=None)


@contextmanager
def checked(check: Callable[[str | os.PathLike[str], bytes], None]) -> Iterator[None]:
    """Context manager: `check` is called with the path and bytes of each file read, before they are used; it may raise."""
    token = _CHECK.set(check)
    try:
        yield
    finally:
        _CHECK.reset(token)


def read_bytes(path: str | os.PathLike[str], kind: Kind, *, follow: bool = True, dir_fd: int | None = None) -> bytes:
    """The bytes of an ordinary file.

    Args:
        path: the file.
        kind: what it is, which says how many bytes it may have.
        follow: whether the path itself may be a link.
        dir_fd: descriptor of the folder that the path is relative to; None for the current one.

    Raises:
        InputRefusedError: it is no ordinary file, or is larger than its kind may be.
        OSError: it does not exist, is a folder or may not be read.
    """
    data = _read(path, kind, follow, dir_fd)
    if (check := _CHECK.get()) is not None:
        check(path, data)
    return data


def _read(path: str | os.PathLike[str], kind: Kind, follow: bool, dir_fd: int | None) -> bytes:
    kept = _READ.get() if kind in (SOURCE, DRAWING, TABLE, SETTINGS, DATA) and dir_fd is None else None
    name = os.path.abspath(path) if kept is not None else ""
    if kept is not None and name in kept and len(kept[name]) <= kind.most:
        return kept[name]
    with open_file(path, follow=follow, dir_fd=dir_fd) as stream:
        data = read_whole(stream, kind)
    if data is None:
        cause = f"it is larger than {kind.limit}, the most that a {kind.name} may have"
        raise InputRejectedError(errno.EFBIG, cause, path, f"check that it is a {kind.name}, or split it")
    if kind is SOURCE and b"\r" in data:
        data = _OLD_END.sub(b"\n", data)
    if kept is not None:
        kept[name] = data
    return data


def read_whole(stream: BinaryIO, kind: Kind) -> bytes | None:
    """The content of an open file; None if it is larger than its kind may be.

    It takes no more memory than the file has bytes: `read` makes room for as many as it is asked for.
    """
    size = os.fstat(stream.fileno()).st_size
    if size > kind.most:
        return None
    data = stream.read(size + 1)
    if len(data) > size:  # the size may be wrong, as in /proc
        data += stream.read(kind.most + 1 - len(data))
    return data if len(data) <= kind.most else None


_OLD_END = re.compile(rb"\r(?!\n)")
"""The line end of old systems (a carriage return alone), which compilers accept."""


def read_text(path: str | os.PathLike[str], kind: Kind, encoding: str = "utf-8", errors: str = "strict") -> str:
    """The text of an ordinary file, its line ends as line feeds.

    Settings and tables may begin with a byte order mark, as tools of Windows write them: it says the encoding and is left out.

    Args:
        path: the file.
        kind: what it is, which says how many bytes it may have.
        encoding: as for `bytes.decode`.
        errors: as for `bytes.decode`.

    Raises:
        OSError: as for `read_bytes`.
        UnicodeDecodeError: it is no text in that encoding.
    """
    data = read_bytes(path, kind)
    if encoding == "utf-8" and kind in (SETTINGS, TABLE):
        encoding = next((name for mark, name in _MARKS.items() if data.startswith(mark)), encoding)
    return data.decode(encoding, errors).replace("\r\n", "\n").replace("\r", "\n")


_MARKS = {
    codecs.BOM_UTF8: "utf-8-sig",
    codecs.BOM_UTF32_LE: "utf-32",
    codecs.BOM_UTF32_BE: "utf-32",
    codecs.BOM_UTF16_LE: "utf-16",
    codecs.BOM_UTF16_BE: "utf-16",
}
"""Byte order mark -> encoding; that of UTF-32 goes before that of UTF-16, with which it begins."""
