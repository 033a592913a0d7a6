"""Parsing one text with libclang: arguments, virtual headers, the prelude loop, diagnostics, and the file's top level.

The result holds raw cursors as a tree of `Node`s with plain offsets (`tree`). At most three parses: the second with
declarations for undeclared names (`prelude`), the third for names that only then came to light; one more where a semicolon is
missing, which takes the place of a blank in the parser's copy (the complaint about it stays).
"""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from robosmi.transformations.t2m.c_source import clang, tree
from robosmi.transformations.t2m.c_source.prelude import Prelude
from robosmi.transformations.t2m.c_source.source import SourceText
from robosmi.transformations.t2m.platform_api import ApiIndex

VIRTUAL = "/robosmi.virtual"
HEADERS = f"{VIRTUAL}/include"
PRELUDE = f"{VIRTUAL}/prelude.h"
MAX_PARSES = 3
_MISSING_DECLARATIONS = (
    "use of undeclared identifier", "unknown type name", "use of unknown builtin", "call to undeclared", "conflicting types for",
    "type specifier missing", "redefinition of",
)  # fmt: skip


@dataclass
class Diagnostic:
    """A complaint of the parser: where in the file (-1 for elsewhere), its words, 2 warning, 3 error, 4 fatal."""

    offset: int
    message: str
    severity: int

    @property
    def syntax(self) -> bool:
        """True for a complaint about the form of the text, not about what names mean."""
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
            )
        ) or (" expected" in m and "argument" not in m and "type" not in m)


@dataclass
class Parsed:
    """A text with its tree. Give it back with `close`."""

    source: SourceText
    unit: int
    nodes: list[tree.Node]
    expansions: list[tree.Expansion]
    skipped: list[tuple[int, int]]
    inclusions: list[str]
    diagnostics: list[Diagnostic]
    first_diagnostics: list[Diagnostic]
    prelude: Prelude
    parses: int
    reader: tree.TreeReader
    cut: list[tuple[int, int]] = field(default_factory=list)

    def close(self) -> None:
        """Free the parser's memory; the nodes' cursors are dead afterwards."""
        if self.unit:
            clang.library().disposeTranslationUnit(self.unit)
            self.unit = 0


_INCLUDED = re.compile(rb"#\s*include\s*[<\"]([^>\"\n]+)[>\"]")


def _virtual_files(api: ApiIndex, source: SourceText, include_dirs: Sequence[str]) -> list[clang.UnsavedFile]:
    """The standard headers that the text can reach; each one given costs time even where it is not read."""
    headers = api.virtual_headers()
    wanted = {name.decode("latin-1") for name in _INCLUDED.findall(source.parsed)}
    folder = os.path.dirname(os.path.abspath(source.path))
    if include_dirs or any(os.path.isfile(os.path.join(folder, name)) for name in wanted):
        reached = set(headers)  # real headers may include any of them
    else:
        reached, pending = set(), [*wanted, "stdarg.h"]
        while pending:
            name = pending.pop()
            if name in headers and name not in reached:
                reached.add(name)
                pending += [n.decode("latin-1") for n in _INCLUDED.findall(headers[name])]
    return clang.unsaved({f"{HEADERS}/{name}": headers[name] for name in sorted(reached)})


def arguments(api: ApiIndex, language: str, include_dirs: Sequence[str], defines: Sequence[str]) -> list[str]:
    """The parser's arguments (research note on libclang, section 8)."""
    settings = api.settings["parser"]
    cxx = language == "C++"
    result = [
        "-x",
        "c++" if cxx else "c",
        "-std=gnu++14" if cxx else f"-std={settings['standard']}",
        "-nostdinc",
        "-target",
        settings["target"],
    ]
    result += [
        "-ferror-limit=0",
        "-Wno-everything",
        "-Wno-implicit-function-declaration",
        "-Wno-int-conversion",
        "-Wno-implicit-int",
    ]
    result += ["-Wno-incompatible-function-pointer-types", "-Wno-return-type", "-fno-spell-checking"]
    result += [f"-D{d}" for d in settings.get("defines", ())] + [f"-D{d}" for d in defines]
    result += [f"-I{os.path.abspath(d)}" for d in include_dirs]
    return [*result, "-isystem", HEADERS, "-include", PRELUDE]


def parse(source: SourceText, api: ApiIndex, include_dirs: Sequence[str], defines: Sequence[str]) -> Parsed | None:
    """Parse a text, again with declarations for what it does not declare; None when the parser gave up."""
    settings = api.settings["parser"]
    given = arguments(api, source.language, include_dirs, defines)
    path = os.path.abspath(source.path)
    fixed = _virtual_files(api, source, include_dirs)
    prelude = Prelude(api)
    if b"va_arg" in source.parsed:  # it takes a type, so it cannot be guessed as a function
        prelude.always.append("#include <stdarg.h>")
    first: list[Diagnostic] = []
    mended: list[Diagnostic] = []
    number = 0
    while True:
        number += 1
        text = prelude.text(settings.get("builtins", {}), settings.get("attribute_macros", ()))
        unit = clang.parse(path, given, [*fixed, *clang.unsaved({path: source.parsed, PRELUDE: text.encode()})])
        if unit is None:
            return None
        reader = tree.TreeReader(unit, path, len(source.parsed))
        diagnostics = _diagnostics(unit, reader)
        if number == 1:
            first = diagnostics
        messages = [d.message for d in diagnostics if d.severity >= 3]
        if number < MAX_PARSES and messages and prelude.collect(messages, source.tokens, reader.own_names):
            clang.library().disposeTranslationUnit(unit)
            continue
        gaps = [] if mended else _missing_semicolons(source, diagnostics)
        if not gaps:
            break
        mended = gaps
        source.parsed = _mend(source.parsed, [d.offset for d in gaps])
        number = min(number, MAX_PARSES - 1)
        clang.library().disposeTranslationUnit(unit)
    nodes = reader.read()
    return Parsed(
        source,
        unit,
        nodes,
        reader.expansions,
        reader.skipped(),
        clang.inclusions(unit),
        [*mended, *diagnostics],
        first,
        prelude,
        number,
        reader,
        reader.cut,
    )


def _missing_semicolons(source: SourceText, diagnostics: list[Diagnostic]) -> list[Diagnostic]:
    """Complaints about a semicolon that can be put in place of a blank, so that the next statement is not lost with it."""
    found = [d for d in diagnostics if d.offset >= 0 and d.message.startswith("expected ';'")]
    return [d for d in found if source.parsed[d.offset : d.offset + 1].isspace()]


def _mend(data: bytes, offsets: list[int]) -> bytes:
    result = bytearray(data)
    for offset in offsets:
        result[offset] = ord(";")
    return bytes(result)


def _diagnostics(unit: int, reader: tree.TreeReader) -> list[Diagnostic]:
    lib = clang.library()
    found = []
    for i in range(lib.getNumDiagnostics(unit)):
        handle = lib.getDiagnostic(unit, i)
        severity = lib.getDiagnosticSeverity(handle)
        if severity >= 3:
            offset = reader.offset(lib.getDiagnosticLocation(handle))
            found.append(Diagnostic(offset, lib.text(lib.getDiagnosticSpelling(handle)), severity))
        lib.disposeDiagnostic(handle)
    return found


def about_missing(diagnostic: Diagnostic) -> bool:
    """Whether a complaint is about a declaration that is not there, so that it says nothing against the text."""
    return diagnostic.message.startswith(_MISSING_DECLARATIONS) or diagnostic.message.endswith("file not found")
