"""Headers on the disk: where an include is looked for, and which headers the parser must not be given as they are.

The folders' lists of names are kept, so that a file with many includes and many folders costs few questions to the system.
What the parser cannot take is said in `bounds`.
"""

from __future__ import annotations

import os
import re
import stat
from collections.abc import Collection, Iterator, Sequence
from contextlib import suppress
from functools import lru_cache
from typing import NamedTuple

from robosmi.errors import SourceError
from robosmi.transformations.t2m.c_source.bounds import LARGEST, cuts, shallow
from robosmi.transformations.t2m.c_source.lexer import tokens
from robosmi.transformations.t2m.c_source.mending import Scratch

MOST = 1000
"""Headers of one file that are looked through."""
INCLUDED = re.compile(rb"#\s*include\s*[<\"]([^>\"\n]+)[>\"]")
_UP = frozenset(["", ".", ".."])


class Folders:
    """Where headers are searched for, in this order.

    Attributes:
        stamped: each folder with when an entry of it was last made, renamed or removed; 0 for no folder.
    """

    def __init__(self, folders: Sequence[str]) -> None:
        self.stamped = tuple(_stamped(os.path.abspath(folder)) for folder in folders)
        self._holding = _holding(self.stamped)

    def places(self, name: str, beside: str | None) -> Iterator[str]:
        """Where a header of this name may be: beside the file that includes it (None for `<>`), then in the folders."""
        if beside is not None:
            yield os.path.join(beside, name)
        first = name.partition("/")[0]
        for folder in self._holding.get(first if first not in _UP else "", ()):
            yield os.path.join(folder, name)


class Header(NamedTuple):
    """A header that a text reaches: its path, its size in bytes, and its text where the parser must be given another."""

    path: str
    size: int
    text: bytes | None


def reached(path: str, data: bytes, folders: Folders, known: Collection[str] = ()) -> list[Header]:
    """The headers that a text reaches beside it and in folders, whatever the conditions of its includes.

    What nests too deep is taken out of a header's text; one that cannot be read, or whose macros are without bound, becomes
    an empty one. Hardly any is like that.

    Args:
        path: of the file with the text.
        data: the text.
        folders: with headers, searched after the file's own.
        known: headers that were looked through before, with all that they include.
    """
    found: list[Header] = []
    own = os.path.dirname(os.path.abspath(path))
    pending = [(own, name) for name in INCLUDED.findall(data)]
    seen: set[str] = set()
    while pending and len(seen) < MOST:
        beside, raw = pending.pop()
        for place in folders.places(os.fsdecode(raw), beside):
            if place in seen or place in known:
                break
            try:
                state = os.stat(place)
            except (OSError, ValueError):
                continue
            seen.add(place)
            if stat.S_ISREG(state.st_mode):
                text, included = _harmless(place, state.st_mtime_ns, state.st_size)
                found.append(Header(place, state.st_size, text))
                pending += [(os.path.dirname(place), inner) for inner in included]
                break
    return found


def _stamped(folder: str) -> tuple[str, int]:
    try:
        return folder, os.stat(folder).st_mtime_ns
    except (OSError, ValueError):
        return folder, 0


@lru_cache(maxsize=100)
def _holding(folders: tuple[tuple[str, int], ...]) -> dict[str, list[str]]:
    """For each name the folders that have an entry of that name, in order; all of them for the empty name."""
    found: dict[str, list[str]] = {"": [folder for folder, _ in folders]}
    for folder, changed in folders:
        with suppress(OSError):  # a file, or a folder that may not be read
            for name in os.listdir(folder) if changed else ():
                found.setdefault(name, []).append(folder)
    return found


@lru_cache(maxsize=2000)
def _harmless(path: str, changed: int, size: int) -> tuple[bytes | None, tuple[bytes, ...]]:
    """A header's text where it must be another than the file's, and the names of what it includes."""
    if size > LARGEST:
        return b"", ()
    try:
        with open(path, "rb") as stream:
            data = stream.read()
        included = tuple(INCLUDED.findall(data))
        if shallow(data):
            return None, included
        edits = cuts(path, data, tokens(data))
    except (OSError, SourceError):
        return b"", ()
    return (Scratch(data, edits).data if edits else None), included
