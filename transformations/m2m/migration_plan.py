"""The migration plan: partition, connections, port bindings and library choices put together (the hub of the method).

Each decision is made by its own module; here they are given the same trace and become one model. Inputs are recorded
with their digests, so that a stored plan can tell whether it still belongs to its sources.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from robosmi.diagnostics import Finding
from robosmi.metamodels import ccode, hardware, migration, platform
from robosmi.model.files import digest
from robosmi.query import Q
from robosmi.recommend.ranking import Choices as EarlierChoices
from robosmi.recommend.ranking import Ranker
from robosmi.transform import Trace
from robosmi.transformations.m2m.library_choice import LibraryModels, choose_libraries
from robosmi.transformations.m2m.plan_tasks import plan_findings, plan_tasks
from robosmi.transformations.m2m.platform_dependence import partition
from robosmi.transformations.m2m.port_binding import bind_ports
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.source_text import words_of
from robosmi.transformations.t2m.target_platform import TargetFacts, target_repository


@dataclass(frozen=True)
class Choices:
    """What persons said, and how far rules may go.

    Attributes:
        libraries: component (title or `#model_index`) -> library.
        bind: port of the source -> pin or mapping.
        limit: a rule's choice is taken when its confidence is at least this.
        candidates: how many libraries a decision keeps.
    """

    libraries: Mapping[str, str] = field(default_factory=dict)
    bind: Mapping[str, str] = field(default_factory=dict)
    limit: float = 0.8
    candidates: int = 10


@dataclass(frozen=True)
class Hardware:
    """The hardware side of a migration: the drawing, its board component, the connections, what was odd."""

    circuit: hardware.Circuit
    board: hardware.Component
    connections: Sequence[migration.Connection]


def make_plan(
    name: str,
    version: str,
    views: Sequence[CodeView],
    drawn: Hardware | None,
    board: platform.Board,
    target: TargetFacts,
    choices: Choices,
    ranker: Ranker | None,
    history: EarlierChoices,
    files: Mapping[str, bytes],
    findings: list[Finding],
    paths: Mapping[str, str],
) -> tuple[migration.MigrationPlan, platform.PlatformRepository]:
    """Make the plan of a migration.

    Args:
        name: the sketch's name.
        version: the tool's version.
        views: a view of each unit of the program; paths of units are relative to the models' folder.
        drawn: the hardware, or None where there is no drawing.
        board: the target board.
        target: the target.
        choices: what persons said.
        ranker: ranks libraries; None for a target that has none.
        history: earlier choices.
        files: path relative to the models' folder -> bytes of what was read.
        findings: what readers and mappings found.
        paths: path as the user gave it -> path in `files`.

    Returns:
        The plan, and the part of the platform models that it refers to.

    Raises:
        UsageError: a choice names what does not exist.
    """
    trace = Trace()
    program = views[0].program
    dependence = partition(views, target, files, trace)
    assert dependence.source is not None
    connections = list(drawn.connections) if drawn else []
    for connection in connections:
        trace.link(
            "connector mapping", "hardware", [*connection.boardConnectors, *connection.connectors, *connection.via], [connection]
        )
    bindings = bind_ports(views, dependence.source, connections, board, choices.bind, choices.limit)
    for binding in bindings:
        trace.link("port binding", "hardware", [binding.element, binding.connection], [binding])
    libraries = LibraryModels(target, board)
    library_choices = []
    if drawn is not None and ranker is not None:
        reached = [c for c in Q(connections).collect(lambda c: c.component).distinct() if c is not None]
        library_choices = choose_libraries(
            drawn.circuit, reached, choices.libraries, ranker, libraries, history, choices.candidates, choices.limit
        )
        for choice in library_choices:
            trace.link("library ranking", "libraries", [choice.component], [choice])
    words = words_of(files[unit.path] for unit in program.units)
    repository = target_repository(target, dependence.source, board, list(libraries.elements.values()), words)
    divided = any(d.loop is not None for d in dependence.divisions)
    plan = migration.MigrationPlan(
        name=name,
        toolVersion=version,
        structure=migration.ProgramStructure.loopForever if divided else migration.ProgramStructure.runOnce,
        program=program,
        circuit=drawn.circuit if drawn else None,
        source=dependence.source,
        target=target.model.platform,
        board=board,
        boardComponent=drawn.board if drawn else None,
        inputs=[
            migration.Input(
                path=path,
                digest=digest(data),
                kind="source" if _is_source(path, program) else "drawing",
                origin=path.rpartition("/")[2],
            )
            for path, data in files.items()
        ],
        dispositions=dependence.dispositions,
        connections=connections,
        portBindings=bindings,
        libraryChoices=library_choices,
        adapterUses=dependence.adapters,
        symbolUses=dependence.symbols,
    )
    complete(plan, findings, paths)
    plan.trace = trace.to_model()
    return plan, repository


def complete(plan: migration.MigrationPlan, findings: list[Finding], paths: Mapping[str, str]) -> None:
    """Derive the plan's tasks and findings from its decisions."""
    plan.findings.extend(plan_findings(plan, findings, paths))
    plan.tasks.extend(plan_tasks(plan))


def _is_source(path: str, program: ccode.Program) -> bool:
    return any(unit.path == path for unit in program.units)
