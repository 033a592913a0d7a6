"""What a part is to the software: a curated entry for its id, else the first rule that fits, each with its reason.

Reads `parts/curated.toml` and `parts/roles.toml` of the platform repository, the user's folders first. The built-in
catalogue was made with them; a drawing needs them only for parts that the catalogue does not have.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase
from functools import cache
from pathlib import Path
from typing import Any

from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError
from robosmi.resources import folders
from robosmi.transformations.knowledge.part import ROLES, Part
from robosmi.transformations.knowledge.part_names import PartNames, Phrases, names, read_toml

_REMARK = re.compile(r"\([^()]*\)|\[[^\[\]]*\]")
_SYMBOL_CONNECTORS = 2  # of a symbol of a supply; a part with more is one that has a supply


@dataclass(frozen=True, slots=True)
class RoleRules:
    """The rules of `roles.toml` in their order, ready for looking up."""

    rules: tuple[Mapping[str, Any], ...]
    words: Phrases
    tags: Phrases
    weak: frozenset[int]
    forbidden: tuple[Phrases | None, ...]
    named: tuple[tuple[str, int], ...]
    families: tuple[tuple[str, str, int], ...]
    connectors: tuple[tuple[frozenset[str], int], ...]


def classify(part: Part, project: Path | None = None) -> Part:
    """The part with role, driver flag and evidence; unchanged if it has a role already, or if nothing is known.

    Args:
        part: the part.
        project: the project folder, whose own rules go first; the current folder if None.

    Raises:
        PlatformDataError: the rules are damaged.
    """
    if part.role != "Unknown":
        return part
    entry = _curated_entries(project).get((part.tool, part.id)) or _curated_entries(project).get(("", part.id))
    if entry is not None:
        return replace(part, role=entry["role"], driver=bool(entry.get("driver", False)), evidence=f"curated: {entry['why']}")
    known = _rules_in_order(project)
    about = f"{_without_remarks(part.title)} / {part.family}"
    for number, clue in _clues(part, known, names(project)):
        forbidden = known.forbidden[number]
        if forbidden is None or about not in forbidden:
            return _with(part, known.rules[number], clue)
    return part


def classify_drawn(
    part: Part, title: str, properties: Mapping[str, str], file_hint: str = "", project: Path | None = None
) -> Part:
    """The same for one placed part that is a general one (a chip, a mystery part): what its label and its properties name.

    Args:
        part: the part, with the connector names of this placement.
        title: its label in the drawing.
        properties: its own properties.
        file_hint: name of the file that its missing definition was in, or empty.
        project: the project folder; the current folder if None.
    """
    if part.role != "Unknown":
        return part
    known = _rules_in_order(project)
    device = names(project).device_properties
    texts = [value for key, value in properties.items() if key.lower() in device and value]
    clues = [(text, f"called '{text}' in the drawing") for text in texts]
    for text, what in [*clues, (title, f"labelled '{title}'"), (file_hint, f"the file '{file_hint}' defined it")]:
        for number, words in sorted(known.words.found(text)):
            rule = known.rules[number]
            forbidden = known.forbidden[number]
            if rule["role"] not in ("Board", "Decoration") and (forbidden is None or text not in forbidden):
                return _with(part, rule, f"'{words}', {what}")
    return next((_with(part, known.rules[number], clue) for number, clue in _connector_clues(part, known)), part)


def _with(part: Part, rule: Mapping[str, Any], clue: str) -> Part:
    return replace(part, role=rule["role"], driver=bool(rule.get("driver", False)), evidence=f"{clue}: {rule['why']}")


def _clues(part: Part, known: RoleRules, lists: PartNames) -> Iterator[tuple[int, str]]:
    """What speaks for a rule, by its number, the strongest first (see the head of `roles.toml`)."""
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
        if _same_tool(tool, part.tool) and fnmatchcase(family, pattern):
            yield number, f"family '{family}'"
    for number, words in sorted(known.words.found(family)):
        yield number, f"'{words}' in the family"
    for number, words in _words_in(part.description, known.words):
        yield number, f"'{words}' in the description"


def _words_in(text: str, phrases: Phrases) -> Iterator[tuple[int, str]]:
    """The phrases in a text: those of what it says first, then those of its remarks in brackets."""
    said = _without_remarks(text)
    yield from sorted(phrases.found(said))
    if said != text:
        yield from sorted(phrases.found(text))


def _without_remarks(text: str) -> str:
    """A text without what stands in brackets, unless that is all of it."""
    said = _REMARK.sub(" ", text)
    return said if said.strip() else text


def _connector_clues(part: Part, known: RoleRules) -> Iterator[tuple[int, str]]:
    own = {connector.name.strip().lower() for connector in part.connectors.values()}
    for wanted, number in known.connectors:
        if wanted <= own:
            yield number, f"connectors {', '.join(sorted(wanted))}"


def _of_tool(listed: Any, tool: str) -> Iterator[str]:
    """The texts of a list that hold for a tool: a plain list for all, a table by tool; for no tool all of them."""
    if isinstance(listed, Mapping):
        for name, texts in listed.items():
            if _same_tool(name, tool):
                yield from texts
    else:
        yield from listed


def _same_tool(named: str, tool: str) -> bool:
    return not named or not tool or named == tool


def _id_clue(part_id: str, tool: str, rule: Mapping[str, Any]) -> str:
    return next((f"the part's id has '{text}' in it" for text in _of_tool(rule.get("ids", ()), tool) if text in part_id), "")


def _family_clue(family: str, tool: str, rule: Mapping[str, Any]) -> str:
    found = any(fnmatchcase(family, pattern) for pattern in _of_tool(rule.get("families", ()), tool))
    return f"family '{family}'" if found else ""


def _by_tool(listed: Any) -> Iterator[tuple[str, str]]:
    """Tool (empty for all) and text of each entry of such a list."""
    if isinstance(listed, Mapping):
        yield from ((tool, text) for tool, texts in listed.items() for text in texts)
    else:
        yield from (("", text) for text in listed)


def _rules_in_order(project: Path | None) -> RoleRules:
    for folder in folders("platform_repo", project):
        path = folder / "parts" / "roles.toml"
        if path.is_file():
            return _rules(str(path), path.stat().st_mtime_ns)
    raise PlatformDataError("there is no parts/roles.toml in the platform repository", fix="install robosmi again")


def _curated_entries(project: Path | None) -> dict[tuple[str, str], Mapping[str, Any]]:
    """The entries of all folders by tool (empty for every tool) and id."""
    result: dict[tuple[str, str], Mapping[str, Any]] = {}
    for folder in folders("platform_repo", project):
        path = folder / "parts" / "curated.toml"
        if path.is_file():
            for key, entry in _curated(str(path), path.stat().st_mtime_ns).items():
                result.setdefault(key, entry)
    return result


@cache
def _rules(path: str, changed: int) -> RoleRules:
    rules = tuple(read_toml(path).get("rule", ()))
    for rule in rules:
        _check_role(rule, path)
    words = [(word, number) for number, rule in enumerate(rules) for word in rule.get("words", ())]
    return RoleRules(
        rules=rules,
        words=Phrases(words),
        tags=Phrases((word, number) for word, number in words if rules[number].get("tags", True)),
        forbidden=tuple(Phrases((word, 0) for word in rule["not"]) if rule.get("not") else None for rule in rules),
        weak=frozenset(number for number, rule in enumerate(rules) if rule.get("weak")),
        named=tuple((kind, number) for number, rule in enumerate(rules) for kind in rule.get("named", ())),
        families=tuple((tool, family, n) for n, rule in enumerate(rules) for tool, family in _by_tool(rule.get("families", ()))),
        connectors=tuple((frozenset(wanted), number) for number, r in enumerate(rules) for wanted in r.get("connectors", ())),
    )


@cache
def _curated(path: str, changed: int) -> dict[tuple[str, str], Mapping[str, Any]]:
    entries: Sequence[Mapping[str, Any]] = read_toml(path).get("part", ())
    for entry in entries:
        _check_role(entry, path)
    return {key: entry for entry in entries for key in _by_tool(entry.get("ids", ()))}


def _check_role(entry: Mapping[str, Any], path: str) -> None:
    if entry.get("role") not in ROLES or not entry.get("why"):
        raise PlatformDataError(
            f"an entry has the role '{entry.get('role', '')}' and the reason '{entry.get('why', '')}'",
            location=Location(path),
            fix=f"give it a why, and as role one of: {', '.join(ROLES)}",
        )
