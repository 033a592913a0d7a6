"""The user's folders on this machine: own data, what can be made again, the folders of `ROBOSMI_PATH`, the project's.

What lies in them and in which order it is looked for is `resources`' business, what of it may run `trust`'s.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path

OWN = ".robosmi"
"""The folder of a project with data of its own."""
_project: ContextVar[str] = ContextVar("robosmi_project", default="")


def user_data() -> Path:
    """The user's own data folder (XDG base directory specification; `ROBOSMI_HOME` overrides it). It need not exist."""
    return Path(_user_data())


def _user_data() -> str:
    if own := os.environ.get("ROBOSMI_HOME"):
        return own
    data = os.environ.get("XDG_DATA_HOME") or os.path.join(_home(), ".local", "share")
    return os.path.join(data, "robosmi")


def _home() -> str:
    """The user's home folder; one that is not there, as system users have, for a user whom the system does not know."""
    home = os.path.expanduser("~")
    return home if os.path.isabs(home) else os.path.join(os.sep, "nonexistent")


def cache_dir() -> Path:
    """The folder for what can be made again, e.g. compiled cores (XDG base directory specification)."""
    return Path(os.environ.get("XDG_CACHE_HOME") or os.path.join(_home(), ".cache")) / "robosmi"


def named() -> list[str]:
    """The folders with data that the user has named: those of `ROBOSMI_PATH`, then the user's own."""
    return [*(place for place in os.environ.get("ROBOSMI_PATH", "").split(os.pathsep) if place), _user_data()]


@contextmanager
def project_of_input(first: str | Path) -> Iterator[None]:
    """Within this, the project is the folder of a run's first input, where that has data of its own.

    Args:
        first: the first file that a command is given, or a folder.
    """
    path = os.path.abspath(first)
    folder = path if os.path.isdir(path) else os.path.dirname(path)
    if not os.path.isdir(os.path.join(folder, OWN)):
        yield
        return
    before = _project.set(folder)
    try:
        yield
    finally:
        _project.reset(before)


def project_folder() -> str:
    """The folder whose `.robosmi` counts before all other data: see `project_of_input`; else the current folder."""
    return _project.get() or os.getcwd()
