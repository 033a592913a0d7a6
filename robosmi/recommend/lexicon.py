"""The device lexicon: what the parts of drawings are, by their model numbers, trade names and kinds. Data, read from tables.

An entry states the names of a device, the more general devices that it is a kind of, whether a program needs a library for it,
and its interface; missing values are inherited from the more general entries. `part_words` finds the entries that a part
names; the usual libraries of a device are another table, read by `transformations`.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Iterable, Iterator
from functools import cache
from pathlib import Path
from typing import Literal, cast, get_args

from msgspec import Struct

from robosmi import inputs
from robosmi.base.quantities import quantity
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, did_you_mean
from robosmi.recommend.tokens import plain

Need = Literal["library", "optional", "none", ""]
"""Whether a program needs a library for a device: needed; helpful, though plain calls suffice; not needed; unknown."""

_NEEDS = get_args(Need)

COLUMNS = ("names", "is", "need", "interface")
"""The columns of a table. `names` apart by |, the first being the one it is called by; a model number may end in *, which
stands for any ending. `is`: names of other entries, apart by +."""

_FIX = f"write {','.join(COLUMNS)}; names apart by |"


class KnownDevice(Struct, frozen=True):
    """One entry.

    Attributes:
        names: as written.
        kinds: numbers of the entries that it is one of or made of; need and interface come from the first.
        stands_for: the same as written: a model number among them says which of an entry's names is meant.
        need: own or inherited.
        interface: own or inherited: i2c, spi, onewire, serial, analog, digital, pwm, pulse or nothing.
        depth: how many entries are above it, counted along the first kinds.
    """

    names: tuple[str, ...]
    kinds: tuple[int, ...]
    stands_for: tuple[str, ...]
    need: Need
    interface: str
    depth: int

    @property
    def name(self) -> str:
        """The name by which reports call the device."""
        return self.names[0].removesuffix("*")


class Lexicon:
    """The entries of some tables.

    Args:
        paths: CSV tables with `COLUMNS`. A name that two entries have belongs to the first.

    Raises:
        PlatformDataError: a table cannot be read, or says what makes no sense.
    """

    def __init__(self, paths: Iterable[Path]) -> None:
        rows = [row for path in paths for row in _rows(path)]
        self._exact: dict[str, int] = {}
        self._prefixes: dict[str, int] = {}
        for number, row in enumerate(rows):
            for name in row.names:
                (self._prefixes if name.endswith("*") else self._exact).setdefault(plain(name), number)
        self.devices = _resolved(rows, cache(self.number_of))  # many entries are of the same kinds

    def number_of(self, name: str) -> int | None:
        """The index of the entry with a name, ignoring letter case and punctuation; None if there is none.

        A model number also matches an entry that is listed with its beginning and a `*`.
        """
        key = plain(name)
        return self._prefixes[key] if key in self._prefixes and key not in self._exact else self.by_model(key)

    def exactly(self, key: str) -> int | None:
        """The index of the entry with exactly this name in the form of `words.plain`; a `*` in a name is not expanded."""
        return self._exact.get(key)

    def by_model(self, key: str) -> int | None:
        """The entry of a model number in lower case: the one listed, or else the one with the longest matching beginning and
        `*`.

        If the beginning ends in a letter, a digit must follow, so that ordinary words do not match.
        """
        if key in self._exact:
            return self._exact[key]
        for length in range(len(key), 2, -1):
            number = self._prefixes.get(key[:length])
            if number is not None and (length == len(key) or key[length - 1].isdigit() or key[length].isdigit()):
                return number
        return None

    def lineage(self, device: int) -> list[tuple[int, int]]:
        """The entry and all its ancestors, the more general devices that it is a kind of or contains, in breadth-first order.

        Returns:
            (index of the entry, its distance) pairs without duplicates, beginning with the device itself at distance 0.
        """
        found = {device: 0}
        waiting = [device]
        for number in waiting:  # grows while it is walked: breadth first
            for above in self.devices[number].kinds:
                if above not in found:
                    found[above] = found[number] + 1
                    waiting.append(above)
        return list(found.items())


class _Row(Struct, frozen=True):
    names: tuple[str, ...]
    kinds: tuple[str, ...]
    need: Need
    interface: str
    place: Location


def _rows(path: Path) -> Iterator[_Row]:
    place = Location(str(path))
    try:
        with io.StringIO(inputs.read_bytes(path, inputs.DATA).decode(), newline="") as lines:
            table = csv.reader(lines, strict=True)
            if tuple(next(table, ())) != COLUMNS:
                raise PlatformDataError("is not a table of devices", location=place, fix=_FIX)
            for row in table:
                if row:  # a blank line
                    yield _row(row, Location(str(path), table.line_num))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise PlatformDataError(f"the table of devices cannot be read: {error}", location=place, fix="correct it") from error


def _row(row: list[str], place: Location) -> _Row:
    if len(row) != len(COLUMNS):
        raise PlatformDataError(f"this line has {quantity(len(row), 'column')}, not {len(COLUMNS)}", location=place, fix=_FIX)
    names = tuple(part.strip() for part in row[0].split("|") if part.strip())
    if not names:
        raise PlatformDataError("this line has no device", location=place, fix=_FIX)
    kinds = tuple(part.strip() for part in row[1].split("+") if part.strip())
    need = row[2].strip()
    if need not in _NEEDS:
        known = [each for each in _NEEDS if each]
        raise PlatformDataError(
            f"'{need}' is no need{did_you_mean(need, known)}", location=place, fix=f"use one of: {', '.join(known)}"
        )
    return _Row(names, kinds, cast(Need, need), row[3].strip(), place)


def _resolved(rows: list[_Row], number_of: Callable[[str], int | None]) -> list[KnownDevice]:
    """The entries with the values that they inherit along their first kinds.

    Raises:
        PlatformDataError: an entry names a kind that is in no table.
    """
    above = [tuple(_number(kind, row, number_of) for kind in row.kinds) for row in rows]
    devices = []
    for number, row in enumerate(rows):
        chain = [number]
        while above[chain[-1]] and above[chain[-1]][0] not in chain:  # a ring ends where it began
            chain.append(above[chain[-1]][0])
        need: Need = next((rows[n].need for n in chain if rows[n].need), "")
        interface = next((rows[n].interface for n in chain if rows[n].interface), "")
        devices.append(KnownDevice(row.names, above[number], row.kinds, need, interface, len(chain) - 1))
    return devices


def _number(kind: str, row: _Row, number_of: Callable[[str], int | None]) -> int:
    found = number_of(kind)
    if found is None:
        raise PlatformDataError(
            f"'{row.names[0]}' has the kind '{kind}', which is in no table", location=row.place, fix="use an entry of a table"
        )
    return found
