"""Files on disk, whole or not at all: atomic writes, and folders that move into place when they are complete.

A reader never sees half a file, and a run that fails leaves what was there. No model, no template here.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path, PurePosixPath

from robosmi.diagnostics import Location
from robosmi.errors import InternalError, SourceError


def digest(data: bytes) -> str:
    """SHA-256, hexadecimal."""
    return hashlib.sha256(data).hexdigest()


def read_input(path: Path, what: str) -> bytes:
    """The bytes of a file that the user gave.

    Args:
        path: the file.
        what: what it should be, for the message ("source file").

    Raises:
        SourceError: it does not exist, is a folder or may not be read.
    """
    try:
        return path.read_bytes()
    except FileNotFoundError:
        raise SourceError(f"the {what} does not exist", location=Location(str(path)), fix="check the path") from None
    except IsADirectoryError:
        raise SourceError(f"the {what} is a folder", location=Location(str(path)), fix="give a file") from None
    except OSError as error:
        raise SourceError(
            f"the {what} cannot be read: {error.strerror}", location=Location(str(path)), fix="check the file's permissions"
        ) from None


def write_atomic(path: Path, data: bytes) -> None:
    """Write a file by way of a temporary one beside it; the old content stays until the new one is complete.

    Raises:
        SourceError: the path is no ordinary file, or may not be written.
    """
    fix = "give another output path"
    if path.exists() and not path.is_file():
        raise SourceError("the output path is no ordinary file", location=Location(str(path)), fix=fix)
    try:
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


def within(name: str) -> bool:
    """Whether a relative path stays in the folder it is relative to."""
    path = PurePosixPath(name)
    return bool(path.parts) and not path.is_absolute() and ".." not in path.parts


def write_folder(folder: Path, contents: Mapping[str, bytes], obsolete: frozenset[str] = frozenset()) -> None:
    """Put files into a folder: all are written to a temporary folder first, then moved into place.

    The temporary folder lies where moving is one step: beside a folder that is new, in one that is there.

    Args:
        folder: the folder; made when missing. Files in it that are not named stay where they are.
        contents: relative path -> bytes. A file that already has these bytes is left untouched.
        obsolete: relative paths of an earlier run that are removed.

    Raises:
        SourceError: the folder may not be written, is a file, or has something in the way of a file.
    """
    fix = "give another output folder"
    if folder.exists() and not folder.is_dir():
        raise SourceError("the output path is a file", location=Location(str(folder)), fix=fix)
    for name in contents:
        _check_place(folder, name, fix)
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        stage = Path(tempfile.mkdtemp(prefix=".robosmi-", dir=folder if folder.is_dir() else folder.parent))
    except OSError as error:
        raise SourceError(f"cannot write here: {error.strerror}", location=Location(str(folder)), fix=fix) from error
    try:
        changed = {}
        for name, data in contents.items():
            target = folder / name
            if target.is_file() and target.read_bytes() == data:
                continue
            staged = stage / name
            staged.parent.mkdir(parents=True, exist_ok=True)
            staged.write_bytes(data)
            changed[name] = staged
        if not folder.exists():
            os.chmod(stage, 0o755)
            os.rename(stage, folder)
            return
        for name, staged in changed.items():
            target = folder / name
            target.parent.mkdir(parents=True, exist_ok=True)
            os.replace(staged, target)
        for name in obsolete:
            (folder / name).unlink(missing_ok=True)
    except OSError as error:
        raise SourceError(f"cannot write here: {error.strerror}", location=Location(str(folder)), fix=fix) from error
    finally:
        shutil.rmtree(stage, ignore_errors=True)


def _check_place(folder: Path, name: str, fix: str) -> None:
    """Make sure that a file can be moved to its place, so that moving does not stop halfway."""
    if not within(name):
        raise InternalError(f"'{name}' would be written outside of the output folder '{folder}'")
    target = folder / name
    if target.is_dir():
        raise SourceError("a folder stands where a file is to be written", location=Location(str(target)), fix=fix)
    for parent in target.parents:
        if parent == folder:
            return
        if parent.exists() and not parent.is_dir():
            raise SourceError("a file stands where a folder is to be made", location=Location(str(parent)), fix=fix)
