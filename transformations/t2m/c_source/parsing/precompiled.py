"""Precompiled headers for the includes that several files of a process begin with.

Parsing the vendor's headers takes most of the time of a file: a dozen lines pull in thousands. So the leading includes are kept
as libclang's precompiled header when several files begin with them, and are blanked in the copy that is parsed. The tree is the
same either way, and shorter to walk, as the index leaves out what is not of the file. Headers that cause errors, or that must
not be read as they are (`bounds`), are not kept; nor are those that were changed since, or beside which a file was put that an
include might now refer to.

It serves whoever analyses many programs with `-I` in one process, as studies do: 160 programs with the vendor's headers take
two thirds to three quarters of the time. A command that reads one file never comes to it.
"""

from __future__ import annotations

import codecs
import os
import re
import sys
from collections import Counter
from collections.abc import Sequence
from contextlib import suppress
from functools import cache
from itertools import count
from threading import Lock
from typing import TYPE_CHECKING, NamedTuple

from msgspec import Struct
from msgspec.structs import replace

from robosmi.transformations.knowledge.lexer import directive_comments, directive_parts
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.t2m.c_source.parsing import clang
from robosmi.transformations.t2m.c_source.parsing.headers import Folders, State, reached, state_of
from robosmi.transformations.t2m.c_source.parsing.invocation import HEADERS, VIRTUAL, standard_headers, unsaved
from robosmi.transformations.t2m.c_source.parsing.prelude import Prelude
from robosmi.transformations.t2m.c_source.parsing.source import ReadSource

if TYPE_CHECKING:
    import tempfile

BASE = f"{VIRTUAL}/base.h"
"""Path of the virtual prelude of a precompiled header, which does not depend on the program."""
_BEGINNING = f"{VIRTUAL}/beginning.h"
LEAST = 60_000
"""Bytes of headers below which a precompiled header saves no time."""
ENOUGH = 3
"""Files with the same leading includes after which they are precompiled; this takes as long as three parses of the headers."""
MANY = 12
"""Files after which a longer run of includes is precompiled although a shorter one is."""
MOST = 64
"""Precompiled headers kept at one time; each takes about a megabyte on the disk."""
_NAMED = re.compile(r'"([^"\n]+)"|<([^>\n]+)>')
_BLANK = bytes(byte if byte in b"\r\n" else 32 for byte in range(256))


class Beginning(Struct, frozen=True):
    """A precompiled header for the start of a text.

    Attributes:
        end: offset in the text after the last include that it replaces.
        file: path of the precompiled header.
        inclusions: paths of the headers in it, standard ones too.
        macros: names of the macros that it defines, without those of the prelude.
        states: states of these headers and of their folders when they were read.
    """

    end: int
    file: str
    inclusions: tuple[str, ...]
    macros: frozenset[str] = frozenset()
    states: tuple[State, ...] = ()

    def blank(self, text: bytes) -> bytes:
        """The text with its precompiled includes blanked; line ends stay."""
        return text[: self.end].translate(_BLANK) + text[self.end :]

    def standard(self) -> list[str]:
        """The names of the standard headers in it."""
        return [path[len(HEADERS) + 1 :] for path in self.inclusions if path.startswith(HEADERS)]

    @property
    def current(self) -> bool:
        """Whether none of its headers has changed."""
        return all(state == state_of(state[0]) for state in self.states)


def beginning(source: ReadSource, api: ApiIndex, given: Sequence[str], folders: Folders) -> Beginning | None:
    """The precompiled header for the leading includes of a text; None if there is none and it would not pay.

    There is none for C++: the list of a file's own declarations has instances of templates there, and leaves out others.

    Args:
        source: the text.
        api: the platform it was written for.
        given: the parser's arguments.
        folders: folders with headers.
    """
    run = _leading(source, api, folders) if source.language == "C" else []
    return _kept(os.getpid()).find(run, api, given, folders) if any(include.place for include in run) else None


def forget(found: Beginning) -> None:
    """Discard a precompiled header whose headers have changed."""
    _kept(os.getpid()).drop(found)


class _Include(NamedTuple):
    """An include as it is written, the header's path (empty for a standard one), and where it ends in the text."""

    written: str
    place: str
    end: int


def _leading(source: ReadSource, api: ApiIndex, folders: Folders) -> list[_Include]:
    """The leading includes of a text, up to the first whose header is missing."""
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
    """Whether a directive contains a comment that is never closed, which libclang reports."""
    comments = [directive[start:end] for start, end in directive_comments(directive)]
    return any(text.startswith("/*") and (len(text) < 4 or not text.endswith("*/")) for text in comments)


class _Kept:
    """The precompiled headers of one process, in a folder that is deleted with it."""

    def __init__(self) -> None:
        self._seen: Counter[object] = Counter()
        self._made: dict[object, Beginning | None] = {}
        self._folder: tempfile.TemporaryDirectory[str] | None = None
        self._numbers = count()
        self._lock = Lock()

    def find(self, run: Sequence[_Include], api: ApiIndex, given: Sequence[str], folders: Folders) -> Beginning | None:
        """The longest prefix of these includes that is precompiled, or that is now worth it."""
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
            return replace(found, end=run[kept].end)

    def drop(self, found: Beginning) -> None:
        """Discard a precompiled header."""
        with self._lock:
            self._drop(found)

    def _drop(self, found: Beginning) -> None:
        self._made = {key: one for key, one in self._made.items() if one is None or one.file != found.file}
        with suppress(OSError):
            os.unlink(found.file)

    def _current(self, key: object) -> bool:
        """Whether there is a precompiled header under this key that is not stale."""
        found = self._made.get(key)
        if found is None or found.current:
            return found is not None
        self._drop(found)
        return False

    def _make(self, run: Sequence[_Include], api: ApiIndex, given: Sequence[str], folders: Folders) -> Beginning | None:
        """Precompile headers; None if they are too small for it, cause errors, or must not be read as they are."""
        text = b"".join(
            b'#include "%s"\n' % os.fsencode(i.place) if i.place else b"#include %s\n" % i.written.encode() for i in run
        )
        headers = reached(_BEGINNING, text, folders).headers
        if sum(header.size for header in headers) < LEAST or any(header.text is not None for header in headers):
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
    """A temporary folder that is deleted at the end of the process.

    Raises:
        OSError: there is no place for it.
    """
    import tempfile  # 3 ms, wanted only here

    folder = tempfile.TemporaryDirectory(prefix="robosmi-")
    if "multiprocessing" in sys.modules:  # a worker that was forked off ends without what others do at their end
        from multiprocessing.util import Finalize

        Finalize(folder, folder.cleanup, exitpriority=0)
    return folder


@cache
def _kept(process: int) -> _Kept:
    """The precompiled headers of a process, by its id: a forked process must not share its parent's folder."""
    return _Kept()
