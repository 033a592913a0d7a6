"""The program's side of a migration: its files, its stored code model, and the findings in the sources alone.

The files include the program's own headers, which are read, stored and carried over with it: the headers, and included `.c`
files, that a source file or another such header includes and that no platform provides. They are searched as a C compiler does:
beside the including file, then in the given folders. A header with the name of a platform header is the program's own if its
sources define most of the functions that the platform's header declares, as the sources of a library do; else it is a copy of
the platform's.
"""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from msgspec import Struct

from robosmi import inputs
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError
from robosmi.metamodels import ccode
from robosmi.query import ancestor_of_kind
from robosmi.transformations.chains.stages.own_adapters import still_unknown
from robosmi.transformations.chains.stages.reading import read_program
from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.platforms.target_platform import CPLUSPLUS, PLAIN_C, TargetFacts
from robosmi.transformations.m2m.language.cpp_incompatibilities import remarks
from robosmi.transformations.queries.block_braces import is_torn
from robosmi.transformations.queries.code import CodeView, views
from robosmi.transformations.queries.own_headers import is_member
from robosmi.transformations.queries.reports.analysis import library_cogs, unknown_functions
from robosmi.transformations.queries.source_text import ADAPTERS_FILE, INCLUDED, is_header
from robosmi.transformations.t2m.c_source.parsing.source import stored_bytes
from robosmi.transformations.t2m.c_source.parsing.sources import source_files
from robosmi.transformations.t2m.c_source.side_file import ENDING, SideProject, adjacent_project, read_side

_ONE_OF_MANY = re.compile(rb"\b(?:inline|__inline|__inline__|weak|__weak__)\b")
"""Words of definitions that a linker accepts several of."""


class ProgramFiles(Struct, frozen=True):
    """The files of one program (sources, then its own headers), the options for reading them, and what was excluded."""

    paths: Sequence[Path]
    include_dirs: Sequence[Path]
    defines: Sequence[str]
    findings: Sequence[Finding] = ()


class StoredProgram(Struct, frozen=True):
    """A program that was read and whose units have the paths of their copies.

    Attributes:
        program: the code model.
        name: the sketch's name: that of the unit with main, as the target's tools allow it.
        views: a view of each unit.
        places: path as given -> path of the copy, relative to the models' folder.
        copies: path of the copy -> bytes.
        findings: what is found in the sources alone, and what of it the target's language refuses.
    """

    program: ccode.Program
    name: str
    views: Sequence[CodeView]
    places: Mapping[str, str]
    copies: Mapping[str, bytes]
    findings: Sequence[Finding]


def program_files(
    files: Sequence[str | Path], include_dirs: Sequence[Path], defines: Sequence[str], api: ApiIndex
) -> ProgramFiles:
    """The files of a program.

    Args:
        files: as given; a folder stands for the sources in it, `compile_commands.json` for those that it names, a project file
            of SimpleIDE for those that it lists, and a single source with such a file of its name beside it, too.
        include_dirs: folders with headers.
        defines: macros defined from outside.
        api: what is known of the source platform.

    Raises:
        SourceError: a folder holds no sources, or the compile commands or the project file cannot be read.
        UsageError: a file is given twice.
    """
    given, left_out = [Path(f) for f in files], list[Finding]()
    named = [*include_dirs, *(path if path.is_dir() else path.parent for path in given)]
    if len(given) == 1 and (side := _side_project(str(given[0]))) is not None:
        given, left_out = [Path(source) for source in side.sources], side.findings
        include_dirs = [*include_dirs, *(Path(each) for each in side.include_dirs)]
        defines = [*defines, *side.defines]
    sources = source_files(given, [str(d) for d in include_dirs], defines, api.sketch)
    folders = [Path(d) for d in dict.fromkeys(d for source in sources for d in source.include_dirs)]
    macros = list(dict.fromkeys(d for source in sources for d in source.defines))
    paths = [Path(source.path) for source in sources]
    reached = with_headers(paths, folders, api)
    outside = from_outside(reached[len(paths) :], [*named, *(path.parent for path in paths)])
    return ProgramFiles(reached, folders, macros, [*left_out, *outside])


def _side_project(path: str) -> SideProject | None:
    """The content of a SimpleIDE project file that is given, or lies beside a source and lists it; None for any other file.

    Raises:
        SourceError: it cannot be read, or lists no source.
    """
    if path.endswith(ENDING):
        return read_side(path, sourced=True)
    beside = adjacent_project(path)
    if not beside:
        return None
    made = read_side(beside)
    own = next((source for source in made.sources if os.path.realpath(source) == os.path.realpath(path)), None)
    if own is None:
        return None
    made.sources.remove(own)
    made.sources.insert(0, path)
    return made


def stored_program(files: ProgramFiles, api: ApiIndex, target: TargetFacts) -> StoredProgram:
    """Read a program as it is to be migrated and stored.

    Raises:
        SourceError: a file cannot be read as a program, there is not one function main, a macro tears it, or a file is not C and
            the target takes C alone.
    """
    program, findings = read_program(files.paths, api.name, files.include_dirs, files.defines)
    findings = [*files.findings, *findings]
    if target.language == PLAIN_C:
        _refuse_cplusplus(program, target)
    keeps = target.platform == api.name
    if keeps:
        _check_entries(program, api)
    else:
        main = _the_main(program)
        if not target.preserves_main:
            _refuse_torn(main)
    seen = views(program, api)
    for view in seen:
        findings = [*findings, *library_cogs(view), *unknown_functions(view)]
    findings = still_unknown(findings, api.adapters.index if api.adapters is not None else None)
    name = sketch_name_of(Path(program.units[0].path)) if keeps else _sketch_name(main)
    places = _store_in_place(program) if keeps else _store_units(program, target.own_headers | {ADAPTERS_FILE})
    copies = {places[str(path)]: stored_bytes(inputs.read_bytes(path, inputs.SOURCE)) for path in files.paths}
    names = {place: path for path, place in places.items()}
    findings = [*findings, *_double_definitions(program, copies, names)]
    for view in seen if target.language == CPLUSPLUS else ():
        findings = [*findings, *remarks(view, copies[view.unit.path], names[view.unit.path])]
    return StoredProgram(program, name, seen, places, copies, findings)


def _refuse_cplusplus(program: ccode.Program, target: TargetFacts) -> None:
    """Refuse a program with a file that is not C, for a target that takes C alone.

    Raises:
        SourceError: there is such a file.
    """
    for unit in program.units:
        if unit.language != PLAIN_C:
            raise SourceError(
                f"the file is {unit.language}, and the target '{target.target}' takes C alone", location=Location(unit.path),
                fix="give another --target",
            )  # fmt: skip


def _the_main(program: ccode.Program) -> ccode.Function:
    """The program's function main, of which there has to be one.

    Raises:
        SourceError: there is none, or more than one.
    """
    found = [
        (u, d)
        for u in program.units
        for d in u.declarations
        if isinstance(d, ccode.Function) and d.name == "main" and d.definition
    ]
    if not found:
        raise SourceError(
            "the program has no main function, so it cannot be migrated", location=Location(program.units[0].path),
            fix="also give the file that has main; analyse works without",
        )  # fmt: skip
    if len(found) > 1:
        unit, second = found[1]
        raise SourceError(
            f"main is defined twice: also in {found[0][0].path}:{found[0][1].line}",
            location=Location(unit.path, second.line, second.column),
            fix="give the files of one program",
        )
    return found[0][1]


def _check_entries(program: ccode.Program, api: ApiIndex) -> None:
    """Refuse a sketch that lacks one of the functions in which it begins, unless it has a main of its own.

    Raises:
        SourceError: one is missing.
    """
    defined = {d.name for u in program.units for d in u.declarations if isinstance(d, ccode.Function) and d.definition}
    unread = {str(lost.name) for unit in program.units for lost in unit.unresolved}
    missing = [name for name in ENTRIES if name not in defined | unread]
    if missing and "main" not in defined:
        raise SourceError(
            f"the sketch has no function {' and no function '.join(missing)}",
            location=Location(program.units[0].path),
            fix=f"write it, or give the sketch that has it; an empty one is enough: void {missing[0]}() {{}}",
        )


def _refuse_torn(main: ccode.Function) -> None:
    """Refuse a main that cannot be divided, since a macro writes one of its braces together with statements.

    Raises:
        SourceError: it is such a one.
    """
    if main.body is not None and is_torn(main.body):
        unit = ancestor_of_kind(main, ccode.SourceUnit)
        raise SourceError(
            "main begins or ends in a macro with more than its brace",
            location=Location(unit.path if unit is not None else "", main.line, main.column),
            fix="write the braces of main in the source, next to the statements of that macro",
        )


def _store_in_place(program: ccode.Program) -> dict[str, str]:
    """Set the paths of units and includes to those of their copies, which lie as the files do: path as given -> of the copy.

    A file outside of the first one's folder lies beside the others under its name.
    """
    places: dict[str, str] = {}
    used: set[str] = set()
    beside = os.path.dirname(os.path.realpath(program.units[0].path))
    program.includeFolders[:] = [os.path.relpath(os.path.realpath(folder), beside) for folder in program.includeFolders]
    for unit in program.units:
        within = os.path.relpath(os.path.realpath(unit.path), beside).replace(os.sep, "/")
        name = within if not within.startswith("..") else Path(unit.path).name
        number, base = 1, name
        while name.lower() in used:
            number += 1
            folder, _, last = base.rpartition("/")
            name = f"{folder}/{number}_{last}" if folder else f"{number}_{last}"
        used.add(name.lower())
        places[unit.path] = f"source/{name}"
    copies = {os.path.realpath(path): place for path, place in places.items()}
    for unit in program.units:
        unit.path = places[unit.path]
    for include in (i for unit in program.units for i in unit.includes if i.resolvedPath):
        include.resolvedPath = copies.get(os.path.realpath(include.resolvedPath), include.header)
    return places


def _store_units(program: ccode.Program, taken: Collection[str]) -> dict[str, str]:
    """Set the paths of units and includes to those of their copies; returns path as given -> path of the copy.

    A header that cannot keep its name is prefixed with `own_`, a further file of the same name gets a number; no two names
    differ only in case, since some file systems ignore it. Include folders are then relative to the first unit. A platform
    header, which is found but not copied, keeps the name in its include.
    """
    places: dict[str, str] = {}
    used: set[str] = set()
    beside = os.path.dirname(os.path.realpath(program.units[0].path))
    folders = [os.path.relpath(os.path.realpath(folder), beside) for folder in program.includeFolders]
    program.includeFolders.clear()
    program.includeFolders.extend(folders)
    for unit in program.units:
        name = Path(unit.path).name
        stem, number = f"own_{name}" if name.lower() in taken else name, 1
        name = stem
        while name.lower() in used:
            number += 1
            name = f"{number}_{stem}"
        used.add(name.lower())
        places[unit.path] = f"source/{name}"
        unit.path = places[unit.path]
    copies = {os.path.realpath(path): place for path, place in places.items()}
    for include in (i for unit in program.units for i in unit.includes if i.resolvedPath):
        include.resolvedPath = copies.get(os.path.realpath(include.resolvedPath), include.header)
    return places


def _sketch_name(main: ccode.Function) -> str:
    """The sketch's name: that of the unit with main, in letters, digits and underscores."""
    unit = ancestor_of_kind(main, ccode.SourceUnit)
    return sketch_name_of(Path(unit.path) if unit is not None else Path())


def sketch_name_of(path: Path) -> str:
    """The name of the sketch that a file with main becomes: the file's, as the target's tools allow it."""
    name = "".join(c if c.isascii() and (c.isalnum() or c == "_") else "_" for c in path.stem)
    if not name[:1].isalnum() or _RESERVED.fullmatch(name):
        name = f"sketch_{name}"
    return name[:_LONGEST_NAME]


_LONGEST_NAME = 63
"""Characters of a sketch's name in Arduino's specification of sketches."""
_RESERVED = re.compile(r"con|prn|aux|nul|com[0-9]|lpt[0-9]", re.IGNORECASE)
"""Names that Windows reserves for devices; Arduino's specification forbids them, and no such folder can be made there."""


ENTRIES = ("setup", "loop")
"""The functions in which a sketch begins (Arduino, "Sketch specification")."""
# ---- the program's own headers

OUTSIDE = "RS113"
"""The rule for a header that is taken from outside of the program's folders."""
_INCLUDE = re.compile(r'#\s*include\s*[<"]([^>"\n]+)[>"]')


def with_headers(paths: Sequence[Path], include_dirs: Sequence[Path], api: ApiIndex) -> list[Path]:
    """The files of a program, followed by its own headers that they include directly or indirectly.

    Args:
        paths: the source files.
        include_dirs: folders with headers.
        api: what is known of the source platform; its headers are not the program's.
    """
    found = list(paths)
    seen = {os.path.realpath(path) for path in paths}
    defined: set[str] | None = None
    for path in found:  # grows while it is walked
        for name in _included(path):
            if not name.lower().endswith(INCLUDED):
                continue
            places = (folder / name for folder in (path.parent, *include_dirs))
            place = next((p for p in places if p.exists() and not p.is_dir()), None)
            if place is not None:
                _check_ordinary(place, path)
            if place is not None and os.path.realpath(place) not in seen:
                if api.header_kind(name) is not None:
                    defined = _defined(paths) if defined is None else defined
                    if not _written(api.functions_of(name), defined):
                        continue
                seen.add(os.path.realpath(place))
                found.append(place)
    return found


def _check_ordinary(header: Path, includer: Path) -> None:
    """Make sure that a header is an ordinary file: a compiler would wait for a named pipe, and read a device without end.

    Raises:
        SourceError: it is none.
    """
    try:
        inputs.check_ordinary(header)
    except inputs.InputRejectedError as error:
        raise SourceError(
            f"cannot read the header '{header.name}': {error.strerror}", location=Location(str(includer)), fix=error.fix
        ) from error


def library_headers(paths: Sequence[Path], api: ApiIndex) -> list[str]:
    """The headers that a program's files include and that are neither the program's own nor known to its platform."""
    files = [Path(source.path) for source in source_files(paths, sketch=api.sketch)]
    own = {file.name for file in files}
    names = dict.fromkeys(name.rpartition("/")[2] for file in files for name in _included(file))
    return [name for name in names if name not in own and api.header_kind(name) is None]


_NAME_FOLDER = "give its folder with -I if it belongs to the program, else remove its #include"


def from_outside(
    paths: Iterable[Path], folders: Iterable[Path], fix: str = _NAME_FOLDER, severity: Severity = Severity.warning
) -> list[Finding]:
    """Says of each file of a program that lies outside of its folders that it is taken over: the user may not know of it.

    Args:
        paths: the headers that the program reaches, the drawing that its project file names, its adapter files.
        folders: those of its sources and project file, and those that the user names for headers.
        fix: what to do about such a file.
        severity: of the findings.
    """
    inside = {Path(os.path.realpath(folder)) for folder in folders}
    found = [(path, Path(os.path.realpath(path))) for path in paths]
    return [
        Finding(
            OUTSIDE, severity, f"'{real}' is outside the program's folders and is copied with it",
            Location(str(path)), fix=fix,
        )
        for path, real in found if not inside & {*real.parents}
    ]  # fmt: skip


def _written(functions: Collection[str], defined: Collection[str]) -> bool:
    """Whether most of a header's functions are defined in the program."""
    return 2 * sum(name in defined for name in functions) > len(functions)


def _defined(paths: Sequence[Path]) -> set[str]:
    """The names of the functions that source files define: names before a parameter list and a body."""
    found: set[str] = set()
    for path in paths:
        depth, name, before = 0, "", ""
        for kind, _, _, text in tokens(_read(path)):
            if kind in ("comment", "directive"):
                continue
            if text == "(" and depth == 0:
                name = before
            elif text == "{" and depth == 0 and before == ")":
                found.add(name)
            depth += (text in "({") - (text in ")}") if kind == "punct" else 0
            before = text
    return found


def _read(path: Path) -> bytes:
    """The bytes of a file; empty if it cannot be read, which its reader reports."""
    try:
        return inputs.read_bytes(path, inputs.SOURCE)
    except OSError:
        return b""


def _included(path: Path) -> list[str]:
    """The names in a file's include directives."""
    data = _read(path)
    directives = (text for kind, _, _, text in tokens(data) if kind == "directive") if b"include" in data else ()
    return [match[1].replace("\\", "/") for directive in directives if (match := _INCLUDE.match(directive))]


def _double_definitions(program: ccode.Program, copies: Mapping[str, bytes], names: Mapping[str, str]) -> Iterator[Finding]:
    """A finding RS342 for each function, and each variable with an initial value, that more than one file defines.

    No linker accepts that, on the source platform neither.

    Args:
        program: the program.
        copies: path of a unit -> its bytes.
        names: path of a unit -> the file as the user knows it.
    """
    found: dict[str, list[tuple[str, ccode.Declaration]]] = {}
    for unit in program.units:
        for declared in unit.declarations if not is_header(unit) else ():  # headers stand in the files that include them
            if _for_all_files(declared, copies[unit.path]):
                found.setdefault(str(declared.name), []).append((names[unit.path], declared))
    for name, (first, *others) in found.items():
        path, declared = first
        folder = os.path.dirname(path)
        elsewhere = [f"{os.path.relpath(other, folder or '.')}:{again.line}" for other, again in others if other != path]
        if elsewhere:
            message = f"'{name}' is also defined in {' and '.join(elsewhere)}: a linker accepts only one definition"
            place, advice = (
                Location(path, declared.line, declared.column),
                "give the files of one program, or remove one definition",
            )
            yield Finding("RS342", Severity.warning, message, place, fix=advice)


def _for_all_files(declared: ccode.Declaration, data: bytes) -> bool:
    if isinstance(declared, ccode.Function) and not is_member(declared):
        end = declared.body.startOffset if declared.body is not None else -1
    elif isinstance(declared, ccode.Variable):
        end = declared.initializer.startOffset if declared.initializer is not None else -1
    else:
        return False
    static = end < 0 or declared.storage.name == "staticStorage"
    return not static and _ONE_OF_MANY.search(data, data.rfind(b"\n", 0, declared.startOffset) + 1, end) is None
