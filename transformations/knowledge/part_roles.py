"""Determines a part's role for the software: by a curated entry for its id, else by the first matching rule, with the reason.

The entries and rules are those of `role_rules`, the user's files first. The built-in catalogue was made with them; a drawing
needs them only for parts that the catalogue lacks.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path

from msgspec.structs import replace

from robosmi.transformations.knowledge.part import Part
from robosmi.transformations.knowledge.part_names import PartNames, Phrases, names
from robosmi.transformations.knowledge.role_rules import ByTool, RoleRule, RoleRules, curated_entries, role_rules
from robosmi.transformations.knowledge.wildcards import fits

_REMARK = re.compile(r"\([^()]*\)|\[[^\[\]]*\]")
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
    about = f"{_without_remarks(part.title)} / {part.family}"
    for known in role_rules(project):
        for number, clue in _clues(part, known, names(project)):
            forbidden = known.forbidden[number]
            if forbidden is None or about not in forbidden:
                return _with(part, known.rules[number], clue)
    return part


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
