"""Records which found folders may run code here: the user confirms this once for exactly the files in them.

Folders named on the command line or in Python need no confirmation. The confirmation is kept in the user's data as the digests
of the files that would run; a file's digest is compared when it is read, so that only confirmed bytes run. `resources` finds
the folders.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path, PurePath

from robosmi import inputs
from robosmi.base import user_folders
from robosmi.base.data_text import json_of, json_written
from robosmi.base.user_cache import read_own, write_own
from robosmi.base.user_folders import OWN
from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.inputs import DATA, RECORD, read_bytes

RUNS = {"templates": "", "platform_repo": ".toml"}
"""The folders of a `.robosmi` with files that run, or name programs and their arguments; and the ending of those files."""
HOST = "host"
"""The folder of a platform whose files are compiled into programs of this machine, so that all of them run."""


def files_that_run(folder: Path) -> dict[str, str]:
    """What would run if a `.robosmi` folder were trusted: relative path -> SHA-256.

    Args:
        folder: the `.robosmi` folder.

    Raises:
        SourceError: a file cannot be read, or a folder in it is a link, so that its files can change unseen.
    """
    return {name: digest for kind in RUNS for name, digest in _files(folder, kind).items()}


def _files(folder: Path, kind: str) -> dict[str, str]:
    found: dict[str, str] = {}
    try:
        for place, folders, names in os.walk(folder / kind, onerror=_raise):
            ending = "" if HOST in Path(place).relative_to(folder).parts else RUNS[kind]
            for name in folders:
                if os.path.islink(linked := os.path.join(place, name)):
                    raise SourceError(
                        "a link to a folder cannot be trusted", location=Location(linked), fix="replace it with a copy"
                    )
            for path in (Path(place, name) for name in names if name.endswith(ending)):
                found[path.relative_to(folder).as_posix()] = _digest(read_bytes(path, DATA))
    except OSError as error:
        place = str(error.filename or folder)
        message = f"the folder's code cannot be read: {error.strerror or error}"
        raise SourceError(message, location=Location(place), fix="check its permissions") from error
    return found


def _raise(error: OSError) -> None:
    if not isinstance(error, FileNotFoundError):
        raise error


def trust(folder: Path) -> tuple[Path, list[str]]:
    """Trust what a project's `.robosmi` holds now; a file that is added or changed later is not.

    Args:
        folder: the project, or its `.robosmi` itself.

    Returns:
        The `.robosmi` folder and the relative paths of the files that may run.

    Raises:
        SourceError: there is nothing to trust, or it cannot be read or noted.
    """
    own = folder if folder.name == OWN else folder / OWN
    files = files_that_run(own)
    if not files:
        fix = "nothing; this folder needs no trust" if own.is_dir() else "give a folder with a .robosmi"
        raise SourceError("this folder has no code to run", location=Location(str(folder)), fix=fix)
    place = _place(own)
    try:
        place.parent.mkdir(parents=True, exist_ok=True)
        write_own(place, json_written(files, sort_keys=True))
    except OSError as error:
        message = f"the trust cannot be saved: {error.strerror or error}"
        raise SourceError(message, location=Location(str(place)), fix="set ROBOSMI_HOME to a folder of your own") from error
    return own, sorted(files)


def demand(folder: Path, kind: str, *, host: bool = True) -> None:
    """Make sure that a `.robosmi` folder that was merely found may run all that it holds of a kind.

    Args:
        folder: the `.robosmi` folder.
        kind: a folder in it.
        host: whether the models of libraries, which run on this machine, are among what would run.

    Raises:
        SourceError: nobody has trusted it, or it was changed since.
    """

    def asked(name: str) -> bool:
        return name.startswith(f"{kind}/") and (host or HOST not in name.split("/")[1:-1])

    files = {name: digest for name, digest in _files(folder, kind).items() if asked(name)}
    if not files:
        return
    noted = {name: digest for name, digest in _noted(folder).items() if asked(name)}
    if noted != files:
        raise _refused(folder, sorted(name for name in files if noted.get(name) != files[name]) or sorted(files), bool(noted))


def check(path: str | os.PathLike[str], data: bytes) -> None:
    """Make sure that bytes that were read may run, if they are of a folder that was merely found.

    Args:
        path: where they were read.
        data: the bytes, which and no others the caller uses.

    Raises:
        SourceError: nobody has trusted that file, or it was changed since.
    """
    if (found := _found(path)) is not None:
        folder, name = found
        noted = _noted(folder)
        if noted.get(name) != _digest(data):
            raise _refused(folder, [name], bool(noted))


@contextmanager
def acting(project: Path | None = None, *, host: bool = False) -> Iterator[None]:
    """Context manager: data may start programs, so a found folder must be trusted, and each file of it is checked when read.

    Args:
        project: the project folder; the current folder if None.
        host: whether models of libraries are compiled for this machine and run.

    Raises:
        SourceError: nobody has trusted the data of that folder, or it was changed since.
    """
    demand(Path(project or user_folders.project_folder()) / OWN, "platform_repo", host=host)
    with inputs.checked(check):
        yield


def _found(path: str | os.PathLike[str]) -> tuple[Path, str] | None:
    """The found `.robosmi` folder that a file that would run lies in, and its path there; None for any other file."""
    parts = PurePath(os.path.abspath(path)).parts
    for at, part in enumerate(parts[:-2], 1):
        if part == OWN and (ending := RUNS.get(parts[at])) is not None and (HOST in parts[at:-1] or parts[-1].endswith(ending)):
            folder = Path(*parts[:at])
            return (
                None
                if os.fspath(folder) in (os.path.abspath(one) for one in user_folders.named())
                else (folder, "/".join(parts[at:]))
            )
    return None


def _refused(folder: Path, files: list[str], known: bool) -> SourceError:
    why = "have changed since you trusted them" if known else "are not trusted"
    return SourceError(
        f"files with code in this folder {why}; RoboSMi did not run them", location=Location(str(folder)),
        fix=f"read them ({', '.join(files[:3])}{', ...' if len(files) > 3 else ''}), then: "
        f"robosmi trust {folder.parent}; or move the folder away",
    )  # fmt: skip


def _noted(folder: Path) -> dict[str, str]:
    """What was trusted of a folder: relative path -> SHA-256; nothing where no note of this user is there, or it is damaged."""
    try:
        noted = json_of(read_own(_place(folder), RECORD).decode())
    except (OSError, ValueError):
        return {}
    return noted if isinstance(noted, dict) else {}


def _digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


def _place(folder: Path) -> Path:
    real = os.fsencode(os.path.realpath(folder))
    return user_folders.user_data() / "trusted" / hashlib.sha256(real).hexdigest()
