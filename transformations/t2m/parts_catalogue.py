"""The catalogue of parts: what is known of a part of a drawing by its id, and what its family says when the id is unknown.

Reads `parts/*.toml` of the platform repository (its README has the keys), the user's folders first. Only the entries that
are asked for are parsed: reading all of a large catalogue as TOML would take longer than the rest of the work. What a
drawing itself carries (embedded definitions) is read by its own reader, which gives it the same form, `Part`. Nothing here
knows how a part is wired.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import Any

from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError
from robosmi.resources import folders

ROLES = ("Unknown", "Board", "Input", "Output", "Both", "Passive", "Power", "Decoration")
"""The roles, as the hardware metamodel names them."""

KINDS = ("unknown", "signal", "supply", "ground")
"""What a connector carries, as the hardware metamodel names it."""

_HEAD = "[[part]]"
_RULES = "families.toml"
_KEYS = "see parts/README.md for the keys"
_WORDS = re.compile(r"[^\w+.-]+")


@dataclass(frozen=True, slots=True)
class PartConnector:
    """A connector of a part: identity, name, what it carries (one of `KINDS`)."""

    id: str
    name: str = ""
    kind: str = "unknown"


@dataclass(frozen=True, slots=True)
class Part:
    """What is known of a part, from the catalogue or from a definition in the drawing.

    Attributes:
        id: identity in the drawing tool's catalogue.
        role: one of `ROLES`; `evidence` says why.
        driver: whether it drives a load of its own.
        connectors: by identity, in the part's order.
        buses: connectors that are joined inside the part, by the bus's identity.
        source: where the facts come from, for messages.
    """

    id: str
    title: str = ""
    family: str = ""
    tags: tuple[str, ...] = ()
    role: str = "Unknown"
    evidence: str = ""
    driver: bool = False
    connectors: Mapping[str, PartConnector] = field(default_factory=dict)
    buses: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    properties: Mapping[str, str] = field(default_factory=dict)
    source: str = ""


@dataclass(frozen=True, slots=True)
class Rules:
    """The content of `families.toml`, sets in lower case."""

    names: Mapping[str, frozenset[str]]
    bus_only: tuple[str, ...]
    rules: tuple[Mapping[str, Any], ...]
    generated: tuple[Mapping[str, Any], ...]


class Catalogue:
    """The entries of the catalogue as it is now; opening one looks at the files once.

    Args:
        project: the project folder; the current folder if None.
    """

    def __init__(self, project: Path | None = None) -> None:
        self._files = [(str(path), _chunks(str(path), path.stat().st_mtime_ns)) for path in _files(project)]

    def find(self, part_id: str) -> Part | None:
        """The entry for a part id of the drawing tool's catalogue, or None.

        Raises:
            PlatformDataError: the entry is damaged.
        """
        quoted = f'"{part_id}"'
        for path, chunks in self._files:
            for line, chunk in chunks:
                if quoted in chunk and (part := _entry(path, line, chunk, part_id)) is not None:
                    return part
        return None

    def ids(self) -> Iterator[tuple[str, Path]]:
        """Every id with the file that has it, in search order; parses all entries."""
        for path, chunks in self._files:
            for line, chunk in chunks:
                yield from ((part_id, Path(path)) for part_id in _table(path, line, chunk)["ids"])


def rules(project: Path | None = None) -> Rules:
    """The rules for families and names; the first file in search order counts as a whole.

    Raises:
        PlatformDataError: the file is damaged or missing.
    """
    for folder in folders("platform_repo", project):
        path = folder / "parts" / _RULES
        if path.is_file():
            return _rules(str(path), path.stat().st_mtime_ns)
    raise PlatformDataError(f"there is no parts/{_RULES} in the platform repository", fix="install robosmi again")


def connector_kind(name: str, known: Rules) -> str:
    """What a connector carries by its name: supply, ground, unknown for a name that says nothing, else signal."""
    word = name.strip().lower()
    for kind in ("supply", "ground"):
        if word in known.names[kind]:
            return kind
    return "unknown" if word in known.names["idle"] else "signal"


def name_direction(name: str, known: Rules) -> str | None:
    """The direction that a connector's name tells (bus, write, read), or None."""
    word = name.strip().lower()
    return next((way for way in ("bus", "write", "read") if word in known.names[way]), None)


def conducts_by_bus_only(family: str, known: Rules) -> bool:
    """Whether parts of the family join connectors only where a bus says so (breadboards, headers, terminals)."""
    words = _padded(family)
    return any(f" {phrase} " in words or f" {phrase}s " in words for phrase in known.bus_only)


def classify(part: Part, known: Rules) -> Part:
    """The part with role, driver flag and evidence by the first rule that fits; unchanged if it has a role already."""
    if part.role != "Unknown":
        return part
    family = part.family.strip().lower()
    words = _padded(" ".join((part.title, family, *part.tags)))
    part_id = part.id.lower()
    for rule in known.rules:
        clue = _clue(rule, part_id, family, words)
        if clue:
            evidence = f"{clue}: {rule.get('reason', '')}"
            return replace(part, role=rule["role"], driver=bool(rule.get("driver", False)), evidence=evidence)
    return part


def generated_part(part_id: str, known: Rules) -> Part | None:
    """The part that a generated id stands for (pin headers, generic ICs, stripboards), or None.

    The number of connectors is the first whole number between underscores (Fritzing's `TextUtils::getPinsAndSpacing`);
    boards of holes have none of their own, those that a drawing uses are told by the drawing.
    """
    for shape in known.generated:
        holes = any(text in part_id for text in shape.get("contains", ()))
        if not holes and not part_id.startswith(tuple(shape.get("prefixes", ()))):
            continue
        count = 0 if holes else next((int(piece) for piece in part_id.split("_") if piece.isdigit() and len(piece) < 4), 0)
        if count or holes:
            connectors = {f"connector{i}": PartConnector(f"connector{i}", f"pin {i + 1}") for i in range(count)}
            return Part(part_id, shape["title"], shape["family"], connectors=connectors, source="the part's generated id")
    return None


def _clue(rule: Mapping[str, Any], part_id: str, family: str, words: str) -> str:
    for text in rule.get("ids", ()):
        if text in part_id:
            return f"the part's id has '{text}' in it"
    for text in rule.get("words", ()):
        if f" {text} " in words and not any(f" {no} " in words for no in rule.get("not", ())):
            return f"'{text}' in title, family or tags"
    for text in rule.get("families", ()):
        if family == text or (text[-1] == "*" and family.startswith(text[:-1])):
            return f"family '{family}'"
    return ""


def _padded(text: str) -> str:
    """The words of a text with single blanks around each, for searching whole words."""
    return " " + " ".join(_WORDS.split(text.lower())) + " "


def _files(project: Path | None) -> Iterator[Path]:
    for folder in folders("platform_repo", project):
        yield from sorted(path for path in (folder / "parts").glob("*.toml") if path.name != _RULES)


@cache
def _chunks(path: str, changed: int) -> tuple[tuple[int, str], ...]:
    """The file cut before each `[[part]]`: line number and text, which is TOML by itself. `changed` keys the cache."""
    found: list[tuple[int, list[str]]] = []
    for number, line in enumerate(_text(path).splitlines(), 1):
        if line.rstrip() == _HEAD:
            found.append((number, []))
        if found:
            found[-1][1].append(line)
    return tuple((number, "\n".join(lines)) for number, lines in found)


@cache
def _table(path: str, line: int, chunk: str) -> dict[str, Any]:
    table: dict[str, Any] = _toml(chunk, path, line)["part"][0]
    if not isinstance(table.get("ids"), list) or not table["ids"]:
        raise PlatformDataError("a part has no ids", location=Location(path, line), fix='give it ids = ["..."]')
    if table.get("role", "Unknown") not in ROLES:
        raise _unknown_role(f"part '{table['ids'][0]}'", table["role"], Location(path, line))
    return table


@cache
def _entry(path: str, line: int, chunk: str, part_id: str) -> Part | None:
    table = _table(path, line, chunk)
    if part_id not in table["ids"]:
        return None
    try:
        listed = [PartConnector(c["id"], c.get("name", ""), c.get("kind", "unknown")) for c in table.get("connectors", ())]
        connectors = {c.id: c for c in listed}
        buses = {name: tuple(members) for name, members in table.get("buses", {}).items()}
        for grid in table.get("grid", ()):
            _expand(grid, connectors, buses)
    except (KeyError, TypeError, ValueError) as error:
        raise PlatformDataError(f"part '{part_id}' is damaged: {error!r}", location=Location(path, line), fix=_KEYS) from error
    faults = [f"connector '{c.id}' has the unknown kind '{c.kind}'" for c in connectors.values() if c.kind not in KINDS]
    faults += [
        f"bus '{bus}' has a connector that the part has not"
        for bus, members in buses.items()
        if not connectors.keys() >= {*members}
    ]
    if (size := table.get("size", len(connectors))) != len(connectors):
        faults.append(f"it has {len(connectors)} connectors, not {size}")
    if faults:
        raise PlatformDataError(f"part '{part_id}': {faults[0]}", location=Location(path, line), fix=_KEYS)
    return Part(
        id=part_id,
        title=table.get("title", ""),
        family=table.get("family", ""),
        tags=tuple(table.get("tags", ())),
        role=table.get("role", "Unknown"),
        evidence=f"catalogue of parts: {table.get('evidence', 'so says the entry')}",
        driver=bool(table.get("driver", False)),
        connectors=connectors,
        buses=buses,
        properties={str(k): str(v) for k, v in table.get("properties", {}).items()},
        source=f"parts/{Path(path).name}",
    )


def _unknown_role(what: str, role: object, place: Location) -> PlatformDataError:
    return PlatformDataError(f"{what} has the unknown role '{role}'", location=place, fix=f"use one of: {', '.join(ROLES)}")


def _expand(grid: Mapping[str, Any], connectors: dict[str, PartConnector], buses: dict[str, tuple[str, ...]]) -> None:
    joined: dict[str, list[str]] = {}
    for index, column in enumerate(_numbers(grid["columns"]), grid.get("first", 0)):
        for row in grid["rows"]:
            name = grid["connector"].format(column=column, row=row, index=index)
            connectors[name] = PartConnector(name, name)
            joined.setdefault(grid["bus"].format(column=column, row=row, index=index), []).append(name)
    buses.update((name, tuple(members)) for name, members in joined.items())


def _numbers(ranges: str) -> Iterator[int]:
    for piece in ranges.split(","):
        first, _, last = piece.partition("-")
        yield from range(int(first), int(last or first) + 1)


@cache
def _rules(path: str, changed: int) -> Rules:
    table = _toml(_text(path), path, 1)
    names = {key: frozenset(table.get("names", {}).get(key, ())) for key in ("supply", "ground", "idle", "bus", "write", "read")}
    for rule in table.get("rule", ()):
        if rule.get("role") not in ROLES:
            raise _unknown_role("a rule", rule.get("role"), Location(path))
    bus_only = tuple(table.get("walk", {}).get("bus_only", ()))
    return Rules(names, bus_only, tuple(table.get("rule", ())), tuple(table.get("generated", ())))


def _text(path: str) -> str:
    try:
        return Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise PlatformDataError(f"cannot be read: {error}", location=Location(path), fix="mend or remove the file") from error


def _toml(text: str, path: str, first_line: int) -> dict[str, Any]:
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        at = re.search(r"at line (\d+), column (\d+)", str(error))
        line, column = (int(at[1]) + first_line - 1, int(at[2])) if at else (first_line, None)
        cause = str(error).partition(" (at ")[0]
        place = Location(path, line, column)
        raise PlatformDataError(f"not valid TOML: {cause}", location=place, fix="mend the entry") from error
