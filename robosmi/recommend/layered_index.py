"""Several index files seen as one: the shipped one and those that users add; a later file hides libraries of an earlier one.

Library and header numbers continue from file to file, so that numbers which rankers store stay valid. A library of an earlier
file that a later one contains, too, keeps its number but is no longer found by any search. The file format is in `index`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec.structs import replace

from robosmi.recommend.index import FIELDS, Facts, Header, Library, LibraryIndex
from robosmi.recommend.tfidf import Postings

if TYPE_CHECKING:
    from robosmi.recommend.library_api import HeaderApi


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
