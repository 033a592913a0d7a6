"""Assembles the migration plan, the hub of the method, from partition, connections, port bindings and library choices.

Each decision is made by a module of its own; here they get a common trace and become one model. The digests of the inputs are
recorded, so that a stored plan can tell whether it still belongs to its sources.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from msgspec import Struct

from robosmi.diagnostics import Finding, Location
from robosmi.files.files import digest
from robosmi.metamodels import ccode, hardware, migration, platform
from robosmi.query import Q
from robosmi.recommend.ranking import Choices as EarlierChoices, Ranker
from robosmi.transform import Trace
from robosmi.transformations.knowledge.platforms.target_platform import TargetFacts, target_repository
from robosmi.transformations.m2m.adapters.adapter_choice import AdapterChoice, settle_libraries
from robosmi.transformations.m2m.choices.library_choice import LibraryModels, choose_libraries, close_idle_choices
from robosmi.transformations.m2m.choices.plan_checks import plan_checks
from robosmi.transformations.m2m.choices.stored_choices import UserChoice
from robosmi.transformations.m2m.partition.platform_dependence import Dependence, partition
from robosmi.transformations.m2m.partition.text_changes import mark_rewritten, settle_lists
from robosmi.transformations.m2m.plan_tasks import plan_findings, plan_tasks
from robosmi.transformations.m2m.ports.port_texts import explicit_enumerators, port_changes
from robosmi.transformations.m2m.widths.widths import Widened, cast_pins
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.plans.binding_edits import TRACED
from robosmi.transformations.queries.plans.retained_pins import move_facts, retained_pins, retains_platform
from robosmi.transformations.queries.ports.ports import ProgramPorts
from robosmi.transformations.queries.source_text import SourceText, words_of


class UserLibraries(Struct, frozen=True):
    """What persons chose about libraries, and how sure rules must be to choose.

    Attributes:
        libraries: component (title or `#model_index`) -> library.
        limit: the least confidence at which a rule's choice is used.
        candidates: how many libraries a decision lists.
        stored: (elementId, title) -> the user's choice in a stored plan; ranks after `libraries`.
        places: component -> the place of its choice, for messages; without choices that are in no file.
    """

    libraries: Mapping[str, str] = {}
    limit: float = 0.8
    candidates: int = 10
    stored: Mapping[tuple[str, str], UserChoice] = {}
    places: Mapping[str, Location] = {}


class Hardware(Struct, frozen=True):
    """The hardware side of a migration: the drawing's circuit, its board component, the board's connections and motors."""

    circuit: hardware.Circuit
    board: hardware.Component
    connections: Sequence[migration.Connection]
    motor_channels: Sequence[migration.MotorChannel] = ()


def judge_program(
    views: Sequence[CodeView], target: TargetFacts, choice: AdapterChoice, files: Mapping[str, bytes], look_up: Sequence[str] = ()
) -> tuple[Dependence, Trace]:
    """Decide what happens to each element of the program; returns this partition and the trace of what it was made from.

    Args:
        views: a view of each unit of the program; paths of units are relative to the models' folder.
        target: the target.
        choice: the adapters that there are.
        files: path relative to the models' folder -> bytes of what was read.
    """
    trace = Trace()
    return partition(views, target, choice, files, trace, look_up), trace


def decide_libraries(
    drawn: Hardware | None,
    board: platform.Board,
    target: TargetFacts,
    choices: UserLibraries,
    ranker: Ranker | None,
    history: EarlierChoices,
) -> tuple[list[migration.LibraryChoice], LibraryModels]:
    """The library decision of each component that a board pin reaches, and the libraries that these decisions name.

    Args:
        drawn: the hardware, or None where there is no drawing.
        board: the target board.
        target: the target.
        choices: what persons said.
        ranker: ranks libraries; None for a target that has none.
        history: earlier choices.

    Raises:
        UsageError: a choice names a component or library that does not exist.
    """
    libraries = LibraryModels(target, board)
    if drawn is None or ranker is None:
        return [], libraries
    reached = [c for c in Q(drawn.connections).collect(lambda c: c.component).distinct() if c is not None]
    made = choose_libraries(
        drawn.circuit, reached, choices.libraries, ranker, libraries, history, choices.candidates, choices.limit, choices.stored,
        choices.places,
    )  # fmt: skip
    return made, libraries


class Decided(Struct, frozen=True):
    """The decisions of a plan and their subjects, ready to be assembled.

    Attributes:
        name: the sketch's name.
        version: the tool's version.
        program: the code model.
        drawn: the hardware, or None without a drawing.
        board: the target board.
        target: the target.
        dependence: what happens to the program's elements.
        trace: the links from elements to these decisions.
        widened: the changes that keep the widths of numbers.
        fixed: whether the widths are to be kept.
        ports: the program's ports and the flow of their numbers.
        bindings: the bindings of the ports.
        choices: the choices of libraries.
        libraries: the libraries that the plan names.
        files: path relative to the models' folder -> bytes of the input.
        findings: the findings of readers and mappings.
        paths: path as the user gave it -> path in `files`.
        views: a view of each unit.
    """

    name: str
    version: str
    program: ccode.Program
    drawn: Hardware | None
    board: platform.Board
    target: TargetFacts
    dependence: Dependence
    trace: Trace
    widened: Widened
    fixed: bool
    ports: ProgramPorts
    bindings: Sequence[migration.PortBinding]
    choices: Sequence[migration.LibraryChoice]
    libraries: LibraryModels
    files: Mapping[str, bytes]
    findings: Sequence[Finding]
    paths: Mapping[str, str]
    views: Sequence[CodeView]


def _same_architecture(plan: migration.MigrationPlan) -> bool:
    """Whether the processors of the source board and of the target board have one architecture."""
    mappings = plan.source.boardMappings if plan.source is not None else ()
    boards = [*(mapping.board for mapping in mappings), plan.board]
    return len({str(b.microcontroller.architecture) for b in boards if b is not None and b.microcontroller is not None}) == 1


def put_together(
    d: Decided, check: Callable[[migration.MigrationPlan], Sequence[Finding]]
) -> tuple[migration.MigrationPlan, platform.PlatformRepository]:
    """Assemble the plan of a migration and the part of the platform models that it refers to.

    Args:
        d: the decisions; those that were part of an earlier plan are moved into this one.
        check: what is wrong with a plan that has its decisions and not yet its findings and tasks.
    """
    assert d.dependence.source is not None
    connections = list(d.drawn.connections) if d.drawn else []
    trace = Trace()
    trace.take(d.trace)
    for connection in connections:
        trace.link(
            "connector mapping", "hardware", [*connection.boardConnectors, *connection.connectors, *connection.via], [connection]
        )
    for binding in d.bindings:
        trace.link(TRACED, "hardware", [binding.element, binding.connection or binding.pin], [binding])
    for choice in d.choices:
        trace.link("library ranking", "libraries", [choice.component], [choice])
    for widening in d.widened.widenings:
        trace.link("widths", "code", [widening.element], [widening])
    words = words_of(d.files[unit.path] for unit in d.program.units)
    for name in dict.fromkeys(library for piece in d.dependence.pieces for library in piece.libraries):
        d.libraries.get(name)
    repository = target_repository(d.target, d.dependence.source, d.board, list(d.libraries.elements.values()), words)
    target = d.target.model.platform
    assert target is not None
    target.adapters.clear()
    target.adapters.extend(d.dependence.pieces)
    target.unsupportedHeaders.clear()
    target.unsupportedHeaders.extend(
        platform.UnsupportedHeader(name=header.name, reason=header.reason) for header in d.dependence.unserved
    )
    divided = any(division.loop is not None for division in d.dependence.divisions)
    plan = migration.MigrationPlan(
        name=d.name,
        toolVersion=d.version,
        structure=migration.ProgramStructure.loopForever if divided else migration.ProgramStructure.runOnce,
        program=d.program,
        circuit=d.drawn.circuit if d.drawn else None,
        source=d.dependence.source,
        target=d.target.model.platform,
        targetDescription=d.target.model,
        board=d.board,
        boardComponent=d.drawn.board if d.drawn else None,
        inputs=[
            migration.Input(
                path=path,
                digest=digest(data),
                kind="source" if _is_source(path, d.program) else "drawing",
                origin=path.rpartition("/")[2],
            )
            for path, data in d.files.items()
        ],
        dispositions=d.dependence.dispositions,
        widths=migration.Widths.fix if d.fixed else migration.Widths.keep,
        widenings=d.widened.widenings,
        concurrency=d.dependence.concurrency,
        connections=connections,
        motorChannels=list(d.drawn.motor_channels) if d.drawn else [],
        portBindings=list(d.bindings),
        libraryChoices=list(d.choices),
        adapterUses=d.dependence.adapters,
        symbolUses=d.dependence.symbols,
        helpers=d.dependence.helpers,
    )
    arrays = any(helper.name == "ports" for helper in d.dependence.helpers)
    plan.portFlows.extend(port_changes(d.ports, d.bindings, d.files, arrays=arrays, kept=retained_pins(plan)))
    cast_pins(plan.widenings, plan.portBindings)
    if retains_platform(plan):
        from robosmi.transformations.m2m.ports.port_texts import change_registers  # other programs have no such registers

        change_registers(d.views, d.bindings, d.files, _same_architecture(plan), bool(move_facts(plan).pwm_frequency))
        explicit_enumerators(plan, d.files)
    settle_libraries(plan)
    close_idle_choices(plan)
    settle_lists(plan, [SourceText(u, d.files[u.path], ()) for u in plan.program.units] if plan.program else [])
    mark_rewritten(plan)
    complete(plan, [*d.findings, *check(plan)], d.paths)
    plan.trace = trace.to_model()
    return plan, repository


def complete(plan: migration.MigrationPlan, findings: list[Finding], paths: Mapping[str, str]) -> None:
    """Derive the plan's tasks, checks and findings from its decisions."""
    plan.findings.extend(plan_findings(plan, findings, paths))
    plan.tasks.extend(plan_tasks(plan))
    plan.checks.extend(plan_checks(plan))


def _is_source(path: str, program: ccode.Program) -> bool:
    return any(unit.path == path for unit in program.units)
