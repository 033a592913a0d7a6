"""Determines a part's role for the software: by a curated entry for its id, else by the first matching rule, with the reason.

The rules are in `parts/roles.toml`, the entries for single ids in `parts/curated.toml`. The files of all folders of the platform
repository are used, the user's before the built-in one, so an own file extends and precedes the built-in rules. Unknown keys are
refused. The built-in catalogue was made with these rules; a drawing needs them only for parts that the catalogue lacks.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import TypedDict

from msgspec import Struct
from msgspec.structs import replace

from robosmi import inputs
from robosmi.base.data_text import Json, line_of_value
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, did_you_mean
from robosmi.plugins import registry
from robosmi.resources import built_in, folders
from robosmi.transformations.knowledge.part import ROLES, Part
from robosmi.transformations.knowledge.part_names import PartNames, Phrases, names, read_toml
from robosmi.transformations.knowledge.wildcards import fits

_REMARK = re.compile(r"\([^()]*\)|\[[^\[\]]*\]")
_PIN_NAME = re.compile("[A-Za-z]{2}|[A-Za-z][0-9]")
"""What the name of a board's pin contains, unlike `1`, `+` or `P$1`."""
_SYMBOL_CONNECTORS = 2  # of a symbol of a supply; a part with more is one that has a supply


def classify(part: Part, project: Path | None = None) -> Part:
    """The part with role, driver flag and evidence; unchanged if it has a role already, or if nothing is known.

    Args:
        part: the part.
        project: the project folder, whose own rules go first; the current folder if None.

    Raises:
        PlatformDataError: the rules are damaged.
    """
    if (curated := _curated(part, project)) is not None:
        return curated
    found = _first_rule(part, project)
    return _with(part, *found) if found is not None else part


def is_connector(part: Part, project: Path | None = None) -> bool:
    """Whether the first rule that fits a part says that something is plugged in there (`connector`), whatever it is.

    Args:
        part: the part, without a role.
        project: the project folder, whose own rules go first; the current folder if None.

    Raises:
        PlatformDataError: the rules are damaged.
    """
    found = _first_rule(part, project)
    return found is not None and bool(found[0].get("connector"))


def _first_rule(part: Part, project: Path | None) -> tuple[RoleRule, str] | None:
    """The rule that decides the role of a part, with the clue by which it fits."""
    about = f"{_without_remarks(part.title)} / {part.family}"
    for known in role_rules(project):
        for number, clue in _clues(part, known, names(project)):
            rule, forbidden = known.rules[number], known.forbidden[number]
            if rule["role"] == "Board" and _has_bare_ends(part):
                continue
            if forbidden is None or about not in forbidden:
                return rule, clue
    return None


def _has_bare_ends(part: Part) -> bool:
    """Whether a part has only one or two connectors and none with a name, such as a resistor that is named after its library."""
    ends = [connector.name for connector in part.connectors.values()]
    return len(ends) in (1, 2) and not any(_PIN_NAME.search(name) for name in ends)


def classify_by_id(part: Part, project: Path | None = None) -> Part:
    """The part with the role that an entry or rule assigns to its id alone; for parts whose names do not show what they do.

    Args:
        part: the part.
        project: the project folder, whose own rules go first; the current folder if None.

    Raises:
        PlatformDataError: the rules are damaged.
    """
    if (curated := _curated(part, project)) is not None:
        return curated
    for known in role_rules(project):
        for rule in known.rules:
            ids = rule.get("ids")
            if isinstance(ids, dict) and part.tool in ids and (clue := _id_clue(part.id[:400].lower(), part.tool, rule)):
                return _with(part, rule, clue)
    return part


def classify_drawn(
    part: Part, title: str, properties: Mapping[str, str], file_hint: str = "", project: Path | None = None
) -> Part:
    """Classify one placed part that is generic (a chip, a mystery part) by its label and its properties.

    Args:
        part: the part, with the connector names of this placement.
        title: its label in the drawing.
        properties: its own properties.
        file_hint: name of the file that its missing definition was in, or empty.
        project: the project folder; the current folder if None.
    """
    if part.role != "Unknown":
        return part
    device = names(project).device_properties
    texts = [value for key, value in properties.items() if key.lower() in device and value]
    clues = [(text, f"called '{text}' in the drawing") for text in texts]
    clues += [(title, f"labelled '{title}'"), (file_hint, f"the file '{file_hint}' defined it")]
    for known in role_rules(project):
        for text, what in clues:
            for number, words in sorted(known.words.found(text)):
                rule = known.rules[number]
                forbidden = known.forbidden[number]
                if rule["role"] not in ("Board", "Decoration") and (forbidden is None or text not in forbidden):
                    return _with(part, rule, f"'{words}', {what}")
        if (found := next(_connector_clues(part, known), None)) is not None:
            return _with(part, known.rules[found[0]], found[1])
    return part


def _curated(part: Part, project: Path | None) -> Part | None:
    """The part if it has a role already or a curated entry for its id assigns one; else None."""
    if part.role != "Unknown":
        return part
    entries = curated_entries(project)
    entry = entries.get((part.tool, part.id)) or entries.get(("", part.id))
    if entry is None:
        return None
    return replace(part, role=entry["role"], driver=bool(entry.get("driver", False)), evidence=f"curated: {entry['why']}")


def _with(part: Part, rule: RoleRule, clue: str) -> Part:
    return replace(part, role=rule["role"], driver=bool(rule.get("driver", False)), evidence=f"{clue}: {rule['why']}")


def _clues(part: Part, known: RoleRules, lists: PartNames) -> Iterator[tuple[int, str]]:
    """The clues for each rule, by its index, the strongest first (see the head of `roles.toml`)."""
    part_id, family = part.id[:400].lower(), part.family[:200].strip().lower()
    for number, rule in enumerate(known.rules):
        if rule.get("first") and (clue := _id_clue(part_id, part.tool, rule) or _family_clue(family, part.tool, rule)):
            yield number, clue
    title = part.title.strip().lower()
    if len(part.connectors) <= _SYMBOL_CONNECTORS:
        for kind, number in known.named:
            if title and title in lists.names[kind]:
                yield number, f"its title '{title}'"
    weak: list[tuple[int, str]] = []
    for number, clue in _strong_clues(part, family, known):
        if number in known.weak and part.description:
            weak.append((number, clue))
        else:
            yield number, clue
    yield from weak
    for number, words in sorted(known.tags.found(" / ".join(part.tags))):
        yield number, f"'{words}' in the tags"
    yield from _connector_clues(part, known)
    for number, rule in enumerate(known.rules):
        if clue := _id_clue(part_id, part.tool, rule):
            yield number, clue


def _strong_clues(part: Part, family: str, known: RoleRules) -> Iterator[tuple[int, str]]:
    for number, words in _words_in(part.title, known.words):
        yield number, f"'{words}' in the title"
    for tool, pattern, number in known.families:
        if _same_tool(tool, part.tool) and fits(family, pattern):
            yield number, f"family '{family}'"
    for number, words in sorted(known.words.found(family)):
        yield number, f"'{words}' in the family"
    for number, words in _words_in(part.description, known.words):
        yield number, f"'{words}' in the description"


def _words_in(text: str, phrases: Phrases) -> Iterator[tuple[int, str]]:
    """The phrases in a text: first those outside of brackets, then those inside."""
    said = _without_remarks(text)
    yield from sorted(phrases.found(said))
    if said != text:
        yield from sorted(phrases.found(text))


def _without_remarks(text: str) -> str:
    """A text without what is in brackets, unless that is all of it."""
    said = _REMARK.sub(" ", text)
    return said if said.strip() else text


def _connector_clues(part: Part, known: RoleRules) -> Iterator[tuple[int, str]]:
    own = {connector.name.strip().lower() for connector in part.connectors.values()}
    for wanted, number in known.connectors:
        if wanted <= own:
            yield number, f"connectors {', '.join(sorted(wanted))}"


def _of_tool(listed: ByTool, tool: str) -> Iterator[str]:
    """The texts of a list that apply to a tool: a plain list applies to all tools, a table by tool; without a tool all apply."""
    if isinstance(listed, dict):
        for name, texts in listed.items():
            if _same_tool(name, tool):
                yield from texts
    else:
        yield from listed


def _same_tool(named: str, tool: str) -> bool:
    return not named or not tool or named == tool


def _id_clue(part_id: str, tool: str, rule: RoleRule) -> str:
    return next((f"the part's id has '{text}' in it" for text in _of_tool(rule.get("ids", []), tool) if text in part_id), "")


def _family_clue(family: str, tool: str, rule: RoleRule) -> str:
    found = any(fits(family, pattern) for pattern in _of_tool(rule.get("families", []), tool))
    return f"family '{family}'" if found else ""


# ---- the files

_FLAGS = ("driver", "first", "weak", "tags", "connector")
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
    connector: bool
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
        raise PlatformDataError("the platform repository has no parts/roles.toml", fix="install robosmi again")
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
        for key, entry in _curated_rules(str(path), path.stat().st_mtime_ns).items():
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
def _curated_rules(path: str, changed: int) -> dict[tuple[str, str], RoleRule]:
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
        what = f"unknown table '{odd}'{did_you_mean(odd, [key])}" if odd is not None else f"'{key}' is not a list of tables"
        raise PlatformDataError(what, location=Location(path), fix=f"begin each entry with [[{key}]]")
    tools = None if Path(path).is_relative_to(built_in("platform_repo")) else _tools()
    for entry in entries:
        _check_role(entry, path)
        if problem := _problem(entry, keys, tools):
            raise PlatformDataError(
                f"the entry for {entry['role']} ({entry['why']}) cannot be used: {problem}",
                location=Location(path),
                fix="the head of the built-in parts/roles.toml explains the keys",
            )
    return entries


def _check_role(entry: Mapping[str, Json], path: str) -> None:
    if entry.get("role") not in ROLES or not entry.get("why"):
        role = str(entry.get("role", ""))
        near = next((t for key in entry if key not in ("role", "why") and (t := did_you_mean(key, ("role", "why")))), "")
        said = f"an entry has the role '{role}' and the reason '{entry.get('why', '')}'{did_you_mean(role, ROLES) or near}"
        raise PlatformDataError(
            f"an entry for '{role}' has no reason{near}" if role in ROLES else said,
            location=Location(path, line_of_value(inputs.read_text(path, inputs.DATA), role)),
            fix=f"give it a `why`, and one of these roles: {', '.join(ROLES)}",
        )


def _problem(entry: Mapping[str, Json], keys: Sequence[str], tools: Collection[str] | None) -> str:
    """The message about what is wrong with an entry, or an empty text; `tools` are the known ones, None for any."""
    for key, value in entry.items():
        if key not in keys:
            return f"'{key}' is not a key{did_you_mean(key, keys)}"
        named = list(value) if key in _BY_TOOL and isinstance(value, Mapping) else []
        if tools is not None and (odd := next((tool for tool in named if tool not in tools), None)) is not None:
            return f"'{key}.{odd}' names an unknown drawing tool{did_you_mean(odd, tools)}"
        if not _fits(key, value):
            return f"'{key}' has the value {value!r}"
        kinds = [str(kind) for kind in value] if key == "named" and isinstance(value, list) else []
        if (odd := next((kind for kind in kinds if kind not in _NAMED), None)) is not None:
            return f"'named' has '{odd}'{did_you_mean(odd, _NAMED)}; use one of: {', '.join(_NAMED)}"
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
