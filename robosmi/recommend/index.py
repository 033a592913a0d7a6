"""The file of libraries of one target: what is in it and how it is read. One SQLite file, never written to here.

Tables `library` and `header` hold facts; `term` holds, for each word, the headers it occurs in (the gaps between
their numbers) and how often, each as 8-bit numbers or, where one needs it (`wide`: 1 gaps, 2 counts), as 16-bit ones;
`ident` holds the same for the words of identifiers; `fact` holds, for each word, the libraries that have it in one of
`FIELDS`, and how often there; `run` holds numbers of each header or library in one piece, because ranking looks at all
of them; `api`, which an index need not have, holds what each library offers to a program (`library_api`), read only when
asked for; `registers`, which an index need not have either, holds the registers that libraries use on every processor.
Libraries are numbered by name, headers by library. No ranking here; the writing is in `library_record`.

`LayeredIndex` shows several files as one: the shipped one and those that users add; a later file hides libraries of an earlier
one. Library and header numbers continue from file to file, so that numbers which rankers store stay valid. A library of an
earlier file that a later one contains, too, keeps its number but is no longer found by any search.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Callable, Sequence
from functools import lru_cache
from itertools import accumulate, chain
from pathlib import Path
from typing import TYPE_CHECKING, Any
from weakref import finalize

from msgspec import Struct
from msgspec.structs import replace

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError

if TYPE_CHECKING:
    from robosmi.recommend.library_api import HeaderApi
    from robosmi.recommend.tfidf import Postings

FORMAT = 2
"""Number of the format: `PRAGMA user_version` of the file."""

APPLICATION = 0x52534C49
"""What marks such a file: `PRAGMA application_id`, "RSLI"."""

FIELDS = ("name", "header", "keyword", "meta", "ident")
"""Where a library's words come from: its name, the names of its main headers, its keywords and classes, what it declares
about itself, and the identifiers in its main headers."""

INTERFACES = ("i2c", "spi", "onewire", "serial")
"""How a library speaks to a device, told by what its headers include; bit n of the run `interfaces` is number n."""

RUNS = ("library_of", "named", "main", "copies", "used_by", "interfaces", *(f"length_{field}" for field in FIELDS))

_PUNCTUATION = re.compile(r"[\W_]+")
_REMEMBERED = 2048
"""Libraries that are read again only when there were as many others."""

_FIX = "build it again, or install robosmi again"

Facts = tuple[Sequence[int], tuple[bytes, ...]]
"""Which libraries have a word: their numbers, ascending, and for each of `FIELDS` how often (a byte a library, or empty)."""


class Library(Struct, frozen=True):
    """Facts about one library, as it declares them; empty where it declares nothing.

    Attributes:
        id: its number in the index, by name from 0.
        name: unique in the index.
        architectures: processor architectures it is for; `*` for all.
        depends: libraries it needs, perhaps with a version in brackets.
        main: bare names of the headers a program includes, best first; never empty.
        copies: in how many collections a library of this name was seen: a small measure of popularity.
        in_registry: it is in the registry of the target's maker.
        installed: it was found on this machine.
        origin: where it was read: `owner/repository@commit:folder`.
        registers: some registers of one architecture's processors that its source uses without asking for these processors;
            empty where its source was not read.
    """

    id: int
    name: str
    version: str = ""
    author: str = ""
    category: str = ""
    architectures: tuple[str, ...] = ()
    depends: tuple[str, ...] = ()
    url: str = ""
    license: str = ""
    origin: str = ""
    main: tuple[str, ...] = ()
    copies: int = 1
    in_registry: bool = False
    installed: bool = False
    registers: tuple[str, ...] = ()

    @property
    def header(self) -> str:
        """The one header a program includes: the main one named like the library, else the first main one."""
        return next((file for file in self.main if is_named_like(file, self.name)), self.main[0])


class Header(Struct, frozen=True):
    """One public header: its number, that of its library, its bare file name, and whether a program includes it."""

    id: int
    library: int
    file: str
    main: bool


def is_named_like(file: str, library: str) -> bool:
    """Whether a header bears the name of a library; letter case, blanks and punctuation do not count."""
    stem = file.rsplit(".", 1)[0]
    return _plain(stem) == _plain(library)


def _plain(name: str) -> str:
    return _PUNCTUATION.sub("", name).casefold()


class LibraryIndex:
    """An index file, open for reading. Implements `tfidf.Documents`. Safe to share between threads.

    Args:
        path: the file, which must not change while it is open.

    Raises:
        PlatformDataError: not there, damaged, or of another format.
    """

    def __init__(self, path: Path) -> None:
        import sqlite3  # 5 ms, wanted only when libraries are ranked

        self.path = path
        try:
            inputs.check_ordinary(path)  # SQLite would take a named pipe or a device
            # immutable: no locks and no search for a journal. Python's sqlite3 serialises the calls of several threads
            self._db = sqlite3.connect(f"{path.absolute().as_uri()}?immutable=1", uri=True, check_same_thread=False)
            finalize(self, self._db.close)
        except (OSError, sqlite3.Error) as error:
            raise self._damaged((isinstance(error, OSError) and error.strerror) or str(error)) from error
        try:
            if self._one("PRAGMA application_id") != (APPLICATION,) or self._one("PRAGMA user_version") != (FORMAT,):
                raise self._damaged(f"it is not an index of libraries of format {FORMAT}")
            runs = {name: self._run(name) for name in RUNS}
        except PlatformDataError:
            self.close()
            raise
        self.library_of, self.named, self.is_main = runs["library_of"], runs["named"], runs["main"]
        self.copies, self.used_by, self.interfaces = runs["copies"], runs["used_by"], runs["interfaces"]
        self.lengths = tuple(runs[f"length_{field}"] for field in FIELDS)
        found = self._all("SELECT library, names FROM registers") if self._has("registers") else []
        self._registers = {number: _split(names) for number, names in found}
        # a drawing has the same few words and candidates again and again
        self.postings = lru_cache(maxsize=256)(self._postings)
        self.identifiers = lru_cache(maxsize=256)(self._identifiers)
        self.facts = lru_cache(maxsize=1024)(self._facts)
        self._read: dict[int, Library] = {}
        self.library_named = lru_cache(maxsize=2048)(self._library_named)
        self.header = lru_cache(maxsize=4096)(self._header)

    @property
    def documents(self) -> int:
        """N: how many headers the index has."""
        return len(self.library_of)

    def __len__(self) -> int:
        """How many libraries the index has."""
        return len(self.copies)

    def close(self) -> None:
        """Close the file. The index cannot be used any more."""
        self._db.close()

    def _postings(self, term: str) -> Postings:
        return self._counted("SELECT wide, gaps, counts FROM term WHERE term = ?", term)

    def _identifiers(self, term: str) -> Postings:
        """The libraries in whose identifiers (not comments, not strings) a word occurs, and how often."""
        return self._counted("SELECT wide, gaps, counts FROM ident WHERE term = ?", term)

    def _counted(self, sql: str, term: str) -> Postings:
        row = self._one(sql, term)
        if row is None:
            return (), ()
        wide, gaps, counts = row
        return tuple(accumulate(_unpack(gaps, wide & 1))), _unpack(counts, wide & 2)

    def _facts(self, term: str) -> Facts:
        """The libraries that have a word; to be called as `facts`."""
        row = self._one(f"SELECT wide, gaps, {', '.join(FIELDS)} FROM fact WHERE term = ?", term)
        return ((), ()) if row is None else (tuple(accumulate(_unpack(row[1], row[0]))), row[2:])

    def terms_from(self, prefix: str, limit: int = 40) -> list[str]:
        """The first words of libraries that begin like this, in order of the alphabet."""
        rows = self._all("SELECT term FROM fact WHERE term >= ? AND term < ? LIMIT ?", prefix, f"{prefix}\uffff", limit)
        return [row[0] for row in rows]

    def terms_containing(self, piece: str) -> list[str]:
        """All words of headers that contain this; looks at every word there is."""
        return [row[0] for row in self._all("SELECT term FROM term WHERE instr(term, ?) ORDER BY term", piece)]

    def library(self, number: int) -> Library:
        """The library of that number (0 <= number < len(index)).

        Raises:
            PlatformDataError: the index lacks it.
        """
        return self._read.get(number) or self.libraries([number])[0]

    def libraries(self, numbers: Sequence[int]) -> list[Library]:
        """The libraries of these numbers, read at once; one query for each would take five times as long.

        Raises:
            PlatformDataError: the index lacks one.
        """
        known = self._read if len(self._read) < _REMEMBERED else {}
        if wanted := [number for number in numbers if number not in known]:
            found = self._libraries(f"id IN ({_places(wanted)})", *wanted)
            known = self._read = known | {library.id: library for library in found}
        lacking = next((number for number in numbers if number not in known), None)
        if lacking is not None:
            raise self._damaged(f"library {lacking} is missing")
        return [known[number] for number in numbers]

    def spread(self, terms: Sequence[str]) -> dict[str, int]:
        """How many libraries have each of these words in one of `FIELDS`, without those that none has."""
        rows = self._all(f"SELECT term, length(gaps), wide FROM fact WHERE term IN ({_places(terms)})", *terms)
        return {term: size // (2 if wide else 1) for term, size, wide in rows}

    def _library_named(self, name: str) -> Library | None:
        """The library of that name: letter for letter, else without regard to case if that is unique, else None.

        To be called as `library_named`.
        """
        found = self._libraries("name = ? COLLATE NOCASE", name)
        exact = [library for library in found if library.name == name]
        return exact[0] if exact else found[0] if len(found) == 1 else None

    def names(self) -> list[str]:
        """The names of all libraries, in the order of their numbers."""
        return [row[0] for row in self._all("SELECT name FROM library ORDER BY id")]

    def _header(self, number: int) -> Header:
        """The header of that number (0 <= number < `documents`); to be called as `header`.

        Raises:
            PlatformDataError: the index lacks it.
        """
        row = self._one("SELECT id, library, file, main FROM header WHERE id = ?", number)
        if row is None:
            raise self._damaged(f"header {number} is missing")
        return Header(row[0], row[1], row[2], bool(row[3]))

    def api(self, number: int) -> tuple[HeaderApi, ...]:
        """What the library of that number declares, header by header; empty where the index knows nothing of it.

        Raises:
            PlatformDataError: the index is damaged.
        """
        from robosmi.recommend.library_api import unpacked

        if not self._has("api"):
            return ()
        row = self._one("SELECT headers FROM api WHERE library = ?", number)
        try:
            return unpacked(row[0]) if row is not None else ()
        except ValueError as error:
            raise self._damaged(f"what library {number} offers cannot be read: {error}") from error

    def headers_named(self, file: str) -> list[Header]:
        """All headers of that bare file name; those that agree letter for letter, if there are any."""
        rows = self._all("SELECT id, library, file, main FROM header WHERE file = ? COLLATE NOCASE ORDER BY id", file)
        found = [Header(row[0], row[1], row[2], bool(row[3])) for row in rows]
        return [header for header in found if header.file == file] or found

    def _libraries(self, condition: str, *values: object) -> list[Library]:
        rows = self._all(
            "SELECT id, name, version, author, category, architectures, depends, url, license, origin, main, copies, "
            f"in_registry, installed FROM library WHERE {condition} ORDER BY id",
            *values,
        )
        return [_library_of_row(row, self._registers.get(row[0], ())) for row in rows]

    def _has(self, table: str) -> bool:
        return self._one("SELECT 1 FROM sqlite_master WHERE name = ?", table) is not None

    def _run(self, name: str) -> Sequence[int]:
        row = self._one("SELECT numbers FROM run WHERE name = ?", name)
        if row is None:
            raise self._damaged(f"the run '{name}' is missing")
        return _unpack(row[0])

    def _one(self, sql: str, *values: object) -> tuple[Any, ...] | None:
        rows = self._all(sql, *values)
        return rows[0] if rows else None

    def _all(self, sql: str, *values: object) -> list[tuple[Any, ...]]:
        import sqlite3

        try:
            return self._db.execute(sql, values).fetchall()
        except sqlite3.Error as error:
            raise self._damaged(str(error)) from error

    def _damaged(self, cause: str) -> PlatformDataError:
        return PlatformDataError(f"the index of libraries cannot be used: {cause}", location=Location(str(self.path)), fix=_FIX)


def _library_of_row(row: tuple[Any, ...], registers: tuple[str, ...]) -> Library:
    number, name, version, author, category, architectures, depends, url, licence, origin, main, copies, known, here = row
    lists = [_split(text) for text in (architectures, depends, main)]
    return Library(
        number,
        name,
        version,
        author,
        category,
        lists[0],
        lists[1],
        url,
        licence,
        origin,
        lists[2],
        copies,
        bool(known),
        bool(here),
        registers,
    )


def _unpack(data: bytes, wide: int = 1) -> Sequence[int]:
    return struct.unpack(f"<{len(data) // 2}H", data) if wide else data  # bytes are 8-bit numbers already


def _places(values: Sequence[object]) -> str:
    return ",".join("?" * len(values))


def _split(text: str) -> tuple[str, ...]:
    return tuple(text.split("\n")) if text else ()


class LayeredIndex(LibraryIndex):
    """Index files in order; see `LibraryIndex` for every method.

    Args:
        paths: at least one file, the shipped one first.

    Raises:
        PlatformDataError: one is not there, damaged, or of another format.
    """

    def __init__(self, paths: Sequence[Path]) -> None:
        self.path = paths[0]
        self._layers = [LibraryIndex(path) for path in paths]
        self._first, self._first_header = [0], [0]
        for layer in self._layers:
            self._first.append(self._first[-1] + len(layer))
            self._first_header.append(self._first_header[-1] + layer.documents)
        names = [layer.names() for layer in self._layers]
        self._names = list(chain.from_iterable(names))
        last = {name: number for number, name in enumerate(self._names)}
        self._hidden = frozenset(number for number, name in enumerate(self._names) if last[name] != number)
        self.library_of = [number + self._first[n] for n, layer in enumerate(self._layers) for number in layer.library_of]
        self.named = self._joined(lambda layer: layer.named)
        self.is_main = self._joined(lambda layer: layer.is_main)
        self.copies = self._highest(self._joined(lambda layer: layer.copies), last)
        self.used_by = self._highest(self._joined(lambda layer: layer.used_by), last)
        self.interfaces = self._joined(lambda layer: layer.interfaces)
        self.lengths = tuple(list(chain.from_iterable(layer.lengths[n] for layer in self._layers)) for n in range(len(FIELDS)))
        self.postings = lru_cache(maxsize=256)(lambda term: self._counts(lambda layer: layer.postings(term)))
        self.identifiers = lru_cache(maxsize=256)(lambda term: self._counts(lambda layer: layer.identifiers(term)))
        self.facts = lru_cache(maxsize=1024)(self._facts)
        self.library_named = lru_cache(maxsize=2048)(self._library_named)
        self.header = lru_cache(maxsize=4096)(self._header)

    def close(self) -> None:
        """Close the files."""
        for layer in self._layers:
            layer.close()

    def names(self) -> list[str]:
        """The names of all libraries in the order of their numbers; a hidden one's is that of the one that hides it."""
        return list(self._names)

    def _library_named(self, name: str) -> Library | None:
        """See `LibraryIndex._library_named`; the last file that has it counts."""
        for n in reversed(range(len(self._layers))):
            found = self._layers[n].library_named(name)
            if found is not None and found.id + self._first[n] not in self._hidden:
                return self.library(found.id + self._first[n])
        return None

    def api(self, number: int) -> tuple[HeaderApi, ...]:
        """See `LibraryIndex.api`."""
        n = self._layer(self._first, number)
        return self._layers[n].api(number - self._first[n])

    def headers_named(self, file: str) -> list[Header]:
        """See `LibraryIndex.headers_named`."""
        found = [self._moved(header, n) for n, layer in enumerate(self._layers) for header in layer.headers_named(file)]
        found = [header for header in found if header.library not in self._hidden]
        return [header for header in found if header.file == file] or found

    def terms_from(self, prefix: str, limit: int = 40) -> list[str]:
        """See `LibraryIndex.terms_from`."""
        return sorted({term for layer in self._layers for term in layer.terms_from(prefix, limit)})[:limit]

    def terms_containing(self, piece: str) -> list[str]:
        """See `LibraryIndex.terms_containing`."""
        return sorted({term for layer in self._layers for term in layer.terms_containing(piece)})

    def _joined(self, run: Callable[[LibraryIndex], Sequence[int]]) -> list[int]:
        return list(chain.from_iterable(run(layer) for layer in self._layers))

    def _highest(self, numbers: list[int], last: dict[str, int]) -> list[int]:
        """Give each library at least the popularity of the one that it hides."""
        for number in self._hidden:
            seen = last[self._names[number]]
            numbers[seen] = max(numbers[seen], numbers[number])
        return numbers

    def _counts(self, postings: Callable[[LibraryIndex], Postings]) -> Postings:
        headers: list[int] = []
        counts: list[int] = []
        for n, layer in enumerate(self._layers):
            for header, count in zip(*postings(layer), strict=True):
                number = header + self._first_header[n]
                if self.library_of[number] not in self._hidden:
                    headers.append(number)
                    counts.append(count)
        return headers, counts

    def _facts(self, term: str) -> Facts:
        libraries: list[int] = []
        columns = [bytearray() for _ in FIELDS]
        for n, layer in enumerate(self._layers):
            found, given = layer.facts(term)
            for place, library in enumerate(found):
                if library + self._first[n] not in self._hidden:
                    libraries.append(library + self._first[n])
                    for column, values in zip(columns, given, strict=True):
                        column.append(values[place] if values else 0)
        return libraries, tuple(bytes(column) if any(column) else b"" for column in columns) if libraries else ()

    def library(self, number: int) -> Library:
        """See `LibraryIndex.library`."""
        n = self._layer(self._first, number)
        own = self._layers[n].library(number - self._first[n])
        return own if not n else replace(own, id=number)

    def libraries(self, numbers: Sequence[int]) -> list[Library]:
        """See `LibraryIndex.libraries`."""
        return [self.library(number) for number in numbers]

    def spread(self, terms: Sequence[str]) -> dict[str, int]:
        """See `LibraryIndex.spread`."""
        return {term: found for term in terms if (found := len(self.facts(term)[0]))}

    def _header(self, number: int) -> Header:
        n = self._layer(self._first_header, number)
        return self._moved(self._layers[n].header(number - self._first_header[n]), n)

    def _moved(self, header: Header, n: int) -> Header:
        return Header(header.id + self._first_header[n], header.library + self._first[n], header.file, header.main)

    @staticmethod
    def _layer(firsts: Sequence[int], number: int) -> int:
        return max(n for n in range(len(firsts) - 1) if firsts[n] <= number)
