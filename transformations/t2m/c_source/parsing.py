"""Parsing one text with libclang: arguments, virtual headers, the prelude loop, diagnostics, and the file's top level.

The result holds raw cursors as a tree of `Node`s with plain offsets (`tree`). There are up to three parses: the second with
declarations for undeclared names (`prelude`), the third for names that only then came to light. Where the text is damaged, some
more of a copy that is mended step by step (`mending`); the complaints stay, offsets are those of the file.
"""

from __future__ import annotations

from collections.abc import Sequence

from msgspec import Struct

from robosmi.transformations.knowledge.platform_api import ApiIndex
from robosmi.transformations.t2m.c_source import clang, tree
from robosmi.transformations.t2m.c_source.bounds import cuts
from robosmi.transformations.t2m.c_source.call import Call
from robosmi.transformations.t2m.c_source.mending import (
    MAX_ROUNDS,
    NESTED,
    Edit,
    Scratch,
    closed_strings,
    declared_only,
    guess,
    opening,
)
from robosmi.transformations.t2m.c_source.prelude import Prelude
from robosmi.transformations.t2m.c_source.source import ReadSource

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
    edits: list[Edit] = []

    @property
    def syntax(self) -> bool:
        """Whether it is a syntax error, and not about the meaning of names."""
        m = self.message
        return m.startswith(
            (
                "expected ",
                "extraneous ",
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
    source: ReadSource, api: ApiIndex, include_dirs: Sequence[str], defines: Sequence[str], before: Sequence[str] = ()
) -> Parsed | None:
    """Parse a text, again with declarations of what it does not declare; None if libclang gave up."""
    return _parse(source, api, Call(source, api, include_dirs, defines, before))


def _parse(source: ReadSource, api: ApiIndex, call: Call) -> Parsed | None:
    first: list[Diagnostic] = []
    taken_out = [*cuts(source.path, source.parsed, source.tokens), *call.own_includes()]
    attempt = _Attempt(source, taken_out)
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
            return _parse(source, api, call)
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
    nodes = reader.read()
    reader.cut[:0] = [(e.offset, e.offset + e.removed) for e in taken_out]
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
    return prelude


class _Attempt:
    """The repair of one text: the copy to parse next, and the errors that were repaired so far."""

    def __init__(self, source: ReadSource, taken_out: list[Edit]) -> None:
        self.source = source
        self.scratch = Scratch(source.parsed, taken_out)
        self.mended: list[Diagnostic] = []
        self.names_left = MAX_PARSES - 1 + 3 * (source.language == "C++")  # there names hide behind each other
        self._kept: tuple[Scratch, list[Diagnostic]] = (self.scratch, [])
        self._best: tuple[int, int, int] | None = None
        self._rounds = MAX_ROUNDS if len(source.parsed) < 300_000 else 2
        self._tried: set[tuple[Edit, ...]] = set()
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
                    found[-1].edits.append(Edit(start, stop - start, text.encode()))
        lib.disposeDiagnostic(handle)
    return found
