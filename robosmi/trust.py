"""Which found folders may run something here: a person says so once, for exactly the files that are in them.

What is named on the command line or in Python is not asked about. Kept in the user's data, by a digest of what would run.
"""

from __future__ import annotations

import hashlib
import json
import os
from pathlib import Path

from robosmi import resources
from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.inputs import DATA, read_bytes

RUNS = ("templates",)
"""The folders of a `.robosmi` whose files run."""


def files_that_run(folder: Path) -> dict[str, str]:
    """What would run if a `.robosmi` folder were trusted: relative path -> SHA-256.

    Args:
        folder: the `.robosmi` folder.

    Raises:
        SourceError: a file cannot be read, or a folder in it is a link, so that its files can change unseen.
    """
    found: dict[str, str] = {}
    try:
        for root in RUNS:
            for place, folders, names in os.walk(folder / root, onerror=_raise):
                for name in folders:
                    if os.path.islink(linked := os.path.join(place, name)):
                        raise SourceError(
                            "a link to a folder cannot be trusted", location=Location(linked), fix="put a copy in its place"
                        )
                for name in names:
                    path = Path(place, name)
                    found[path.relative_to(folder).as_posix()] = hashlib.sha256(read_bytes(path, DATA)).hexdigest()
    except OSError as error:
        place = str(error.filename or folder)
        message = f"what would run cannot be read: {error.strerror or error}"
        raise SourceError(message, location=Location(place), fix="check its permissions") from error
    return found


def _raise(error: OSError) -> None:
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
    own = folder if folder.name == ".robosmi" else folder / ".robosmi"
    files = files_that_run(own)
    if not files:
        raise SourceError("nothing in this folder would run", location=Location(str(folder)), fix="name a folder with a .robosmi")
    place = _place(own)
    try:
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(_digest(files), encoding="utf-8")
    except OSError as error:
        message = f"the trust cannot be noted: {error.strerror or error}"
        raise SourceError(message, location=Location(str(place)), fix="set ROBOSMI_HOME to a folder of your own") from error
    return own, sorted(files)


def demand(folder: Path) -> None:
    """Make sure that a `.robosmi` folder that was merely found may run what it holds.

    Raises:
        SourceError: nobody has trusted it, or it was changed since.
    """
    files = files_that_run(folder)
    if not files:
        return
    try:
        noted = read_bytes(_place(folder), DATA).decode()
    except (OSError, ValueError):
        noted = ""
    if noted != _digest(files):
        why = "were changed since they were trusted" if noted else "were found here and are not trusted"
        raise SourceError(
            f"the templates in this folder {why}; nothing of them was run", location=Location(str(folder)),
            fix=f"read them ({', '.join(sorted(files)[:3])}{', ...' if len(files) > 3 else ''}), then: "
            f"robosmi trust {folder.parent}; or move the folder away",
        )  # fmt: skip


def _digest(files: dict[str, str]) -> str:
    return hashlib.sha256(json.dumps(files, sort_keys=True).encode()).hexdigest()


def _place(folder: Path) -> Path:
    real = os.fsencode(os.path.realpath(folder))
    return resources.user_data() / "trusted" / hashlib.sha256(real).hexdigest()
