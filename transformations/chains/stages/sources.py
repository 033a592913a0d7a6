"""Remembers, outside of the output folder, where a migration's sources are, so that choices reach the project file there.

An output folder itself contains copies and no path of the machine. A remembered place is used only while the files there are
those that the plan was made from.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from robosmi import inputs
from robosmi.base.data_text import Json, as_list, as_table, as_text, json_of, json_written
from robosmi.errors import UsageError
from robosmi.files.files import digest
from robosmi.files.run_lock import SOURCES, store, stored
from robosmi.metamodels import migration
from robosmi.project import Project, load_project
from robosmi.transformations.t2m.c_source.parsing.source import stored_bytes


def remember_sources(
    output: Path,
    plan: migration.MigrationPlan,
    places: dict[str, str],
    files: Sequence[str | Path],
    arguments: Mapping[str, Json],
) -> None:
    """Keep where the sources of a plan lie, and how they were migrated.

    Args:
        output: the output folder.
        plan: the plan.
        places: stored path -> path as given.
        files: those that were given; the project file lies beside the first one, or in it if that is a folder.
        arguments: the other arguments of `migrate`; paths become absolute.

    Raises:
        SourceError: there is no place for it.
    """
    first = Path(files[0])
    found = {name: os.path.abspath(places[name]) for name in _sources(plan) if name in places}
    folder = os.path.abspath(first if first.is_dir() else first.parent)
    told = {name: _absolute(value) for name, value in arguments.items()}
    record: dict[str, Json] = {
        "folder": folder,
        "sources": found,
        "files": [os.path.abspath(file) for file in files],
        "arguments": told,
    }
    store(output, SOURCES, json_written(record, sort_keys=True))


def _absolute(value: Any) -> Any:
    if isinstance(value, Path):
        return os.path.abspath(value)
    return [_absolute(each) for each in value] if isinstance(value, (list, tuple)) else value


def last_run(output: Path) -> tuple[list[str], dict[str, Any]] | None:
    """The files and arguments of the last migration into an output folder; None if unknown."""
    try:
        known = as_table(json_of(stored(output, SOURCES)))
        return [str(file) for file in as_list(known["files"])], as_table(known["arguments"])
    except (OSError, ValueError, KeyError, TypeError):
        return None


def project_folder(output: Path, plan: migration.MigrationPlan, source: Path | None = None) -> tuple[Path | None, str]:
    """The folder of the program that a plan was made from, or None and the reason why it is unknown.

    Args:
        output: the output folder.
        plan: its plan.
        source: a source of the program that the user names; None for where the last migration read them.

    Raises:
        UsageError: the named file is none of the plan's sources, or was changed.
    """
    wanted = _sources(plan)
    if source is not None:
        if _digest(source) not in wanted.values():
            raise UsageError(
                f"'{source}' is not a source of this plan, or has changed since",
                fix="give the unchanged source, or migrate again",
            )
        return (source if source.is_dir() else source.parent).absolute(), ""
    try:
        known = as_table(json_of(stored(output, SOURCES)))
        folder = Path(as_text(known["folder"]))
        found = {name: Path(as_text(path)) for name, path in as_table(known["sources"]).items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return None, "none of your migrations created this folder in this place"
    changed = [path for name, path in found.items() if _digest(path) != wanted.get(name)]
    if changed:
        return None, f"the source has changed since the migration: {changed[0]}"
    if not found or not folder.is_dir():
        return None, "the program's folder no longer exists"
    return folder, ""


def project_of_output(output: Path, plan: migration.MigrationPlan) -> Project:
    """The project file in an output folder, else the one beside the program that its plan was made from.

    Raises:
        SourceError: the project file cannot be read.
    """
    own = load_project(output)
    if own.path is not None:
        return own
    folder, _ = project_folder(output, plan)
    return load_project(folder) if folder is not None else own


def _sources(plan: migration.MigrationPlan) -> dict[str, str]:
    """The digests of the plan's sources by their stored paths."""
    return {str(entry.path): str(entry.digest) for entry in plan.inputs if entry.kind == "source"}


def _digest(path: Path) -> str:
    try:
        return digest(stored_bytes(inputs.read_bytes(path, inputs.SOURCE)))
    except OSError:
        return ""
