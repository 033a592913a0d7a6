"""Headers on the disk: where an include is looked for, and which headers libclang must get in a changed form.

The folders' listings are cached, so that a file with many includes and many folders costs few system calls. `bounds` tells what
libclang cannot take.
"""

from __future__ import annotations

import os
import re
import stat
from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from contextlib import suppress
from functools import lru_cache
from itertools import islice

from msgspec import Struct

from robosmi import inputs
from robosmi.errors import SourceError
from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.t2m.c_source.parsing.bounds import LARGEST, cuts, shallow
from robosmi.transformations.t2m.c_source.parsing.error_recovery import Scratch

MOST = 1000
"""Number of headers of one file that are read at most."""
INCLUDED = re.compile(rb"#\s*include\s*[<\"]([^>\"\n]+)[>\"]")
_INCLUDE_LINE = re.compile(rb"^[ \t]*#[ \t]*include\b[^\n]*", re.MULTILINE)
MOST_NAMED = 20_000
"""Number of places named by macros that are looked at."""
MOST_ENTERED, MOST_READ, OFTEN = 20_000, 200_000_000, 60
"""Inclusions and bytes of one text; beyond, headers entered more often than `OFTEN` lose their includes."""
DEEPEST = 200
"""Nesting of includes at which libclang gives up."""
_GUARD = re.compile(rb"^[ \t]*#[ \t]*(?:ifndef[ \t]+|if[ \t]*![ \t]*defined[ \t(]+)(\w+)", re.MULTILINE)
_FIRST = re.compile(rb"^[ \t]*#", re.MULTILINE)
_ONCE = re.compile(rb"^[ \t]*#[ \t]*pragma[ \t]+once\b", re.MULTILINE)
_COMPUTED = re.compile(rb"include(?![ \t]*[\"<])")
_MACRO = re.compile(rb"^[ \t]*#[ \t]*define\b[^\n]*", re.MULTILINE)
_QUOTED = re.compile(rb"[\"<]([^\">\n]+)[\">]")
_UP = frozenset(["", ".", ".."])


State = tuple[str, int, int]
"""(path, time of the last change in nanoseconds, size in bytes) of a file or folder; zeros if it does not exist."""


class Folders:
    """The folders in which headers are searched, in this order.

    Attributes:
        stamped: the state of each folder when this object was made.
    """

    def __init__(self, folders: Sequence[str]) -> None:
        self.stamped = tuple(state_of(os.path.abspath(folder)) for folder in folders)
        self._holding = _holding(self.stamped)

    def places(self, name: str, beside: str | None) -> Iterator[str]:
        """Where a header of this name may be: beside the file that includes it (None for `<>`), then in the folders."""
        if beside is not None:
            yield os.path.join(beside, name)
        first = name.partition("/")[0]
        for folder in self._holding.get(first if first not in _UP else "", ()):
            yield os.path.join(folder, name)


class HeaderText(Struct, frozen=True):
    """A header that a text includes: its path, its size in bytes, and the text that replaces the file's own, if any."""

    path: str
    size: int
    text: bytes | None


class Reached(Struct, frozen=True):
    """The headers that a text includes, directly or not, and whether it includes itself without end."""

    headers: list[HeaderText]
    itself: bool = False


def reached(path: str, data: bytes, folders: Folders, known: Collection[str] = ()) -> Reached:
    """The headers that a text includes, directly or not, whatever the conditions of its includes.

    A header whose text nests too deep gets that part cut out; one that includes itself again and again loses its includes; one
    that cannot be read, is a pipe or device, or has macros that grow without bound becomes empty. All of this is rare.

    A macro may name a header (`#include NAME`) that no pattern finds. So each pipe and device in a folder that is searched, and
    each that a text of a macro names, is there as an empty file: libclang would wait for it.

    Args:
        path: path of the file with the text.
        data: the text.
        folders: folders with headers, searched after the file's own.
        known: headers that are left out, with all that they include.
    """
    root = os.path.abspath(path)
    files = {root: _File(root, len(data), _content_of(data, None))}
    keys: dict[str, str] = {}  # of places, which `..` spells in many ways
    pending = [root]
    waiting = {place for folder in folders.stamped for place in not_ordinary(folder)}
    while pending:
        file = files[pending.pop()]
        beside = os.path.dirname(file.path)
        waiting.update(not_ordinary(state_of(beside)))
        for raw in file.content.included:
            for place in folders.places(os.fsdecode(raw), beside):
                if place in known:
                    break
                key = keys.get(place) or keys.setdefault(place, os.path.normpath(place))
                if key not in files:
                    try:
                        state = os.stat(place)
                    except (OSError, ValueError):
                        continue
                    if stat.S_ISDIR(state.st_mode) or len(files) > MOST:
                        continue
                    files[key] = _File(
                        place, state.st_size, _content(place, state.st_mtime_ns, state.st_size, stat.S_ISREG(state.st_mode))
                    )
                    pending.append(key)
                file.inner.append(key)
                break
    if asking := {os.path.dirname(file.path) for file in files.values() if file.content.by_macro}:
        names = dict.fromkeys(os.fsdecode(raw) for file in files.values() for raw in file.content.named)
        places = (place for name in names for beside in asking for place in folders.places(name, beside))
        waiting.update(place for place in islice(places, MOST_NAMED) if _waits(place))
    itself = _bound(files, root)
    del files[root]
    for place in waiting:
        files.setdefault(os.path.normpath(place), _File(place, 0, _NOTHING))
    return Reached([HeaderText(file.path, file.size, file.text) for file in files.values()], itself)


class _Content(Struct, frozen=True):
    """The facts about a header that was read.

    Attributes:
        text: the changed text that replaces the file's own, None if that is used.
        included: the names in its `#include` directives.
        guarded: whether an include guard or `#pragma once` keeps it from being read twice.
        named: the names between quotes or `<>` in its macros.
        by_macro: whether it may have an `#include` that does not name its file itself, but a macro.
    """

    text: bytes | None
    included: tuple[bytes, ...]
    guarded: bool
    named: tuple[bytes, ...] = ()
    by_macro: bool = False


_NOTHING = _Content(b"", (), True)


class _File:
    """A header, or the text itself; `inner` are the keys of the files that it includes."""

    def __init__(self, path: str, size: int, content: _Content) -> None:
        self.path, self.size, self.content = path, size, content
        self.text = content.text
        self.inner: list[str] = []


def _bound(files: dict[str, _File], root: str) -> bool:
    """Remove the includes of headers that are entered again and again; returns whether the text itself is one of them."""
    itself = False
    while (often := _entered_too_often(files, root)) is not None:
        itself |= root in often
        for key in often:
            file = files[key]
            file.inner.clear()
            if key != root and file.text != b"":
                with suppress(OSError):
                    text = file.text if file.text is not None else inputs.read_bytes(file.path, inputs.SOURCE)
                    file.text = _INCLUDE_LINE.sub(b"", text)
    return itself


def _entered_too_often(files: dict[str, _File], root: str) -> list[str] | None:
    """The files whose includes make the total input grow beyond the limits; None if it does not."""
    entered: Counter[str] = Counter([root])
    size = files[root].size
    ways = [iter(files[root].inner)]
    while ways:
        key = next(ways[-1], None)
        if key is None:
            ways.pop()
            continue
        file = files[key]
        if file.content.guarded and entered[key]:
            continue
        entered[key] += 1
        size += file.size
        if size > MOST_READ or entered.total() > MOST_ENTERED:
            return [key for key, times in entered.items() if times > OFTEN and files[key].inner] or None
        if len(ways) < DEEPEST and file.inner:
            ways.append(iter(file.inner))
    return None


def state_of(path: str) -> State:
    """The present state of a file or folder; a folder's changes when an entry of it is created, renamed or removed."""
    try:
        found = os.stat(path)
    except (OSError, ValueError):
        return path, 0, 0
    return path, found.st_mtime_ns, found.st_size


@lru_cache(maxsize=100)
def _holding(folders: tuple[State, ...]) -> dict[str, list[str]]:
    """Name of an entry -> the folders that contain it, in order; the empty name stands for all folders."""
    found: dict[str, list[str]] = {"": [folder for folder, _, _ in folders]}
    for folder, changed, _ in folders:
        with suppress(OSError):  # a file, or a folder that may not be read
            for name in os.listdir(folder) if changed else ():
                found.setdefault(name, []).append(folder)
    return found


@lru_cache(maxsize=2000)
def _content(path: str, changed: int, size: int, regular: bool) -> _Content:
    if size > LARGEST or not regular:  # a pipe or device may never end
        return _NOTHING
    try:
        data = inputs.read_bytes(path, inputs.SOURCE)
        edits = [] if shallow(data) else cuts(path, data, tokens(data))
    except (OSError, SourceError):
        return _NOTHING
    return _content_of(data, Scratch(data, edits).data if edits else None)


def _content_of(data: bytes, text: bytes | None) -> _Content:
    """The facts about a text, which `text` replaces unless it is None."""
    named = tuple(name for line in _MACRO.findall(data) for name in _QUOTED.findall(line))
    return _Content(text, tuple(INCLUDED.findall(data)), guarded(data), named, names_by_macro(data))


def names_by_macro(data: bytes) -> bool:
    """Whether a text may have an `#include` that does not name its file itself."""
    return _COMPUTED.search(data) is not None


@lru_cache(maxsize=1000)
def not_ordinary(folder: State) -> tuple[str, ...]:
    """The paths of the pipes, devices and sockets in a folder."""
    try:
        with os.scandir(folder[0]) as entries:
            return tuple(e.path for e in entries if not e.is_file() and not e.is_dir() and _waits(e.path))
    except OSError:
        return ()


def _waits(path: str) -> bool:
    """Whether a path leads to a pipe, a device or a socket."""
    try:
        mode = os.stat(path).st_mode
    except (OSError, ValueError):
        return False
    return not stat.S_ISREG(mode) and not stat.S_ISDIR(mode)


def guarded(data: bytes) -> bool:
    """Whether a header protects itself from being read twice, by an include guard or by `#pragma once`."""
    match = _GUARD.search(data)
    if match is None or _FIRST.search(data, 0, match.start()):
        return _ONCE.search(data) is not None
    name = re.escape(match[1])
    return (
        re.search(rb"#[ \t]*define[ \t]+%s\b" % name, data) is not None
        and re.search(rb"#[ \t]*undef[ \t]+%s\b" % name, data) is None
    )
