"""Which connectors of a drawing are one electrical node: plain records in, sets of nodes out.

A node is a connector with all that its part joins to it (a bus); a wire is one node from end to end. Stripboards, net labels
and power symbols join connectors as their properties say. `t2m/drawing` decides what a net is for (rails).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from typing import TypeAlias

from robosmi.transformations.t2m.connectivity import Joined, Leaders, Node
from robosmi.transformations.t2m.fritzing.document import Instance

DERIVED = 8 | 16
"""Wire flags of old jumpers and of ratsnest lines: hints that Fritzing derives and that do not conduct (viewgeometry.h)."""

PCB_TRACE, SCHEMATIC_TRACE = 4, 128
"""Wire flags of what was drawn in one view only. Old sketches repeat such a wire in every view; only its own shows it or conducts
by it (`ConnectorItem::getSkipFlags`)."""


Has: TypeAlias = Callable[[Instance, str], bool]
"""Whether an instance that is no wire has a connector."""


class ViewWiring:
    """The connections of one view.

    Attributes:
        view: the view they were read from.
        joined: the disjoint sets of nodes.
        used: identity of an instance -> its connectors that are in some connection.
        wire_ends: identity of a wire -> the connectors of components at its ends.
        wires: identities of the wires that conduct.
        ignored_wires: how many wires are derived hints.
        foreign_wires: how many wires are traces of another view.
        dangling: connections to instances that are not in the drawing.
        lacking: identity of an instance -> connectors in connections that its part lacks; those connections are left out.
        too_big: stripboards with more than `MAX_HOLES` holes, which are left out.
    """

    def __init__(self, view: str) -> None:
        self.view = view
        self.joined = Joined()
        self.used: dict[str, dict[str, None]] = {}
        self.wire_ends: dict[str, dict[tuple[str, str], None]] = {}
        self.wires: list[str] = []
        self.ignored_wires = 0
        self.foreign_wires = 0
        self.dangling: list[tuple[Instance, str]] = []
        self.lacking: dict[str, dict[str, None]] = {}
        self.too_big: list[Instance] = []


def wiring(view: str, instances: Mapping[str, Instance], leaders: Leaders, has: Has, twice: Collection[str] = ()) -> ViewWiring:
    """The connections of a view.

    Args:
        view: name of the view.
        instances: the live instances by identity, which is their model index.
        leaders: what parts join inside (`bus_leaders`), by module id.
        has: whether an instance that is no wire has a connector.
        twice: model indices that several instances have: connections that name one of them are left out as ambiguous.
    """
    result = ViewWiring(view)
    joined, used = result.joined, result.used
    silent: set[str] = set()
    for identity, instance in instances.items():
        if instance.is_wire:
            flags = instance.view(view).flags or 0
            if flags & DERIVED:
                silent.add(identity)
                result.ignored_wires += 1
            elif flags & _foreign(view, instance):
                silent.add(identity)
                result.foreign_wires += 1
            else:
                result.wires.append(identity)

    def node(identity: str, instance: Instance, connector: str) -> Node:
        if instance.is_wire:
            return identity, ""
        used.setdefault(identity, {})[connector] = None
        return identity, leaders[instance.module_id].get(connector, connector)

    for identity, instance in instances.items():
        if identity in silent:
            continue
        for own, index, theirs in instance.view(view).edges:
            other = instances.get(index)
            if index in twice:
                continue
            if other is None:
                result.dangling.append((instance, index))
            elif index in silent:
                continue
            elif odd := [
                (i, c)
                for i, part, c in ((identity, instance, own), (index, other, theirs))
                if not part.is_wire and not has(part, c)
            ]:
                for lacking, connector in odd:
                    result.lacking.setdefault(lacking, {})[connector] = None
            else:
                joined.union(node(identity, instance, own), node(index, other, theirs))
                if instance.is_wire and not other.is_wire:
                    result.wire_ends.setdefault(identity, {})[index, theirs] = None
                elif other.is_wire and not instance.is_wire:
                    result.wire_ends.setdefault(index, {})[identity, own] = None
    _join_symbols(result, instances)
    _join_strips(result, instances)
    return result


def _foreign(view: str, wire: Instance) -> int:
    """The flags that mark a wire as a trace of another view; old schematics without a PCB view have the PCB's flag."""
    if view == "breadboardView":
        return PCB_TRACE | SCHEMATIC_TRACE
    return SCHEMATIC_TRACE if view == "pcbView" else PCB_TRACE if "pcbView" in wire.elements else 0


def links_parts(found: ViewWiring, instances: Mapping[str, Instance]) -> bool:
    """Whether the view connects at least two different components."""
    owner: dict[Node, str] = {}
    for identity, leader in list(found.joined.parent):
        if not instances[identity].is_wire and owner.setdefault(found.joined.find((identity, leader)), identity) != identity:
            return True
    return False


def partition(found: ViewWiring, instances: Mapping[str, Instance], ignore: Iterable[str] = ()) -> set[frozenset[Node]]:
    """The nets as sets of nodes of components, without those of fewer than two nodes, and without instances to ignore."""
    skip = set(ignore)
    sets: dict[Node, set[Node]] = {}
    for node in list(found.joined.parent):
        if node[0] not in skip and not instances[node[0]].is_wire:
            sets.setdefault(found.joined.find(node), set()).add(node)
    return {frozenset(nodes) for nodes in sets.values() if len(nodes) > 1}


_VOLTAGE = re.compile(r"[-+]?\d+(?:\.\d+)?")


def symbol_net(instance: Instance) -> dict[str, str]:
    """Connector -> the common net it belongs to, for a net label or power symbol; empty for other parts.

    Source: fritzing-app src/items/symbolpaletteitem.cpp.
    """
    module_id, properties = instance.module_id, instance.properties
    number = _VOLTAGE.search(properties.get("voltage", ""))
    voltage = f"voltage {float(number[0]):g}" if number else "voltage ?"
    if label := label_text(instance):
        return {"connector0": f"label {label}"}
    if module_id == "PowerLabelModuleID":
        return {"connector0": voltage.replace("voltage", "label")}
    if module_id == "GroundModuleID":
        return {"connector0": "ground"}
    if module_id in ("PowerModuleID", "JustPowerModuleID"):
        return {"connector0": voltage, "connector1": "ground"} if module_id == "PowerModuleID" else {"connector0": voltage}
    return {}


def label_text(instance: Instance) -> str:
    """The text of a net label; empty for other parts."""
    if instance.module_id not in ("NetLabelModuleID", "LeftNetLabelModuleID"):
        return ""
    return instance.properties.get("label", "") or instance.title


def _join_symbols(result: ViewWiring, instances: Mapping[str, Instance]) -> None:
    first: dict[str, Node] = {}
    for identity, instance in instances.items():
        for connector, net in symbol_net(instance).items():
            if connector in result.used.get(identity, ()):
                result.joined.union(first.setdefault(net, (identity, connector)), (identity, connector))


_STRIPBOARD = re.compile(r"([0-9]{1,9})\.([0-9]{1,9})Stripboard(2?)ModuleID")
_CUT = re.compile(r"([0-9]{1,9})\.([0-9]{1,9})([vh]+)")
MAX_HOLES = 100_000
"""Holes of all stripboards of a drawing together; the largest that are sold have under 10,000."""

_ROW = 1000  # connector id = connector + (row * 1000 + column), src/items/perfboard.cpp


def _join_strips(result: ViewWiring, instances: Mapping[str, Instance]) -> None:
    room = MAX_HOLES
    for identity, instance in instances.items():
        size = _STRIPBOARD.fullmatch(instance.module_id)
        if size is None or not result.used.get(identity):
            continue
        columns, rows = min(int(size[1]), _ROW), min(int(size[2]), _ROW)
        if columns * rows > room:
            result.too_big.append(instance)
            continue
        room -= columns * rows
        for one, other in _strip_links(columns, rows, instance.properties, size[3] == ""):
            result.joined.union((identity, one), (identity, other))


def _strip_links(columns: int, rows: int, properties: Mapping[str, str], old: bool) -> Iterator[tuple[str, str]]:
    """The neighbouring holes that copper joins (src/items/stripboard.cpp): a full grid less the cuts."""
    cuts = {(int(c[1]), int(c[2]), way) for c in _CUT.finditer(properties.get("buses", "")) for way in c[3]}
    horizontal = old or "horizontal" in properties.get("layout", "").lower()
    if not properties.get("buses"):
        cuts = {(x, y, "v" if horizontal else "h") for x in range(columns) for y in range(rows)}
    for y in range(rows):
        for x in range(columns):
            here = f"connector{y * _ROW + x}"
            if y + 1 < rows and (x, y, "v") not in cuts:
                yield here, f"connector{(y + 1) * _ROW + x}"
            if x + 1 < columns and (x, y, "h") not in cuts:
                yield here, f"connector{y * _ROW + x + 1}"
