"""The catalogue of parts: looks up what is known about a drawing's part by its id, one part at a time.

It searches the folders `parts` of the platform repository, the user's first: hand-written entries (`*.toml`, explained in their
README) precede imported files (`*.sqlite`, see `parts_store`). Only requested entries are parsed. Definitions embedded in a
drawing are read by its own reader, into the same type `Part`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi import inputs
from robosmi.base.data_text import Json, as_list, as_table, as_text, as_texts, line_of_key
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, did_you_mean
from robosmi.resources import folders
from robosmi.transformations.knowledge.part import KINDS, ROLES, Part, PartConnector
from robosmi.transformations.knowledge.part_names import connector_kind, names, parse_toml

if TYPE_CHECKING:
    from robosmi.transformations.knowledge.parts_store import PartsFile

_HEAD = re.compile(r"[ \t]*\[\[[ \t]*part[ \t]*\]\][ \t]*(#.*)?")
_NO_PARTS = (
    "names.toml",
    "roles.toml",
    "curated.toml",
    "electrical.toml",
    "wokwi_types.toml",
    "port_roles.toml",
    "motor_drivers.toml",
    "drawn_symbols.toml",
)
"""Files of the folder that other modules read."""
_PART_KEYS = (
    "ids", "title", "family", "tags", "role", "evidence", "driver", "connectors", "buses", "properties", "description", "shapes",
)  # fmt: skip
_KEYS = "see parts/README.md for the keys"


class Catalogue:
    """The entries of the catalogue as it is now; opening one looks at the files once.

    Args:
        project: the project folder; the current folder if None.
        tool: the drawing tool in lower case, whose ids are meant; empty for those of all tools.
    """

    def __init__(self, project: Path | None = None, tool: str = "") -> None:
        self.tool = tool
        self._names = names(project)
        self._files = [(path, path.stat().st_mtime_ns) for path in _files(project)]

    def find(self, part_id: str) -> Part | None:
        """The entry for a part id of the drawing tool's catalogue, or None.

        Raises:
            PlatformDataError: the entry or its file is damaged.
        """
        quoted = f'"{part_id}"'
        for path, changed in self._files:
            if path.suffix == ".sqlite":
                opened = _opened(path, changed)
                if self.tool in ("", opened.tool) and (part := opened.part(part_id, self._names)) is not None:
                    return part
                continue
            for line, chunk in _chunks(path, changed):
                if quoted in chunk and (part := _entry(str(path), line, chunk, part_id, self.tool)) is not None:
                    return part
        return None

    def variants(self, part_id: str) -> tuple[str, ...]:
        """The suffixes, after a blank, in the ids of a part's variants (`pins=i2c`), in search order."""
        found: dict[str, None] = {}
        begin = f'"{part_id} '
        for path, changed in self._files:
            for _, chunk in _chunks(path, changed) if path.suffix != ".sqlite" else ():
                for piece in chunk.split(begin)[1:]:
                    found[piece.partition('"')[0]] = None
        return tuple(found)

    def words(self, part_id: str) -> dict[str, int]:
        """The number of occurrences of each word (lower case) in a part's description; empty if unknown."""
        for path, changed in self._files:
            if path.suffix == ".sqlite" and (words := _opened(path, changed).words(part_id)):
                return words
        return {}

    def ids(self) -> Iterator[tuple[str, Path]]:
        """Every id with the file that has it, in search order; parses all hand-written entries."""
        for path, changed in self._files:
            if path.suffix == ".sqlite":
                yield from ((part_id, path) for part_id in _opened(path, changed).ids())
                continue
            for line, chunk in _chunks(path, changed):
                yield from ((part_id, path) for part_id in _ids(_table(str(path), line, chunk), ""))

    def titles(self) -> dict[str, str]:
        """The titles of imported parts, each with its role."""
        stores = [_opened(path, changed) for path, changed in self._files if path.suffix == ".sqlite"]
        return {title: role for store in stores for title, role in store.titles() if title}


def _files(project: Path | None) -> Iterator[Path]:
    for folder in folders("platform_repo", project):
        parts = folder / "parts"
        yield from sorted(path for path in parts.glob("*.toml") if path.name not in _NO_PARTS)
        yield from sorted(parts.glob("*.sqlite"))


@cache
def _opened(path: Path, changed: int) -> PartsFile:  # `changed` keys the cache: a file that is imported anew is opened anew
    from robosmi.transformations.knowledge.parts_store import PartsFile

    return PartsFile(path)


@cache
def _chunks(path: Path, changed: int) -> tuple[tuple[int, str], ...]:
    """The file cut before each `[[part]]`: line number and text, which is TOML by itself."""
    try:
        text = inputs.read_text(path, inputs.DATA)
    except (OSError, UnicodeDecodeError) as error:
        place = Location(str(path))
        raise PlatformDataError(f"cannot be read: {error}", location=place, fix="correct or remove the file") from error
    found: list[tuple[int, list[str]]] = []
    for number, line in enumerate(text.splitlines(), 1):
        if _HEAD.fullmatch(line):
            found.append((number, []))
        if found:
            found[-1][1].append(line)
        elif line.strip() and not line.lstrip().startswith("#"):
            raise _no_part(path, number, line.strip())
    return tuple((number, "\n".join(lines)) for number, lines in found)


def _no_part(path: Path, number: int, line: str) -> PlatformDataError:
    """The error for a file with unknown content at its beginning, such as a misspelt table."""
    other = did_you_mean(path.name.lower(), _NO_PARTS)
    return PlatformDataError(
        f"'{line[:60]}' is outside every [[part]]{other and ', by its name' + other}", location=Location(str(path), number),
        fix="write [[part]] before each part; files of other kinds are called " + ", ".join(_NO_PARTS),
    )  # fmt: skip


@cache
def _table(path: str, line: int, chunk: str) -> dict[str, Json]:
    parsed = parse_toml(chunk, path, line)
    table = as_table(as_list(parsed["part"])[0])
    ids = table.get("ids")
    lists = [*ids.values()] if isinstance(ids, dict) else [ids]
    if not all(isinstance(texts, list) and texts for texts in lists) or not lists:
        raise PlatformDataError("a part has no ids", location=Location(path, line), fix='give it ids = ["..."]')
    for key, known in [(key, ("part",)) for key in parsed] + [(key, _PART_KEYS) for key in table]:
        if key not in known:
            place = Location(path, line + (line_of_key(chunk, key) or 1) - 1)
            raise PlatformDataError(
                f"'{key}' is not a key of a part{did_you_mean(key.lower(), known)}", location=place, fix=_KEYS
            )
    if (role := table.get("role", "Unknown")) not in ROLES:
        cause = f"part '{as_list(lists[0])[0]}' has the unknown role '{role}'"
        raise PlatformDataError(cause, location=Location(path, line), fix=f"use one of: {', '.join(ROLES)}")
    return table


def _ids(table: Mapping[str, Json], tool: str) -> list[str]:
    """The ids of an entry that are meant: a list holds for every tool, a table has a list for each."""
    ids = table["ids"]
    if isinstance(ids, dict):
        return [text for name, texts in ids.items() if tool in ("", name) for text in as_texts(texts)]
    return as_texts(ids)


_COUNTED = re.compile(r"\.[0-9]+$")


def _connector(entry: Json) -> PartConnector:
    """A connector from an entry: a table, or its name alone, which implies its kind."""
    if isinstance(entry, str):
        return PartConnector(entry, entry, connector_kind(_COUNTED.sub("", entry), names()))
    said = as_table(entry)
    return PartConnector(as_text(said["id"]), as_text(said.get("name", "")), as_text(said.get("kind", "unknown")))


@cache
def _entry(path: str, line: int, chunk: str, part_id: str, tool: str) -> Part | None:
    table = _table(path, line, chunk)
    if part_id not in _ids(table, tool):
        return None

    def text(key: str, default: str = "") -> str:
        return as_text(table.get(key, default))

    try:
        listed = [_connector(c) for c in as_list(table.get("connectors", ()))]
        connectors = {c.id: c for c in listed}
        buses = {name: tuple(as_texts(members)) for name, members in as_table(table.get("buses", {})).items()}
        shapes = tuple(re.compile(shape).pattern for shape in as_texts(table.get("shapes", ())))
        title, family, role, description = text("title"), text("family"), text("role", "Unknown"), text("description")
        tags, evidence = tuple(as_texts(table.get("tags", ()))), text("evidence", "given in the entry")
        properties = {str(k): str(v) for k, v in as_table(table.get("properties", {})).items()}
    except (KeyError, TypeError, ValueError, AttributeError, re.error) as error:
        raise PlatformDataError(f"part '{part_id}' is damaged: {error!r}", location=Location(path, line), fix=_KEYS) from error
    faults = [f"connector '{c.id}' has the unknown kind '{c.kind}'" for c in connectors.values() if c.kind not in KINDS]
    faults += [
        f"bus '{bus}' has a connector that the part does not have"
        for bus, members in buses.items()
        if not connectors.keys() >= {*members}
    ]
    if faults:
        raise PlatformDataError(f"part '{part_id}': {faults[0]}", location=Location(path, line), fix=_KEYS)
    return Part(
        id=part_id,
        title=title,
        family=family,
        tags=tags,
        role=role,
        evidence=f"catalogue of parts: {evidence}" if "role" in table else "",
        driver=bool(table.get("driver", False)),
        connectors=connectors,
        buses=buses,
        properties=properties,
        source=f"parts/{Path(path).name}",
        tool=tool,
        description=description,
        shapes=shapes,
    )
