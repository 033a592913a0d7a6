"""Entries added to a `robosmi.toml` that a person keeps: in the table they belong to, with everything else as it stands.

The text is not written anew, so comments, order and layout stay. What was added is read back before anything is written; where
that does not give what was meant, nothing is.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from robosmi import inputs
from robosmi.data_text import toml_of
from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.model.files import write_atomic
from robosmi.project import FILE_NAME

_TABLE = re.compile(r"[ \t]*\[")
_BARE = re.compile(r"[A-Za-z0-9_-]+")


def add_to_project(folder: Path, entries: Mapping[str, Mapping[str, str]]) -> Path:
    """Add entries to the project file of a folder, which is made if there is none.

    Args:
        folder: the folder of the program.
        entries: table -> key -> value; a key that the table has already keeps its value.

    Returns:
        The file.

    Raises:
        SourceError: the file cannot be read or written, or an entry cannot be added without changing others.
    """
    path = folder / FILE_NAME
    try:
        text = inputs.read_text(path, inputs.SETTINGS) if path.exists() else ""
        before = toml_of(text)
    except (OSError, ValueError) as error:
        raise SourceError(f"the project file cannot be read: {error}", location=Location(str(path)), fix="correct it") from error
    made = text
    for table, values in entries.items():
        known = before.get(table, {})
        made = with_entries(made, table, {k: v for k, v in values.items() if k not in known})
    if not _adds(before, made, entries):
        advice = [f"write in [{t}]: {', '.join(_line(k, v) for k, v in values.items())}" for t, values in entries.items()]
        raise SourceError("the choices cannot be added to the project file", location=Location(str(path)), fix="; ".join(advice))
    write_atomic(path, made.encode("utf-8"))
    return path


def with_entries(text: str, table: str, entries: Mapping[str, str]) -> str:
    """The text of a TOML file with entries at the end of a table, which is added if there is none."""
    if not entries:
        return text
    end = "\r\n" if "\r\n" in text else "\n"
    added = [_line(key, value) + end for key, value in entries.items()]
    lines = text.splitlines(keepends=True)
    if lines and not lines[-1].endswith("\n"):
        lines[-1] += end
    heads = [
        i for i, line in enumerate(lines) if re.match(rf"[ \t]*\[[ \t]*{re.escape(table)}[ \t]*\][ \t]*(#.*)?$", line.rstrip())
    ]
    if not heads:
        return "".join([*lines, *([end] if lines else []), f"[{table}]{end}", *added])
    behind = next((i for i in range(heads[0] + 1, len(lines)) if _TABLE.match(lines[i])), len(lines))
    while behind > heads[0] + 1 and not lines[behind - 1].strip():
        behind -= 1
    return "".join([*lines[:behind], *added, *lines[behind:]])


def _line(key: str, value: str) -> str:
    return f"{key if _BARE.fullmatch(key) else json.dumps(key, ensure_ascii=False)} = {json.dumps(value, ensure_ascii=False)}"


def _adds(before: dict[str, Any], made: str, entries: Mapping[str, Mapping[str, str]]) -> bool:
    """Whether a text holds what was there and the entries, and nothing else."""
    try:
        after = toml_of(made)
    except ValueError:
        return False
    wanted = {**before, **{t: {**values, **before.get(t, {})} for t, values in entries.items() if values}}
    return after == wanted
