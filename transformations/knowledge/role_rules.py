"""Reads the files that assign roles to parts: `parts/roles.toml` (rules) and `parts/curated.toml` (entries for single ids).

The files of all folders of the platform repository are used, the user's before the built-in one, so an own file extends and
precedes the built-in rules. Keys are checked here; `part_roles` finds the rule that matches.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import TypedDict

from msgspec import Struct

from robosmi import inputs
from robosmi.data_text import Json, line_of_value
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, did_you_mean
from robosmi.plugins import registry
from robosmi.resources import built_in, folders
from robosmi.transformations.knowledge.part import ROLES
from robosmi.transformations.knowledge.part_names import Phrases, read_toml

_FLAGS = ("driver", "first", "weak", "tags")
_LISTS = ("words", "not", "named")
_BY_TOOL = ("ids", "families")
_RULE_KEYS = ("role", "why", "connectors", *_FLAGS, *_LISTS, *_BY_TOOL)
_CURATED_KEYS = ("role", "why", "driver", "ids")
_NAMED = ("supply", "ground")


ByTool = list[str] | dict[str, list[str]]
"""Texts that hold for every drawing tool, or texts by tool."""
_ListsOfRule = TypedDict("_ListsOfRule", {"words": list[str], "not": list[str], "named": list[str]}, total=False)


class RoleRule(_ListsOfRule, total=False):
    """An entry of a file: a rule, or the role of single ids."""

    role: str
    why: str
    driver: bool
    first: bool
    weak: bool
    tags: bool
    connectors: list[list[str]]
    ids: ByTool
    families: ByTool


class RoleRules(Struct, frozen=True):
    """The rules of one `roles.toml` in order, indexed for look-up."""

    rules: tuple[RoleRule, ...]
    words: Phrases
    tags: Phrases
    weak: frozenset[int]
    forbidden: tuple[Phrases | None, ...]
    named: tuple[tuple[str, int], ...]
    families: tuple[tuple[str, str, int], ...]
    connectors: tuple[tuple[frozenset[str], int], ...]


def role_rules(project: Path | None) -> list[RoleRules]:
    """The rules of each file, the user's before the built-in ones: the first file with a rule that fits decides.

    Args:
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: a file is damaged, or there is none.
    """
    found = [_rules(str(path), path.stat().st_mtime_ns) for path in _files("roles.toml", project)]
    if not found:
        raise PlatformDataError("there is no parts/roles.toml in the platform repository", fix="install robosmi again")
    return found


def curated_entries(project: Path | None) -> dict[tuple[str, str], RoleRule]:
    """The entries of all files by tool (empty for every tool) and id; the first file that has one counts.

    Args:
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: a file is damaged.
    """
    result: dict[tuple[str, str], RoleRule] = {}
    for path in _files("curated.toml", project):
        for key, entry in _curated(str(path), path.stat().st_mtime_ns).items():
            result.setdefault(key, entry)
    return result


def _files(name: str, project: Path | None) -> Iterator[Path]:
    return (path for folder in folders("platform_repo", project) if (path := folder / "parts" / name).is_file())


@cache
def _rules(path: str, changed: int) -> RoleRules:
    rules = _entries(path, "rule", _RULE_KEYS)
    words = [(word, number) for number, rule in enumerate(rules) for word in rule.get("words", [])]
    return RoleRules(
        rules=tuple(rules),
        words=Phrases(words),
        tags=Phrases((word, number) for word, number in words if rules[number].get("tags", True)),
        forbidden=tuple(Phrases((word, 0) for word in rule["not"]) if rule.get("not") else None for rule in rules),
        weak=frozenset(number for number, rule in enumerate(rules) if rule.get("weak")),
        named=tuple((kind, number) for number, rule in enumerate(rules) for kind in rule.get("named", [])),
        families=tuple((tool, family, n) for n, rule in enumerate(rules) for tool, family in _by_tool(rule.get("families", []))),
        connectors=tuple((frozenset(wanted), number) for number, r in enumerate(rules) for wanted in r.get("connectors", [])),
    )


@cache
def _curated(path: str, changed: int) -> dict[tuple[str, str], RoleRule]:
    return {key: entry for entry in _entries(path, "part", _CURATED_KEYS) for key in _by_tool(entry.get("ids", []))}


def _by_tool(listed: ByTool) -> Iterator[tuple[str, str]]:
    """Tool (empty for all) and text of each entry of such a list."""
    if isinstance(listed, Mapping):
        yield from ((tool, text) for tool, texts in listed.items() for text in texts)
    else:
        yield from (("", text) for text in listed)


def _entries(path: str, key: str, keys: Sequence[str]) -> list[RoleRule]:
    """The tables `[[key]]` of a file, each with keys and values that mean something.

    Raises:
        PlatformDataError: one has a key or a value that means nothing.
    """
    table = read_toml(path)
    odd = next((name for name in table if name != key), None)
    entries = table.get(key, [])
    if odd is not None or not isinstance(entries, list) or not all(isinstance(entry, Mapping) for entry in entries):
        what = f"'{odd}' means nothing here{did_you_mean(odd, [key])}" if odd is not None else f"'{key}' is no list of tables"
        raise PlatformDataError(what, location=Location(path), fix=f"begin each entry with [[{key}]]")
    tools = None if Path(path).is_relative_to(built_in("platform_repo")) else _tools()
    for entry in entries:
        _check_role(entry, path)
        if problem := _problem(entry, keys, tools):
            raise PlatformDataError(
                f"the entry for {entry['role']} ({entry['why']}) cannot be used: {problem}",
                location=Location(path),
                fix="the head of the built-in parts/roles.toml says what the keys mean",
            )
    return entries


def _check_role(entry: Mapping[str, Json], path: str) -> None:
    if entry.get("role") not in ROLES or not entry.get("why"):
        role = str(entry.get("role", ""))
        near = next((t for key in entry if key not in ("role", "why") and (t := did_you_mean(key, ("role", "why")))), "")
        said = f"an entry has the role '{role}' and the reason '{entry.get('why', '')}'{did_you_mean(role, ROLES) or near}"
        raise PlatformDataError(
            f"an entry for '{role}' says no reason{near}" if role in ROLES else said,
            location=Location(path, line_of_value(inputs.read_text(path, inputs.DATA), role)),
            fix=f"give it a why, and as role one of: {', '.join(ROLES)}",
        )


def _problem(entry: Mapping[str, Json], keys: Sequence[str], tools: Collection[str] | None) -> str:
    """The message about what is wrong with an entry, or an empty text; `tools` are the known ones, None for any."""
    for key, value in entry.items():
        if key not in keys:
            return f"'{key}' is no key{did_you_mean(key, keys)}"
        named = list(value) if key in _BY_TOOL and isinstance(value, Mapping) else []
        if tools is not None and (odd := next((tool for tool in named if tool not in tools), None)) is not None:
            return f"'{key}.{odd}' names a drawing tool that no reader reads{did_you_mean(odd, tools)}"
        if not _fits(key, value):
            return f"'{key}' has the value {value!r}"
        kinds = [str(kind) for kind in value] if key == "named" and isinstance(value, list) else []
        if (odd := next((kind for kind in kinds if kind not in _NAMED), None)) is not None:
            return f"'named' has '{odd}'{did_you_mean(odd, _NAMED)}; there are: {', '.join(_NAMED)}"
    return ""


def _fits(key: str, value: Json) -> bool:
    if key in _FLAGS:
        return isinstance(value, bool)
    if key in ("role", "why"):
        return isinstance(value, str)
    if key == "connectors":
        return isinstance(value, list) and all(_texts(each) for each in value)
    if key in _BY_TOOL and isinstance(value, Mapping):
        return all(_texts(each) for each in value.values())
    return _texts(value)


def _texts(value: Json) -> bool:
    return isinstance(value, list) and all(isinstance(text, str) for text in value)


def _tools() -> set[str]:
    """The drawing tools that an entry may name: those with a reader, and those that the built-in rules know."""
    named = {*registry().names("drawing reader"), *registry().names("parts reader")}
    for rule in _entries(str(built_in("platform_repo") / "parts" / "roles.toml"), "rule", _RULE_KEYS):
        named |= {tool for listed in (rule.get("ids"), rule.get("families")) if isinstance(listed, dict) for tool in listed}
    return named
