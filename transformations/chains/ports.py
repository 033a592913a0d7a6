"""The steps of `migrate` about ports: finds the program's ports and the flow of their numbers, and binds them to pins."""

from __future__ import annotations

from collections.abc import Mapping

from robosmi.metamodels import migration, platform
from robosmi.project import Project, default_number
from robosmi.transform import Trace
from robosmi.transformations.chains.drawn import StoredDrawing
from robosmi.transformations.chains.program import StoredProgram
from robosmi.transformations.knowledge.platform_api import ApiIndex
from robosmi.transformations.m2m.conventional_ports import with_conventions
from robosmi.transformations.m2m.platform_dependence import Dependence
from robosmi.transformations.m2m.port_binding import SaidPins, bind_ports
from robosmi.transformations.m2m.stored_choices import NOTHING, StoredChoices
from robosmi.transformations.queries.port_flows import port_flows
from robosmi.transformations.queries.ports import ProgramPorts, program_ports
from robosmi.transformations.queries.split_wires import split_functions


def ports(program: StoredProgram) -> ProgramPorts:
    """The ports of the program, and the data flow of their numbers to the functions that use them."""
    return program_ports(program.views, port_flows(program.views, program.copies))


def bindings(
    program: StoredProgram,
    ports: ProgramPorts,
    api: ApiIndex,
    judgement: tuple[Dependence, Trace],
    drawing: StoredDrawing | None,
    board: platform.Board,
    bind: Mapping[str, str],
    settings: Project,
    stored: StoredChoices | None,
) -> list[migration.PortBinding]:
    """Bind each port of the program to a connection; flags precede the project file, and that precedes the stored plan.

    Raises:
        UsageError: a name is no port of the program, one port is bound to two pins, or a pin is none of the board.
    """
    source = judgement[0].source
    assert source is not None
    connections = list(drawing.hardware.connections) if drawing is not None else []
    asked = with_conventions(ports, judgement[0].adapters, program.views)
    said = (SaidPins(settings.bind, settings.places("bind", settings.bind)), SaidPins({**bind}))
    limit, kept = default_number("choices", "limit"), (stored or NOTHING).ports
    split = split_functions(judgement[0].adapters)
    return bind_ports(asked, api, source, connections, board, said, limit, kept, split)


def pins_to_choose(plan: migration.MigrationPlan) -> list[str]:
    """The possible values of a binding: all names of the board's pins, and connections."""
    pins = [name for pin in (plan.board.pins if plan.board is not None else []) for name in (pin.label, *pin.aliases)]
    return [*pins, *(connection.name for connection in plan.connections)]
