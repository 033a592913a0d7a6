"""What is known of one library before it is in an index: declared metadata, its headers, and the words of both.

Readers (a file of facts, folders of installed libraries) make such values, `index_writer` writes them. Only facts are kept:
names, counts of words, identifiers' words, includes, declarations; never a text. Which words a part asks for is in `part_words`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from msgspec import Struct

from robosmi.recommend.index import FIELDS, INTERFACES
from robosmi.recommend.library_api import HeaderApi
from robosmi.recommend.tokens import words

_INCLUDED = {
    "wire.h": "i2c",
    "twi.h": "i2c",
    "i2c.h": "i2c",
    "spi.h": "spi",
    "onewire.h": "onewire",
    "softwareserial.h": "serial",
}


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
