"""The chain `migrate`: a program and a drawing to a migration plan, and from it to a sketch (the paper's four steps).

`plan_migration` stops at the plan; `migrate` goes on and writes. The order in which choices count is the contract's:
flag, project file, history, rule above the limit; what is left stays open.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from robosmi import __version__, inputs
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError, UsageError
from robosmi.metamodels import ccode, platform
from robosmi.metamodels import hardware as hw
from robosmi.plugins import content
from robosmi.project import Project, defaults, project_of
from robosmi.query import ancestor_of_kind
from robosmi.recommend.history import ForgivingHistory
from robosmi.transformations.chains.earlier import history_findings
from robosmi.transformations.chains.local_headers import with_headers
from robosmi.transformations.chains.models import MigrationModels
from robosmi.transformations.chains.output import Generated, produce, remember
from robosmi.transformations.chains.reading import check_source_platform, read_drawing, read_program
from robosmi.transformations.constraints.code_rules import move_findings
from robosmi.transformations.m2m.connector_mapping import keep_apart
from robosmi.transformations.m2m.language_gap import remarks
from robosmi.transformations.m2m.migration_plan import Choices, Hardware, make_plan
from robosmi.transformations.queries.analysis import library_cogs, unknown_functions
from robosmi.transformations.queries.circuit import the_board
from robosmi.transformations.queries.code import views
from robosmi.transformations.queries.plan import library_json
from robosmi.transformations.t2m.c_source.sources import source_files
from robosmi.transformations.t2m.platform_api import ApiIndex
from robosmi.transformations.t2m.target_platform import TargetFacts, target_facts


def plan_migration(
    files: Sequence[str | Path],
    *,
    project: Project | None = None,
    hardware: str | Path | None = None,
    target: str | None = None,
    source_platform: str | None = None,
    include_dirs: Sequence[Path] = (),
    defines: Sequence[str] = (),
    libraries: Mapping[str, str] | None = None,
    bind: Mapping[str, str] | None = None,
    history: str | None = None,
) -> MigrationModels:
    """Make the plan of a migration, with the models it refers to.

    Args:
        files: source files of one program; a folder stands for those in it, `compile_commands.json` for those that it names.
        project: the project file; the one beside the first source if None.
        hardware: drawing of the new hardware; the project file's if None.
        target: target board.
        source_platform: platform that the program was written for.
        include_dirs: folders with headers.
        defines: macros defined from outside.
        libraries: component -> library, before the project file.
        bind: port of the source -> target pin, before the project file.
        history: place of earlier choices, a file or a URL; the user's own if None.

    Raises:
        SourceError: an input cannot be read or used.
        UsageError: a choice names what does not exist.
    """
    given = [Path(f) for f in files]
    project = project if project is not None else project_of(given[0])
    sources = source_files(given, [str(d) for d in include_dirs], defines)
    paths = [Path(source.path) for source in sources]
    include_dirs = [Path(d) for d in dict.fromkeys(d for source in sources for d in source.include_dirs)]
    defines = list(dict.fromkeys(d for source in sources for d in source.defines))
    platform_name = source_platform or project.source_platform or defaults()["migrate"]["source_platform"]
    facts = target_facts(target or project.target or defaults()["migrate"]["target"])
    drawing_path = Path(hardware) if hardware is not None else project.hardware
    check_source_platform(platform_name)
    api = ApiIndex.load(platform_name)
    paths = with_headers(paths, include_dirs, api)
    program, findings = read_program(paths, platform_name, include_dirs, defines)
    main = _the_main(program)
    seen = views(program, api)
    for view in seen:
        findings = [*findings, *library_cogs(view), *unknown_functions(view)]
    drawn, board, stored = None, None, {}
    places = _store_units(program)
    for path in paths:
        stored[places[str(path)]] = inputs.read_bytes(path, inputs.SOURCE)
    names = {place: path for path, place in places.items()}
    for view in seen:
        findings = [*findings, *remarks(view, stored[view.unit.path], names[view.unit.path])]
    if drawing_path is not None:
        drawing = read_drawing(drawing_path, project.roles, facts.board)
        component = the_board(drawing.circuit)
        board = drawing.board_models.get(component.elementId)
        _check_board(component, board, facts, drawing_path)
        drawn = Hardware(drawing.circuit, component, drawing.connections)
        findings = [*findings, *drawing.findings]
        declared = {d.name for view in seen for d in (*view.of_kind(ccode.Declaration), *view.unit.macros)}
        findings += keep_apart(drawing.connections, declared, Location(str(drawing_path)))
        places[str(drawing_path)] = f"source/{drawing_path.name}"
        drawing.circuit.path = places[str(drawing_path)]
        stored[drawing.circuit.path] = inputs.read_bytes(drawing_path, inputs.DRAWING)
    else:
        findings = [
            *findings,
            Finding("RS210", Severity.info, "no drawing was given: ports and libraries stay open", fix="give --hardware SKETCH"),
        ]
    settings = defaults()
    choices = Choices(
        {**project.libraries, **(libraries or {})},
        {**project.bind, **(bind or {})},
        settings["choices"]["limit"],
        settings["rank"]["candidates"],
    )
    if choices.libraries and drawn is None:
        raise UsageError("a library is chosen for a component, but there is no drawing", fix="give --hardware SKETCH")
    ranker = None
    if facts.libraries:
        ranker = content("ranker", settings["rank"]["ranker"])(facts.libraries, architecture=facts.architecture)
    elif choices.libraries:
        raise UsageError(
            f"the target '{facts.target}' has no libraries, and one is chosen", fix="leave out the choice of a library"
        )
    earlier = ForgivingHistory(history)
    findings = [*findings, *history_findings(earlier)]
    plan, repository = make_plan(
        _sketch_name(main), __version__, seen, drawn, board or facts.board_model, facts, choices, ranker,
        earlier, stored, findings, places,
    )  # fmt: skip
    plan.findings.extend(move_findings(plan, seen))
    return MigrationModels(plan, program, drawn.circuit if drawn else None, repository, stored, {v: k for k, v in places.items()})


def migrate(
    files: Sequence[str | Path],
    output: str | Path,
    *,
    dry_run: bool = False,
    strict: bool = False,
    adapters: str | None = None,
    project: Project | None = None,
    hardware: str | Path | None = None,
    target: str | None = None,
    source_platform: str | None = None,
    include_dirs: Sequence[Path] = (),
    defines: Sequence[str] = (),
    libraries: Mapping[str, str] | None = None,
    bind: Mapping[str, str] | None = None,
    history: str | None = None,
    ask: Callable[[Sequence[Mapping[str, Any]]], Mapping[str, str]] | None = None,
) -> Generated:
    """Migrate a program: plan, generate, write.

    Args:
        files: source files of one program.
        output: the output folder.
        dry_run: write nothing.
        strict: stop when a choice is open.
        adapters: `placeholders`; bodies (`filled`) are not there yet.
        project, hardware, target, source_platform, include_dirs, defines, libraries, bind, history: see
            `plan_migration`; what persons chose is recorded there, too.
        ask: asks a person: open choices (`libraries[]` of the contract) -> component -> library; None to ask nobody.

    Raises:
        SourceError: an input cannot be read or used, or the output cannot be written.
        UsageError: a choice names what does not exist.
        StoppedError: a choice is open under `strict`, or a person's edit would be lost.
    """
    if adapters == "filled":
        raise UsageError(
            "adapters with bodies are not part of this version", fix="leave out --adapters, or give --adapters placeholders"
        )

    def planned(said: Mapping[str, str]) -> MigrationModels:
        return plan_migration(
            files, project=project, hardware=hardware, target=target, source_platform=source_platform, include_dirs=include_dirs,
            defines=defines, libraries=said, bind=bind, history=history,
        )  # fmt: skip

    models = planned(libraries or {})
    left = [library_json(choice) for choice in models.plan.libraryChoices if choice.open]
    if ask is not None and left and (answers := ask(left)):
        models = planned({**(libraries or {}), **answers})
    made = produce(models, Path(output), dry_run=dry_run, strict=strict)
    remember(made, history)
    return made


def _check_board(component: hw.Component, board: platform.Board | None, facts: TargetFacts, path: Path) -> None:
    """Refuse a drawn board that nothing is known of, or that is not the target's.

    Raises:
        SourceError: it is one of these.
    """
    what = f"the board '{component.title}'"
    if board is None:
        raise SourceError(
            f"nothing is known of {what} ({component.partTitle or component.partId})",
            location=Location(str(path)), fix=f"use a board of the target '{facts.target}' there",
        )  # fmt: skip
    if board.name != facts.board and not facts.any_board:
        raise SourceError(
            f"{path.name} has {what} ({board.title}), the target is '{facts.target}'",
            location=Location(str(path)), fix=f"give --target {board.name}, or the hardware of the target '{facts.target}'",
        )  # fmt: skip


def _the_main(program: ccode.Program) -> ccode.Function:
    """The one function that is run.

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
            "there is no function main, so nothing can be migrated", location=Location(program.units[0].path),
            fix="give the file that has main, too; analyse works without",
        )  # fmt: skip
    if len(found) > 1:
        unit, second = found[1]
        raise SourceError(
            f"main is defined twice: also in {found[0][0].path}:{found[0][1].line}",
            location=Location(unit.path, second.line, second.column),
            fix="give the files of one program",
        )
    return found[0][1]


def _store_units(program: ccode.Program) -> dict[str, str]:
    """Give units, and includes of them, the paths of their copies; path as given -> path of the copy.

    Include folders are then as seen from the first unit. A header that was found and is not copied, a platform's, keeps the name
    by which it is included.
    """
    places: dict[str, str] = {}
    beside = os.path.dirname(os.path.realpath(program.units[0].path))
    folders = [os.path.relpath(os.path.realpath(folder), beside) for folder in program.includeFolders]
    program.includeFolders.clear()
    program.includeFolders.extend(folders)
    for unit in program.units:
        name = Path(unit.path).name
        stem, number = name, 1
        while f"source/{name}" in places.values():
            number += 1
            name = f"{number}_{stem}"
        places[unit.path] = f"source/{name}"
        unit.path = places[unit.path]
    copies = {os.path.realpath(path): place for path, place in places.items()}
    for include in (i for unit in program.units for i in unit.includes if i.resolvedPath):
        include.resolvedPath = copies.get(os.path.realpath(include.resolvedPath), include.header)
    return places


def _sketch_name(main: ccode.Function) -> str:
    """The sketch's name: that of the unit with main, as the target's tools allow it (letters, digits, underscores)."""
    unit = ancestor_of_kind(main, ccode.SourceUnit)
    stem = Path(unit.path).stem if unit is not None else ""
    name = "".join(c if c.isascii() and (c.isalnum() or c == "_") else "_" for c in stem)
    return name if name[:1].isalnum() else f"sketch_{name}"
