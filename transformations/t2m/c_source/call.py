"""The calls of the parser for one text: what stays the same from one to the next, and what makes them cheap.

Headers that were parsed before are taken from there (`precompiled`). The parser's own macros, some four hundred, are left out
where nothing that is parsed has one of their names. Which calls are made is said in `parsing`.
"""

from __future__ import annotations

import os
import re
from collections.abc import Sequence

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
from robosmi.typed import kept, matches

_WORD = re.compile(r"[A-Za-z_]\w*", re.ASCII)
_WITHOUT_OWN_MACROS = "-undef"
_NOTHING = f"{VIRTUAL}/nothing.c"


class Call:
    """The calls for a text.

    Args:
        source: the text.
        api: its platform.
        include_dirs: folders with headers.
        defines: macros from outside.
        before: paths of headers that stand before the text in the file that includes it.

    Attributes:
        path: the text's, absolute.
        names: all names in the headers that the text reaches; None where it reaches others than our own.
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
        """A unit of a copy of the text; None when the parser gave up."""
        text = prelude.text()
        words = frozenset(matches(_WORD, text))
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
        """Call without a precompiled header from now on; whether there was one.

        Args:
            outdated: it is none of these headers any more, for no other text either.
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
        """The real headers that the text reaches, but for the precompiled ones."""
        if self._reached is None:
            start, text = self._beginning, self._source.parsed
            known = frozenset(start.inclusions if start is not None else ())
            self._reached = reached(self.path, text if start is None else text[start.end :], self._folders, known)
        return self._reached

    def _others(self) -> list[clang.UnsavedFile]:
        """The headers that the parser is given."""
        if not self._files:
            start, text = self._beginning, self._source.parsed
            headers = standard_headers(self._api, None)  # real headers may include any of them
            if start is not None and not included(text[start.end :]) and b"va_arg" not in text:
                headers = {name: headers[name] for name in start.standard()}
            real = [(header.path, header.text) for header in self._headers().headers if header.text is not None]
            self._files = unsaved(headers, real)
        return self._files

    def _has_no_macro_of_the_parser(self, names: frozenset[str]) -> bool:
        """Whether neither the text nor the arguments have a name of the parser's own macros, nor headers with these names."""
        if b"##" in self._source.parsed:  # which makes names
            return False
        own = own_macros(tuple(self._given))
        words = {text for kind, _, _, text in self._source.tokens if kind == "name"}
        for kind, _, _, text in self._source.tokens:
            if kind == "directive":
                words.update(matches(_WORD, text))
        words.update(word for argument in self._given if argument.startswith("-D") for word in matches(_WORD, argument[2:]))
        return bool(own) and own.isdisjoint(words) and own.isdisjoint(names)


@kept
def own_macros(given: tuple[str, ...]) -> frozenset[str]:
    """The names of the macros that the parser has by itself when it is called with these arguments; none where it gave up."""
    library = clang.library()
    unit = clang.parse(_NOTHING, [a for a in given if not a.startswith("-D")], clang.unsaved({_NOTHING: b""}))
    if unit is None:
        return frozenset()
    found = clang.macro_names(unit)
    library.disposeTranslationUnit(unit)
    return frozenset(found)
