"""What is known of one library before it is in an index: declared metadata, its headers, and the words of both.

Readers (a file of facts, folders of installed libraries) make such values. Only facts are kept: names, counts of words,
identifiers' words, includes, declarations; never a text. `write_index` writes them into the file that `index` describes and
reads; its bytes depend on the content alone. Which words a part asks for is in `part_words`.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec import Struct

from robosmi.errors import PlatformDataError, UsageError
from robosmi.files.sqlite_files import writing
from robosmi.recommend.index import APPLICATION, FIELDS, FORMAT, INTERFACES, is_named_like
from robosmi.recommend.library_api import HeaderApi, packed
from robosmi.recommend.tokens import words

if TYPE_CHECKING:
    import sqlite3

_INCLUDED = {
    "wire.h": "i2c",
    "twi.h": "i2c",
    "i2c.h": "i2c",
    "spi.h": "spi",
    "onewire.h": "onewire",
    "softwareserial.h": "serial",
}

_SCHEMA = f"""
CREATE TABLE library(id INTEGER PRIMARY KEY, name TEXT NOT NULL, version TEXT, author TEXT, category TEXT, architectures TEXT,
  depends TEXT, url TEXT, license TEXT, origin TEXT, main TEXT NOT NULL, copies INTEGER, in_registry INTEGER, installed INTEGER);
CREATE INDEX library_name ON library(name COLLATE NOCASE);
CREATE TABLE header(id INTEGER PRIMARY KEY, library INTEGER NOT NULL, file TEXT NOT NULL, main INTEGER NOT NULL);
CREATE INDEX header_file ON header(file COLLATE NOCASE);
CREATE TABLE term(term TEXT PRIMARY KEY, wide INTEGER NOT NULL, gaps BLOB NOT NULL, counts BLOB NOT NULL) WITHOUT ROWID;
CREATE TABLE ident(term TEXT PRIMARY KEY, wide INTEGER NOT NULL, gaps BLOB NOT NULL, counts BLOB NOT NULL) WITHOUT ROWID;
CREATE TABLE fact(term TEXT PRIMARY KEY, wide INTEGER NOT NULL, gaps BLOB NOT NULL, {", ".join(FIELDS)}) WITHOUT ROWID;
CREATE TABLE run(name TEXT PRIMARY KEY, numbers BLOB NOT NULL) WITHOUT ROWID;
CREATE TABLE api(library INTEGER PRIMARY KEY, headers BLOB NOT NULL);
CREATE TABLE registers(library INTEGER PRIMARY KEY, names TEXT NOT NULL);
"""


class HeaderRecord(Struct, frozen=True):
    """One public header of a library.

    Attributes:
        file: its bare name.
        main: a program includes it.
        counts: word (lower case) -> how often in the whole text, comments and all.
        identifiers: the same for the words of identifiers.
        includes: bare names of what it includes itself.
    """

    file: str
    main: bool
    counts: Mapping[str, int]
    identifiers: Mapping[str, int] = {}
    includes: Sequence[str] = ()


class LibraryRecord(Struct, frozen=True):
    """One library.

    Attributes:
        name, version, author, category, architectures, depends, url, license: as it declares them.
        main: bare names of the headers a program includes, best first; never empty.
        headers: all its public headers.
        said: word -> count in what it declares about itself.
        keywords: word -> count in the keywords it declares; names of classes among them are in `classes`.
        copies, in_registry, installed, origin, registers: see `index.Library`.
        api: what it offers to a program; empty where that is not known.
    """

    name: str
    main: tuple[str, ...]
    headers: Sequence[HeaderRecord]
    version: str = ""
    author: str = ""
    category: str = ""
    architectures: tuple[str, ...] = ()
    depends: tuple[str, ...] = ()
    url: str = ""
    license: str = ""
    said: Mapping[str, int] = {}
    keywords: Mapping[str, int] = {}
    classes: Sequence[str] = ()
    copies: int = 1
    in_registry: bool = False
    installed: bool = False
    origin: str = ""
    api: Sequence[HeaderApi] = ()
    registers: tuple[str, ...] = ()

    def fields(self) -> tuple[dict[str, int], ...]:
        """Word -> count for each of `index.FIELDS`."""
        found: dict[str, dict[str, int]] = {name: {} for name in FIELDS}
        _add(found["name"], self.name)
        for header in self.headers:
            if header.main:
                _add(found["header"], header.file.rsplit(".", 1)[0])
                _count(found["ident"], header.identifiers)
        for name in self.classes:
            _add(found["keyword"], name)
        _count(found["keyword"], self.keywords)
        _count(found["meta"], self.said)
        return tuple(found[name] for name in FIELDS)

    def interfaces(self) -> int:
        """How it speaks to a device, a bit for each of `index.INTERFACES`."""
        spoken = {_INCLUDED.get(name.rsplit("/", 1)[-1].lower()) for header in self.headers for name in header.includes}
        return sum(1 << number for number, name in enumerate(INTERFACES) if name in spoken)


def used_by(libraries: Iterable[LibraryRecord]) -> dict[str, int]:
    """How many other libraries need a library, by its name: they declare it, or include a main header that it alone has."""
    listed = list(libraries)
    owners: dict[str, set[str]] = {}
    for library in listed:
        for file in library.main:
            owners.setdefault(file.lower(), set()).add(library.name)
    names = {library.name.lower(): library.name for library in listed}
    result: dict[str, int] = {library.name: 0 for library in listed}
    for library in listed:
        declared = (names.get(entry.split("(")[0].strip().lower()) for entry in library.depends)
        needed = {name for name in declared if name is not None}
        for header in library.headers:
            for file in header.includes:
                known = owners.get(file.rsplit("/", 1)[-1].lower(), set())
                if len(known) == 1 and library.name not in known:
                    needed |= known
        for name in needed - {library.name}:
            result[name] += 1
    return result


def _add(counts: dict[str, int], text: str) -> None:
    for word in words(text):
        counts[word] = counts.get(word, 0) + 1


def _count(counts: dict[str, int], more: Mapping[str, int]) -> None:
    for text, count in more.items():
        for word in words(text):
            counts[word] = counts.get(word, 0) + count


def write_index(target: Path, libraries: Iterable[LibraryRecord]) -> tuple[int, int]:
    """Write an index file; the same libraries give the same bytes. A file that is there is replaced when all is done.

    Args:
        target: the file. Its folder must exist.
        libraries: in any order; they are numbered by name.

    Returns:
        How many libraries and headers are in it.

    Raises:
        UsageError: a name comes twice.
        PlatformDataError: more headers or a higher count than 16 bits hold.
    """
    rows = sorted(libraries, key=lambda row: (row.name.casefold(), row.name))
    for before, row in pairwise(rows):
        if before.name == row.name:
            raise UsageError(f"the library '{row.name}' occurs twice", fix="remove one of them")
    headers = [(number, header) for number, row in enumerate(rows) for header in row.headers]
    with writing(target, _SCHEMA, APPLICATION, FORMAT) as db:
        _fill(db, rows, headers)
    return len(rows), len(headers)


def _fill(db: sqlite3.Connection, rows: Sequence[LibraryRecord], headers: Sequence[tuple[int, HeaderRecord]]) -> None:
    joined = (
        (number, row.name, row.version, row.author, row.category, _join(row.architectures), _join(row.depends), row.url,
         row.license, row.origin, _join(row.main), row.copies, row.in_registry, row.installed)
        for number, row in enumerate(rows)
    )  # fmt: skip
    db.executemany(f"INSERT INTO library VALUES ({', '.join('?' * 14)})", joined)
    bound = ((number, _join(row.registers)) for number, row in enumerate(rows) if row.registers)
    db.executemany("INSERT INTO registers VALUES (?, ?)", bound)
    numbered = list(enumerate(headers))
    db.executemany("INSERT INTO header VALUES (?, ?, ?, ?)", ((n, lib, h.file, h.main) for n, (lib, h) in numbered))
    _fill_counts(db, "term", ((n, header.counts) for n, (_, header) in numbered))
    _fill_counts(db, "ident", ((n, header.identifiers) for n, (_, header) in numbered))
    fields = [row.fields() for row in rows]
    _fill_facts(db, fields)
    needed = used_by(rows)
    runs = {
        "copies": [row.copies for row in rows],
        "used_by": [needed[row.name] for row in rows],
        "interfaces": [row.interfaces() for row in rows],
        "library_of": [library for library, _ in headers],
        "main": [int(header.main) for _, header in headers],
        "named": [int(is_named_like(header.file, rows[library].name)) for library, header in headers],
    } | {
        f"length_{name}": [min(sum(found[number].values()), 0xFFFF) for found in fields] for number, name in enumerate(FIELDS)
    }  # fmt: skip
    db.executemany("INSERT INTO run VALUES (?, ?)", ((name, _pack(numbers)) for name, numbers in sorted(runs.items())))
    db.executemany("INSERT INTO api VALUES (?, ?)", ((n, packed(row.api)) for n, row in enumerate(rows) if row.api))


def _fill_counts(db: sqlite3.Connection, table: str, headers: Iterable[tuple[int, Mapping[str, int]]]) -> None:
    terms: dict[str, list[tuple[int, int]]] = {}
    for number, counts in headers:
        for term, tf in counts.items():
            terms.setdefault(term, []).append((number, tf))
    for term in sorted(terms):
        found = sorted(terms[term])
        gaps, counted = _gaps([number for number, _ in found]), [tf for _, tf in found]
        wide = (max(gaps) > 0xFF) * 1 + (max(counted) > 0xFF) * 2
        db.execute(f"INSERT INTO {table} VALUES (?, ?, ?, ?)", (term, wide, _pack(gaps, wide & 1), _pack(counted, wide & 2)))


def _fill_facts(db: sqlite3.Connection, fields: Sequence[tuple[dict[str, int], ...]]) -> None:
    terms: dict[str, dict[int, list[int]]] = {}
    for library, counts in enumerate(fields):
        for number, of_field in enumerate(counts):
            for word, count in of_field.items():
                terms.setdefault(word, {}).setdefault(library, [0] * len(FIELDS))[number] = min(count, 0xFF)
    for term in sorted(terms):
        found = sorted(terms[term].items())
        gaps = _gaps([library for library, _ in found])
        wide = int(max(gaps) > 0xFF)
        columns = [bytes(counts[number] for _, counts in found) for number in range(len(FIELDS))]
        values = (term, wide, _pack(gaps, wide), *(column if any(column) else b"" for column in columns))
        db.execute(f"INSERT INTO fact VALUES ({', '.join('?' * len(values))})", values)


def _gaps(numbers: Sequence[int]) -> list[int]:
    return [number - before for before, number in pairwise([0, *numbers])]


def _pack(numbers: Sequence[int], wide: int = 1) -> bytes:
    if numbers and max(numbers) > 0xFFFF:
        raise PlatformDataError(f"the number {max(numbers)} does not fit the index", fix="index fewer headers")
    return struct.pack(f"<{len(numbers)}H", *numbers) if wide else bytes(numbers)


def _join(texts: Sequence[str]) -> str:
    return "\n".join(texts)
