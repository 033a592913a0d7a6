"""How signals run through a circuit: from nets across passive parts to components, behind a driver, from the pins of a board.

Rules, constraints and pictures use this; pins are mapped to components elsewhere (`m2m/circuits/connector_mapping`).

A pin on a supply net may be there because a component joins it by its own contact, such as a button wired across one contact.
`tied_inside` finds that component by the wires as they are drawn; a drawing whose wires are not known gives no answer.
"""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Callable, Iterable, Sequence

from msgspec import Struct

from robosmi.metamodels import hardware
from robosmi.transformations.knowledge.described_circuit import is_either_side, joins_by_bus_only
from robosmi.transformations.queries.circuits.connector_names import displayed_name

Role = hardware.Role
_SILENT = (Role.Board, Role.Power, Role.Decoration)


class ReachedComponent(Struct, frozen=True):
    """A component that a path ended at: it, its connectors in the net where the path met it, and the passive parts before."""

    component: hardware.Component
    connectors: tuple[hardware.Connector, ...]
    via: tuple[hardware.Component, ...]


class _Path(Struct, frozen=True):
    """A passive part that a path goes through, and the path before it."""

    part: hardware.Component
    before: _Path | None


def _components_of(path: _Path | None) -> tuple[hardware.Component, ...]:
    """The parts of a path, the first one first."""
    found = []
    while path is not None:
        found.append(path.part)
        path = path.before
    return tuple(reversed(found))


def pins_of(board: hardware.Component) -> dict[str, list[hardware.Connector]]:
    """The connectors of each signal pin of a board, by its label, digital before analogue and both by number."""
    pins: dict[str, list[hardware.Connector]] = {}
    for connector in board.connectors:
        if connector.pin:
            pins.setdefault(connector.pin, []).append(connector)
    return dict(sorted(pins.items(), key=lambda item: _label_order(item[0])))


def walk(
    start: Iterable[hardware.Net], is_blocked: Callable[[hardware.Net], bool], ignore: hardware.Component
) -> list[ReachedComponent]:
    """What is reached from some nets, nearest first: across two-terminal passive parts, never into a rail or a blocked net.

    Args:
        start: where to begin; rails among them are left out.
        is_blocked: whether passive parts do not lead into a net.
        ignore: the component that is asked about.
    """
    found: dict[hardware.Component, ReachedComponent] = {}
    todo: deque[tuple[hardware.Net, _Path | None]] = deque((net, None) for net in start if not net.rail)
    closed = {id(net) for net, _ in todo}
    while todo:
        net, path = todo.popleft()
        for component, connectors in _by_component(net):
            if component is ignore or component.role in _SILENT or component in found:
                continue
            if component.role is not Role.Passive:
                found[component] = ReachedComponent(component, tuple(connectors), _components_of(path))
                continue
            beyond = _other_side(component, net)
            if beyond is not None and not beyond.rail and id(beyond) not in closed and not is_blocked(beyond):
                closed.add(id(beyond))
                todo.append((beyond, _Path(component, path)))
    return list(found.values())


def beyond_driver(driver: hardware.Component) -> tuple[list[hardware.Component], list[hardware.Component]]:
    """The outputs that a driver drives and the inputs that it senses, beyond its connectors that lead to no board.

    They are given for the whole device, not channel by channel, and have no mapping of their own.
    """
    nets = list(dict.fromkeys(c.net for c in driver.connectors if c.net is not None and not c.net.rail))
    free = [net for net in nets if not any(c.component.role is Role.Board for c in net.connectors)]  # type: ignore[union-attr]
    reached = [r.component for r in walk(free, _is_on_board, driver) if not r.component.driver]
    reached.sort(key=lambda component: natural_key(component.elementId))
    return [c for c in reached if c.role is Role.Output], [c for c in reached if c.role is Role.Input]


def either_side(component: hardware.Component) -> tuple[list[hardware.Component], list[hardware.Component]]:
    """`beyond_driver` for a chip that may be on either side of the board, nothing for any other component."""
    return beyond_driver(component) if is_either_side(component) else ([], [])


def _label_order(label: str) -> tuple[int, tuple[tuple[int, str], ...]]:
    return ("DA".find(label[0]) if label[0] in "DA" and label[1:].isdecimal() else 2, natural_key(label))


def _by_component(net: hardware.Net) -> list[tuple[hardware.Component, list[hardware.Connector]]]:
    groups: dict[hardware.Component, list[hardware.Connector]] = {}
    for connector in net.connectors:
        if connector.component is not None:
            groups.setdefault(connector.component, []).append(connector)
    return list(groups.items())


def _other_side(component: hardware.Component, net: hardware.Net) -> hardware.Net | None:
    """The net at the other terminal of a two-terminal passive part, None for any other part."""
    if joins_by_bus_only(component):
        return None
    joined = [set(bus.connectors) for bus in component.buses]
    terminals: list[hardware.Connector] = []
    for connector in component.connectors:
        if not any(connector in bus and any(t in bus for t in terminals) for bus in joined):
            terminals.append(connector)
            if len(terminals) > 2:
                return None
    if len(terminals) != 2:
        return None
    others = [t.net for t in terminals if t.net is not None and t.net is not net]
    return others[0] if len(others) == 1 else None


def _is_on_board(net: hardware.Net) -> bool:
    """Whether a net is on a signal pin of a board."""
    return any(c.pin and c.component is not None and c.component.role is Role.Board for c in net.connectors)


def natural_key(text: str) -> tuple[tuple[int, str], ...]:
    """A sort key by which connector2 comes before connector10."""
    pieces = re.split(r"([0-9]{1,18})", text)  # int() refuses very long numbers
    return tuple((int(piece), "") if piece[0] in "0123456789" else (-1, piece) for piece in pieces if piece)


# ---- short circuits inside a component


def tied_inside(pins: Sequence[hardware.Connector], net: hardware.Net) -> tuple[hardware.Component, list[str]] | None:
    """The component whose own contact ties pins to the supply of their net, with the connectors that the contact joins.

    Args:
        pins: the connectors of a board's pin in that net.
        net: a rail.

    Returns:
        The component, or None: without any component's contact, the wires still lead to the supply, or they are not known.
    """
    switches = {
        component: [[c for c in bus.connectors if c.net is net] for bus in component.buses]
        for component in dict.fromkeys(c.component for c in net.connectors if c.component is not None)
        if component.role is hardware.Role.Input and component.buses
    }
    wires = [wire for wire in _wires(net) if len(wire.ends) > 1]
    for component, buses in switches.items():
        joined = next(([displayed_name(c) or c.connectorId for c in bus] for bus in buses if len(_wired(bus, wires)) > 1), None)
        if joined is not None and not _leads_to_supply(pins, net, wires, component):
            return component, joined
    return None


def _wires(net: hardware.Net) -> list[hardware.Wire]:
    return [wire for wire in net.circuit.wires if wire.net is net] if net.circuit is not None else []


def _wired(bus: Sequence[hardware.Connector], wires: Sequence[hardware.Wire]) -> list[hardware.Connector]:
    return [c for c in bus if any(c in wire.ends for wire in wires)]


def _leads_to_supply(
    pins: Sequence[hardware.Connector], net: hardware.Net, wires: Sequence[hardware.Wire], without: hardware.Component
) -> bool:
    """Whether the wires lead from the pins to a supply, or to a terminal of one, without what a component joins inside."""
    import networkx as nx  # 0.2 s, and few drawings want it

    graph: nx.Graph[hardware.Connector] = nx.Graph()
    graph.add_nodes_from(net.connectors)
    for wire in wires:
        nx.add_path(graph, wire.ends)
    for component in {c.component for c in net.connectors if c.component is not None and c.component is not without}:
        for bus in component.buses:
            nx.add_path(graph, [c for c in bus.connectors if c.net is net])
    reached = set().union(*(nx.node_connected_component(graph, pin) for pin in pins if pin in graph))
    powered = (hardware.ConnectorKind.supply, hardware.ConnectorKind.ground)
    return any(c.kind in powered or (c.component is not None and c.component.role is hardware.Role.Power) for c in reached)
