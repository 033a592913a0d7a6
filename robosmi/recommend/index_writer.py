"""Writes the file of libraries that `index` reads: its schema, and bytes that depend on the content alone.

What the numbers in it mean is said in `index`; where the facts come from is the affair of whoever calls.
"""

from __future__ import annotations

import os
import struct
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.errors import PlatformDataError
from robosmi.recommend.index import APPLICATION, FORMAT, Header, Library, is_named_like

if TYPE_CHECKING:
    import sqlite3

_PAGE = 4096  # the smallest file of the sizes tried
_SCHEMA = """
CREATE TABLE library(id INTEGER PRIMARY KEY, name TEXT NOT NULL, version TEXT, author TEXT, category TEXT, architectures TEXT,
  depends TEXT, url TEXT, license TEXT, origin TEXT, main TEXT NOT NULL, copies INTEGER, in_registry INTEGER);
CREATE INDEX library_name ON library(name COLLATE NOCASE);
CREATE TABLE header(id INTEGER PRIMARY KEY, library INTEGER NOT NULL, file TEXT NOT NULL, main INTEGER NOT NULL);
CREATE INDEX header_file ON header(file COLLATE NOCASE);
CREATE TABLE term(term TEXT PRIMARY KEY, wide INTEGER NOT NULL, gaps BLOB NOT NULL, counts BLOB NOT NULL) WITHOUT ROWID;
CREATE TABLE run(name TEXT PRIMARY KEY, numbers BLOB NOT NULL) WITHOUT ROWID;
"""


def write_index(target: Path, libraries: Sequence[Library], headers: Iterable[tuple[Header, Mapping[str, int]]]) -> None:
    """Write an index file; the same input gives the same bytes. A file that is there is replaced when all is done.

    Args:
        target: the file. Its folder must exist.
        libraries: numbered by name from 0.
        headers: each header with the counts of its words (lower case), numbered from 0.

    Raises:
        PlatformDataError: more headers or a higher count than 16 bits hold.
    """
    import sqlite3

    rows: list[Header] = []
    terms: dict[str, list[tuple[int, int]]] = {}
    for header, counts in headers:
        rows.append(header)
        for term, tf in counts.items():
            terms.setdefault(term, []).append((header.id, tf))
    part = target.with_name(f"{target.name}.part-{os.getpid()}")
    part.unlink(missing_ok=True)
    try:
        db = sqlite3.connect(part, isolation_level=None)
        try:
            db.executescript(f"PRAGMA page_size={_PAGE}; PRAGMA journal_mode=OFF; PRAGMA encoding='UTF-8'; BEGIN; {_SCHEMA}")
            _fill(db, libraries, rows, terms)
            for last in ("COMMIT", f"PRAGMA application_id={APPLICATION}", f"PRAGMA user_version={FORMAT}", "VACUUM"):
                db.execute(last)
        finally:
            db.close()
        _forget_the_writer(part)
        part.replace(target)
    finally:
        part.unlink(missing_ok=True)


def _fill(
    db: sqlite3.Connection, libraries: Sequence[Library], headers: Sequence[Header], terms: Mapping[str, list[tuple[int, int]]]
) -> None:
    joined = (
        (lib.id, lib.name, lib.version, lib.author, lib.category, _join(lib.architectures), _join(lib.depends), lib.url,
         lib.license, lib.origin, _join(lib.main), lib.copies, lib.in_registry)
        for lib in libraries
    )  # fmt: skip
    db.executemany(f"INSERT INTO library VALUES ({', '.join('?' * 13)})", joined)
    db.executemany("INSERT INTO header VALUES (?, ?, ?, ?)", ((h.id, h.library, h.file, h.main) for h in headers))
    for term in sorted(terms):
        found = sorted(terms[term])
        numbers, counts = [number for number, _ in found], [tf for _, tf in found]
        gaps = [number - before for before, number in zip([0, *numbers], numbers, strict=False)]
        wide = (max(gaps) > 0xFF) * 1 + (max(counts) > 0xFF) * 2
        db.execute("INSERT INTO term VALUES (?, ?, ?, ?)", (term, wide, _pack(gaps, wide & 1), _pack(counts, wide & 2)))
    runs = {
        "copies": [library.copies for library in libraries],
        "library_of": [header.library for header in headers],
        "main": [int(header.main) for header in headers],
        "named": [int(is_named_like(header.file, libraries[header.library].name)) for header in headers],
    }
    db.executemany("INSERT INTO run VALUES (?, ?)", ((name, _pack(numbers)) for name, numbers in runs.items()))


def _forget_the_writer(path: Path) -> None:
    """Level what depends on the writing program, not on the content: change counters and SQLite's own version."""
    with path.open("r+b") as file:
        file.seek(24)
        file.write(struct.pack(">I", 1))  # SQLite file format, section 1.3: file change counter
        file.seek(92)
        file.write(struct.pack(">II", 1, 3_040_000))  # version-valid-for (equals the counter), version number


def _pack(numbers: Sequence[int], wide: int = 1) -> bytes:
    if numbers and max(numbers) > 0xFFFF:
        raise PlatformDataError(f"the number {max(numbers)} does not fit the index", fix="index fewer headers")
    return struct.pack(f"<{len(numbers)}H", *numbers) if wide else bytes(numbers)


def _join(texts: Sequence[str]) -> str:
    return "\n".join(texts)
