"""The compile check: build a sketch with a toolchain described as data, and report what came of it.

`compile_sketch` is the one entrance. It decides which sketch, toolchain and board, and looks for a board that a program fits on;
the building itself is in `build`, the form of the result in `compile_report`.
"""

from __future__ import annotations

import time
from pathlib import Path, PurePosixPath
from typing import NamedTuple

from msgspec.structs import replace

from robosmi.base.trust import acting
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import PlatformDataError, RobosmiError, SourceError, UsageError
from robosmi.inputs import read_once
from robosmi.plugins import content
from robosmi.verify.toolchains.board_check import board_findings, constant_findings, size_findings, version_finding
from robosmi.verify.toolchains.boards import Board, load_boards
from robosmi.verify.toolchains.build import Build
from robosmi.verify.toolchains.compile_report import (
    MISSING_HEADER,
    NO_BOARD_DATA,
    OTHER_BOARD,
    STAND_IN_USED,
    TOO_BIG,
    CompileReport,
)
from robosmi.verify.toolchains.libraries import LibraryFolders
from robosmi.verify.toolchains.recipes import DataRecipes, InstalledBoard, Recipes
from robosmi.verify.toolchains.sketch import Sketch, choose_board, find_sketch
from robosmi.verify.toolchains.temporary import temporary_folder
from robosmi.verify.toolchains.toolchain_data import Toolchain
from robosmi.verify.toolchains.tools import find_installed

_OFFERS = 3
_CLOCK = "f_cpu"
"""The board's value with the frequency of its processor."""


class Changed(NamedTuple):
    """What is changed in a build that is not for the board as it is.

    Attributes:
        clock_hz: the frequency of the processor; the board's if 0.
        flags: further arguments for every compile.
    """

    clock_hz: int = 0
    flags: tuple[str, ...] = ()


@read_once()
def compile_sketch(
    folder_or_sketch: Path, board: str | None = None, *, keep: Path | None = None, project: Path | None = None,
    changed: Changed | None = None,
) -> CompileReport:  # fmt: skip
    """Compile and link a sketch with the real toolchain. Nothing is written into its folder.

    Args:
        folder_or_sketch: the generated folder, the sketch's folder in it, or its main file.
        board: name or full name of a board; None takes the one of the sketch's project file.
        keep: an existing folder for the program (`.elf`, `.hex`); None keeps nothing.
        project: the project folder (see `robosmi.resources`); the current folder if None.
        changed: how the program is built otherwise than for the board; as for the board if None.

    Raises:
        SourceError: there is no sketch, its project file cannot be used, or found data that names programs is not trusted.
        UsageError: no board is called that, there are several sketches, or `keep` is no folder.
        MissingToolError: a tool or the core is not installed; its fix is the command that installs it.
        PlatformDataError: the repository's data is damaged.
    """
    started = time.perf_counter()
    if keep is not None and not keep.is_dir():
        raise UsageError("the folder for the program does not exist", location=Location(str(keep)), fix="create it first")
    with acting(project):
        return _compiled(Path(folder_or_sketch), board, keep, project, started, changed)


@read_once()
def compile_by(
    folder_or_sketch: Path, found: InstalledBoard, *, keep: Path | None = None, project: Path | None = None
) -> CompileReport:
    """Compile and link a sketch as a core builds programs for a board, whatever the sketch says; see `compile_sketch`."""
    with acting(project):
        sketch, toolchain = find_sketch(folder_or_sketch, project)
        return _compiled_by_core(sketch, found, toolchain, keep, project)


def _compiled(
    place: Path, board: str | None, keep: Path | None, project: Path | None, started: float, changed: Changed | None = None
) -> CompileReport:
    sketch, toolchain = find_sketch(place, project)
    boards = load_boards(toolchain.platform, project)
    if (found := _board_without_data(sketch, boards, toolchain, board)) is not None:
        known = _without_options(found.board, boards, toolchain)
        report = _compiled_by_core(sketch, found._replace(board=known or found.board), toolchain, keep, project)
        told = [_no_data(found.board, sketch)] if known is None else _pins_and_version(known, found, toolchain)
        report = replace(report, diagnostics=(*told, *report.diagnostics))
        return replace(report, seconds=time.perf_counter() - started)
    chosen = choose_board(sketch, boards, toolchain, board)
    if changed is not None:
        values = {**chosen.values, **({_CLOCK: str(changed.clock_hz)} if changed.clock_hz else {})}
        chosen = chosen._replace(values=values, extra_flags=(*chosen.extra_flags, *changed.flags))
    if chosen.architecture != toolchain.architecture:
        found = _by_its_core(chosen, toolchain)
        report = _compiled_by_core(sketch, found._replace(board=chosen), toolchain, keep, project)
        told = []
        if found.board.name in chosen.full_names:  # else a stand-in for any board
            told = [*_pins_and_version(chosen, found, toolchain), *size_findings(chosen, found.board)]
        report = replace(report, diagnostics=(*told, *report.diagnostics))
        return replace(report, seconds=time.perf_counter() - started)
    installed = find_installed(toolchain)
    index = LibraryFolders(toolchain, installed.core, project)

    def built(board: Board, keep: Path | None = None) -> CompileReport:
        return _build(sketch, board, toolchain, DataRecipes(toolchain, installed, board), index, keep)

    report = built(chosen, keep)
    if report.ok and not report.fits:
        alike = (board for board in boards if board.architecture == chosen.architecture)
        bigger = [board for board in alike if board.has_more_memory_than(chosen)]
        others = (built(other) for other in bigger)
        report = replace(report, fits_on=next((other.board for other in others if other.ok and other.fits), None))
        report = replace(report, diagnostics=(*report.diagnostics, _too_big(report, sketch)))
    if (made_for := _other_board(sketch, chosen, boards, toolchain)) is not None:
        report = replace(report, diagnostics=(made_for, *report.diagnostics))
    report = replace(report, diagnostics=(*board_findings(chosen, toolchain, installed), *report.diagnostics))
    diagnostics = tuple(_with_offers(finding, toolchain, project) for finding in report.diagnostics)
    return replace(report, diagnostics=diagnostics, seconds=time.perf_counter() - started)


def _by_its_core(board: Board, toolchain: Toolchain) -> InstalledBoard:
    """A board with data whose programs another core builds than that of the toolchain, as that core describes it.

    Raises:
        MissingToolError: no such core is installed, or its compiler is not.
        PlatformDataError: its data names no core.
    """
    found: InstalledBoard | None = content("query", "installed_board")(board.full_names, toolchain)
    if found is None:
        where = Location(str(board.file)) if board.file is not None else None
        message = f"no core builds for '{board.name}', whose processor is of the architecture '{board.architecture}'"
        raise PlatformDataError(
            message,
            location=where,
            fix="name in the board's file, first of its full names, the one in the core that builds for it",
        )
    return found


def _board_without_data(sketch: Sketch, boards: list[Board], toolchain: Toolchain, wanted: str | None) -> InstalledBoard | None:
    """The board of an installed core that is asked for, if it has no data here; else None."""
    given = sketch.project_file
    name = wanted if wanted is not None else given.board if given is not None else None
    if name is None or any(name in (board.name, *board.full_names) for board in boards):
        return None
    try:
        found: InstalledBoard | None = content("query", "installed_board")((name,), toolchain)
    except UsageError as error:
        if wanted is not None or given is None:
            raise
        raise SourceError(error.message, location=Location(str(given.path), given.board_line), fix=error.fix) from error
    return found


def _compiled_by_core(
    sketch: Sketch, found: InstalledBoard, toolchain: Toolchain, keep: Path | None, project: Path | None
) -> CompileReport:
    """The report for a board that is built by its core's own recipes."""
    toolchain = toolchain._replace(architecture=found.architecture)
    index = LibraryFolders(toolchain, found.recipes.core, project, bool(found.stand_in))
    report = _build(sketch, found.board, toolchain, found.recipes, index, keep)
    if report.ok and not report.fits:
        report = replace(report, diagnostics=(*report.diagnostics, _too_big(report, sketch)))
    if found.stand_in:
        why = f" ({found.lacking})" if found.lacking else ""
        message = f"the core '{found.stand_in}' is not installed{why}; compiled with a stand-in, which is only for checks"
        evidence = {"core": found.stand_in}
        used = Finding(STAND_IN_USED, Severity.info, message, Location(str(sketch.main)), fix=found.install, evidence=evidence)
        found_there = tuple(_of_the_core(finding, sketch) for finding in report.diagnostics)
        report = replace(report, stand_in_core=found.stand_in, diagnostics=(used, *found_there))
    told = (_in_the_core(finding, found.recipes.core) for finding in report.diagnostics)
    return replace(report, diagnostics=tuple(_with_offers(finding, toolchain, project) for finding in told))


def _in_the_core(finding: Finding, core: Path) -> Finding:
    """The finding; if a file of the core misses a header, with the advice to install the core again."""
    place = finding.location
    if finding.rule != MISSING_HEADER or place is None or not Path(place.path).is_relative_to(core / "cores"):
        return finding
    return replace(finding, fix="install the board's core again: a file of it is missing")


def _of_the_core(finding: Finding, sketch: Sketch) -> Finding:
    """The finding; if a library misses a header, with the advice to install the core, whose stand-in may not have it."""
    place = finding.location
    if finding.rule != MISSING_HEADER or place is None or Path(place.path).resolve().is_relative_to(sketch.folder.resolve()):
        return finding
    return replace(finding, fix=f"install the core, whose stand-in has few headers for libraries; else {finding.fix}")


def _without_options(board: Board, boards: list[Board], toolchain: Toolchain) -> Board | None:
    """The board with data that a full name with options of menus names, if its core builds its programs; else None."""
    plain, given = board.name.split(":")[:3], set(board.name.split(":", 3)[-1].split(","))
    found: list[tuple[int, Board]] = []
    for each in (each for each in boards if each.architecture != toolchain.architecture):
        for name in (name.split(":", 3) for name in each.full_names):
            if name[:3] == plain and (own := set(",".join(name[3:]).split(",")) - {""}) <= given:
                found.append((len(own), each))
    return max(found, key=lambda each: each[0])[1] if found else None


def _pins_and_version(board: Board, found: InstalledBoard, toolchain: Toolchain) -> list[Finding]:
    """What a board's file has otherwise than the core that builds its programs, but for sizes, which options may change."""
    version = version_finding(board, found.version) if found.version else []
    return [*version, *constant_findings(board, toolchain, found.recipes.core_folders)]


def _no_data(board: Board, sketch: Sketch) -> Finding:
    message = f"'{board.name}' has no data here: its pins, voltage, stack and upload are not checked"
    fix = "add the board's data: docs/how-to/add-a-target.md"
    return Finding(NO_BOARD_DATA, Severity.info, message, Location(str(sketch.main)), fix=fix)


def _other_board(sketch: Sketch, chosen: Board, boards: list[Board], toolchain: Toolchain) -> Finding | None:
    """The finding that a program bound to its board (`bound_to` of the toolchain) is compiled for another one, or None."""
    key, given = toolchain.sketch.text("bound_to", ""), sketch.project_file
    if not key or given is None or given.board is None:
        return None
    own = choose_board(sketch, boards, toolchain)
    if own.values[key] == chosen.values[key]:
        return None
    message = (
        f"the program is for '{own.name}' ({own.values[key]}) and writes its pins by ports; "
        f"on '{chosen.name}' ({chosen.values[key]}) these are other pins"
    )
    fix = f"migrate the program to {chosen.name}, or compile it for {own.name}"
    return Finding(OTHER_BOARD, Severity.warning, message, Location(str(given.path), given.board_line), fix=fix)


def _with_offers(finding: Finding, toolchain: Toolchain, project: Path | None) -> Finding:
    """The finding; if a header is missing, with the libraries that offer it for this architecture, the likeliest first."""
    if finding.rule != MISSING_HEADER:
        return finding
    try:
        header = PurePosixPath(str(finding.evidence["header"])).name
        found = content("query", "libraries_by_header")(header, toolchain.platform, project)
    except RobosmiError:
        return finding  # there is no index of libraries; the finding is true without
    built = [each for each in found if not each.architectures or {"*", toolchain.architecture} & set(each.architectures)]
    names = [each.name for each in (built or found)[:_OFFERS]]
    if not names:
        return finding
    fix = f"{finding.fix}; libraries that have it: {', '.join(repr(name) for name in names)}"
    return replace(finding, fix=fix, evidence={**finding.evidence, "libraries": names})


def _too_big(report: CompileReport, sketch: Sketch) -> Finding:
    needs = [
        f"{used if used is not None else 'more than its'} bytes of {kind}, available are {limit}"
        for kind, used, limit in (
            ("flash", report.flash_bytes, report.flash_limit),
            ("RAM", report.ram_bytes, report.ram_limit),
        )
        if limit is not None and (used is None or used > limit)
    ]
    fix = f"it fits on '{report.fits_on}': compile for that board, or make it smaller" if report.fits_on else "make it smaller"
    message = f"the program is too big for '{report.board}': it needs {' and '.join(needs)}"
    return Finding(TOO_BIG, Severity.error, message, Location(str(sketch.main)), fix=fix)


def _build(
    sketch: Sketch, board: Board, toolchain: Toolchain, recipes: Recipes, index: LibraryFolders, keep: Path | None
) -> CompileReport:
    with temporary_folder("build") as folder:
        return Build(sketch, board, toolchain, recipes, index, Path(folder)).report(keep)
