"""Where the sources of a migration lie, kept outside of its output folder, so that choices reach the project file beside them.

An output folder itself holds copies and no path of the machine. A place counts only as long as the files there are those that
the plan was made from.
"""

from __future__ import annotations

import json
import os
from pathlib import Path

from robosmi import inputs
from robosmi.data_text import json_of
from robosmi.errors import UsageError
from robosmi.metamodels import migration
from robosmi.model.files import digest
from robosmi.model.runs import keep_sources, kept_sources


def remember_sources(output: Path, plan: migration.MigrationPlan, places: dict[str, str], first: Path) -> None:
    """Keep where the sources of a plan lie.

    Args:
        output: the output folder.
        plan: the plan.
        places: stored path -> path as given.
        first: the first file that was given, or the folder of the program.

    Raises:
        SourceError: there is no place for it.
    """
    found = {name: os.path.abspath(places[name]) for name in _sources(plan) if name in places}
    folder = os.path.abspath(first if first.is_dir() else first.parent)
    keep_sources(output, json.dumps({"folder": folder, "sources": found}, sort_keys=True))


def project_folder(output: Path, plan: migration.MigrationPlan, source: Path | None = None) -> tuple[Path | None, str]:
    """The folder of the program that a plan was made from, and why it is not known where there is None.

    Args:
        output: the output folder.
        plan: its plan.
        source: a source of the program that a person names; None for where the last migration read them.

    Raises:
        UsageError: the named file is none of the plan's sources, or was changed.
    """
    wanted = _sources(plan)
    if source is not None:
        if _digest(source) not in wanted.values():
            raise UsageError(
                f"'{source}' is none of the sources that the plan was made from, or was changed since",
                fix="give the source as it was migrated, or migrate again",
            )
        return (source if source.is_dir() else source.parent).absolute(), ""
    try:
        kept = json_of(kept_sources(output))
        folder, found = Path(kept["folder"]), {str(name): Path(path) for name, path in kept["sources"].items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return None, "no migration of yours has made this folder where it is now"
    changed = [path for name, path in found.items() if _digest(path) != wanted.get(name)]
    if changed:
        return None, f"the source is not the one that the plan was made from any more: {changed[0]}"
    if not found or not folder.is_dir():
        return None, "the program's folder is not there any more"
    return folder, ""


def _sources(plan: migration.MigrationPlan) -> dict[str, str]:
    """The digests of the plan's sources by their stored paths."""
    return {str(entry.path): str(entry.digest) for entry in plan.inputs if entry.kind == "source"}


def _digest(path: Path) -> str:
    try:
        return digest(inputs.read_bytes(path, inputs.SOURCE))
    except OSError:
        return ""
