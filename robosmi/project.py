"""`robosmi.toml`, the project file beside the input, and the defaults of the platform repository.

Both are read here and nowhere else; a key that nobody knows is an error with the nearest that is meant, since a
misspelt choice that is silently ignored is worse than none. What the values mean is up to the commands.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

from robosmi import inputs, resources
from robosmi.data_text import toml_of
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, SourceError, did_you_mean

FILE_NAME = "robosmi.toml"
LEVELS = ("off", "info", "warning", "error")


@dataclass(frozen=True)
class Accepted:
    """A finding that the user has looked at and accepts: rule, element (its URI or name) and the reason."""

    rule: str
    element: str
    reason: str


@dataclass(frozen=True)
class Project:
    """What the project file says; empty where there is none.

    Attributes:
        path: the file, or None.
        hardware: the drawing, an absolute path, or None.
        target: the target's name, or None.
        source_platform: the source platform's name, or None.
        libraries: component (title or `#model_index`) -> library.
        bind: port of the source -> target pin or mapping.
        roles: component -> role.
        severity: rule -> level.
        accept: accepted findings.
    """

    path: Path | None = None
    hardware: Path | None = None
    target: str | None = None
    source_platform: str | None = None
    libraries: dict[str, str] = field(default_factory=dict)
    bind: dict[str, str] = field(default_factory=dict)
    roles: dict[str, str] = field(default_factory=dict)
    severity: dict[str, str] = field(default_factory=dict)
    accept: tuple[Accepted, ...] = ()


_TABLES = ("migrate", "libraries", "bind", "roles", "severity", "accept")
_MIGRATE = ("hardware", "target", "source_platform")


def project_of(first: Path) -> Project:
    """The project file beside an input, or in it if it is a folder.

    Raises:
        SourceError: as `load_project`.
    """
    return load_project(first if first.is_dir() else first.parent)


def load_project(folder: Path) -> Project:
    """The project file in a folder, or an empty project.

    Raises:
        SourceError: it is not TOML, or has a key or value that means nothing.
    """
    path = folder / FILE_NAME
    if not os.path.lexists(path):
        return Project()
    try:
        data = toml_of(inputs.read_text(path, inputs.SETTINGS))
    except OSError as error:
        why = "it is a link to a file that is not there" if path.is_symlink() and not path.exists() else error.strerror
        fix = inputs.fix_of(error, "put an ordinary file in its place, check its permissions, or move it away")
        raise SourceError(f"the project file cannot be read: {why}", location=Location(str(path)), fix=fix) from error
    except ValueError as error:
        raise SourceError(
            f"the project file cannot be read: {error}", location=Location(str(path)), fix="correct it (TOML 1.0)"
        ) from error
    _known(path, data, _TABLES, "table")
    migrate = _table(path, data, "migrate")
    _known(path, migrate, _MIGRATE, "key in [migrate]")
    severity = _table(path, data, "severity")
    for rule, level in severity.items():
        if level not in LEVELS:
            raise _wrong(
                path,
                f"[severity] {rule} = '{level}' is no level{did_you_mean(level, LEVELS)}",
                f"use one of: {', '.join(LEVELS)}",
            )
    return Project(
        path=path,
        hardware=(folder / migrate["hardware"]) if "hardware" in migrate else None,
        target=migrate.get("target"),
        source_platform=migrate.get("source_platform"),
        libraries=_table(path, data, "libraries"),
        bind=_bind(path, data),
        roles=_table(path, data, "roles"),
        severity=severity,
        accept=tuple(_accepted(path, entry) for entry in _list_of_tables(path, data, "accept")),
    )


def _table(path: Path, data: dict[str, Any], name: str) -> dict[str, str]:
    table = data.get(name, {})
    if not isinstance(table, dict) or not all(isinstance(v, str) for v in table.values()):
        raise _wrong(path, f"[{name}] must hold texts only", 'write NAME = "VALUE"')
    return table


def _bind(path: Path, data: dict[str, Any]) -> dict[str, str]:
    """[bind], in which TOML takes a key with a point in it, such as a role of a library, for a table."""
    table = data.get("bind", {})
    if isinstance(table, dict):
        inner = {key: value for key, value in table.items() if isinstance(value, dict)}
        flat = {f"{key}.{name}": value for key, values in inner.items() for name, value in values.items()}
        data = {**data, "bind": {**{key: value for key, value in table.items() if key not in inner}, **flat}}
    return _table(path, data, "bind")


def _list_of_tables(path: Path, data: dict[str, Any], name: str) -> list[Any]:
    entries = data.get(name, [])
    if not isinstance(entries, list):
        raise _wrong(path, f"'{name}' must be a list of tables", f"write each entry as [[{name}]]")
    return entries


def _accepted(path: Path, entry: Any) -> Accepted:
    keys = ("rule", "element", "reason")
    if not isinstance(entry, dict) or any(not isinstance(entry.get(k), str) for k in keys):
        raise _wrong(path, "[[accept]] needs the texts rule, element and reason", "add what is missing")
    return Accepted(entry["rule"], entry["element"], entry["reason"])


def _known(path: Path, data: dict[str, Any], known: tuple[str, ...], what: str) -> None:
    for key in data:
        if key not in known:
            raise _wrong(path, f"'{key}' is no {what}{did_you_mean(key, known)}", f"use one of: {', '.join(known)}")


def _wrong(path: Path, message: str, fix: str) -> SourceError:
    return SourceError(message, location=Location(str(path)), fix=fix)


def defaults(project: Path | None = None) -> dict[str, Any]:
    """What commands take when nothing else is said: all `defaults.toml` of the platform repository as one.

    A file adds its tables to those of the files behind it in search order (project, ROBOSMI_PATH, user, plug-ins, built-in);
    where two files have a key, the first one's value counts.

    Args:
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: a file is damaged.
    """
    return _merged(tuple((str(path), path.stat().st_mtime_ns) for path in _default_files(project)))


def defaults_place(table: str, key: str, project: Path | None = None) -> Path:
    """The file whose value of a key counts, for messages; the built-in one where no file has it.

    Args:
        table: name of a table of the defaults.
        key: in that table.
        project: the project folder; the current folder if None.
    """
    files = list(_default_files(project))
    return next((path for path in files if key in read_data(path).get(table, {})), files[-1])


def _default_files(project: Path | None) -> Iterator[Path]:
    return (path for folder in resources.folders("platform_repo", project) if (path := folder / "defaults.toml").is_file())


@cache
def _merged(files: tuple[tuple[str, int], ...]) -> dict[str, Any]:  # by time of change: an edited file is read anew
    merged: dict[str, Any] = {}
    for path, _ in reversed(files):
        for name, table in read_data(Path(path)).items():
            if not isinstance(table, dict):
                raise PlatformDataError(
                    f"'{name}' must be a table", location=Location(path), fix=f"write it in a table: [{name}]"
                )
            merged[name] = {**merged.get(name, {}), **table}
    return merged


def read_data(path: Path) -> dict[str, Any]:
    """A TOML file of the platform repository.

    Raises:
        PlatformDataError: it cannot be read.
    """
    try:
        return toml_of(inputs.read_text(path, inputs.DATA))
    except (ValueError, OSError) as error:
        raise PlatformDataError(
            f"the entry cannot be read: {error}", location=Location(str(path)), fix="correct the entry"
        ) from error
