"""Calls libclang for one text, and keeps what stays the same from one parse of it to the next.

Headers that were parsed before are loaded from precompiled headers (`precompiled`). libclang's own macros, some four hundred,
are left out where nothing that is parsed has one of their names. `parsing` decides which parses are made.
"""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from functools import cache

from robosmi.transformations.knowledge.lexer import directive_parts
from robosmi.transformations.knowledge.platform_api import ApiIndex
from robosmi.transformations.t2m.c_source import clang
from robosmi.transformations.t2m.c_source.headers import Folders, Reached, reached
from robosmi.transformations.t2m.c_source.invocation import (
    PRELUDE,
    VIRTUAL,
    arguments,
    included,
    names_in,
    standard_headers,
    unsaved,
)
from robosmi.transformations.t2m.c_source.mending import Edit, Scratch
from robosmi.transformations.t2m.c_source.precompiled import beginning, forget
from robosmi.transformations.t2m.c_source.prelude import Prelude
from robosmi.transformations.t2m.c_source.source import ReadSource

_WORD = re.compile(r"[A-Za-z_]\w*", re.ASCII)
_WITHOUT_OWN_MACROS = "-undef"
_NOTHING = f"{VIRTUAL}/nothing.c"


class Call:
    """Parses copies of one text.

    Args:
        source: the text.
        api: the platform it was written for.
        include_dirs: folders with headers.
        defines: macros as on a command line, `NAME` or `NAME=VALUE`.
        before: paths of headers that stand before the text in the file that includes it.

    Attributes:
        path: absolute path of the text.
        names: all names in the headers that the text reaches; None if it includes headers from the disk.
    """

    def __init__(
        self,
        source: ReadSource,
        api: ApiIndex,
        include_dirs: Sequence[str],
        defines: Sequence[str],
        before: Sequence[str] = (),
    ) -> None:
        self.path = os.path.abspath(source.path)
        self._source, self._api = source, api
        self._given = arguments(api, source.language, include_dirs, defines)
        for header in before:
            self._given += ["-include", header]
        self._folders = Folders(include_dirs)
        self._files: list[clang.UnsavedFile] = []
        self._reached: Reached | None = None
        self._beginning = beginning(source, api, self._given, self._folders) if not before else None
        self.names: frozenset[str] | None = None
        own = os.path.dirname(self.path)
        if (
            not include_dirs
            and not before
            and not any(os.path.exists(os.path.join(own, name)) for name in included(source.parsed) if name)
        ):
            headers = standard_headers(api, source.parsed)
            self.names = frozenset[str]().union(*(names_in(header) for header in headers.values()))
            self._files = unsaved(headers)
        self._plain = self.names is not None and self._has_no_macro_of_the_parser(self.names)

    def parse(self, scratch: Scratch, prelude: Prelude) -> int | None:
        """Parse a copy of the text behind a prelude: the handle of the translation unit, None if libclang gave up."""
        text = prelude.text()
        words = frozenset(_WORD.findall(text))
        if scratch.edits or (self._beginning is not None and not self._beginning.macros.isdisjoint(words)):
            self.leave()  # an edit may lie in what is parsed already, and a macro would change what is declared
        given, data, start = [*self._given, "-include", PRELUDE], scratch.data, self._beginning
        if start is not None:
            given, data = [*given, "-include-pch", start.file], start.blank(data)
        elif self._plain and own_macros(tuple(self._given)).isdisjoint(words):
            given.append(_WITHOUT_OWN_MACROS)
        files = [*self._others(), *clang.unsaved({self.path: data, PRELUDE: text.encode()})]
        unit = clang.parse(self.path, given, files, own_only=start is not None)
        return self.parse(scratch, prelude) if unit is None and self.leave(outdated=True) else unit

    def leave(self, outdated: bool = False) -> bool:
        """Use no precompiled header from now on; False if none was used.

        Args:
            outdated: whether the precompiled header is stale, so that no other text may use it either.
        """
        start, self._beginning = self._beginning, None
        if start is None:
            return False
        self._files, self._reached = [], None
        if outdated:
            forget(start)
        return True

    def inclusions(self, unit: int) -> list[str]:
        """The paths of all files that were read, the text's own first."""
        own, *others = clang.inclusions(unit)
        return [own, *(self._beginning.inclusions if self._beginning is not None else ()), *others]

    def own_includes(self) -> list[Edit]:
        """Edits that remove all `#include` directives of a text that includes itself without end; an empty list otherwise."""
        if self.names is not None or not self._headers().itself:
            return []
        tokens = self._source.tokens
        return [
            Edit(start, end - start, b"")
            for kind, start, end, text in tokens
            if kind == "directive" and directive_parts(text)[0].startswith("include")
        ]

    def _headers(self) -> Reached:
        """The headers on the disk that the text includes, without those in the precompiled header."""
        if self._reached is None:
            start, text = self._beginning, self._source.parsed
            known = frozenset(start.inclusions if start is not None else ())
            self._reached = reached(self.path, text if start is None else text[start.end :], self._folders, known)
        return self._reached

    def _others(self) -> list[clang.UnsavedFile]:
        """The headers that are passed to libclang as texts."""
        if not self._files:
            start, text = self._beginning, self._source.parsed
            headers = standard_headers(self._api, None)  # real headers may include any of them
            if start is not None and not included(text[start.end :]) and b"va_arg" not in text:
                headers = {name: headers[name] for name in start.standard()}
            real = [(header.path, header.text) for header in self._headers().headers if header.text is not None]
            self._files = unsaved(headers, real)
        return self._files

    def _has_no_macro_of_the_parser(self, names: frozenset[str]) -> bool:
        """Whether no name in the text, the arguments or the given header names is one of libclang's predefined macros."""
        if b"##" in self._source.parsed:  # which makes names
            return False
        own = own_macros(tuple(self._given))
        words = {text for kind, _, _, text in self._source.tokens if kind == "name"}
        for kind, _, _, text in self._source.tokens:
            if kind == "directive":
                words.update(_WORD.findall(text))
        words.update(word for argument in self._given if argument.startswith("-D") for word in _WORD.findall(argument[2:]))
        return bool(own) and own.isdisjoint(words) and own.isdisjoint(names)


@cache
def own_macros(given: tuple[str, ...]) -> frozenset[str]:
    """The names of libclang's predefined macros under these arguments; empty if it gave up."""
    library = clang.library()
    without = [argument for argument in given if not argument.startswith("-D")]
    unit = clang.parse(_NOTHING, without, clang.unsaved({_NOTHING: b""}))
    if unit is None:
        return frozenset()
    found = clang.macro_names(unit)
    library.disposeTranslationUnit(unit)
    return frozenset(found)
