"""Parsing one text with libclang: arguments, virtual headers, the prelude loop, diagnostics, and the file's top level.

The result holds raw cursors as a tree of `Node`s with plain offsets (`tree`). There are up to three parses: the second with
declarations for undeclared names (`prelude`), the third for names that only then came to light. Where the text is damaged, some
more of a copy that is mended step by step (`error_recovery`); the complaints stay, offsets are those of the file.

`Call` runs libclang and keeps what stays the same from one parse to the next. Headers that were parsed before are loaded from
precompiled headers (`precompiled`). The compiler's own macros, the platform's or some four hundred of libclang, are left out
where nothing that is parsed has one of their names.
"""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from functools import cache

from msgspec import Struct

from robosmi.errors import TooLargeError
from robosmi.transformations.knowledge.lexer import directive_parts
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.replacements import Replacement
from robosmi.transformations.t2m.c_source.parsing import clang, tree
from robosmi.transformations.t2m.c_source.parsing.bounds import cuts
from robosmi.transformations.t2m.c_source.parsing.error_recovery import (
    MAX_ROUNDS,
    NESTED,
    Scratch,
    closed_strings,
    declared_only,
    guess,
    opening,
)
from robosmi.transformations.t2m.c_source.parsing.headers import Folders, Reached, names_by_macro, not_ordinary, reached, state_of
from robosmi.transformations.t2m.c_source.parsing.invocation import (
    PRELUDE,
    VIRTUAL,
    arguments,
    included,
    names_in,
    predefined,
    standard_headers,
    unsaved,
)
from robosmi.transformations.t2m.c_source.parsing.joined_tabs import NOT_JOINED, JoinedTabs
from robosmi.transformations.t2m.c_source.parsing.precompiled import beginning, forget
from robosmi.transformations.t2m.c_source.parsing.prelude import Prelude
from robosmi.transformations.t2m.c_source.parsing.source import ReadSource

MAX_PARSES = 3
_MISSING_DECLARATIONS = (
    "use of undeclared identifier", "unknown type name", "use of unknown builtin", "call to undeclared", "conflicting types for",
    "type specifier missing", "redefinition of",
)  # fmt: skip


class Diagnostic(Struct):
    """A diagnostic of libclang: offset in the file (-1: elsewhere), message, severity (3 error, 4 fatal), fix-its."""

    offset: int
    message: str
    severity: int
    edits: list[Replacement] = []

    @property
    def syntax(self) -> bool:
        """Whether it is a syntax error, and not about the meaning of names."""
        m = self.message
        return m.startswith(
            (
                "expected ",
                "extraneous ",
                "unexpected ",
                "unterminated ",
                "missing terminating",
                "bracket nesting",
                "invalid suffix",
                "invalid digit",
                NESTED,
            )
        ) or (" expected" in m and "argument" not in m and "type" not in m)

    @property
    def about_missing(self) -> bool:
        """Whether it reports a missing declaration or header, which is no fault of the text."""
        return self.message.startswith(_MISSING_DECLARATIONS) or self.message.endswith("file not found")


class Parsed(Struct):
    """A parsed text with its tree; `close` frees libclang's memory."""

    source: ReadSource
    unit: int
    nodes: list[tree.Node]
    expansions: list[tree.Expansion]
    skipped: list[tuple[int, int]]
    inclusions: list[str]
    diagnostics: list[Diagnostic]
    first_diagnostics: list[Diagnostic]
    prelude: Prelude
    reader: tree.TreeReader
    cut: list[tuple[int, int]] = []

    def close(self) -> None:
        """Free the parser's memory; the nodes' cursors are dead afterwards."""
        if self.unit:
            clang.library().disposeTranslationUnit(self.unit)
            self.unit = 0


def parse(
    source: ReadSource,
    api: ApiIndex,
    include_dirs: Sequence[str],
    defines: Sequence[str],
    before: Sequence[str] = (),
    joined: JoinedTabs = NOT_JOINED,
) -> Parsed | None:
    """Parse a text, again with declarations of what it does not declare; None if libclang gave up.

    Args:
        source: the text.
        api: the platform it was written for.
        include_dirs: folders with headers.
        defines: macros as on a command line.
        before: paths of files that stand before the text.
        joined: what the platform's tools add to the text; the result has nothing of it.
    """
    return _parse(source, api, Call(source, api, include_dirs, defines, before, joined.before), joined.added)


def _parse(source: ReadSource, api: ApiIndex, call: Call, added: Sequence[Replacement]) -> Parsed | None:
    first: list[Diagnostic] = []
    taken_out = [*cuts(source.path, source.parsed, source.tokens), *call.own_includes()]
    attempt = _Attempt(source, [*taken_out, *added])
    prelude = _prelude(source, api)
    number = 0
    while True:
        number += 1
        scratch = attempt.scratch
        unit = call.parse(scratch, prelude)
        if unit is None:
            return None
        reader = tree.TreeReader(unit, call.path, scratch)
        diagnostics = _diagnostics(unit, reader)
        if (doubt := _doubt(diagnostics)) and call.leave(outdated=any(d.offset < 0 and d.severity >= clang.FATAL for d in doubt)):
            clang.library().disposeTranslationUnit(unit)
            return _parse(source, api, call, added)
        if number == 1:
            first = list(diagnostics)
        else:  # a type that only comes to light when the text is mended is as unknown
            first += [d for d in diagnostics if d.message.startswith("unknown type name")]
        messages = [d.message for d in diagnostics if d.severity >= clang.ERROR]
        if attempt.names_left and messages and prelude.collect(messages, source.tokens, reader.own_names):
            attempt.names_left -= 1
        elif not attempt.next(diagnostics):
            break
        clang.library().disposeTranslationUnit(unit)
    places = {edit.start for edit in added}
    try:
        read = reader.read()
    except tree.TooDense as dense:
        clang.library().disposeTranslationUnit(unit)
        raise TooLargeError(
            f"the file has more than {dense.most:,} declarations, statements and expressions, those of macros counted each time",
            location=source.location(dense.offset),
            fix="put repeated statements into loops and functions, or leave generated code out",
        ) from None
    nodes = [node for node in read if not (node.start == node.end and node.start in places)]
    reader.cut[:0] = [(e.start, e.end) for e in taken_out]
    return Parsed(
        source,
        unit,
        nodes,
        reader.expansions,
        reader.skipped(),
        call.inclusions(unit),
        [*attempt.mended, *diagnostics],
        first,
        prelude,
        reader,
        reader.cut,
    )


def _doubt(diagnostics: list[Diagnostic]) -> list[Diagnostic]:
    """The errors that suggest that the tree would be another without the precompiled header.

    They are about made-up declarations, which come before headers or after them, about headers that were changed, or about a
    declaration that libclang has in its tree but not in its list of the file's own declarations.
    """
    return [d for d in diagnostics if _doubtful(d)]


def _doubtful(diagnostic: Diagnostic) -> bool:
    if diagnostic.message.endswith("file not found"):
        return False
    return diagnostic.offset < 0 or not diagnostic.about_missing or diagnostic.message.startswith("redefinition of")


def _prelude(source: ReadSource, api: ApiIndex) -> Prelude:
    """The prelude to begin with, before anything is known about a text."""
    prelude = Prelude(api, source.language == "C++")
    if b"va_arg" in source.parsed:  # it takes a type, so it cannot be guessed as a function
        prelude.always.append("#include <stdarg.h>")
    if _HANDLER.search(source.parsed):
        prelude.always += _HANDLERS
    return prelude


_HANDLER = re.compile(rb"\b(?:ISR|SIGNAL|EMPTY_INTERRUPT)\s*\(\s*\w+_vect\b")
_HANDLERS = (
    "#ifndef ISR",
    "#define ISR(vector, ...) void vector(void)",
    "#define SIGNAL(vector) void vector(void)",
    "#define EMPTY_INTERRUPT(vector) void vector(void) { }",
    "#endif",
)
"""What avr/interrupt.h makes of an interrupt handler, as far as a parser needs it: sketches have it without an include."""


class _Attempt:
    """The repair of one text: the copy to parse next, and the errors that were repaired so far."""

    def __init__(self, source: ReadSource, taken_out: list[Replacement]) -> None:
        self.source = source
        self.scratch = Scratch(source.parsed, taken_out)
        self.mended: list[Diagnostic] = []
        self.names_left = MAX_PARSES - 1 + 3 * (source.language == "C++")  # there names hide behind each other
        self._kept: tuple[Scratch, list[Diagnostic]] = (self.scratch, [])
        self._best: tuple[int, int, int] | None = None
        self._rounds = MAX_ROUNDS if len(source.parsed) < 300_000 else 2
        self._tried: set[tuple[Replacement, ...]] = set()
        self._before: list[Diagnostic] = []

    def next(self, diagnostics: list[Diagnostic]) -> bool:
        """Whether another copy is to be parsed, given the diagnostics of this one."""
        errors = [d for d in diagnostics if d.offset >= 0 and not d.about_missing]
        if not errors and self._best is None:
            return False
        score = _score(errors)
        if self._best is None or score < self._best:
            self._best, self._kept, self._before = score, (self.scratch, list(self.mended)), errors
        again = self._rounds > 0 and self._propose(self._kept[0], self._before)
        if again:
            self._rounds -= 1
            self.names_left = max(self.names_left, 1)
            return True
        if self.scratch is not self._kept[0]:  # the last edit made it worse
            self.scratch, self.mended = self._kept
            self._rounds = 0
            return True
        return False

    def _propose(self, base: Scratch, errors: list[Diagnostic]) -> bool:
        """Apply the next edits that were not tried yet to the copy; False if there are none."""
        fixed = [d for d in errors if d.edits]
        syntax = sorted((d for d in errors if d.syntax), key=lambda d: d.offset)
        proposals = [(fixed, [e for d in fixed for e in d.edits])] if fixed else []
        tokens = [t for t in self.source.tokens if t[0] not in ("comment", "directive")] if syntax else []
        starts = [t[1] for t in tokens]
        if not base.edits and (quotes := closed_strings(tokens)):
            proposals.insert(0, (syntax[:1], quotes))
        surplus = [d for d in syntax if d.message.startswith("extraneous closing brace")]
        for d in [*surplus[:1], *(d for d in syntax[:1] if surplus)]:
            proposals.insert(0, ([d], guess(d.message, d.offset, tokens, starts)))
        for d in syntax[:1]:
            proposals.insert(0, ([d], opening(d.offset, tokens, starts)))
        for d in syntax[:3]:
            proposals.append(([d], list(d.edits) or guess(d.message, d.offset, tokens, starts)))
        nested = [d for d in syntax if d.message.startswith(NESTED)]
        proposals.insert(0, (nested, declared_only([d.offset for d in nested], tokens)))
        for about, edits in proposals:
            key = tuple(sorted({*base.edits, *edits}))
            if edits and key not in self._tried:
                self._tried.add(key)
                scratch = Scratch(self.source.parsed, key)
                if scratch.data != base.data:
                    self.scratch, self.mended = scratch, [*self._kept[1], *about]
                    return True
        return False


def _score(errors: list[Diagnostic]) -> tuple[int, int, int]:
    """How damaged a text still is, less being better: number of syntax errors, of all errors, negated offset of the first."""
    syntax = [d.offset for d in errors if d.syntax]
    return len(syntax), len(errors), -min(syntax, default=0)


def _diagnostics(unit: int, reader: tree.TreeReader) -> list[Diagnostic]:
    lib = clang.library()
    found = []
    for i in range(lib.getNumDiagnostics(unit)):
        handle = lib.getDiagnostic(unit, i)
        severity = lib.getDiagnosticSeverity(handle)
        if severity >= clang.ERROR:
            offset = reader.offset(lib.getDiagnosticLocation(handle))
            found.append(Diagnostic(offset, lib.text(lib.getDiagnosticSpelling(handle)), severity))
            for begin, end, text in clang.fix_its(handle) if offset >= 0 else ():
                start, stop = reader.offset(begin), reader.offset(end)
                if 0 <= start <= stop:
                    found[-1].edits.append(Replacement(start, stop, text))
        lib.disposeDiagnostic(handle)
    return found


# ---- one call of libclang

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
        texts: path of one of them -> its text, where it is another than the file's.

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
        texts: Mapping[str, bytes] = NOT_JOINED.before,
    ) -> None:
        self.path = os.path.abspath(source.path)
        self._source, self._api, self._texts = source, api, texts
        self._given = arguments(api, source.language, include_dirs, defines)
        self._predefined = predefined(api)
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
            and not names_by_macro(source.parsed)
            and not not_ordinary(state_of(own))
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
        elif self._plain and self._own_macros().isdisjoint(words):
            given = [*(word for word in given if word not in self._predefined), _WITHOUT_OWN_MACROS]
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

    def own_includes(self) -> list[Replacement]:
        """Edits that remove all `#include` directives of a text that includes itself without end; an empty list otherwise."""
        if self.names is not None or not self._headers().itself:
            return []
        tokens = self._source.tokens
        return [
            Replacement(start, end, "")
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
            self._files = unsaved(headers, [*real, *self._texts.items()])
        return self._files

    def _own_macros(self) -> frozenset[str]:
        """The names of the macros that the compiler defines itself: the platform's, or libclang's."""
        platform = (word[2:].partition("=")[0] for word in self._predefined if word.startswith("-D"))
        return own_macros(tuple(self._given)).union(platform)

    def _has_no_macro_of_the_parser(self, names: frozenset[str]) -> bool:
        """Whether no name in the text, the arguments or the given header names is one of the compiler's own macros."""
        if b"##" in self._source.parsed:  # which makes names
            return False
        own = self._own_macros()
        words = {text for kind, _, _, text in self._source.tokens if kind == "name"}
        for kind, _, _, text in self._source.tokens:
            if kind == "directive":
                words.update(_WORD.findall(text))
        told = [word for word in self._given if word.startswith("-D") and word not in self._predefined]
        words.update(word for argument in told for word in _WORD.findall(argument[2:]))
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
