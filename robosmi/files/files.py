"""Writes single files atomically, and checks inputs and relative paths.

Folders of files are written by `commit`. A reader never sees a partial file, and a failing run keeps the old one.
"""

from __future__ import annotations

import hashlib
import os
from pathlib import Path, PurePosixPath, PureWindowsPath

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, StoppedError

ANOTHER_NAME = "give the result another name, or move that file away"
"""The advice if something blocks the path of a result."""


def digest(data: bytes) -> str:
    """SHA-256, hexadecimal."""
    return hashlib.sha256(data).hexdigest()


def read_input(path: Path, what: str, kind: inputs.Kind) -> bytes:
    """The bytes of a file that the user gave.

    Args:
        path: the file.
        what: what it should be, for the message ("source file").
        kind: its kind, which says how many bytes it may have.

    Raises:
        SourceError: it does not exist, is no ordinary file, is too large or may not be read.
    """
    try:
        return inputs.read_bytes(path, kind)
    except FileNotFoundError:
        raise SourceError(f"the {what} does not exist", location=Location(str(path)), fix="check the path") from None
    except IsADirectoryError:
        raise SourceError(f"the {what} is a folder", location=Location(str(path)), fix="give a file") from None
    except OSError as error:
        raise SourceError(
            f"the {what} cannot be read: {error.strerror}", location=Location(str(path)),
            fix=inputs.fix_of(error, "check the file's permissions"),
        ) from None  # fmt: skip


def free_name(folder: Path, name: str) -> str:
    """A name that no file of the folder has: the given one, or with a number behind it.

    Args:
        folder: the folder.
        name: relative to it.
    """
    number, found = 1, name
    while os.path.lexists(folder / found):
        number += 1
        found = f"{name}.{number}"
    return found


def write_atomic(path: Path, data: bytes) -> None:
    """Write a file by way of a temporary one beside it; the old content stays until the new one is complete.

    Raises:
        SourceError: the path is no ordinary file, or may not be written.
    """
    import tempfile  # slow to load, and wanted only where a single file is written

    fix = "give another output path"
    try:
        if path.exists() and not path.is_file():
            raise SourceError("the output path is not an ordinary file", location=Location(str(path)), fix=fix)
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, temporary = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    except OSError as error:
        raise SourceError(f"cannot write here: {error.strerror}", location=Location(str(path)), fix=fix) from error
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())  # the rename must not reach the disk before the bytes
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except OSError as error:
        raise SourceError(f"cannot write here: {error.strerror}", location=Location(str(path)), fix=fix) from error
    finally:
        Path(temporary).unlink(missing_ok=True)


def refuse_link(path: Path) -> None:
    """Make sure that the path of a result is not a link, which would be replaced, or written through.

    Raises:
        StoppedError: it is a link, wherever it leads.
    """
    if path.is_symlink():
        raise StoppedError("the result's path is a link, which would be replaced", location=Location(str(path)), fix=ANOTHER_NAME)


def within(name: str) -> bool:
    """Whether a relative path stays in the folder it is relative to."""
    path = PurePosixPath(name)
    windows = PureWindowsPath(name)
    drive = os.name == "nt" and bool(windows.drive or windows.root)
    return bool(path.parts) and not path.is_absolute() and ".." not in windows.parts and "\0" not in name and not drive
