"""Headers that programs begin with, parsed once for all files of a process that begin with them.

Most of the time of a file with the vendor's headers is the parse of these: a dozen lines pull in thousands. So what a file
includes before anything else is kept as the parser's precompiled header when several files begin so, and is blank in the copy
that is parsed. The tree is the same either way, and shorter to walk, as the index leaves out what is not of the file. Headers
that complain, or that must not be read as they are (`bounds`), are not kept; nor are those that were changed since, or beside
which something was put that an include might mean now.
"""

from __future__ import annotations

import codecs
import os
import re
import sys
from collections import Counter
from collections.abc import Sequence
from contextlib import suppress
from itertools import count
from threading import Lock
from typing import TYPE_CHECKING, NamedTuple

from msgspec import Struct

from robosmi.transformations.knowledge.lexer import directive_comments, directive_parts
from robosmi.transformations.knowledge.platform_api import ApiIndex
from robosmi.transformations.t2m.c_source import clang
from robosmi.transformations.t2m.c_source.headers import Folders, State, reached, state_of
from robosmi.transformations.t2m.c_source.invocation import HEADERS, VIRTUAL, standard_headers, unsaved
from robosmi.transformations.t2m.c_source.prelude import Prelude
from robosmi.transformations.t2m.c_source.source import ReadSource
from robosmi.typed import kept, replaced, sum_of

if TYPE_CHECKING:
    import tempfile

BASE = f"{VIRTUAL}/base.h"
"""The prelude of a precompiled header: what is said of every program."""
_BEGINNING = f"{VIRTUAL}/beginning.h"
LEAST = 60_000
"""Bytes of headers below which it takes longer to keep them than to read them again."""
ENOUGH = 3
"""Files with the same beginning after which it is kept; to make one takes as long as to read the headers three times."""
MANY = 12
"""Files after which more headers are kept than a shorter beginning has."""
MOST = 64
"""Kept at one time; one is about a megabyte on the disk."""
_NAMED = re.compile(r'"([^"\n]+)"|<([^>\n]+)>')
_BLANK = bytes(byte if byte in b"\r\n" else 32 for byte in range(256))


class Beginning(Struct, frozen=True):
    """A precompiled header for the start of a text.

    Attributes:
        end: offset behind the last include that it stands for.
        file: path of the precompiled header.
        inclusions: paths of the headers in it, standard ones too.
        macros: names of the macros that are defined behind it, those of the prelude left out.
        states: of these and of their folders, when they were read.
    """

    end: int
    file: str
    inclusions: tuple[str, ...]
    macros: frozenset[str] = frozenset()
    states: tuple[State, ...] = ()

    def blank(self, text: bytes) -> bytes:
        """The text with nothing but the ends of lines where the includes were."""
        return text[: self.end].translate(_BLANK) + text[self.end :]

    def standard(self) -> list[str]:
        """The names of the standard headers in it."""
        return [path[len(HEADERS) + 1 :] for path in self.inclusions if path.startswith(HEADERS)]

    @property
    def current(self) -> bool:
        """Whether its headers are as they were."""
        return all(state == state_of(state[0]) for state in self.states)


def beginning(source: ReadSource, api: ApiIndex, given: Sequence[str], folders: Folders) -> Beginning | None:
    """The precompiled header for what a text begins with; None where there is none, or it would not pay.

    There is none for C++: the list of a file's own declarations has instances of templates there, and leaves out others.

    Args:
        source: the text.
        api: its platform.
        given: the parser's arguments.
        folders: with headers.
    """
    run = _leading(source, api, folders) if source.language == "C" else []
    return _kept(os.getpid()).find(run, api, given, folders) if any(include.place for include in run) else None


def forget(found: Beginning) -> None:
    """Keep a precompiled header no longer: its headers say something else now."""
    _kept(os.getpid()).drop(found)


class _Include(NamedTuple):
    """An include as it is written, the header's path (empty for a standard one), and where it ends in the text."""

    written: str
    place: str
    end: int


def _leading(source: ReadSource, api: ApiIndex, folders: Folders) -> list[_Include]:
    """The includes before anything else whose headers are there."""
    own = os.path.dirname(os.path.abspath(source.path))
    run: list[_Include] = []
    for kind, _, end, text in source.tokens:
        if kind == "comment":
            continue
        word, rest = directive_parts(text) if kind == "directive" else ("", "")
        match = _NAMED.fullmatch(rest) if word == "include" else None
        if match is None or _left_open(text) or source.parsed.find(codecs.BOM_UTF8, 1, end) > 0:
            break
        name = os.fsdecode((match[1] or match[2]).encode("latin-1"))  # tokens have a character for each byte
        place = next(filter(os.path.isfile, folders.places(name, own if match[1] else None)), "")
        if '"' in place or not (place or name in api.virtual_headers()):
            break
        run.append(_Include(f"<{name}>", place, end))
    return run


def _left_open(directive: str) -> bool:
    """Whether a comment that begins in a directive never ends; the parser complains of it."""
    comments = [directive[start:end] for start, end in directive_comments(directive)]
    return any(text.startswith("/*") and (len(text) < 4 or not text.endswith("*/")) for text in comments)


class _Kept:
    """The precompiled headers of one process, in a folder that goes with it."""

    def __init__(self) -> None:
        self._seen: Counter[object] = Counter()
        self._made: dict[object, Beginning | None] = {}
        self._folder: tempfile.TemporaryDirectory[str] | None = None
        self._numbers = count()
        self._lock = Lock()

    def find(self, run: Sequence[_Include], api: ApiIndex, given: Sequence[str], folders: Folders) -> Beginning | None:
        """The longest beginning of these includes that is kept, or that is worth it from now on."""
        headers = tuple(include[:2] for include in run)
        keys = [(api.origin, *given, folders.stamped, headers[: number + 1]) for number in range(len(run))]
        with self._lock:
            self._seen.update(keys)
            kept = next((number for number in reversed(range(len(run))) if self._current(keys[number])), -1)
            enough = ENOUGH if kept < 0 else MANY
            better = [n for n in range(kept + 1, len(run)) if keys[n] not in self._made and self._seen[keys[n]] >= enough]
            if better:
                made = self._made[keys[better[-1]]] = self._make(run[: better[-1] + 1], api, given, folders)
                kept = better[-1] if made else kept
            found = self._made.pop(keys[kept]) if kept >= 0 else None
            if found is None:
                return None
            self._made[keys[kept]] = found  # now the one that was used last
            all_made = [one for one in self._made.values() if one]
            for oldest in all_made[:-MOST]:
                self._drop(oldest)
            return replaced(found, end=run[kept].end)

    def drop(self, found: Beginning) -> None:
        """Keep it no longer."""
        with self._lock:
            self._drop(found)

    def _drop(self, found: Beginning) -> None:
        self._made = {key: one for key, one in self._made.items() if one is None or one.file != found.file}
        with suppress(OSError):
            os.unlink(found.file)

    def _current(self, key: object) -> bool:
        """Whether there is one, made from what the headers say now."""
        found = self._made.get(key)
        if found is None or found.current:
            return found is not None
        self._drop(found)
        return False

    def _make(self, run: Sequence[_Include], api: ApiIndex, given: Sequence[str], folders: Folders) -> Beginning | None:
        """A precompiled header; None for headers that are too small for it, complain, or must not be read as they are."""
        text = b"".join(
            b'#include "%s"\n' % os.fsencode(i.place) if i.place else b"#include %s\n" % i.written.encode() for i in run
        )
        headers = reached(_BEGINNING, text, folders).headers
        if sum_of(header.size for header in headers) < LEAST or any(header.text is not None for header in headers):
            return None
        try:
            self._folder = self._folder or _passing_folder()
        except OSError:  # no place to keep anything
            return None
        base = Prelude(api).text()
        files = unsaved(standard_headers(api, None), [(BASE, base.encode()), (_BEGINNING, text)])
        arguments = ["-x", "c-header", *given[2:], "-include", BASE]
        unit = clang.parse(_BEGINNING, arguments, files, clang.WHOLE | clang.FOR_SERIALIZATION, own_only=True)
        if unit is None:
            return None
        library = clang.library()
        try:
            if any(severity >= clang.ERROR for severity in clang.severities(unit)):
                return None
            file = os.path.join(self._folder.name, f"{next(self._numbers)}.pch")
            if library.saveTranslationUnit(unit, os.fsencode(file), 0) != 0:
                return None
            read = [name for name in clang.inclusions(unit) if name not in (BASE, _BEGINNING)]
            real = {path for path in read if not path.startswith(VIRTUAL)}
            places = sorted(real | {os.path.dirname(path) for path in real})
            macros = clang.macro_names(unit) - set(api.settings["parser"].get("attribute_macros", []))
            return Beginning(0, file, tuple(read), frozenset(macros), tuple(state_of(place) for place in places))
        finally:
            library.disposeTranslationUnit(unit)


def _passing_folder() -> tempfile.TemporaryDirectory[str]:
    """A folder that goes with the process.

    Raises:
        OSError: there is no place for it.
    """
    import tempfile  # 3 ms, wanted only here

    folder = tempfile.TemporaryDirectory(prefix="robosmi-")
    if "multiprocessing" in sys.modules:  # a worker that was forked off ends without what others do at their end
        from multiprocessing.util import Finalize

        Finalize(folder, folder.cleanup, exitpriority=0)
    return folder


@kept
def _kept(process: int) -> _Kept:
    """Those of a process: one that was forked off must not share its parent's folder."""
    return _Kept()
