"""The name of a connector for people, made unique among the connectors of its component.

Several gates of a part, or units of a symbol, may have pins of one name; programs that read models tell them apart by
`connectorId`. Only the text is made here; its meaning is derived from the drawing's own name by the knowledge of parts.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from robosmi.metamodels import hardware

_POWERED = (hardware.ConnectorKind.supply, hardware.ConnectorKind.ground)


class ConnectorNames:
    """The displayed names of connectors of a circuit that does not change meanwhile; each component is looked through once."""

    def __init__(self) -> None:
        self._alike: dict[hardware.Component, dict[str, list[hardware.Connector]]] = {}

    def of(self, connector: hardware.Connector) -> str:
        """The displayed name of a connector, empty if it has none.

        If the component has another, unconnected connector of that name, the name is made unique: by the identity if that
        contains the name (gate and pin of EAGLE, `A.OUT`), else by appending it (`OUT@7`, the pad of a KiCad symbol).
        Unconnected supply and ground pins stay as they are.
        """
        name = str(connector.name)
        component = connector.component
        if not name or component is None:
            return name
        if component not in self._alike:
            self._alike[component] = _by_name(component)
        if not any(_is_another(connector, other) for other in self._alike[component][name] if other is not connector):
            return name
        return connector.connectorId if name in connector.connectorId else f"{name}@{connector.connectorId}"


def _by_name(component: hardware.Component) -> dict[str, list[hardware.Connector]]:
    """The connectors of each name, two of those that are in one net, have one label and lie on the same buses.

    What holds between a connector and one of these holds for all that are like it, and two are enough to find another one.
    """
    buses: dict[hardware.Connector, list[int]] = {}
    for number, bus in enumerate(component.buses):
        for connector in bus.connectors:
            buses.setdefault(connector, []).append(number)
    found: dict[str, list[hardware.Connector]] = {}
    often: Counter[tuple[object, ...]] = Counter()
    for connector in component.connectors:
        where = (connector.name, connector.net, connector.pin, connector.kind, *buses.get(connector, ()))
        often[where] += 1
        if often[where] <= 2:
            found.setdefault(str(connector.name), []).append(connector)
    return found


def displayed_name(connector: hardware.Connector) -> str:
    """The displayed name of one connector; use `ConnectorNames` for many."""
    return ConnectorNames().of(connector)


def displayed_names(connectors: Iterable[hardware.Connector]) -> list[str]:
    """The names of connectors as they are shown."""
    known = ConnectorNames()
    return [known.of(connector) for connector in connectors]


def wire_name(connectors: Iterable[hardware.Connector]) -> str:
    """What the user calls the wire to these connectors of a component: their names, or `a wire` where they have none."""
    return " and ".join(filter(None, dict.fromkeys(displayed_names(connectors)))) or "a wire"


def _is_another(one: hardware.Connector, other: hardware.Connector) -> bool:
    if (one.net is not None and one.net is other.net) or (one.pin and one.pin == other.pin):
        return False
    if one.kind in _POWERED and (one.net is None or other.net is None):
        return False
    component = one.component
    return component is None or not any(one in bus.connectors and other in bus.connectors for bus in component.buses)
