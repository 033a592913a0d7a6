"""The name of a connector for people, made unique among the connectors of its component.

Several gates of a part, or units of a symbol, may have pins of one name; programs that read models tell them apart by
`connectorId`. Only the text is made here; its meaning is derived from the drawing's own name by the knowledge of parts.
"""

from __future__ import annotations

from collections.abc import Iterable

from robosmi.metamodels import hardware

_POWERED = (hardware.ConnectorKind.supply, hardware.ConnectorKind.ground)


def displayed_name(connector: hardware.Connector) -> str:
    """The displayed name of a connector, empty if it has none.

    If the component has another, unconnected connector of that name, the name is made unique: by the identity if that contains
    the name (gate and pin of EAGLE, `A.OUT`), else by appending it (`OUT@7`, the pad of a KiCad symbol). Unconnected supply and
    ground pins stay as they are.
    """
    name = str(connector.name)
    component = connector.component
    if not name or component is None:
        return name
    others = [c for c in component.connectors if c.name == name and c is not connector]
    if not any(_is_another(connector, other) for other in others):
        return name
    return connector.connectorId if name in connector.connectorId else f"{name}@{connector.connectorId}"


def displayed_names(connectors: Iterable[hardware.Connector]) -> list[str]:
    """The names of connectors as they are shown."""
    return [displayed_name(connector) for connector in connectors]


def wire_name(connectors: Iterable[hardware.Connector]) -> str:
    """What a person calls the wire to these connectors of a component: their names, or `a wire` where they have none."""
    return " and ".join(filter(None, dict.fromkeys(displayed_names(connectors)))) or "a wire"


def _is_another(one: hardware.Connector, other: hardware.Connector) -> bool:
    if (one.net is not None and one.net is other.net) or (one.pin and one.pin == other.pin):
        return False
    if one.kind in _POWERED and (one.net is None or other.net is None):
        return False
    component = one.component
    return component is None or not any(one in bus.connectors and other in bus.connectors for bus in component.buses)
