"""What a part is to the software: a curated entry for its id, else the first rule that fits, each with its reason.

Reads `parts/curated.toml` and `parts/roles.toml` of the platform repository, the user's folders first. The built-in
catalogue was made with them; a drawing needs them only for parts that the catalogue does not have.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase
from functools import cache
from pathlib import Path
from typing import Any

from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError
from robosmi.resources import folders
from robosmi.transformations.knowledge.part import ROLES, Part, PartConnector
from robosmi.transformations.knowledge.part_names import Names, Phrases, names, read_toml

_CHIP_NAMES = ("chip label", "part number", "chip", "part #", "mpn")
"""Properties of a drawn part that name the device behind a general one."""


@dataclass(frozen=True, slots=True)
class RoleRules:
    """The rules of `roles.toml` in their order, ready for looking up."""

    rules: tuple[Mapping[str, Any], ...]
    words: Phrases
    tags: Phrases
    forbidden: tuple[Phrases | None, ...]
    families: tuple[tuple[str, int], ...]
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
    entry = _curated_entries(project).get(part.id)
    if entry is not None:
        return replace(part, role=entry["role"], driver=bool(entry.get("driver", False)), evidence=f"curated: {entry['why']}")
    known = _rules_in_order(project)
    for number, clue in _clues(part, known):
        forbidden = known.forbidden[number]
        if forbidden is None or f"{part.title} / {part.family}" not in forbidden:
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
    texts = [value for key, value in properties.items() if key.lower() in _CHIP_NAMES and value]
    clues = [(text, f"called '{text}' in the drawing") for text in texts]
    for text, what in [*clues, (title, f"labelled '{title}'"), (file_hint, f"the file '{file_hint}' defined it")]:
        for number, words in sorted(known.words.found(text)):
            rule = known.rules[number]
            forbidden = known.forbidden[number]
            if rule["role"] not in ("Board", "Decoration") and (forbidden is None or text not in forbidden):
                return _with(part, rule, f"'{words}', {what}")
    return next((_with(part, known.rules[number], clue) for number, clue in _connector_clues(part, known)), part)


def generated_part(part_id: str, known: Names | None = None) -> Part | None:
    """The part that a generated id stands for (pin headers, generic ICs, stripboards), or None.

    The number of connectors is the first whole number between underscores (Fritzing's `TextUtils::getPinsAndSpacing`);
    boards of holes have none of their own, those that a drawing uses are told by the drawing.
    """
    for shape in (known or names()).generated:
        holes = any(text in part_id for text in shape.get("contains", ()))
        if not holes and not part_id.startswith(tuple(shape.get("prefixes", ()))):
            continue
        count = 0 if holes else next((int(piece) for piece in part_id.split("_") if piece.isdecimal() and len(piece) < 4), 0)
        if count or holes:
            connectors = {f"connector{i}": PartConnector(f"connector{i}", f"pin {i + 1}", "unknown") for i in range(count)}
            return Part(part_id, shape["title"], shape["family"], connectors=connectors, source="the part's generated id")
    return None


def _with(part: Part, rule: Mapping[str, Any], clue: str) -> Part:
    return replace(part, role=rule["role"], driver=bool(rule.get("driver", False)), evidence=f"{clue}: {rule['why']}")


def _clues(part: Part, known: RoleRules) -> Iterator[tuple[int, str]]:
    """What speaks for a rule, by its number, the strongest first (see the head of `roles.toml`)."""
    part_id, family = part.id[:400].lower(), part.family[:200].strip().lower()
    for number, rule in enumerate(known.rules):
        if rule.get("first") and (clue := _id_clue(part_id, rule) or _family_clue(family, rule)):
            yield number, clue
    for number, words in sorted(known.words.found(part.title)):
        yield number, f"'{words}' in the title"
    for pattern, number in known.families:
        if fnmatchcase(family, pattern):
            yield number, f"family '{family}'"
    for number, words in sorted(known.words.found(family)):
        yield number, f"'{words}' in the family"
    for number, words in sorted(known.tags.found(" / ".join(part.tags))):
        yield number, f"'{words}' in the tags"
    yield from _connector_clues(part, known)
    for number, rule in enumerate(known.rules):
        if clue := _id_clue(part_id, rule):
            yield number, clue


def _connector_clues(part: Part, known: RoleRules) -> Iterator[tuple[int, str]]:
    own = {connector.name.strip().lower() for connector in part.connectors.values()}
    for wanted, number in known.connectors:
        if wanted <= own:
            yield number, f"connectors {', '.join(sorted(wanted))}"


def _id_clue(part_id: str, rule: Mapping[str, Any]) -> str:
    return next((f"the part's id has '{text}' in it" for text in rule.get("ids", ()) if text in part_id), "")


def _family_clue(family: str, rule: Mapping[str, Any]) -> str:
    return f"family '{family}'" if any(fnmatchcase(family, pattern) for pattern in rule.get("families", ())) else ""


def _rules_in_order(project: Path | None) -> RoleRules:
    for folder in folders("platform_repo", project):
        path = folder / "parts" / "roles.toml"
        if path.is_file():
            return _rules(str(path), path.stat().st_mtime_ns)
    raise PlatformDataError("there is no parts/roles.toml in the platform repository", fix="install robosmi again")


def _curated_entries(project: Path | None) -> dict[str, Mapping[str, Any]]:
    result: dict[str, Mapping[str, Any]] = {}
    for folder in folders("platform_repo", project):
        path = folder / "parts" / "curated.toml"
        if path.is_file():
            for part_id, entry in _curated(str(path), path.stat().st_mtime_ns).items():
                result.setdefault(part_id, entry)
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
        families=tuple((family, number) for number, rule in enumerate(rules) for family in rule.get("families", ())),
        connectors=tuple((frozenset(wanted), number) for number, r in enumerate(rules) for wanted in r.get("connectors", ())),
    )


@cache
def _curated(path: str, changed: int) -> dict[str, Mapping[str, Any]]:
    entries: Sequence[Mapping[str, Any]] = read_toml(path).get("part", ())
    for entry in entries:
        _check_role(entry, path)
    return {part_id: entry for entry in entries for part_id in entry.get("ids", ())}


def _check_role(entry: Mapping[str, Any], path: str) -> None:
    if entry.get("role") not in ROLES or not entry.get("why"):
        raise PlatformDataError(
            f"an entry has the role '{entry.get('role', '')}' and the reason '{entry.get('why', '')}'",
            location=Location(path),
            fix=f"give it a why, and as role one of: {', '.join(ROLES)}",
        )
