"""Provides the adapter files of a migration, and checks that the user's own adapters compile.

Built-in adapters were compiled when they were written. An own one is compiled separately with the pieces it needs, if the
target's toolchain is installed; otherwise errors appear at `compile`.
"""

from __future__ import annotations

import re
import tempfile
from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import Path

from robosmi import inputs
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import MissingToolError, PlatformDataError, SourceError, did_you_mean
from robosmi.metamodels import migration, platform
from robosmi.project import FILE_NAME, Project
from robosmi.transformations.knowledge.adapters.adapter_data import adapter_paths
from robosmi.transformations.knowledge.adapters.adapter_files import MARK
from robosmi.transformations.knowledge.adapters.adapter_index import BUILT_IN, OWN, AdapterIndex, adapter_index
from robosmi.transformations.knowledge.adapters.adapter_model import adapter_element
from robosmi.transformations.knowledge.adapters.adapter_records import AdapterPiece
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.platforms.target_platform import TargetFacts, target_facts
from robosmi.transformations.m2m.adapters.adapter_choice import AdapterChoice
from robosmi.transformations.m2t.adapter_text import adapter_text
from robosmi.transformations.queries.plans.adapter_needs import AdapterPieces
from robosmi.transformations.queries.plans.port_pins import UNBOUND
from robosmi.transformations.queries.reports.analysis import UNKNOWN
from robosmi.transformations.queries.signature_text import split_signature

_UNKNOWN = re.compile(r"['‘](\w+)['’] (?:was not declared|undeclared)|implicit declaration of function ['‘](\w+)['’]")
_MISSING_HEADER = "RS803"
"""The rule for a header that the compiler does not find."""
_FIRST_STATEMENT = 3
"""Distance in lines from the end of the pieces' text to the first statement of `setup`."""
_C_HEAD = """#include <{header}>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#define AVR_PIN(port, bit) (((port) - 'A') * 8 + (bit))
#define AVR_ADC(channel) (100 + (channel))
"""
_PROGRAMS = {
    "C": (_C_HEAD, "int main(void) {\n{setup}return 0; }\n", "check.c", "Makefile"),
    "C++": ("#include <{header}>\n", "void setup() {\n{setup}}\nvoid loop() {}\n", "check.ino", ""),
}
"""For each language of a target: the text before and after the pieces, the file name, and the required project file."""


def adapter_files_of(settings: Project, target: TargetFacts, api: ApiIndex) -> AdapterIndex:
    """The adapter files for a target, those beside the project file first.

    Raises:
        PlatformDataError: a file beside the project file is wrong or is named like no header, so that it would never be used.
    """
    beside = settings.path.parent if settings.path is not None else None
    index = adapter_index(target.platform, api.name, beside=beside, language=target.language)
    index.check_those_of("project")
    return index


def still_unknown(findings: Iterable[Finding], index: AdapterIndex | None) -> list[Finding]:
    """The findings about a program, without those about unknown headers and functions for which the user keeps adapters.

    Args:
        findings: of the program, with what they are about as their evidence.
        index: the adapter files of the target; None where they are not asked.

    Raises:
        PlatformDataError: an adapter file cannot be read, or says something wrong.
    """

    def known(finding: Finding) -> bool:
        if index is None or finding.rule not in UNKNOWN:
            return False
        header, function = finding.evidence.get("header", ""), finding.evidence.get("function", "")
        return header in index.own_headers() or index.own_adapter(str(function)) is not None

    return [finding for finding in findings if not known(finding)]


def unread_adapters(settings: Project, folders: Iterable[Path]) -> list[Finding]:
    """A warning about a folder of adapter files beside a program that is ignored: without a project file, or under another name.

    Args:
        settings: of the project.
        folders: where the program's files lie.
    """
    without_project = settings.path is None
    found = []
    for folder in dict.fromkeys(folders):
        for name in (OWN, *_OTHER_NAMES) if without_project else _OTHER_NAMES:
            paths = adapter_paths(folder / name) if (folder / name).is_dir() else []
            if any(MARK.encode() in inputs.read_bytes(path, inputs.DATA) for path in paths):
                fix = [f"rename it to '{OWN}'"] if name != OWN else []
                fix += [f"make an empty {FILE_NAME} there"] if without_project else []
                why = f"there is no {FILE_NAME} beside the folder" if name == OWN else f"their folder is not called '{OWN}'"
                message, place = f"the adapter files are not read: {why}", Location(str(folder / name))
                found.append(Finding("RS529", Severity.warning, message, place, fix=", and ".join(fix)))
    return found


_OTHER_NAMES = ("adapter", "adaptor", "adaptors")


def project_files(choice: AdapterChoice) -> list[Path]:
    """The adapter files beside the project file that a plan uses."""
    pieces = (piece for piece in choice.chosen_pieces if choice.index.owner_of(piece) == "project")
    return [*dict.fromkeys(Path(piece.location.path) for piece in pieces)]


def check_own_adapters(choice: AdapterChoice, target: TargetFacts, board: platform.Board) -> list[Finding]:
    """Compile the own adapters that a plan uses.

    Returns:
        A warning where they cannot be compiled now: a found folder names the programs, and nobody has trusted it.

    Args:
        choice: the adapters of the plan.
        target: the target.
        board: its board.

    Raises:
        PlatformDataError: one does not compile, at its place in its file, or declares a library of which it includes nothing.
    """
    own = [piece for piece in choice.chosen_pieces if choice.index.owner_of(piece) != BUILT_IN]
    _check_libraries(own, choice, target)
    _check_results(own, choice.api)
    _check_timers(own, board)
    if not own or target.language not in _PROGRAMS:
        return []
    try:
        fault = first_fault(own, choice.pieces, choice.mcu, target, board)
    except SourceError as error:
        message = f"the text of your own adapters was not compiled: {error.message}"
        return [Finding("RS539", Severity.warning, message, own[0].location, fix=error.fix)]
    if fault is not None:
        piece, finding = fault
        raise PlatformDataError(
            f"the text of '{piece.name}' does not compile: {finding.message}",
            location=finding.location,
            fix=_fix(finding.message, piece, choice.pieces),
        )
    return []


def _check_timers(own: Iterable[AdapterPiece], board: platform.Board) -> None:
    """Refuse a timer that the board's microcontroller lacks.

    Raises:
        PlatformDataError: at the piece; conflicts over such a timer could not be detected.
    """
    timers = [str(timer.name) for timer in board.microcontroller.timers] if board.microcontroller is not None else []
    for piece in own:
        for timer in piece.timers:
            if timers and timer not in timers:
                raise PlatformDataError(
                    f"'{piece.name}' takes the timer '{timer}', and '{board.title}' has: {', '.join(timers)}"
                    f"{did_you_mean(timer, timers)}",
                    location=piece.location, fix="name one of these, or say with `mcu:` for which microcontrollers the piece is",
                )  # fmt: skip


def _check_libraries(own: Iterable[AdapterPiece], choice: AdapterChoice, target: TargetFacts) -> None:
    """Refuse a declared library none of whose headers the piece, or a piece it needs, includes.

    Raises:
        PlatformDataError: at the piece; the sketch would require a library that it does not use.
    """
    for piece in own:
        needed = choice.pieces.needed([(piece.header, piece.name)], choice.mcu).pieces if piece.libraries else ()
        for name in piece.libraries:
            included = [header for each in needed if name in each.libraries for header in each.includes]
            if included and any(name in _offering(header, target) for header in included):
                continue
            others = f", and {', '.join(included)} is none" if included else ""
            own_header = _header_of(name, target)
            raise PlatformDataError(
                f"'{piece.name}' declares the library '{name}', and its text includes no header of it{others}",
                location=piece.location,
                fix=f"add `{MARK}   include: <{own_header}>` to its markers, or take `library: {name}` out; nothing was written",
            )


def _check_results(own: Iterable[AdapterPiece], api: ApiIndex) -> None:
    """Refuse a piece that returns no value for a function that does, or the other way round.

    Raises:
        PlatformDataError: at the piece; calls that use the result would not compile.
    """
    for piece in own:
        known = [api.signature(piece.name, entry) for entry in api.entries(piece.name) if entry.header == piece.header]
        nothing = {_gives_nothing(signature) for signature in known}
        if known and piece.signatures and not any(_gives_nothing(signature) in nothing for signature in piece.signatures):
            raise PlatformDataError(
                f"'{piece.name}' is for '{piece.signatures[0]}', and {piece.header} declares '{known[0]}'",
                location=piece.location,
                fix=f"write `{MARK}   for: {known[0]}`, and let the text give the same; nothing was written",
            )


def _gives_nothing(signature: str) -> bool:
    return split_signature(signature)[0].strip() == "void"


def _offering(header: str, target: TargetFacts) -> list[str]:
    """The libraries that provide an included header."""
    from robosmi.transformations.knowledge.libraries.library_ranking import (
        libraries_by_header,  # most programs have no own adapters
    )

    if not target.libraries:
        return []
    return [library.name for library in libraries_by_header(_bare(header), target.libraries)]


def _header_of(name: str, target: TargetFacts) -> str:
    """The header of a library that programs include."""
    from robosmi.transformations.knowledge.libraries.library_ranking import library_index

    library = library_index(target.libraries).library_named(name) if target.libraries else None
    return library.header if library is not None else "HEADER.h"


def _bare(header: str) -> str:
    """The file name of a header, given as in an include or as a path."""
    return header.strip().strip('<>"').rpartition("/")[2]


def first_fault(
    own: Sequence[AdapterPiece], known: AdapterPieces, mcu: str, target: TargetFacts, board: platform.Board
) -> tuple[AdapterPiece, Finding] | None:
    """The first of some pieces that does not compile, and the compiler's message with its line.

    Args:
        own: the pieces.
        known: all pieces that there are.
        mcu: name of the microcontroller.
        target: the target.
        board: its board.

    Returns:
        None where all compile, and where there is no compiler to ask.

    Raises:
        SourceError: the folder with the data that names the compiler is not trusted, or the machine let the compiler down.
    """
    pieces = known.needed([(piece.header, piece.name) for piece in own], mcu).pieces
    text = adapter_text([adapter_element(piece) for piece in pieces], {}, UNBOUND)
    setup = [(piece, str(statement)) for piece in pieces for statement in piece.setup]
    try:
        wrong = _errors(text, [statement for _, statement in setup], target, board)
    except MissingToolError:
        return None
    for finding in wrong:
        lost = _bare(finding.message.partition(":")[0]) if finding.rule == _MISSING_HEADER else ""
        includer = next((each for each in own if lost and any(_bare(header) == lost for header in each.includes)), None)
        if includer is not None and not _offering(lost, target):
            message = f"'{lost}', which it includes, is neither installed nor a header of a known library"
            return includer, Finding(finding.rule, finding.severity, message, includer.location)
        at = (finding.location.line or 0) - text.count("\n") - _FIRST_STATEMENT if finding.location is not None else -1
        if 0 <= at < len(setup) and setup[at][0] in own:
            message = f"'{setup[at][1]}' of its setup: {finding.message}"
            return setup[at][0], Finding(finding.rule, finding.severity, message, setup[at][0].location)
        piece, line = _piece_at(pieces, text, finding.location.line if finding.location is not None else None)
        if piece is not None and piece in own:
            return piece, Finding(finding.rule, finding.severity, finding.message, Location(piece.location.path, line))
    return None


def fault_of_saved(
    files: Mapping[Path, str], saved: Collection[tuple[str, str]], folder: Path, plan: migration.MigrationPlan
) -> tuple[str, str, str] | None:
    """Compile the user's adapter bodies before they are saved for later programs.

    Args:
        files: the adapter files as they would be written.
        saved: header and function of each body.
        folder: where they go; other files that are there may be needed.
        plan: the plan of the program that the bodies were written in.

    Returns:
        Header and function of the first body that does not compile, and what the compiler says; None where all do.

    Raises:
        SourceError: as for `first_fault`.
    """
    assert plan.board is not None
    assert plan.source is not None
    assert plan.targetDescription is not None
    target = target_facts(str(plan.targetDescription.name))
    if target.language not in _PROGRAMS:
        return None
    with tempfile.TemporaryDirectory() as place:
        copy = Path(place) / OWN
        for path in adapter_paths(folder) if folder.is_dir() else ():
            _put(copy / path.relative_to(folder), inputs.read_text(path, inputs.DATA))
        for path, text in files.items():
            _put(copy / path.relative_to(folder), text)
        index = adapter_index(target.platform, str(plan.source.name), beside=Path(place), language=target.language)
        chip = plan.board.microcontroller
        known = AdapterPieces(index, architecture=str(chip.architecture) if chip is not None else "")
        here = [piece for piece in known if Path(piece.location.path).is_relative_to(copy)]
        own = [piece for piece in here if piece.kind == "adapter" and (piece.header, piece.name) in saved]
        mcu = str(chip.name) if chip is not None else ""
        fault = first_fault(own, known, mcu, target, plan.board)
    return (fault[0].header, fault[0].name, fault[1].message) if fault is not None else None


def _put(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def _errors(text: str, setup: Iterable[str], target: TargetFacts, board: platform.Board) -> list[Finding]:
    """The compiler's errors for a text of adapters; lines count from its first line."""
    from robosmi.verify.toolchains.toolchain import compile_sketch  # most programs have no own adapters

    head, tail, name, project = _PROGRAMS[target.language]
    start = head.replace("{header}", target.include)
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place) / "check"
        folder.mkdir()
        end = tail.replace("{setup}", "".join(f"{statement}\n" for statement in setup))
        (folder / name).write_text(f"{start}{text}\n{end}", encoding="utf-8")
        if project:
            (folder / project).write_text(f"BOARD := {board.name}\n", encoding="utf-8")
        report = compile_sketch(folder, str(board.name))
    found = []
    for each in report.diagnostics:
        if each.severity is Severity.error and each.location is not None and Path(each.location.path).name == name:
            line = (each.location.line or 0) - start.count("\n")
            found.append(Finding(each.rule, each.severity, each.message, Location(each.location.path, line)))
    return found


def _piece_at(pieces: Sequence[AdapterPiece], text: str, line: int | None) -> tuple[AdapterPiece | None, int]:
    """The piece that contains a line of the text, and the corresponding line of the piece's file."""
    lines, at = text.split("\n"), 0
    for piece in pieces:
        own = piece.text.split("\n")
        at = next(number for number in range(at, len(lines)) if lines[number : number + len(own)] == own)
        if line is not None and at < line <= at + len(own):
            return piece, _first_line(piece) + line - at - 1
        at += len(own)
    return None, 0


def _first_line(piece: AdapterPiece) -> int:
    """The line of its file in which a piece's text begins."""
    rows = inputs.read_text(Path(piece.location.path), inputs.DATA).split("\n")
    first = piece.location.line or 1
    while first < len(rows) and (rows[first].startswith(MARK) or not rows[first].strip()):
        first += 1
    return first + 1


def _fix(message: str, piece: AdapterPiece, pieces: AdapterPieces) -> str:
    """The advice for an error; if another piece's name is missing, that the piece needs it."""
    missed = _UNKNOWN.search(message)
    name = next((each for each in missed.groups() if each), "") if missed is not None else ""
    key = pieces.key(name, piece.header) if name else None
    if key is None:
        return "correct it, then run again; nothing was written"
    needed = key[1] if key[0] == piece.header else "/".join(key)
    return f"add `{MARK}   needs: {needed}` to its markers; nothing was written"
