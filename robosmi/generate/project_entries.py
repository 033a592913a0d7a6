"""Adds, changes and removes entries of the user's `robosmi.toml`, leaving everything else as it is.

tomlkit preserves comments, order and layout. The result is read back before it is used; if it does not have the intended
meaning, it is discarded. Nothing is written here: the change is part of the commit of the run that makes the choice
(`files.commit`). `robosmi.project` defines the content of a project file.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, MutableMapping
from pathlib import Path
from typing import Any

import tomlkit
from msgspec import Struct
from tomlkit.exceptions import TOMLKitError
from tomlkit.items import AoT

from robosmi import inputs
from robosmi.base.data_text import toml_of
from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.files.external_files import ExternalFiles
from robosmi.project import FILE_NAME, Accepted, load_project, project_in

Entries = Mapping[str, Mapping[str, str | None]]
"""Table -> key -> value; None takes the key out. A table in another one has the name of that one and a point before its own."""


class ProjectChange(Struct, frozen=True):
    """A change of a project file, to be written in the same commit as a run's results.

    Attributes:
        files: the file (or the target of a link) with its old and its new content; empty if it does not change.
        stays: the reason why it is not changed although there is something to store; else empty.
    """

    files: ExternalFiles
    stays: str = ""


def added_to_project(folder: Path, entries: Mapping[str, Mapping[str, str]]) -> ProjectChange:
    """Add entries to the project file of a folder; the file is created if necessary.

    Args:
        folder: the folder of the program.
        entries: table -> key -> value; a key that the table has already keeps its value.

    Raises:
        SourceError: the file cannot be read, means nothing, or an entry cannot be added without changing others.
    """
    path = folder / FILE_NAME
    before = _values(_text(path), path)
    new = {t: {k: v for k, v in values.items() if _held(_table_of(before, t), k) is None} for t, values in entries.items()}
    return changed_project(folder, new)


def changed_project(folder: Path, entries: Entries) -> ProjectChange:
    """Add, change or remove entries of a folder's project file; it is created if necessary.

    A link stays a link: its target is changed. A read-only file, or one in a read-only folder, is not changed.

    Raises:
        SourceError: the file cannot be read, means nothing, or an entry cannot be set without changing others.
    """
    load_project(folder)
    path = folder / FILE_NAME
    text = _text(path)
    made = _with_all(text, path, entries)
    if not (path.exists() or any(value for values in entries.values() for value in values.values())):
        return ProjectChange({})
    return _change(path, text, made)


def accepted_in_project(folder: Path, accepted: Accepted) -> ProjectChange:
    """Add, change or remove an `[[accept]]` of a folder's project file; it is created if necessary.

    Args:
        folder: the folder of the program.
        accepted: the entry; it takes the place of the one with its rule and element, and an empty reason removes that.

    Raises:
        SourceError: the file cannot be read, means nothing, or the entry cannot be set without changing others.
    """
    others = [one for one in load_project(folder).accept if (one.rule, one.element) != (accepted.rule, accepted.element)]
    path = folder / FILE_NAME
    text = _text(path)
    before = _values(text, path)
    try:
        made = _with_accepted(text, accepted)
        after = project_in(path, made)
        right = _values(made, path) | {"accept": 0} == before | {"accept": 0}
        right = right and [*after.accept] == [*others, *[accepted] * bool(accepted.reason)]
    except (TOMLKitError, ValueError, SourceError):
        right = False
    if not right:
        raise SourceError(
            "the reason cannot be set in the project file", location=Location(str(path)),
            fix=f"write an [[accept]] with rule, element and reason for {accepted.rule}",
        )  # fmt: skip
    return _change(path, text, made)


def _with_accepted(text: str, accepted: Accepted) -> str:
    """The text of a project file with an `[[accept]]` as the last one, or without it."""
    crlf = "\r\n" in text
    document = tomlkit.parse(text.replace("\r\n", "\n"))
    entries: Any = document.get("accept")
    if entries is None:
        entries = tomlkit.aot()
    for at in reversed(range(len(entries))):
        if (entries[at]["rule"], entries[at]["element"]) == (accepted.rule, accepted.element):
            del entries[at]
    if accepted.reason:
        entry = tomlkit.table() if isinstance(entries, AoT) else tomlkit.inline_table()
        entry.update({"rule": accepted.rule, "element": accepted.element, "reason": accepted.reason})
        entries.append(entry)
    if "accept" not in document and len(entries):
        document.append("accept", entries)
    elif not len(entries):
        document.pop("accept", None)
    made = tomlkit.dumps(document)
    return made.replace("\n", "\r\n") if crlf else made


def _change(path: Path, text: str, made: str) -> ProjectChange:
    """The change of a project file from one text to another, if it may be written."""
    place, there = Path(os.path.realpath(path)) if path.is_symlink() else path, path.exists()
    if made == text:
        return ProjectChange({})
    if there and (not place.stat().st_mode & 0o222 or not os.access(place, os.W_OK)):
        return ProjectChange({}, f"{place} is read-only")
    if not os.access(place.parent, os.W_OK):
        return ProjectChange({}, f"the folder {place.parent} is read-only")
    return ProjectChange({place: (text.encode("utf-8") if there else None, made.encode("utf-8"))})


def _with_all(text: str, path: Path, entries: Entries) -> str:
    """The text of a project file with entries set.

    Raises:
        SourceError: the file is no TOML, or an entry cannot be set without changing others.
    """
    before = _values(text, path)
    try:
        made = text
        for table, values in entries.items():
            made = with_entries(made, table, values)
        right = _values(made, path) == _meant(before, entries) and project_in(path, made) is not None
    except (TOMLKitError, ValueError, SourceError):
        right = False
    if not right:
        lines = {t: [f'{k} = "{v}"' if v is not None else f"no {k}" for k, v in values.items()] for t, values in entries.items()}
        advice = [f"in [{table}]: {', '.join(written)}" for table, written in lines.items()]
        raise SourceError("the choices cannot be set in the project file", location=Location(str(path)), fix="; ".join(advice))
    return made


def with_entries(text: str, table: str, entries: Mapping[str, str | None]) -> str:
    """The text of a TOML file with entries of a table, which is added if there is none.

    Raises:
        TOMLKitError, ValueError: it is no TOML, or the table is none.
    """
    if not entries:
        return text
    crlf = "\r\n" in text
    text += "" if not text or text.endswith("\n") else "\n"
    document = tomlkit.parse(text.replace("\r\n", "\n") if crlf else text)
    inside: Any = document
    for name in _names(table):
        if name not in inside:
            inside[name] = tomlkit.table()
        inside = inside[name]
    for key, value in entries.items():
        holder, own = _place(inside, key)
        if value is not None:
            holder[own] = value
        elif own in holder:
            del holder[own]
    made = tomlkit.dumps(document)
    return made.replace("\n", "\r\n") if crlf else made


def displayed_path(path: Path) -> str:
    """The path of a project file for messages; for a link, together with the file it leads to."""
    return f"{path} (a link to {os.path.realpath(path)})" if path.is_symlink() else str(path)


def key_of(path: Path, table: str, names: tuple[str, ...], otherwise: str) -> str:
    """The key by which a project file speaks of something that has several names.

    Args:
        path: the project file; it need not exist.
        table: of it.
        names: what it may be called.
        otherwise: the key where the file does not speak of it.
    """
    known = _table_of(_values(_text(path), path), table)
    return next((name for name in names if _held(known, name) is not None), otherwise)


def _names(table: str) -> list[str]:
    """The names of a table and of the one that it is in."""
    head, point, rest = table.partition(".")
    return [head, rest] if point else [head]


def _table_of(values: Mapping[str, Any], table: str) -> Any:
    """A table of a file; an empty one where it has none."""
    found: Any = values
    for name in _names(table):
        found = found.get(name, {}) if isinstance(found, Mapping) else {}
    return found


def _place(table: Any, key: str) -> tuple[MutableMapping[str, Any], str]:
    """Where a key stands: TOML takes one with a point in it and without quotation marks for a table."""
    if not isinstance(table, MutableMapping):
        raise ValueError("it is not a table")
    head, _, rest = key.partition(".")
    inner = table.get(head)
    return (inner, rest) if key not in table and isinstance(inner, MutableMapping) and rest in inner else (table, key)


def _held(table: Any, key: str) -> Any:
    """The value of a key, None for none."""
    if not isinstance(table, MutableMapping):
        return None
    holder, own = _place(table, key)
    return holder.get(own)


def _meant(before: dict[str, Any], entries: Entries) -> dict[str, Any]:
    """What a file says once the entries are set."""
    made = {name: value.copy() if isinstance(value, dict) else value for name, value in before.items()}
    for table, values in entries.items():
        if not values:
            continue
        inside = made
        for name in _names(table):
            inside[name] = dict(inside.get(name, {}))
            inside = inside[name]
        for key, value in values.items():
            head = key.partition(".")[0]
            holder, own = _place(inside, key)
            if holder is not inside:
                holder = inside[head] = dict(inside[head])
            if value is None:
                holder.pop(own, None)
            else:
                holder[own] = value
    return made


def _text(path: Path) -> str:
    try:
        return inputs.read_bytes(path, inputs.SETTINGS).decode("utf-8") if path.exists() else ""
    except (OSError, ValueError) as error:
        raise _unreadable(path, error) from error


def _values(text: str, path: Path) -> dict[str, Any]:
    try:
        return toml_of(text)
    except ValueError as error:
        raise _unreadable(path, error) from error


def _unreadable(path: Path, error: Exception) -> SourceError:
    return SourceError(f"the project file cannot be read: {error}", location=Location(str(path)), fix="correct it")
