"""The specification of a corpus: `SPEC.toml` with its programs, settings and limits.

An unknown key is an error that suggests the nearest known one. Which programs a place has is found out by `programs`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from msgspec import Struct

from robosmi import inputs
from robosmi.base.data_text import Json, toml_of
from robosmi.corpus.jobs import Limits
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, UsageError, did_you_mean
from robosmi.files.files import read_input
from robosmi.project import LONGEST_WAIT_MS, is_console_wait

STEPS = ("analyse", "migrate", "compile", "verify")
"""The steps there are, in their order."""
NEEDS = {"compile": "migrate", "verify": "migrate"}
"""Step -> the step whose results it uses."""
_TABLES = ("programs", "migrate", "limits", "steps", "keep_models")
_PROGRAMS = ("folder", "glob", "git", "revision", "list", "prefix", "include_dirs", "defines", "migrate", "labels")
_MIGRATE = ("hardware", "target", "source_platform", "from", "console_wait_ms")
_LIMITS = ("seconds", "megabytes")
_LEAST_MB, _MOST_MB, _MOST_S = 100, 1 << 20, 7 * 86_400.0
"""A worker process takes up to 80 MB before it looks at a program."""
_MACRO = re.compile(r"[A-Za-z_]\w*(=|\Z)", re.ASCII)


class ProgramPlace(Struct, frozen=True):
    """An entry of `[[programs]]`: where programs are, and what is particular to them.

    Attributes:
        folder: where `glob` begins; the folder of the specification if the entry has none.
        glob: pattern of the programs; None for every source file.
        git: a repository on this machine, with or without a work tree.
        revision: its commit, branch or tag.
        list: a CSV file of programs.
        prefix: what is put before the ids of its programs.
        include_dirs: folders with headers.
        defines: macros defined from outside.
        migrate: settings that count before the project files beside the programs.
        labels: labels of all its programs.
        number: its number among the entries, from 1.
    """

    folder: Path
    glob: str | None = None
    git: Path | None = None
    revision: str = "HEAD"
    list: Path | None = None
    prefix: str = ""
    include_dirs: tuple[str, ...] = ()
    defines: tuple[str, ...] = ()
    migrate: dict[str, str] = {}
    labels: dict[str, str] = {}
    number: int = 1

    @property
    def name(self) -> str:
        """What it is called in messages."""
        return str(self.git or self.list or self.folder)


class Spec(Struct, frozen=True):
    """A specification.

    Attributes:
        path: its file.
        places: the entries of `[[programs]]`.
        migrate: settings that count behind the project files beside the programs.
        limits: what a step of a program may take.
        steps: the steps; empty if the file names none.
        keep_models: whether the models of all programs are stored.
    """

    path: Path
    places: tuple[ProgramPlace, ...]
    migrate: dict[str, str] = {}
    limits: Limits = Limits()
    steps: tuple[str, ...] = ()
    keep_models: bool = False

    @property
    def folder(self) -> Path:
        """The folder of the file, absolute."""
        return self.path.absolute().parent


def read_spec(path: Path) -> Spec:
    """Read a specification.

    Raises:
        SourceError: it cannot be read, or has a key or value that means nothing.
    """
    data = read_input(path, "specification", inputs.SETTINGS)
    try:
        found = toml_of(data.decode("utf-8-sig"))
    except ValueError as error:
        raise _wrong(path, f"the specification cannot be read: {error}", "correct it (TOML 1.0)") from error
    _known(path, found, _TABLES, "key of a specification")
    entries = found.get("programs", [])
    if not isinstance(entries, list) or not entries:
        raise _wrong(path, "the specification names no programs", 'write [[programs]] and below it glob = "programs/*.c"')
    folder = path.absolute().parent
    places = [_place(path, folder, entry, number) for number, entry in enumerate(entries, 1)]
    keep = found.get("keep_models", False)
    if not isinstance(keep, bool):
        raise _wrong(path, "keep_models is neither true nor false", "write keep_models = true")
    return Spec(
        path, tuple(places), _texts(path, found, "migrate", _MIGRATE, folder), _limits(path, found.get("limits", {})),
        _steps(path, found), keep,
    )  # fmt: skip


def _steps(path: Path, found: Mapping[str, Json]) -> tuple[str, ...]:
    try:
        return checked_steps(_list_of_texts(path, found, "steps")) if "steps" in found else ()
    except UsageError as error:
        raise _wrong(path, error.message, error.fix or "") from None


def checked_steps(names: Sequence[str]) -> tuple[str, ...]:
    """Steps in the order in which they are run.

    Raises:
        UsageError: there is no such step, or one lacks the step whose results it uses.
    """
    for name in names:
        if name not in STEPS:
            raise UsageError(f"'{name}' is no step{did_you_mean(name, STEPS)}", fix=f"use some of: {', '.join(STEPS)}")
        if (needed := NEEDS.get(name)) is not None and needed not in names:
            raise UsageError(f"the step '{name}' needs the step '{needed}'", fix=f"add {needed}")
    if not names:
        raise UsageError("there is no step", fix=f"use some of: {', '.join(STEPS)}")
    return tuple(step for step in STEPS if step in names)


def _place(path: Path, folder: Path, entry: Json, number: int) -> ProgramPlace:
    where = f"[[programs]] number {number}"
    if not isinstance(entry, dict):
        raise _wrong(path, f"{where} is no table", "write [[programs]] and its keys below it")
    _known(path, entry, _PROGRAMS, f"key of {where}")
    for key in ("folder", "glob", "git", "revision", "list", "prefix"):
        if key in entry and (not isinstance(entry[key], str) or not entry[key]):
            raise _wrong(path, f"{key} of {where} is no text", f'write {key} = "..."')
    kinds = [key for key in ("folder", "git", "list") if key in entry]
    if kinds == ["folder", "git"]:
        advice = f'name the folder in the repository by a pattern: glob = "{entry["folder"]}/**/*.c"'
        raise _wrong(path, f"{where} has folder and git", advice)
    if len(kinds) > 1:
        raise _wrong(path, f"{where} has {' and '.join(kinds)}", "write an entry for each")
    if not kinds and "glob" not in entry:
        raise _wrong(path, f"{where} says nowhere where its programs are", "give folder, glob, git or list")
    if "revision" in entry and "git" not in entry:
        raise _wrong(path, f"{where} has a revision and no git", "name the repository: git = ...")
    if "glob" in entry and "list" in entry:
        raise _wrong(path, f"{where} has a glob and a list", "write an entry for each")
    git, listed = entry.get("git"), entry.get("list")
    return ProgramPlace(
        folder / str(entry.get("folder", "")), _optional(entry.get("glob")), folder / str(git) if git else None,
        str(entry.get("revision", "HEAD")), folder / str(listed) if listed else None, str(entry.get("prefix", "")),
        _include_dirs(path, folder, entry, where), _defines(path, entry, where), _texts(path, entry, "migrate", _MIGRATE, folder),
        _texts(path, entry, "labels", None, folder), number,
    )  # fmt: skip


def _include_dirs(path: Path, folder: Path, entry: Mapping[str, Json], where: str) -> tuple[str, ...]:
    names = _list_of_texts(path, entry, "include_dirs")
    for name in names:
        if not (folder / name).is_dir():
            raise _wrong(path, f"include_dirs of {where}: there is no folder '{name}'", "paths are relative to the specification")
    return tuple(str(folder / name) for name in names)


def _defines(path: Path, entry: Mapping[str, Json], where: str) -> tuple[str, ...]:
    found = _list_of_texts(path, entry, "defines")
    for each in found:
        if not _MACRO.match(each):
            raise _wrong(path, f"defines of {where}: '{each}' is no macro", "write NAME or NAME=VALUE")
    return tuple(found)


def _optional(value: Json) -> str | None:
    return value if isinstance(value, str) else None


def _texts(path: Path, data: Mapping[str, Json], name: str, known: Sequence[str] | None, folder: Path) -> dict[str, str]:
    table = data.get(name, {})
    if not isinstance(table, dict):
        raise _wrong(path, f"'{name}' is no table", f"write [{name}] and below it KEY = VALUE")
    if known is not None:
        _known(path, table, known, f"key in [{name}]")
    for key, value in table.items():
        if not isinstance(value, str):
            raise _wrong(path, f"[{name}] {key} is no text", f'write {key} = "{value}"')
    found = {key: str(value) for key, value in table.items()}
    if known is not None and "hardware" in found:
        found["hardware"] = str(folder / found["hardware"])
    if known is not None and (wait := found.get("console_wait_ms")) is not None and not is_console_wait(wait):
        advice = f'write whole milliseconds from "0" (no wait) to "{LONGEST_WAIT_MS}"'
        raise _wrong(path, f'[{name}] console_wait_ms = "{wait}" is no time', advice)
    return found


def _list_of_texts(path: Path, data: Mapping[str, Json], name: str) -> list[str]:
    value = data.get(name, [])
    if not isinstance(value, list) or not all(isinstance(each, str) for each in value):
        raise _wrong(path, f"{name} is no list of texts", f'write {name} = ["..."]')
    return [str(each) for each in value]


def _limits(path: Path, table: Json, of: Limits = Limits(), inner: bool = False) -> Limits:  # noqa: B008
    if not isinstance(table, dict):
        raise _wrong(path, "'limits' is no table", "write [limits] and below it seconds = 60")
    _known(path, table, _LIMITS if inner else (*_LIMITS, *STEPS), "key in [limits]")
    seconds, megabytes = table.get("seconds", of.seconds), table.get("megabytes", of.megabytes)
    if isinstance(seconds, bool) or not isinstance(seconds, (int, float)) or not 0 < seconds <= _MOST_S or math.isnan(seconds):
        raise _wrong(path, f"[limits] seconds = {_written(seconds)} is no time", f"write a number above 0, at most {_MOST_S:.0f}")
    if isinstance(megabytes, bool) or not isinstance(megabytes, int):
        message = f"[limits] megabytes = {_written(megabytes)} is no whole number"
        raise _wrong(path, message, "write it without quotation marks and without a point: megabytes = 1000")
    if not _LEAST_MB <= megabytes <= _MOST_MB:
        advice = f"write a whole number from {_LEAST_MB}, which a worker process needs, to {_MOST_MB}"
        raise _wrong(path, f"[limits] megabytes = {megabytes} is too {'little' if megabytes < _LEAST_MB else 'much'}", advice)
    made = Limits(float(seconds), megabytes)
    steps = {step: _limits(path, table[step], made, inner=True) for step in STEPS if not inner and step in table}
    return Limits(made.seconds, made.megabytes, steps)


def _written(value: Json) -> str:
    """A value as TOML has it, for messages."""
    return f'"{value}"' if isinstance(value, str) else str(value).lower()


def _known(path: Path, data: Mapping[str, Json], known: Sequence[str], what: str) -> None:
    for key in data:
        if key not in known:
            raise _wrong(path, f"'{key}' is no {what}{did_you_mean(key, known)}", f"use one of: {', '.join(known)}")


def _wrong(path: Path, message: str, fix: str) -> SourceError:
    return SourceError(message, location=Location(str(path)), fix=fix)
