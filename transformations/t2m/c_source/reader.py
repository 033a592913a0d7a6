"""Reads C programs: files in, a code model and findings out.

The order of the steps is here, the steps are in the other modules of this package: parsing with bytes and tokens (`parsing`),
elements (`declarations`, `statements`, `expressions`, `types`, `preprocessor`, `macros`), links (`linking`), coverage and
findings (`coverage`, `checks`).

The parser breaks cycles of includes (`headers`), at which a compiler gives up. So a cycle that no include guard ends is reported
here (RS114); includes under a condition may end and are not judged.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError, TooLargeError, UsageError
from robosmi.metamodels import ccode
from robosmi.model.elements.compact_slots import collector_at_rest
from robosmi.model.elements.construct import connect
from robosmi.project import default_text
from robosmi.transformations.knowledge.api_data import SketchSettings
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.t2m.c_source import coverage, declarations, macros, preprocessor
from robosmi.transformations.t2m.c_source.context import UnitContext
from robosmi.transformations.t2m.c_source.grammar import BUILDERS
from robosmi.transformations.t2m.c_source.linking import Linker
from robosmi.transformations.t2m.c_source.parsing import checks
from robosmi.transformations.t2m.c_source.parsing.headers import guarded
from robosmi.transformations.t2m.c_source.parsing.included_before import included_before
from robosmi.transformations.t2m.c_source.parsing.invocation import HEADERS as VIRTUAL_HEADERS
from robosmi.transformations.t2m.c_source.parsing.joined_tabs import NOT_JOINED, joined_text
from robosmi.transformations.t2m.c_source.parsing.sketch import HEADERS
from robosmi.transformations.t2m.c_source.parsing.source import read_source
from robosmi.transformations.t2m.c_source.parsing.sources import Compiled, is_cplusplus_program, source_files
from robosmi.transformations.t2m.c_source.parsing.translation_unit import parse

PathLike = str | os.PathLike[str]


_LOST = frozenset({"RS101", "RS102"})
MOST_FILES = 400
"""Source files of one program: the parser takes 0.9 MB for each, however small, and what is linked is held until the end."""


def read_program(
    paths: PathLike | Iterable[PathLike],
    *,
    platform: str | None = None,
    include_dirs: Sequence[PathLike] = (),
    defines: Sequence[str] = (),
) -> tuple[ccode.Program, list[Finding]]:
    """Read the source files of one program.

    Args:
        paths: one file, or all that are compiled together; a folder stands for the sources in it, `compile_commands.json` for
            those that it names. `SourceUnit.path` is what is given here.
        platform: name of the source platform in the repository; that of the defaults if None.
        include_dirs: folders with headers, searched after the file's own.
        defines: macros from outside, `NAME` or `NAME=VALUE`.

    Returns:
        The code model with its externals, and the findings (rules RS101 to RS107, RS114) in the order of the units.

    Raises:
        SourceError: a file cannot be read or is no C.
        TooLargeError: there are more than `MOST_FILES`.
        UsageError: no file is given.
        PlatformDataError: the repository has no such platform.
        MissingToolError: libclang is not installed.
    """
    given = [paths] if isinstance(paths, (str, os.PathLike)) else list(paths)
    if not given:
        raise UsageError("no source file is given", fix="name at least one C file")
    api = ApiIndex.load(platform or default_text("migrate", "source_platform"))
    folders = [os.fspath(d) for d in include_dirs]
    contexts: list[UnitContext] = []
    files = source_files(given, folders, defines, api.sketch)
    if len(files) > MOST_FILES:
        raise TooLargeError(
            f"the program has {len(files)} source files, but the limit for one program is {MOST_FILES}",
            location=Location(os.fspath(given[0])), fix="give the files of one program, or one part at a time",
        )  # fmt: skip
    with collector_at_rest():
        try:
            units, left_out = _units(files, api, contexts)
            circles(units, contexts)
            externals = Linker(contexts, [list(unit.declarations) for unit in units]).run()
        finally:
            _close(contexts)
        program = ccode.Program(
            name=os.path.splitext(os.path.basename(units[0].path))[0],
            languages=list(dict.fromkeys(str(u.language) for u in units)),
            includeFolders=list(dict.fromkeys(folder for file in files for folder in file.include_dirs)) or folders,
            defines=list(dict.fromkeys(define for file in files for define in file.defines)) or list(defines),
            units=units,
            externals=externals,
        )
        findings = [*left_out, *(finding for context in contexts for finding in context.findings)]
        contexts.clear()  # so that the collector has not to go through tokens and cursors that nobody needs any more
    return program, findings


def _units(files: Sequence[Compiled], api: ApiIndex, contexts: list[UnitContext]) -> tuple[list[ccode.SourceUnit], list[Finding]]:
    """The units, and a finding for each file of a folder that is no source text.

    Raises:
        SourceError: a file that was named itself cannot be read, or none can.
    """
    units: list[ccode.SourceUnit] = []
    left_out: list[Finding] = []
    cplusplus = is_cplusplus_program(files)
    for file in files:
        try:
            before = preincluded(file, files, api.sketch)
            units.append(_unit(file.path, api, file.include_dirs, file.defines, contexts, before, cplusplus, file.tabs))
            if not file.tabs:
                _again_behind_others(file, api, contexts, units, cplusplus, before)
        except SourceError as error:
            if file.given or (file is files[-1] and not units):
                raise
            _close(contexts[len(units) :])
            del contexts[len(units) :]
            place = error.location or Location(file.path)
            left_out.append(Finding("RS112", Severity.warning, f"left out: {error.message}", place, fix=error.fix))
    return units, left_out


def preincluded(file: Compiled, files: Sequence[Compiled], sketch: SketchSettings | None) -> list[str]:
    """The header that the platform's tools include before a file: before a tab of a sketch, and so before a header of one.

    Args:
        file: the file.
        files: all of the program.
        sketch: the platform's settings for sketches.
    """
    joined = file.tabs or (file.path.lower().endswith(HEADERS) and any(each.tabs for each in files))
    return [f"{VIRTUAL_HEADERS}/{sketch['include']}"] if sketch is not None and joined else []


def _again_behind_others(
    file: Compiled,
    api: ApiIndex,
    contexts: list[UnitContext],
    units: list[ccode.SourceUnit],
    cplusplus: bool,
    first: Sequence[str],
) -> None:
    """Parse the last file again after the headers that are included before it, if less of its text is lost that way."""
    lost = _lost(contexts[-1])
    before = included_before(str(file.path), units[:-1]) if lost else []
    if not before:
        return
    others: list[UnitContext] = []
    before = [*first, *before]
    unit = _unit(file.path, api, file.include_dirs, file.defines, others, before, cplusplus)
    if _lost(others[-1]) < lost:
        units[-1], contexts[-1], others[-1] = unit, others[-1], contexts[-1]
    _close(others)


def _lost(context: UnitContext) -> int:
    """How many findings report text that libclang could not read."""
    return len([finding for finding in context.findings if finding.rule in _LOST])


def _close(contexts: Iterable[UnitContext]) -> None:
    """Free the parser's memory."""
    for context in contexts:
        context.parsed.close()


def read_unit(
    path: PathLike, api: ApiIndex, include_dirs: Sequence[PathLike] = (), defines: Sequence[str] = (), cplusplus: bool = False
) -> tuple[ccode.SourceUnit, list[Finding]]:
    """Read one file by itself, a header for example: what it declares, without links to what it uses from elsewhere.

    Args:
        path: the file.
        api: the platform it is for.
        include_dirs: folders with headers.
        defines: macros from outside.
        cplusplus: whether a header whose name fits both languages is C++.

    Raises:
        SourceError: the file cannot be read or is no C.
        MissingToolError: libclang is not installed.
    """
    contexts: list[UnitContext] = []
    try:
        unit = _unit(path, api, [os.fspath(d) for d in include_dirs], defines, contexts, cplusplus=cplusplus)
    finally:
        _close(contexts)
    return unit, [finding for context in contexts for finding in context.findings]


def _unit(
    path: PathLike,
    api: ApiIndex,
    folders: Sequence[str],
    defines: Sequence[str],
    contexts: list[UnitContext],
    before: Sequence[str] = (),
    cplusplus: bool = False,
    tabs: Sequence[str] = (),
) -> ccode.SourceUnit:
    source = read_source(path, cplusplus)
    joined = joined_text(source, [source if tab == source.path else read_source(tab) for tab in tabs]) if tabs else NOT_JOINED
    parsed = parse(source, api, folders, defines, [*before, *joined.before], joined)
    if parsed is None:
        raise SourceError(
            "the C parser gave up on this file: it crashed, or needed too much memory",
            location=Location(source.path),
            fix="check that it is C source text, and that its arrays fit into the source platform's memory",
        )
    context = UnitContext(parsed, api, BUILDERS, folders)
    contexts.append(context)
    checks.refuse_other_languages(parsed)
    includes, own_macros, conditionals, comments = preprocessor.read(context)
    made = declarations.group(context, parsed.nodes)
    uses = macros.uses(context)
    covered = coverage.calls(context)
    found = coverage.problems(context)
    coverage.notes(context, includes, conditionals)
    unit = ccode.SourceUnit(
        path=source.path,
        encoding=source.encoding,
        digest=source.digest,
        language=source.language,
        size=source.size,
        callsInText=covered.in_text,
        callsInModel=covered.in_model,
        includes=includes,
        macros=own_macros,
        macroUses=uses,
        declarations=made,
        comments=comments,
        conditionals=conditionals,
        unresolved=covered.unresolved,
        problems=found,
    )
    by_name = {str(macro.name): macro for macro in own_macros}
    for use in uses:
        macro = by_name.get(str(use.name))
        if macro is not None:
            connect(use, "macro", macro)
    return unit


# ---- cycles of includes

CIRCLE = "RS114"
_OPENS = ("if", "ifdef", "ifndef")


def circles(units: Sequence[ccode.SourceUnit], contexts: Sequence[UnitContext]) -> None:
    """Add a finding RS114 for each file that includes itself, directly or not, at the first include of the cycle.

    Args:
        units: the files of the program.
        contexts: the context that each was built with, in the same order; they collect the findings.
    """
    again = {
        os.path.realpath(str(unit.path)): (unit, contexts[number])
        for number, unit in enumerate(units)
        if unit.includes and not guarded(contexts[number].source.parsed)
    }
    ways = {
        place: {_meant(include, place, context.include_dirs): include for include in reversed(_always(unit))}
        for place, (unit, context) in again.items()
    }
    behind = {place: _reached(place, ways) for place in ways}
    for place, (_, context) in again.items():
        if place in behind[place]:
            together = [other for other in behind[place] if place in behind.get(other, ())]
            first = min((include for end, include in ways[place].items() if end in together), key=_start)
            _tell(context, first, sorted(os.path.basename(each) for each in together))


def _reached(place: str, ways: Mapping[str, Mapping[str, ccode.Include]]) -> set[str]:
    """The files that a file includes, directly or not."""
    found: set[str] = set()
    pending = [place]
    while pending:
        new = ways.get(pending.pop(), {}).keys() - found
        found |= new
        pending.extend(new)
    return found


def _start(element: ccode.Include | ccode.PreprocessorConditional) -> int:
    return int(element.startOffset)


def _always(unit: ccode.SourceUnit) -> list[ccode.Include]:
    """The includes of a file that are under no conditional directive."""
    turns = [(_start(each), (each.directive in _OPENS) - (each.directive == "endif")) for each in unit.conditionals]
    return [each for each in unit.includes if not sum(turn for place, turn in turns if place < _start(each))]


def _meant(include: ccode.Include, place: str, folders: Sequence[str]) -> str:
    """The path of the included file, found as a compiler does if the reader has cut the include; empty if there is none."""
    beside = [] if include.system else [os.path.dirname(place)]
    places = (os.path.join(folder, str(include.header)) for folder in (*beside, *folders))
    known = include.resolvedPath or next((each for each in places if os.path.isfile(each)), None)
    return os.path.realpath(str(known)) if known else ""


def _tell(context: UnitContext, include: ccode.Include, together: Sequence[str]) -> None:
    what = (
        "the file includes itself"
        if len(together) == 1
        else f"the include of {include.header} leads back to this file ({', '.join(together)})"
    )
    message = f"{what}, without an include guard"
    fix = "put `#pragma once` at the top of the headers, or remove the include"
    context.find(CIRCLE, Severity.error, message, _start(include), int(include.endOffset), fix)
