"""The steps of `migrate` about ports: finds the program's ports and the flow of their numbers, and binds them to pins.

Among the ports are those that libraries use by convention, without the program naming them. An adapter declares the ports it uses
on the target. These may be fewer than its function used on the source, such as no encoders for a drive that is steered without
them. A function without an adapter keeps the conventions of the platform's API.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence

from robosmi.metamodels import ccode, migration, platform
from robosmi.project import Project, default_number
from robosmi.transform import Trace
from robosmi.transformations.chains.stages.hardware_stage import StoredDrawing
from robosmi.transformations.chains.stages.program import StoredProgram
from robosmi.transformations.knowledge.board_models import table_of
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.platforms.platform_folder import platform_folder
from robosmi.transformations.knowledge.platforms.target_platform import TargetFacts, target_names
from robosmi.transformations.m2m.choices.stored_choices import NOTHING, StoredChoices
from robosmi.transformations.m2m.partition.platform_dependence import Dependence
from robosmi.transformations.m2m.ports.port_binding import UserPins, bind_ports
from robosmi.transformations.m2m.sketches.pin_proposals import NewBoard, bind_same_pins, propose_pins
from robosmi.transformations.queries.code import CodeView, unit_of
from robosmi.transformations.queries.flows.pin_uses import PinUse
from robosmi.transformations.queries.plans.bus_pins import has_usb_console
from robosmi.transformations.queries.plans.plan_adapters import closure
from robosmi.transformations.queries.ports.port_flows import port_flows
from robosmi.transformations.queries.ports.ports import Port, ProgramPorts, give_numbers, program_ports
from robosmi.transformations.queries.ports.split_wires import split_functions


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
    target: TargetFacts,
    bind: Mapping[str, str],
    settings: Project,
    stored: StoredChoices | None,
    new_board: NewBoard | None = None,
) -> list[migration.PortBinding]:
    """Bind each port of the program to a connection; flags precede the project file, and that precedes the stored plan.

    Without a drawing, pins of `new_board` are proposed for a program whose platform stays.

    Raises:
        UsageError: a name is no port of the program, one port is bound to two pins, or a pin is none of the board.
    """
    source = judgement[0].source
    assert source is not None
    connections = list(drawing.hardware.connections) if drawing is not None else []
    asked = with_conventions(ports, judgement[0].adapters, program.views)
    said = (pins_of_project(settings, target), UserPins({**bind}))
    limit, kept = default_number("choices", "limit"), (stored or NOTHING).ports
    split = split_functions(judgement[0].adapters)
    facts = table_of(platform_folder(target.platform) / "platform.toml").table("ports", needed=False).values
    made = bind_ports(asked, api, source, connections, board, said, limit, kept, split, has_usb_console(board, facts))
    if new_board is not None and drawing is None:
        propose_pins(asked.ports, made, new_board)
    elif new_board is not None:
        bind_same_pins(asked.ports, made, new_board, connections)
    return made


def pins_of_project(settings: Project, target: TargetFacts) -> UserPins:
    """The pins that a project file gives to ports for a target: those of [bind.TARGET] before those of [bind].

    A target is called by its name there, by its board's, or by that in the platform's tools.
    """
    said, places = settings.bind, settings.places("bind", settings.bind)
    if not any("." in name for name in said):
        return UserPins(said, places)
    others = {*target_names()}
    heads = {name: name.partition(".")[0] for name in said}
    of_targets = [name for name, head in heads.items() if head in others or ":" in head]
    mine = [name for name in of_targets if heads[name] in target.called]
    used = [*(name for name in said if name not in of_targets), *mine]
    keys = {name: name.partition(".")[2] if name in mine else name for name in used}
    return UserPins({keys[n]: said[n] for n in used}, {keys[n]: places[n] for n in used if n in places})


def pins_to_choose(plan: migration.MigrationPlan) -> list[str]:
    """The possible values of a binding: all names of the board's pins, and connections."""
    pins = [name for pin in (plan.board.pins if plan.board is not None else []) for name in (pin.label, *pin.aliases)]
    return [*pins, *(connection.name for connection in plan.connections)]


# ---- ports by convention

_NUMBERED = re.compile(r"_(\d+)\Z")
_DIRECTIONS = {platform.Direction.input: "in", platform.Direction.output: "out", platform.Direction.both: "both"}
"""Maps the direction of a port as an adapter declares it to the direction of a pin's use."""


def with_conventions(found: ProgramPorts, uses: Iterable[migration.AdapterUse], views: Sequence[CodeView]) -> ProgramPorts:
    """Replace the conventional ports of functions that have an adapter by those that the adapter declares.

    Args:
        found: the ports, with the conventions of the source platform.
        uses: the platform functions that are called, each with the adapter that fills it.
        views: a view of each unit.
    """
    settings = views[0].api.settings.get("ports", {})
    names, channels = settings.get("names", {}), settings.get("channels", {})
    adapted = {str(use.name): use for use in uses if use.adapter is not None}
    own = [port for port in found.ports if port.origin != "convention"]
    conventional: dict[str, Port] = {}
    for port in found.ports:
        left = [use for use in port.uses if use.function not in adapted]
        if port.origin == "convention" and left:
            conventional[port.name] = Port(port.name, port.origin, left[0].call, port.pin, [], port.what, left)
    for function, use in adapted.items():
        assert use.adapter is not None
        for needed in (port for piece in closure([use.adapter]) for port in piece.ports):
            way = _DIRECTIONS.get(needed.direction, "unknown")
            for call in _calls(use, str(needed.name), channels.get(function), views):
                known = PinUse(_number(needed), "", "convention", function, way, int(call.line), call)
                _add(conventional, needed, names, known)
    asked = give_numbers(own, list(conventional.values()), views[0].api.port_name)
    unasked = [p for p in found.ports if p.origin == "convention" and p.name not in conventional]
    return ProgramPorts([*own, *asked], found.flows, found.anything, unasked, found.shared)


def _number(port: platform.ConventionalPort) -> int | None:
    """The port's number on the source board; None for a channel of a converter, which has no pin number there."""
    return None if port.capability is platform.PinCapability.analog else int(port.number)


def _add(found: dict[str, Port], needed: platform.ConventionalPort, names: dict[str, str], use: PinUse) -> None:
    own = str(needed.name)
    name = str(names.get(own, own))
    port = found.get(name)
    if port is None:
        what = own.rpartition(".")[2].replace("_", " ")
        port = found[name] = Port(name, "convention", use.call, use.pin, what=what)
    port.conventional = port.conventional or needed
    if own != name and own not in port.names:
        port.names.append(own)
    port.uses.append(use)


def _calls(use: migration.AdapterUse, name: str, argument: int | None, views: Sequence[CodeView]) -> Iterator[ccode.Call]:
    """The calls that use a port. For a numbered port these are only the calls whose argument may be its number."""
    numbered = _NUMBERED.search(name)
    if numbered is not None and argument is None:
        return
    for call in (*use.calls, *(made for view in views for made in view.macro_calls.get(str(use.name), ()))):
        if numbered is None or argument is None or int(numbered[1]) in _values(call, argument, views):
            yield call


def _values(call: ccode.Call, argument: int, views: Sequence[CodeView]) -> set[int]:
    """The numbers that an argument may have; all channel numbers if its value is not known statically."""
    unit = unit_of(call)
    view = next((v for v in views if v.unit is unit), views[0])
    arguments = list(call.arguments)
    known = [v.number for v in view.values.of(arguments[argument])] if argument < len(arguments) else [None]
    return set(range(32)) if None in known else {n for n in known if n is not None}
