"""The file format for imported parts, with one look-up for each part of a drawing.

A row is a part: identity, title, family, tags, role with reason, and two compressed fields: connectors with buses and
properties, and the word counts of the description. It contains only facts, no drawings and no prose. Nothing is decided here.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any
from weakref import finalize

from robosmi import inputs
from robosmi.base.data_text import Json, as_list, as_table, as_text, as_texts, as_whole, json_of, json_written
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError
from robosmi.transformations.knowledge.part import Part, PartConnector
from robosmi.transformations.knowledge.part_names import PartNames, connector_kind

FORMAT = 1
"""Number of the format: `PRAGMA user_version` of the file."""

APPLICATION = 0x52535043
"""What marks such a file: `PRAGMA application_id`, "RSPC"."""

FIRST_TOOL = "fritzing"
"""The tool of a file that names none: the first one whose parts could be imported."""

_SCHEMA = """
CREATE TABLE part(id TEXT PRIMARY KEY, title TEXT, family TEXT, tags TEXT, role TEXT NOT NULL, driver INTEGER NOT NULL,
  evidence TEXT, source TEXT, facts BLOB NOT NULL, words BLOB NOT NULL) WITHOUT ROWID;
"""
_COLUMNS = "id, title, family, tags, role, driver, evidence, source, facts"
_FIX = "import the parts again, or install robosmi again"
_COMMON = (  # what many pieces begin with: it makes short ones half as long (zlib's preset dictionary)
    b'"],["connector6","connector5","connector4","P$1","wiper","Pin 2","Pin 1","anode","cathode","GND","VCC","5V","pin 1"'
    b'"connector3","connector2","connector1","bus1":["{"package":"THT","variant":"variant 1","part number":"","chip":"",'
    b'"layer":"","type":"","Pin Spacing":"0.1in (2.54mm)"},{},{"[["connector0","'
)


class PartsFile:
    """A file of parts, open for reading. The file must not change while it is open.

    Args:
        path: the file.

    Raises:
        PlatformDataError: it is not there, damaged, or of another format.
    """

    def __init__(self, path: Path) -> None:
        import sqlite3  # 5 ms, wanted only when there is such a file

        self.path = path
        self._parts: dict[str, tuple[PartNames, Part | None]] = {}
        try:  # immutable: no locks, no look for a journal
            inputs.check_ordinary(path)  # SQLite would take a named pipe or a device
            self._db = sqlite3.connect(f"{path.absolute().as_uri()}?immutable=1", uri=True, check_same_thread=False)
            finalize(self, self._db.close)
        except (OSError, sqlite3.Error) as error:
            raise self._damaged((error.strerror if isinstance(error, OSError) else None) or str(error)) from error
        if self._all("PRAGMA application_id") != [(APPLICATION,)] or self._all("PRAGMA user_version") != [(FORMAT,)]:
            self.close()
            raise self._damaged(f"it is not a file of parts of format {FORMAT}")
        named = self._all("SELECT name FROM sqlite_master WHERE name = 'tool'")
        self.tool = str(self._all("SELECT name FROM tool")[0][0]) if named else FIRST_TOOL

    def close(self) -> None:
        """Close the file."""
        self._db.close()

    def part(self, part_id: str, known: PartNames) -> Part | None:
        """The part of that identity, or None.

        Args:
            part_id: its identity in the drawing tool's catalogue.
            known: lists of names, which tell what its connectors carry.

        Raises:
            PlatformDataError: the file is damaged.
        """
        kept = self._parts.get(part_id)
        if kept is None or kept[0] is not known:
            rows = self._all(f"SELECT {_COLUMNS} FROM part WHERE id = ?", part_id)
            kept = self._parts[part_id] = (known, self._part(rows[0], known) if rows else None)
        return kept[1]

    def words(self, part_id: str) -> dict[str, int]:
        """The number of occurrences of each word in a part's description; empty for an unknown part."""
        rows = self._all("SELECT words FROM part WHERE id = ?", part_id)
        return {word: as_whole(count) for word, count in as_table(self._unpacked(rows[0][0])).items()} if rows else {}

    def ids(self) -> list[str]:
        """The identities of all parts, sorted."""
        return [row[0] for row in self._all("SELECT id FROM part ORDER BY id")]

    def titles(self) -> list[tuple[str, str]]:
        """Title and role of the parts, each title once, sorted."""
        return [
            (str(title), str(role)) for title, role in self._all("SELECT title, role FROM part GROUP BY title ORDER BY title")
        ]

    def _part(self, row: tuple[Any, ...], known: PartNames) -> Part:
        part_id, title, family, tags, role, driver, evidence, source, facts = row
        try:
            listed, buses, said = as_list(self._unpacked(facts))
            names = [as_texts(pair) for pair in as_list(listed)]
            connectors = {c: PartConnector(c, name, connector_kind(name, known)) for c, name in names}
            joined = {bus: tuple(as_texts(members)) for bus, members in as_table(buses).items()}
            properties = {name: as_text(value) for name, value in as_table(said).items()}
        except (ValueError, TypeError, AttributeError) as error:
            raise self._damaged(f"the entry of '{part_id}' is damaged: {error}") from error
        return Part(
            id=part_id,
            title=title,
            family=family,
            tags=tuple(tags.split("\n")) if tags else (),
            role=role,
            evidence=evidence,
            driver=bool(driver),
            connectors=connectors,
            buses=joined,
            properties=properties,
            source=source,
            tool=self.tool,
        )

    def _unpacked(self, piece: bytes) -> Json:
        try:
            return json_of(zlib.decompressobj(zdict=_COMMON).decompress(piece, 16 * 1024 * 1024))
        except (zlib.error, ValueError, TypeError) as error:
            raise self._damaged(str(error)) from error

    def _all(self, sql: str, *values: object) -> list[tuple[Any, ...]]:
        import sqlite3

        try:
            return self._db.execute(sql, values).fetchall()
        except (sqlite3.Error, UnicodeEncodeError) as error:
            raise self._damaged(str(error)) from error

    def _damaged(self, cause: str) -> PlatformDataError:
        return PlatformDataError(f"the file of parts cannot be used: {cause}", location=Location(str(self.path)), fix=_FIX)


def write_parts(target: Path, parts: Iterable[tuple[Part, Mapping[str, int]]], tool: str = FIRST_TOOL) -> None:
    """Write a file of parts; the same parts give the same bytes. A file that is there is replaced when all is done.

    Args:
        target: the file. Its folder must exist.
        parts: each part with the word counts of its description, in any order; identities are unique.
        tool: the drawing tool in lower case, whose parts they are.
    """
    schema = _SCHEMA if tool == FIRST_TOOL else _SCHEMA + "CREATE TABLE tool(name TEXT);"
    from robosmi.files.sqlite_files import writing  # a run mostly reads the store

    with writing(target, schema, APPLICATION, FORMAT) as db:
        if tool != FIRST_TOOL:
            db.execute("INSERT INTO tool VALUES (?)", (tool,))
        rows = (_row(part, words) for part, words in sorted(parts, key=lambda one: one[0].id))
        db.executemany(f"INSERT INTO part VALUES ({', '.join('?' * 10)})", rows)


def _row(part: Part, words: Mapping[str, int]) -> tuple[object, ...]:
    names = [[c.id, c.name] for c in part.connectors.values()]
    facts = _packed([names, {bus: list(members) for bus, members in part.buses.items()}, dict(part.properties)])
    counts = _packed(dict(sorted(words.items())))
    tags = "\n".join(part.tags)
    return part.id, part.title, part.family, tags, part.role, part.driver, part.evidence, part.source, facts, counts


def _packed(value: Json) -> bytes:
    packer = zlib.compressobj(9, zdict=_COMMON)
    text = json_written(value, ensure_ascii=False, separators=(",", ":"))
    return packer.compress(text.encode()) + packer.flush()
