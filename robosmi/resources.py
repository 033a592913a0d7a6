"""Where data files come from: the one place that knows the search order.

Order (first hit wins): `.robosmi/<kind>` in the project folder (that of a run's first input, else the current folder), each
folder of `ROBOSMI_PATH` + `/<kind>`, the user's data folder, the data built into the package. So a user overrides a template or
adds a board without forking. This module reads no data itself and caches nothing but the built-in folders.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from robosmi.base.user_folders import OWN, cache_dir, named, project_folder, project_of_input, user_data
from robosmi.errors import PlatformDataError

__all__ = ["KINDS", "built_in", "cache_dir", "example", "find", "folders", "named", "project_of_input", "user_data"]

KINDS = ("metamodels", "templates", "platform_repo")
"""The kinds of data there are; each is a folder of the package of that name."""


@cache
def built_in(kind: str) -> Path:
    """The folder of built-in data of a kind, in a wheel or in a source checkout.

    Raises:
        PlatformDataError: the installation is incomplete.
    """
    import robosmi

    for root in robosmi.__path__:
        folder = Path(root) / kind
        if folder.is_dir():
            return folder
    raise PlatformDataError(f"the built-in data '{kind}' is not installed", fix="install robosmi again")


def example(name: str) -> Path:
    """The folder of an example that is installed with the package, in a wheel or in a source checkout.

    Raises:
        PlatformDataError: the installation is incomplete.
    """
    import robosmi

    for root in robosmi.__path__:
        folder = Path(root) / "docs" / "examples" / name
        if folder.is_dir():
            return folder
    raise PlatformDataError(f"the example '{name}' is not installed", fix="install robosmi again")


def folders(kind: str, project: Path | None = None) -> Iterator[Path]:
    """The existing folders of a kind of data, in search order.

    Args:
        kind: one of `KINDS`.
        project: the project folder; the current folder if None.

    Raises:
        SourceError: the project has templates that nobody has trusted (see `trust`).
    """
    return (Path(folder) for folder in _folders(kind, project))


def _folders(kind: str, project: Path | None) -> Iterator[str]:
    """As texts, since a migration asks some seventy times."""
    if kind not in KINDS:
        raise ValueError(f"no kind of data is called '{kind}'")
    own = [os.path.join(project or project_folder(), OWN), *named()]
    for root in own:
        if os.path.isdir(folder := os.path.join(root, kind)):
            if kind == "templates" and root is own[0] and root not in own[1:]:
                from robosmi.base.trust import demand  # most projects have no templates of their own

                demand(Path(root), kind)
            yield folder
    yield from _of_plugins(kind)
    yield str(built_in(kind))


@cache
def _of_plugins(kind: str) -> tuple[str, ...]:
    from robosmi.plugins import registry  # the registry asks entry points, which only what reads data has to wait for

    return tuple(folder for root in registry().data if os.path.isdir(folder := os.path.join(root, kind)))


def find(kind: str, name: str, project: Path | None = None) -> Path:
    """The first file or folder of that relative name, in search order.

    Raises:
        PlatformDataError: there is none.
    """
    for folder in _folders(kind, project):
        if os.path.exists(place := os.path.join(folder, name)):
            return Path(place)
    raise PlatformDataError(f"there is no '{name}' among the {kind}", fix="check its name, or the folders in ROBOSMI_PATH")
