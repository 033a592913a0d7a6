"""Files on disk, whole or not at all: atomic writes, and folders that move into place when they are complete.

A reader never sees half a file, and a run that fails leaves what was there. No model, no template here.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path

from robosmi.diagnostics import Location
from robosmi.errors import SourceError


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
        SourceError: the folder does not exist or may not be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, temporary = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    except OSError as error:
        raise SourceError(f"cannot write here: {error.strerror}", location=Location(str(path)), fix="give another output path") from error
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise


def write_folder(folder: Path, contents: Mapping[str, bytes], obsolete: frozenset[str] = frozenset()) -> None:
    """Put files into a folder: all are written to a temporary folder beside it first, then moved into place.

    Args:
        folder: the folder; made when missing. Files in it that are not named stay where they are.
        contents: relative path -> bytes. A file that already has these bytes is left untouched.
        obsolete: relative paths of an earlier run that are removed.

    Raises:
        SourceError: the folder may not be written, or is a file.
    """
    fix = "give another output folder"
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        stage = Path(tempfile.mkdtemp(prefix=f".{folder.name}.", dir=folder.parent))
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
        if folder.exists() and not folder.is_dir():
            raise SourceError("the output path is a file", location=Location(str(folder)), fix=fix)
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
