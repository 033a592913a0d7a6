"""The chain `migrate`: a program and a drawing to a migration plan, and from it to a sketch (the paper's four steps).

`migration_chain` says which steps there are: each is a function whose parameters name what it reads. `plan_migration` stops at
the plan; `migrate` goes on and writes. What a front end is answered is given to the same run, which does again what depends on
it. The order in which choices count is the contract's: flag, project file, the plan that is in the output folder, history, rule
above the limit; what is left stays open. docs/how-to/change-a-step.md shows how to put another function in a step's place.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from robosmi import __version__
from robosmi.chain import Chain
from robosmi.chain.run import ChainRun, Progress
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import UsageError
from robosmi.files.commit import again_when_changed
from robosmi.files.external_files import ExternalFiles
from robosmi.files.recovery import recover
from robosmi.inputs import read_once
from robosmi.metamodels import ccode, migration, platform
from robosmi.plugins import content
from robosmi.project import Project, default_number, default_text, project_of
from robosmi.recommend.history import ForgivingHistory
from robosmi.resources import project_of_input
from robosmi.transform import Trace
from robosmi.transformations.chains.library_steps import history_findings, library_decisions, make_ranker, previous_choices
from robosmi.transformations.chains.retained_program import RetainedProgram, new_board, retained_program
from robosmi.transformations.chains.source_board import SourceBoard, find_source_board
from robosmi.transformations.chains.stages.constraint_sets import added_findings
from robosmi.transformations.chains.stages.edited_plan import import_choices
from robosmi.transformations.chains.stages.hardware_stage import StoredDrawing, stored_drawing
from robosmi.transformations.chains.stages.models import MigrationModels
from robosmi.transformations.chains.stages.moving import Moving, merged_choices
from robosmi.transformations.chains.stages.output import Generated, produce, remember
from robosmi.transformations.chains.stages.own_adapters import (
    adapter_files_of,
    check_own_adapters,
    project_files,
    unread_adapters,
)
from robosmi.transformations.chains.stages.ports import bindings, pins_of_project, pins_to_choose, ports
from robosmi.transformations.chains.stages.program import (
    ProgramFiles,
    StoredProgram,
    from_outside,
    library_headers,
    program_files,
    stored_program,
)
from robosmi.transformations.chains.stages.reading import check_source_platform, platform_of_files
from robosmi.transformations.chains.stages.sources import remember_sources
from robosmi.transformations.chains.stages.widths import FIX, KEEP, widened
from robosmi.transformations.constraints.code_rules import move_findings
from robosmi.transformations.constraints.electrical_plan import plan_faults
from robosmi.transformations.constraints.plan_ports import port_faults
from robosmi.transformations.knowledge.adapters.adapter_index import AdapterPins
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.platforms.target_platform import TargetFacts, target_facts
from robosmi.transformations.m2m.adapters.adapter_choice import adapter_choice, set_console_wait
from robosmi.transformations.m2m.choices.library_choice import LibraryModels
from robosmi.transformations.m2m.choices.stored_choices import NOTHING, StoredChoices, differences
from robosmi.transformations.m2m.circuits.connector_mapping import rename_clashes
from robosmi.transformations.m2m.circuits.driven_devices import drawn_kinds, set_rest_levels, set_servo_trims
from robosmi.transformations.m2m.migration_plan import Decided, UserLibraries, judge_program, put_together
from robosmi.transformations.m2m.partition.platform_dependence import Dependence
from robosmi.transformations.m2m.plan_tasks import plan_findings, settle_tasks
from robosmi.transformations.m2m.ports.port_texts import looked_up
from robosmi.transformations.m2m.widths.widths import Widened, lost_findings, text_findings
from robosmi.transformations.queries.library_pins import LibraryPins
from robosmi.transformations.queries.plans.plan import binding_json, library_json
from robosmi.transformations.queries.plans.plan_adapters import emitted
from robosmi.transformations.queries.ports.ports import ProgramPorts
from robosmi.transformations.queries.record_members import outside_members

GIVEN = (
    "files", "project", "hardware", "target_name", "source_platform", "include_dirs", "defines", "libraries", "bind", "history",
    "adapters", "widths",
)  # fmt: skip
"""The values that a migration gets from outside; `migration_chain` says what each is used for."""


def migration_chain() -> Chain:
    """The steps from what is given to the models of a migration, the value `models`.

    A step can be replaced by its name (`Chain.replace`) with a function of whatever values it needs that returns the same.
    """
    chain = Chain(None, "migrate")
    chain.given(*GIVEN, from_board=None, ranker_name=None, bench=False, stored=None)
    chain.call(settings, makes="settings", step="read the project file")
    chain.call(target, makes="target", step="look up the target")
    chain.call(source_board, makes="source_board", step="look up the source board")
    chain.call(source_api, makes="api", step="look up the source platform")
    chain.call(files_of_program, makes="program_files", step="find the program's files")
    chain.call(program, makes="program", step="read the program")
    chain.call(drawing, makes="drawing", step="read the drawing")
    chain.call(board, makes="board", step="look up the board")
    chain.call(choices, makes="choices", step="collect the libraries that persons chose")
    chain.call(make_ranker, makes="ranker", step="load the ranker")
    chain.call(previous_choices, makes="earlier", step="open the history")
    chain.call(ports, makes="ports", step="follow the program's ports")
    chain.call(retained_program, makes="kept", step="find what behaves differently on another board")
    chain.call(judgement, makes="judgement", step="judge the program's elements")
    chain.call(widenings, makes="widenings", step="keep the widths of numbers")
    chain.call(new_board, makes="new_board", step="look up the pins of the new board")
    chain.call(bindings, makes="bindings", step="bind ports to pins")
    chain.call(library_decisions, makes="library_decisions", step="choose libraries")
    chain.call(models, makes="models", step="put the plan together")
    return chain


# ---- the steps


def settings(files: Sequence[str | Path], project: Project | None) -> Project:
    """The project file: the one given, else the one beside the first source."""
    return project if project is not None else project_of(Path(files[0]))


def source_api(
    files: Sequence[Path],
    source_platform: str | None,
    settings: Project,
    target: TargetFacts,
    source_board: SourceBoard | None,
) -> ApiIndex:
    """What is known of the platform that the program was written for, with its board, or with the pins that adapters declare.

    Raises:
        UsageError: there is no such platform, or its programs cannot be moved to the target.
    """
    api = ApiIndex.load(_source_platform(files, source_platform, settings))
    name = api.name
    if target.platform == name:
        here = api.on_board(source_board.pins) if source_board is not None else api
        return here.adapted(LibraryPins(library_headers([Path(file) for file in files], api), target.libraries))
    if api.sketch is not None:
        raise UsageError(
            f"programs of '{name}' cannot be moved to the target '{target.target}', whose platform is '{target.platform}'",
            fix="give a board of the same platform as --target; robosmi targets lists them",
        )
    return api.adapted(AdapterPins(adapter_files_of(settings, target, api)))


def _source_platform(files: Sequence[Path], source_platform: str | None, settings: Project) -> str:
    name = source_platform or settings.source_platform or platform_of_files([Path(file) for file in files])
    check_source_platform(name)
    return name


def source_board(
    files: Sequence[Path], source_platform: str | None, from_board: str | None, settings: Project, target: TargetFacts
) -> SourceBoard | None:
    """The board that the program runs on today; None on a platform that does not tell its boards apart.

    Raises:
        UsageError: there is no such platform or board.
    """
    api = ApiIndex.load(_source_platform(files, source_platform, settings))
    return find_source_board([Path(file) for file in files], api, from_board or settings.source_board, target.target)


def files_of_program(
    files: Sequence[str | Path],
    include_dirs: Sequence[Path],
    defines: Sequence[str],
    api: ApiIndex,
    source_board: SourceBoard | None,
) -> ProgramFiles:
    """The files of the program, with the macros of its board; see `program_files`."""
    of_board = source_board.defines if source_board is not None else ()
    return program_files(files, include_dirs, [*of_board, *defines], api)


def target(target_name: str | None, settings: Project) -> TargetFacts:
    """The target.

    Raises:
        UsageError: there is no such target.
    """
    return target_facts(target_name or settings.target or default_text("migrate", "target"))


def program(program_files: Any, api: ApiIndex, target: TargetFacts) -> StoredProgram:
    """The program as it is stored.

    Raises:
        SourceError: it cannot be read, has not one function main, or is in a language that the target does not take.
    """
    return stored_program(program_files, api, target)


_COPY = "check it before you give the output folder away, or put a copy of it into the project's folder"
"""What to do about a drawing or an adapter file from outside of the project."""


def drawing(hardware: str | Path | None, settings: Project, target: TargetFacts, program: StoredProgram) -> StoredDrawing | None:
    """The drawing in its stored form, its connections renamed apart from the program's names; None if none is given.

    Raises:
        SourceError: it cannot be read, or has another board than the target's.
    """
    path = Path(hardware) if hardware is not None else settings.hardware
    if path is None:
        return None
    made = stored_drawing(path, settings.roles, target)
    if hardware is None and settings.path is not None:
        made.findings.extend(from_outside([path], [settings.path.parent], _COPY, Severity.info))
    declared = {d.name for view in program.views for d in view.of_kind(ccode.Declaration) if isinstance(d, ccode.Declaration)}
    declared |= {macro.name for view in program.views for macro in view.unit.macros}
    made.findings.extend(rename_clashes(made.hardware.connections, declared, Location(str(path))))
    return made


def choices(
    libraries: Mapping[str, str],
    settings: Project,
    drawing: StoredDrawing | None,
    target: TargetFacts,
    stored: StoredChoices | None,
) -> UserLibraries:
    """The libraries that persons chose, flags before the project file and that before the stored plan, and how far rules may go.

    Raises:
        UsageError: a library is chosen, and there is no drawing or the target has no libraries.
    """
    if libraries and not target.libraries:
        raise UsageError(f"the target '{target.target}' has no libraries to choose", fix="remove the choice")
    said = {**settings.libraries, **libraries} if target.libraries else {}
    kept = (stored or NOTHING).libraries if target.libraries else {}
    places = settings.places("libraries", [name for name in settings.libraries if name not in libraries])
    made = UserLibraries(said, default_number("choices", "limit"), int(default_number("rank", "candidates")), kept, places)
    if made.libraries and drawing is None:
        raise UsageError("a library is chosen for a component, but no drawing is given", fix="give --hardware SKETCH")
    return made


def board(drawing: StoredDrawing | None, target: TargetFacts) -> platform.Board:
    """The board of the plan: the drawn one, or else the target's."""
    return drawing.board if drawing is not None else target.board_model


def judgement(
    program: StoredProgram,
    api: ApiIndex,
    target: TargetFacts,
    board: platform.Board,
    ports: ProgramPorts,
    adapters: str | None,
    widths: str | None,
    settings: Project,
    drawing: StoredDrawing | None,
    kept: RetainedProgram | None,
) -> tuple[Dependence, Trace]:
    """What happens to each element of the program (paper 3.1), and which adapters fill its calls.

    Raises:
        UsageError: adapters are neither filled nor placeholders.
        PlatformDataError: an adapter file is wrong, or an adapter that the user keeps does not compile.
    """
    if kept is not None:
        return kept.judged
    how = adapters or default_text("migrate", "adapters")
    target.reserve_names_of(board)
    index = api.adapters.index if api.adapters is not None else None
    files = index if index is not None else adapter_files_of(settings, target, api)
    members, calls = outside_members(program.views), {name for view in program.views for name in view.called()}
    narrow = target.model.platform is not None and int(target.model.platform.intBits) < int(api.settings["int_bits"])
    wired = drawing.hardware if drawing is not None else None
    drawn = drawn_kinds(wired.connections, wired.motor_channels) if wired is not None else ()
    choice = adapter_choice(files, api, board, how, widened=narrow and widths != KEEP, members=members, calls=calls, drawn=drawn)
    known = api.settings.get("ports", {}).get("look_up", {})
    look_up = [str(known[name]) for name in looked_up(ports) if name in known]
    judged = judge_program(program.views, target, choice, program.copies, look_up)
    judged[0].findings += check_own_adapters(choice, target, board)
    if settings.path is not None:
        judged[0].findings += from_outside(project_files(choice), [settings.path.parent], _COPY)
    return judged


def widenings(
    program: StoredProgram,
    program_files: ProgramFiles,
    judgement: tuple[Dependence, Trace],
    api: ApiIndex,
    target: TargetFacts,
    widths: str | None,
    kept: RetainedProgram | None,
) -> Widened:
    """The changes by which the program's numbers keep the widths that they have on the source."""
    if kept is not None:
        return Widened()
    return widened(program, program_files, judgement[0], api, target, widths)


def models(
    program: StoredProgram,
    drawing: StoredDrawing | None,
    board: platform.Board,
    target: TargetFacts,
    judgement: tuple[Dependence, Trace],
    widenings: Widened,
    widths: str | None,
    ports: ProgramPorts,
    bindings: Sequence[migration.PortBinding],
    library_decisions: tuple[Sequence[migration.LibraryChoice], LibraryModels],
    earlier: ForgivingHistory,
    settings: Project,
    bench: bool,
    bind: Mapping[str, str],
    libraries: Mapping[str, str],
    stored: StoredChoices | None,
    source_board: SourceBoard | None,
    kept: RetainedProgram | None,
) -> MigrationModels:
    """The plan with its findings and tasks, and the models that it refers to."""
    places, files, findings = {**program.places}, {**program.copies}, [*program.findings]
    findings += source_board.findings if source_board is not None else []
    if drawing is not None:
        set_rest_levels(drawing.hardware.connections)
        set_servo_trims(drawing.hardware.connections, bindings, settings.servos)
        findings += drawing.findings
        places[drawing.given] = drawing.copy
        files.update(drawing.files)
    else:
        left = "ports and libraries stay open" if kept is None else "what the new board is wired to is not known"
        findings.append(Finding("RS210", Severity.info, f"no drawing given: {left}", fix="give --hardware SKETCH"))
    if settings.libraries and not target.libraries:
        message = f"the target '{target.target}' has no libraries; the project file's libraries are for other targets"
        findings.append(Finding("RS412", Severity.info, message, Location(str(settings.path))))
    findings += lost_findings(widenings, list(program.program.units), program.copies)
    findings += text_findings(widenings, list(program.program.units), program.copies)
    findings += history_findings(earlier)
    findings += judgement[0].findings
    findings += unread_adapters(settings, (Path(given).parent for given in program.places))
    decided = Decided(
        program.name, __version__, program.program, drawing.hardware if drawing is not None else None, board, target,
        *judgement, widenings, widths != KEEP, ports, bindings, *library_decisions, files, findings, places,
        program.views,
    )  # fmt: skip
    plan, repository = put_together(decided, lambda made: [*plan_faults(made), *port_faults(made)])
    plan.bench = bench
    if settings.console_wait_ms is not None:
        set_console_wait(emitted(plan), settings.console_wait_ms)
    said_pins = pins_of_project(settings, target).pins
    flags, project = {"bind": bind, "libraries": libraries}, {"bind": said_pins, "libraries": settings.libraries}
    if kept is not None:
        from robosmi.transformations.m2m.sketches.retained_platform import place_findings  # loaded for such programs already

        plan.findings.extend(plan_findings(plan, place_findings(kept.left, plan, files), places))
        settle_tasks(plan)
    plan.findings.extend(move_findings(plan, program.views))
    plan.findings.extend(plan_findings(plan, added_findings(plan), places))
    circuit = drawing.hardware.circuit if drawing is not None else None
    notes = differences(plan, flags, project, settings.path, stored or NOTHING)
    return MigrationModels(plan, program.program, circuit, repository, files, {v: k for k, v in places.items()}, notes)


# ---- from outside


def plan_migration(
    files: Sequence[str | Path],
    *,
    project: Project | None = None,
    hardware: str | Path | None = None,
    target: str | None = None,
    source_platform: str | None = None,
    source_board: str | None = None,
    include_dirs: Sequence[Path] = (),
    defines: Sequence[str] = (),
    libraries: Mapping[str, str] | None = None,
    bind: Mapping[str, str] | None = None,
    adapters: str | None = None,
    history: str | None = None,
    widths: str = FIX,
    ranker: str | None = None,
    bench: bool = False,
    progress: Progress | None = None,
    chain: Chain | None = None,
) -> MigrationModels:
    """Make the plan of a migration, with the models it refers to.

    Args:
        files: source files of one program; a folder stands for those in it, `compile_commands.json` for those that it names.
        project: the project file; the one beside the first source if None.
        hardware: drawing of the new hardware; the project file's if None.
        target: target board.
        source_platform: platform that the program was written for.
        source_board: board that the program runs on today; if None that of the project file, of its drawing, or the usual one.
        include_dirs: folders with headers.
        defines: macros defined from outside.
        libraries: component -> library, before the project file.
        bind: port of the source -> target pin, before the project file.
        adapters: `filled` or `placeholders`; what the defaults say if None.
        history: place of earlier choices, a file or a URL; the user's own if None.
        widths: `fix` writes the text so that numbers keep the widths of the source, `keep` leaves it as it is.
        ranker: name of the ranker of libraries; the project file's, or else what the defaults say, if None.
        bench: make a sketch that tries one component at a time, too.
        progress: told of each step.
        chain: steps of one's own, which make `models` of what is given; `migration_chain()` if None.

    Raises:
        SourceError: an input cannot be read or used.
        UsageError: a choice names what does not exist.
    """
    run = _started(
        chain, progress, files=files, project=project, hardware=hardware, target_name=target, source_platform=source_platform,
        from_board=source_board, include_dirs=include_dirs, defines=defines, libraries=libraries or {}, bind=bind or {},
        adapters=adapters, history=history, widths=widths, bench=bench, ranker_name=ranker, stored=NOTHING,
    )  # fmt: skip
    with project_of_input(files[0]), read_once():
        return run.value("models", MigrationModels)


def _started(chain: Chain | None, progress: Progress | None, **values: Any) -> ChainRun:
    return (chain if chain is not None else migration_chain()).start(progress=progress, **values)


@again_when_changed
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
    source_board: str | None = None,
    include_dirs: Sequence[Path] = (),
    defines: Sequence[str] = (),
    libraries: Mapping[str, str] | None = None,
    bind: Mapping[str, str] | None = None,
    history: str | None = None,
    widths: str = FIX,
    ranker: str | None = None,
    bench: bool = False,
    ask: Callable[[Sequence[Mapping[str, Any]]], Mapping[str, str]] | None = None,
    ask_ports: Callable[[Sequence[Mapping[str, Any]], Sequence[str]], Mapping[str, str]] | None = None,
    verify: bool = False,
    moved: Moving | None = None,
    outside: Callable[[], ExternalFiles] | None = None,
    progress: Progress | None = None,
    chain: Chain | None = None,
) -> Generated:
    """Migrate a program: plan, generate, write.

    Args:
        files: source files of one program.
        output: the output folder.
        dry_run: write nothing.
        strict: stop when a choice is open.
        project, hardware, target, source_platform, source_board, include_dirs, defines, libraries, bind, adapters, history,
            widths, ranker, bench, progress, chain: see `plan_migration`; what persons chose is recorded there, too.
        ask: asks the user: open choices (`libraries[]` of the contract) -> component -> library; None to ask nobody.
        ask_ports: the same for ports: open ones (`bindings[]` of the contract), what may be answered -> port -> pin.
        verify: compare what was made with the original at the end; the verdict is a finding of the plan.
        moved: the plan for another board that this one is made from.
        outside: asked, once persons have answered, for the files elsewhere that belong to the run; see `produce`.

    Raises:
        SourceError: an input cannot be read or used, or the output cannot be written.
        UsageError: a choice names what does not exist.
        StoppedError: a choice is open under `strict`, or the user's edit would be lost.
    """
    if not dry_run:
        recover(Path(output))  # what a killed run has begun there may be a change of the project file, too
    chosen, adopted = dict(libraries or {}), import_choices(Path(output))
    stored = adopted.choices if moved is None else merged_choices(adopted.choices, moved.carried.choices)
    run = _started(
        chain, progress, files=files, project=project, hardware=hardware, target_name=target, source_platform=source_platform,
        from_board=source_board, include_dirs=include_dirs, defines=defines, libraries=chosen, bind=bind or {}, adapters=adapters,
        history=history, widths=widths, bench=bench, ranker_name=ranker, stored=stored,
    )  # fmt: skip
    with project_of_input(files[0]):
        with read_once():
            models = run.value("models", MigrationModels)
            left = [library_json(choice) for choice in models.plan.libraryChoices if choice.open]
            if ask is not None and left and (answers := ask(left)):
                run.give(libraries={**chosen, **answers})
                models = run.value("models", MigrationModels)
            ports_left = [binding_json(b) for b in models.plan.portBindings if b.open]
            if ask_ports is not None and ports_left and (pins := ask_ports(ports_left, pins_to_choose(models.plan))):
                run.give(bind={**(bind or {}), **pins})
                models = run.value("models", MigrationModels)
        if moved is not None:
            moved.finish(models.plan)
        models.notes += adopted.notes
        beyond = outside() if outside is not None else {}
        run_name = f"migrate {' '.join(Path(file).absolute().name for file in files)}"
        made = produce(models, Path(output), inputs=adopted.inputs, outside=beyond, dry_run=dry_run, strict=strict, run=run_name)
    if made.written and (moved is None or not moved.copied):
        told: dict[str, Any] = {
            "hardware": Path(hardware) if hardware is not None else None,
            "include_dirs": [Path(each) for each in include_dirs],
        }
        told |= {
            "target": target,
            "source_platform": source_platform,
            "source_board": source_board,
            "defines": list(defines),
            "adapters": adapters,
            "ranker": ranker,
        }
        if moved is not None:
            told |= {"moved_from": moved.place, "hardware": Path(hardware) if hardware and moved.table is None else None}
        remember_sources(Path(output), models.plan, models.places, files, {**told, "widths": widths, "bench": bench})
    remember(made, history)
    return content("chain", "with_verdict")(made, strict=strict) if verify and made.written else made
