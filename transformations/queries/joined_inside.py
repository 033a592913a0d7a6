"""Which component short-circuits a pin to a supply by its own internal contact, as a button wired across one contact does.

It is judged by the wires as they are drawn; a drawing whose wires are not known gives no answer. Nets are computed by the
readers.
"""

from __future__ import annotations

from collections.abc import Sequence

from robosmi.metamodels import hardware
from robosmi.transformations.queries.connector_names import told_name


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
        joined = next(([told_name(c) or c.connectorId for c in bus] for bus in buses if len(_wired(bus, wires)) > 1), None)
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
