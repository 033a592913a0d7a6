"""Operations on circuits and their connections, in the manner of EOL: boards, components by name, port interfaces, report.

Reused by rules, templates and commands. They read models and change nothing.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from robosmi.base.data_text import Json
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, UsageError, did_you_mean
from robosmi.metamodels import hardware, migration, platform
from robosmi.query import Q, root_of
from robosmi.quoting import toml
from robosmi.transformations.knowledge.part import GIVEN
from robosmi.transformations.queries.circuits.circuit_walk import beyond_driver, either_side
from robosmi.transformations.queries.circuits.connector_names import ConnectorNames
from robosmi.transformations.queries.circuits.former_titles import former_title

if TYPE_CHECKING:
    import networkx as nx


def boards(circuit: hardware.Circuit) -> Q[hardware.Component]:
    """The components that run a program, in the drawing's order."""
    return Q(circuit.components).select(lambda component: component.role is hardware.Role.Board)


def the_board(circuit: hardware.Circuit) -> hardware.Component:
    """The board of a circuit that programs are moved to: the only one, or of several the one that the user gave that role.

    Raises:
        SourceError: there is none, or more than one.
    """
    found = boards(circuit)
    named = found.select(lambda board: board.roleEvidence == GIVEN)
    found = named if len(named) == 1 else found
    place = Location(circuit.path)
    if not found:
        unknown = Q(circuit.components).select(lambda c: c.role is hardware.Role.Unknown)
        likely = max(unknown, key=lambda c: sum(wire.net is not None for wire in c.connectors), default=None)
        hint = (
            f"; the role of '{likely.title}' (#{likely.elementId}, {likely.partTitle or likely.partId}) is unknown"
            if likely
            else ""
        )
        line = f': {toml("#" + likely.elementId)} = "Board"' if likely else ""
        raise SourceError(
            f"this drawing has no board{hint}",
            location=place,
            fix=f"draw the board that runs the program, or give a part the role Board in robosmi.toml under [roles]{line}",
        )
    if len(found) > 1:
        names = ", ".join(f"'{board.title}' (#{board.elementId})" for board in found)
        raise SourceError(
            f"this drawing has {len(found)} boards: {names}",
            location=place,
            fix=f'name the one that runs the program under [roles] in robosmi.toml: {toml("#" + found[0].elementId)} = "Board"',
        )
    return found[0]


def of_board(connections: Iterable[migration.Connection], board: hardware.Component) -> list[migration.Connection]:
    """Those of the connections that a board's own pins have."""
    return [c for c in connections if c.boardConnectors and c.boardConnectors[0].component is board]


def component_named(circuit: hardware.Circuit, name: str) -> hardware.Component:
    """The component of that title, or of that identity when the name begins with `#`.

    Args:
        circuit: where to look.
        name: a title in the drawing (`Basic Servo1`), or `#1014`.

    Raises:
        UsageError: no component is meant, or more than one.
    """
    if name.startswith("#") and (exact := Q(circuit.components).select_one(lambda c: c.elementId == name[1:])) is not None:
        return exact
    found = Q(circuit.components).select(lambda c: c.title == name)
    found = found or Q(circuit.components).select(lambda c: former_title(c) == name)
    if len(found) == 1:
        return found[0]
    if found:
        choices = ", ".join(f"#{component.elementId} ({component.partTitle or component.partId})" for component in found)
        raise UsageError(f"{len(found)} components are called '{name}'", fix=f"use one of: {choices}")
    titles = sorted({c.title for c in circuit.components if c.title and c.role is not hardware.Role.Decoration})
    raise UsageError(
        f"no component is called '{name}'{did_you_mean(name, titles)}", fix=f"use one of: {', '.join(titles) or 'there are none'}"
    )


def port_interfaces(connections: Iterable[migration.Connection], mapping: platform.BoardMapping) -> dict[str, str]:
    """The name of every connection with its pin as a program writes it, in their order (paper 3.4, generatePortInterfaces).

    Args:
        connections: of one board.
        mapping: how the target's platform calls that board's pins; a pin that it does not name is written by its label.
    """
    literals = {name.pin.label: name.literal for name in mapping.pinNames if name.pin is not None}
    return {connection.name: literals.get(pin_label(connection), pin_label(connection)) for connection in connections}


def pin_literal(pin: platform.Pin) -> str:
    """How programs of the target write a pin: the name in the repository that the pin is in, else its label."""
    repository = root_of(pin)
    if isinstance(repository, platform.PlatformRepository):
        for name in (n for t in repository.targets if t.platform for m in t.platform.boardMappings for n in m.pinNames):
            if name.pin is pin:
                return str(name.literal)
    return str(pin.label)


def pin_label(connection: migration.Connection) -> str:
    """The normalised label of a connection's pin (`D9`)."""
    if connection.pin is not None:
        return connection.pin.label
    return connection.boardConnectors[0].pin if connection.boardConnectors else ""


def role_on(connection: migration.Connection) -> str:
    """What a component is for the program on this pin: its role; of a part that may be both, as it is wired here."""
    component = connection.component
    if component is None:
        return "Unknown"
    if component.role is hardware.Role.Output and connection.signal is migration.Signal.read:
        return hardware.Role.Input.name
    if component.driver and component.role in (hardware.Role.Input, hardware.Role.Output):
        drives, senses = either_side(component)
        if drives and not senses:
            return hardware.Role.Output.name
        if senses and not drives and connection.signal is not migration.Signal.write:  # written: it only switches the sensor
            return hardware.Role.Input.name
    return component.role.name


def circuit_graph(
    circuit: hardware.Circuit, parts: bool = False
) -> nx.Graph[hardware.Connector | hardware.Net | hardware.Component]:
    """The circuit as a graph of connectors and nets, an edge from each connector to its net.

    Args:
        circuit: the circuit.
        parts: whether the components are nodes too, with an edge to each of their connectors, connected or not.
    """
    import networkx as nx  # 0.2 s, and only comparisons and studies want it

    graph: nx.Graph[hardware.Connector | hardware.Net | hardware.Component] = nx.Graph()
    for net in circuit.nets:
        graph.add_edges_from((connector, net) for connector in net.connectors)
    for component in circuit.components if parts else ():
        graph.add_node(component)
        graph.add_edges_from((component, connector) for connector in component.connectors)
    return graph


def hardware_report(circuit: hardware.Circuit, connections: Iterable[migration.Connection]) -> dict[str, Any]:
    """The result of the command `hardware`, JSON values only (`boards`, `components`, `mappings`, `nets`)."""
    beyond = {c: beyond_driver(c) for c in circuit.components if c.driver}
    names = ConnectorNames()
    return {
        "boards": [{"title": b.title, "model_index": b.elementId, "module_id": b.partId} for b in boards(circuit)],
        "components": [
            {
                "title": c.title,
                "model_index": c.elementId,
                "module_id": c.partId,
                "part_title": c.partTitle,
                "role": c.role.name,
                "driver": c.driver,
                "evidence": c.roleEvidence,
            }
            for c in circuit.components
        ],
        "mappings": [_mapping(connection, beyond, names) for connection in connections],
        "nets": [
            {"name": net.name, "title": net.title, "rail": net.rail, "voltage": net.voltage, "connectors": _ends(net, names)}
            for net in circuit.nets
        ],
    }


def _ends(net: hardware.Net, names: ConnectorNames) -> list[dict[str, str]]:
    return [
        {
            "component": c.component.title,
            "component_model_index": c.component.elementId,
            "id": c.connectorId,
            "name": names.of(c),
        }
        for c in net.connectors
        if c.component is not None
    ]


def _mapping(
    connection: migration.Connection,
    beyond: dict[hardware.Component, tuple[list[hardware.Component], list[hardware.Component]]],
    names: ConnectorNames,
) -> dict[str, Json]:
    board = connection.boardConnectors[0].component if connection.boardConnectors else None
    component = connection.component
    drives, senses = beyond.get(component, ([], [])) if component is not None else ([], [])
    return {
        "board": board.title if board else "",
        "board_model_index": board.elementId if board else "",
        "pin": pin_label(connection),
        "board_connectors": _connectors(connection.boardConnectors, names),
        "component": component.title if component else "",
        "component_model_index": component.elementId if component else "",
        "connectors": _connectors(connection.connectors, names),
        "role": role_on(connection),
        "driver": bool(component and component.driver),
        "signal": connection.signal.name,
        "name": connection.name,
        "via": _components(connection.via),
        "drives": _components(drives),
        "senses": _components(senses),
    }


def _connectors(connectors: Iterable[hardware.Connector], names: ConnectorNames) -> list[dict[str, str]]:
    return [{"id": connector.connectorId, "name": names.of(connector)} for connector in connectors]


def _components(components: Iterable[hardware.Component]) -> list[dict[str, str]]:
    return [{"title": component.title, "model_index": component.elementId} for component in components]
