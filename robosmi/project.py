"""Reads `robosmi.toml`, the project file beside the input, and the defaults of the platform repository.

Both are read only here. An unknown key is an error that suggests the nearest known one, since silently ignoring a misspelt
choice would be worse. The commands interpret the values.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache
from itertools import pairwise
from pathlib import Path

from msgspec import Struct

from robosmi import inputs, resources
from robosmi.base.data_text import Json, as_table, as_text, data_toml, line_of_error, line_of_key, toml_of
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, SourceError, did_you_mean

FILE_NAME = "robosmi.toml"
LEVELS = ("off", "info", "warning", "error")


class Accepted(Struct, frozen=True):
    """A finding that the user accepts: its rule, its element (URI or name) and the reason."""

    rule: str
    element: str
    reason: str


class ServoTrim(Struct, frozen=True):
    """Measured values of a continuous rotation servo.

    Attributes:
        neutral: the pulse width in microseconds at which it stands still; 0 if it was not measured.
        speeds: (speed, pulse width in microseconds) by ascending speed, in the unit of the function that sets the speed.
        place: where the file states this.
    """

    neutral: int
    speeds: tuple[tuple[int, int], ...]
    place: Location


class Project(Struct, frozen=True):
    """What the project file says; empty where there is none.

    Attributes:
        path: the file, or None.
        hardware: the drawing, an absolute path, or None.
        target: the target's name, or None.
        source_platform: the source platform's name, or None.
        source_board: the board that the program runs on today, or None.
        ranker: the name of the ranker of libraries, or None.
        libraries: component (title or `#model_index`) -> library.
        bind: port of the source -> target pin or mapping; the entries of a table in [bind], such as [bind.TARGET], have its name
            and a point before theirs.
        roles: component -> role.
        servos: component, or role of a port -> what was measured of its servo.
        severity: rule -> level.
        accept: accepted findings.
        console_wait_ms: the longest that a program waits for its console, in milliseconds; None for the target's own.
        text: what the file holds.
    """

    path: Path | None = None
    hardware: Path | None = None
    target: str | None = None
    source_platform: str | None = None
    source_board: str | None = None
    ranker: str | None = None
    libraries: dict[str, str] = {}
    bind: dict[str, str] = {}
    roles: dict[str, str] = {}
    servos: dict[str, ServoTrim] = {}
    severity: dict[str, str] = {}
    accept: tuple[Accepted, ...] = ()
    console_wait_ms: int | None = None
    text: str = ""

    def places(self, table: str, keys: Iterable[str]) -> dict[str, Location]:
        """Where a table of the file has each of some keys; the file alone where the line of one is not found."""
        if self.path is None:
            return {}
        lines = _lines_of(table, self.text)
        return {key: Location(str(self.path), lines.get(key)) for key in keys}


TABLES = ("migrate", "libraries", "bind", "roles", "servos", "rank", "severity", "accept")
"""The tables of a project file."""
_SERVO = ("neutral", "speeds")
POINTS = 64
"""Limit on the measured points of a servo; each takes four bytes of the program."""
PULSES = (500, 2500)
"""The shortest and longest pulse width for servos, in microseconds."""
LONGEST_WAIT_MS = 600_000
"""Limit on the wait for a console."""
MIGRATE = ("hardware", "target", "source_platform", "from", "console_wait_ms")
"""The keys of [migrate]."""
RANK = ("ranker",)
"""The keys of [rank]."""


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
        text = inputs.read_text(path, inputs.SETTINGS)
        data = toml_of(text)
    except OSError as error:
        why = "it is a link to a file that is not there" if path.is_symlink() and not path.exists() else error.strerror
        fix = inputs.fix_of(error, "put an ordinary file in its place, check its permissions, or move it away")
        raise SourceError(f"the project file cannot be read: {why}", location=Location(str(path)), fix=fix) from error
    except ValueError as error:
        line = None if isinstance(error, UnicodeDecodeError) else line_of_error(error, text)
        raise SourceError(
            f"the project file cannot be read: {error}", location=Location(str(path), line), fix="correct it (TOML 1.0)"
        ) from error
    return _project(path, text, data)


def project_in(path: Path, text: str) -> Project:
    """What a project file says that has a text.

    Raises:
        ValueError: it is not TOML.
        SourceError: it has a key or value that means nothing.
    """
    return _project(path, text, toml_of(text))


def _project(path: Path, text: str, data: dict[str, Json]) -> Project:
    folder = path.parent
    outside = next((key for key in data if key in MIGRATE), None)
    if outside is not None:
        raise _wrong(path, f"'{outside}' stands in no table", f"write [migrate] above the line with '{outside}'")
    _known(path, data, TABLES, "table")
    migrate = _table(path, data, "migrate", text)
    _known(path, migrate, MIGRATE, "key in [migrate]")
    rank = _table(path, data, "rank", text)
    _known(path, rank, RANK, "key in [rank]")
    severity = _table(path, data, "severity", text)
    for rule, level in severity.items():
        if level not in LEVELS:
            raise _wrong(
                path,
                f"[severity] {rule} = '{level}' is no level{did_you_mean(level, LEVELS)}",
                f"use one of: {', '.join(LEVELS)}",
            )
    return Project(
        path=path,
        hardware=_path_in(folder, migrate["hardware"]) if "hardware" in migrate else None,
        target=migrate.get("target"),
        source_platform=migrate.get("source_platform"),
        console_wait_ms=_wait(path, migrate, text),
        source_board=migrate.get("from"),
        ranker=rank.get("ranker"),
        libraries=_table(path, data, "libraries", text),
        bind=_bind(path, data, text),
        roles=_table(path, data, "roles", text),
        servos=_servos(path, data, text),
        severity=severity,
        accept=tuple(_accepted(path, entry) for entry in _list_of_tables(path, data, "accept")),
        text=text,
    )


def is_console_wait(said: str) -> bool:
    """Whether a text is a time to wait for a console, in milliseconds."""
    return said.isdecimal() and int(said) <= LONGEST_WAIT_MS


def _wait(path: Path, migrate: Mapping[str, str], text: str) -> int | None:
    said = migrate.get("console_wait_ms")
    if said is None or is_console_wait(said):
        return None if said is None else int(said)
    raise SourceError(
        f"[migrate] console_wait_ms = '{said}' is no time",
        location=Location(str(path), _lines_of("migrate", text).get("console_wait_ms")),
        fix=f'write whole milliseconds from "0" (no wait) to "{LONGEST_WAIT_MS}"',
    )


def _path_in(folder: Path, name: str) -> Path:
    """A path of the file; one that was written on Windows has backslashes between its folders."""
    path = folder / name
    return path if os.path.lexists(path) else folder / name.replace("\\", "/")


def _table(path: Path, data: dict[str, Json], name: str, text: str) -> dict[str, str]:
    table = data.get(name, {})
    wrong = next((key for key, value in table.items() if not isinstance(value, str)), None) if isinstance(table, dict) else ""
    if wrong is not None:
        lines = _lines_of(name, text)
        line = lines.get(wrong) or lines.get(wrong.partition(".")[0])
        which = f", and '{wrong}' is none" if wrong else ""
        message = f"[{name}] must hold texts only{which}"
        raise SourceError(message, location=Location(str(path), line), fix=f'write {wrong or "NAME"} = "VALUE"')
    return {key: as_text(value) for key, value in as_table(table).items()}


def _bind(path: Path, data: dict[str, Json], text: str) -> dict[str, str]:
    """[bind] without tables in it: TOML takes a key with a point in it, such as a role of a library, for one, too."""
    table = data.get("bind", {})
    return _table(path, {**data, "bind": _flat(table) if isinstance(table, dict) else table}, "bind", text)


def _flat(table: Mapping[str, Json]) -> dict[str, Json]:
    """The entries of a table and of those in it, with their names joined by points."""
    made: dict[str, Json] = {}
    for key, value in table.items():
        inner = {f"{key}.{name}": entry for name, entry in _flat(value).items()} if isinstance(value, dict) else {key: value}
        made |= inner
    return made


def _servos(path: Path, data: dict[str, Json], text: str) -> dict[str, ServoTrim]:
    """[servos.NAME], in which TOML takes a name with a point in it, such as a role of a library, for a table of tables."""
    found: dict[str, Json] = {}
    table = data.get("servos", {})
    for name, entry in table.items() if isinstance(table, dict) else [("", None)]:
        inner = entry if isinstance(entry, dict) and entry and not set(entry) & set(_SERVO) else None
        named = inner is not None and all(isinstance(value, dict) for value in inner.values())
        found |= {f"{name}.{key}": value for key, value in inner.items()} if named and inner is not None else {name: entry}
    lines = _lines_of("servos", text)
    return {name: _servo(path, name, entry, lines.get(name)) for name, entry in found.items()}


def _servo(path: Path, name: str, entry: Json, line: int | None) -> ServoTrim:
    place, least, most = Location(str(path), line), *PULSES

    def wrong(what: str, fix: str) -> SourceError:
        return SourceError(f"[servos] '{name}': {what}", location=place, fix=fix)

    if not isinstance(entry, dict) or not entry:
        raise wrong("there is no table with neutral or speeds", f'write [servos."{name or "NAME"}"] and below it neutral = 1500')
    for key in entry:
        if key not in _SERVO:
            raise wrong(f"'{key}' is no key of it{did_you_mean(key, _SERVO)}", f"use one of: {', '.join(_SERVO)}")
    neutral, speeds = entry.get("neutral", 0), entry.get("speeds", [])
    whole = isinstance(speeds, list) and all(
        isinstance(point, list) and len(point) == 2 and all(value.__class__ is int for value in point) for point in speeds
    )
    if "neutral" in entry and (neutral.__class__ is not int or not least <= neutral <= most):
        raise wrong(f"neutral = {neutral!r} is no pulse", f"give whole microseconds from {least} to {most}")
    if "speeds" in entry and (not whole or len(speeds) < 2):
        raise wrong("speeds is no list of two [speed, microseconds] or more", "write speeds = [[-100, 1300], [100, 1700]]")
    if len(speeds) > POINTS:
        raise wrong(f"speeds has {len(speeds)} points", f"give at most {POINTS}: between two, the pulse is in proportion")
    odd = next((point for point in speeds if not least <= point[1] <= most or abs(point[0]) > 32767), None)
    if odd is not None:
        raise wrong(f"{odd} in speeds has no pulse or speed that can be", f"give whole microseconds from {least} to {most}")
    back = next((b for a, b in pairwise(speeds) if b[0] <= a[0]), None)
    if back is not None:
        raise wrong(f"{back} in speeds does not come behind a lower speed", "list the speeds from the lowest to the highest")
    at_rest = next((point[1] for point in speeds if point[0] == 0), neutral)
    if neutral and at_rest != neutral:
        raise wrong(f"neutral is {neutral}, and speeds has {at_rest} for a stand", "leave out one of them")
    points = dict(speeds) | ({0: neutral} if neutral and speeds else {})
    return ServoTrim(at_rest, tuple(sorted(points.items())), place)


_KEY = r"\"[^\"]*\"|'[^']*'|[\w.-]+"
_HEAD = re.compile(rf"\s*\[\s*(\w+)\s*(?:\.\s*({_KEY})\s*)?\]")
_ENTRY = re.compile(rf"\s*({_KEY})\s*=")


def _lines_of(table: str, text: str) -> dict[str, int]:
    """The lines in which the entries of a table, or the tables in it and theirs, begin; without those that are not written as
    such.
    """
    found: dict[str, int] = {}
    inside, before = False, ""
    for number, line in enumerate(text.splitlines(), 1):
        if (head := _HEAD.match(line)) is not None:
            inside, before = head[1] == table, f"{name}." if (name := (head[2] or "").strip("\"'")) else ""
            if inside and name:
                found.setdefault(name, number)
        elif line.lstrip().startswith("["):
            inside = False
        elif inside and (entry := _ENTRY.match(line)) is not None:
            found.setdefault(before + entry[1].strip("\"'"), number)
    return found


def _list_of_tables(path: Path, data: dict[str, Json], name: str) -> list[Json]:
    entries = data.get(name, [])
    if not isinstance(entries, list):
        raise _wrong(path, f"'{name}' must be a list of tables", f"write each entry as [[{name}]]")
    return entries


def _accepted(path: Path, entry: Json) -> Accepted:
    keys = ("rule", "element", "reason")
    if not isinstance(entry, dict) or any(not isinstance(entry.get(k), str) for k in keys):
        raise _wrong(path, "[[accept]] needs the texts rule, element and reason", "add what is missing")
    return Accepted(as_text(entry["rule"]), as_text(entry["element"]), as_text(entry["reason"]))


def _known(path: Path, data: Iterable[str], known: tuple[str, ...], what: str) -> None:
    for key in data:
        if key not in known:
            raise _wrong(path, f"'{key}' is no {what}{did_you_mean(key, known)}", f"use one of: {', '.join(known)}")


def _wrong(path: Path, message: str, fix: str) -> SourceError:
    return SourceError(message, location=Location(str(path)), fix=fix)


def defaults(project: Path | None = None) -> dict[str, dict[str, Json]]:
    """The commands' default settings: all `defaults.toml` files of the platform repository, merged.

    Their order of precedence is the search order (project, ROBOSMI_PATH, user, plug-ins, built-in): if two files have a key,
    the value of the first one is used.

    Args:
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: a file is damaged.
    """
    return _merged(tuple((str(path), path.stat().st_mtime_ns) for path in _default_files(project)))


def default_text(table: str, key: str, project: Path | None = None) -> str:
    """The text that a key of the defaults has.

    Args:
        table: name of a table of the defaults.
        key: in that table.
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: it is missing, or no text.
    """
    value = defaults(project).get(table, {}).get(key)
    if not isinstance(value, str):
        raise _no_default(table, key, "text", project)
    return value


def default_number(table: str, key: str, project: Path | None = None) -> float:
    """The number that a key of the defaults has; see `default_text`."""
    value = defaults(project).get(table, {}).get(key)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise _no_default(table, key, "number", project)
    return value


def _no_default(table: str, key: str, kind: str, project: Path | None) -> PlatformDataError:
    said = defaults(project).get(table, {})
    what = f"it is {said[key]!r}" if key in said else f"it is missing{did_you_mean(key, said)}"
    place = defaults_place(table, key, project)
    return PlatformDataError(
        f"'{table}.{key}' must be a {kind}, {what}", location=Location(str(place)), fix=f"write {key} in [{table}]"
    )


def defaults_place(table: str, key: str, project: Path | None = None) -> Path:
    """The file whose value of a key counts, for messages; the built-in one where no file has it.

    Args:
        table: name of a table of the defaults.
        key: in that table.
        project: the project folder; the current folder if None.
    """
    files = list(_default_files(project))
    return next((path for path in files if key in as_table(read_data(path).get(table, {}))), files[-1])


def _default_files(project: Path | None) -> Iterator[Path]:
    return (path for folder in resources.folders("platform_repo", project) if (path := folder / "defaults.toml").is_file())


@cache
def _merged(files: tuple[tuple[str, int], ...]) -> dict[str, dict[str, Json]]:  # by time of change: an edited file is read anew
    merged: dict[str, dict[str, Json]] = {}
    built_in = read_data(Path(files[-1][0])) if files else {}
    for path, _ in reversed(files):
        for name, table in read_data(Path(path)).items():
            _check_default(path, name, tuple(built_in), "table of it")
            if not isinstance(table, dict):
                raise PlatformDataError(
                    f"'{name}' must be a table", location=Location(path), fix=f"write it in a table: [{name}]"
                )
            for key in table if name not in _OPEN else ():
                known = as_table(built_in[name])
                _check_default(path, key, tuple(known), f"key of [{name}]")
            merged[name] = {**merged.get(name, {}), **table}
    return merged


_OPEN = ("readers", "source_platforms", "targets")
"""Tables of the defaults whose keys are names of one's own: endings, and targets."""


def _check_default(path: str, name: str, known: Sequence[str], what: str) -> None:
    """Refuse a table or a key that the built-in file has not: nobody would ask for it."""
    if name not in known:
        place = Location(path, line_of_key(inputs.read_text(Path(path), inputs.DATA), name))
        told = f"'{name}' is no {what}{did_you_mean(name, known)}"
        raise PlatformDataError(told, location=place, fix=f"use one of: {', '.join(known)}")


def read_data(path: Path) -> dict[str, Json]:
    """A TOML file of the platform repository.

    Raises:
        PlatformDataError: it cannot be read.
    """
    try:
        return data_toml(inputs.read_text(path, inputs.DATA))
    except (ValueError, OSError) as error:
        raise PlatformDataError(
            f"the entry cannot be read: {error}", location=Location(str(path)), fix="correct the entry"
        ) from error
