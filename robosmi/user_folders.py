"""The user's folders on this machine: own data, what can be made again, and the folders of `ROBOSMI_PATH`.

What lies in them and in which order it is looked for is `resources`' business, what of it may run `trust`'s.
"""

from __future__ import annotations

import os
from pathlib import Path


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
