"""Reads a Fritzing sketch: a file in, a `hardware.Circuit` and findings out.

The order of work: bytes and records (`container`), definitions in the file and parts that Fritzing makes up
(`part_file`), nets of the view that is used (`ViewWiring`). What is known of parts, roles, pins, rails and the
model itself are made as for every tool (`t2m/drawing`). Components are in the order of their model index and connectors in
their part's order, so that the same drawing gives the same model. Of parts that conduct by bus only, such as breadboards, only
the connectors that the drawing uses become elements of the model.

Fritzing stores the connections in each of its views, and they should agree. The breadboard view is used; where it connects no
parts, the schematic and then the PCB view; where the first two disagree, that is a finding. The views are never united, since
that would unite their errors.

A net is what is one electrical node. A node is a connector with all that its part joins to it (a bus); a wire is one node from
end to end. Stripboards, net labels and power symbols join connectors as their properties say. `t2m/drawing` decides what a net
is for (rails).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from pathlib import Path
from typing import TypeAlias

from robosmi.base.data_text import Json
from robosmi.base.quantities import quantity
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError
from robosmi.metamodels import hardware
from robosmi.transformations.knowledge.part import Part
from robosmi.transformations.t2m.connectivity import Joined, Leaders, Node, natural
from robosmi.transformations.t2m.drawing import CircuitBuilder, End, KnownPart, Placed
from robosmi.transformations.t2m.fritzing.container import (
    VIEWS,
    Container,
    FritzingSketch,
    Instance,
    parse_sketch,
    read_container,
)
from robosmi.transformations.t2m.fritzing.part_file import TOOL, generated_part, parse_part

_DERIVED = 8 | 16
"""Wire flags of old jumpers and of ratsnest lines: hints that Fritzing derives and that do not conduct (viewgeometry.h)."""

_PCB_TRACE, _SCHEMATIC_TRACE = 4, 128
"""Wire flags of what was drawn in one view only. Old sketches repeat such a wire in every view; only its own shows it or conducts
by it (`ConnectorItem::getSkipFlags`)."""


_Has: TypeAlias = Callable[[Instance, str], bool]
"""Whether an instance that is no wire has a connector."""


def read_circuit(
    path: str | Path, project: Path | None = None, roles: Mapping[str, str] | None = None, board: str | None = None
) -> tuple[hardware.Circuit, list[Finding]]:
    """Read a Fritzing sketch.

    Args:
        path: a `.fz` or `.fzz` file.
        project: the project folder, whose own data on parts and boards takes precedence; the current folder if None.
        roles: roles that the user gives to components, by title or `#model_index`; they take precedence.
        board: the board where a file does not say which; a sketch always does.

    Returns:
        The circuit, and what was unknown, odd or left out (rules RS201 to RS213).

    Raises:
        SourceError: the file is missing, damaged, or no Fritzing sketch.
        PlatformDataError: an entry of the catalogue is damaged.
        UsageError: a role or a component in `roles` does not exist, or the title is not unique.
    """
    container = read_container(Path(path))
    sketch = parse_sketch(container.sketch, container.path, container.sketch_name)
    reading = _Reading(container, sketch, CircuitBuilder(container.path, TOOL, project))
    placed = {identity: instance.title for identity, instance in reading.instances.items() if not instance.is_wire}
    reading.builder.give_roles(roles or {}, placed)
    return reading.circuit(Path(path).stem), reading.builder.findings


class _Reading:
    """Reads one file."""

    def __init__(self, container: Container, sketch: FritzingSketch, builder: CircuitBuilder) -> None:
        self.container = container
        self.sketch = sketch
        self.builder = builder
        self.report = builder.report
        builder.findings += container.findings
        self.embedded = self._embedded()
        self.twice: set[str] = set()
        self.instances = self._identified()
        self.known: dict[str, KnownPart] = {
            i.module_id: self.builder.know(
                i.module_id, self.embedded.get(i.module_id) or generated_part(i.module_id, builder.names)
            )
            for i in self.instances.values()
            if not i.is_wire
        }

    def _embedded(self) -> dict[str, Part]:
        parts: dict[str, Part] = {}
        for name, data in self.container.parts:
            try:
                part = parse_part(data, self.container.path, name, self.builder.names)
            except SourceError as error:
                self.report(
                    "RS204", Severity.warning, f"a part definition in the drawing was left out: {error.message}", fix=error.fix
                )
                continue
            if part is None:
                self.report("RS204", Severity.warning, f"'{name}' in the drawing was left out: it is not a part definition")
            else:
                parts.setdefault(part.id, part)
        return parts

    def _identified(self) -> dict[str, Instance]:
        """The live instances by identity, in the order of their numbers."""
        found: dict[str, Instance] = {}
        for instance in self.sketch.instances:
            identity = instance.index
            if not identity or identity in found:
                number = 2
                while (identity := f"{instance.index or 'line' + str(instance.line)}.{number}") in found:
                    number += 1
                why = f"the model index {instance.index} occurs twice" if instance.index else "a part has no model index"
                self.report(
                    "RS206",
                    Severity.warning,
                    f"{why}; '{instance.title or instance.module_id}' is read as {identity}, and what others connect to that"
                    " index is left out",
                    instance.line,
                    "open the sketch in Fritzing and save it again",
                )
                self.twice.add(instance.index)
            found[identity] = instance
        return dict(sorted(found.items(), key=lambda item: natural(item[0])))

    def circuit(self, name: str) -> hardware.Circuit:
        """The model, and the findings of the builder with it."""
        leaders = {module_id: known.leaders for module_id, known in self.known.items()}
        by_bus = {i for i, instance in self.instances.items() if not instance.is_wire and self.known[instance.module_id].by_bus}
        wired, odd = believed(self.instances, leaders, by_bus, self.container.path, self._has, self.twice)
        self.builder.findings += odd
        groups: dict[Node, list[End]] = {}
        for identity, instance in self.instances.items():
            if not instance.is_wire:
                self._place(identity, instance, wired, groups)
        titles = self._net_titles(wired)
        net_of = {root: self.builder.net(ends, titles.get(root, "")) for root, ends in groups.items()}
        for identity in wired.wires:
            ends = sorted(wired.wire_ends.get(identity, ()), key=lambda end: (natural(end[0]), natural(end[1])))
            net = net_of.get(wired.joined.find((identity, ""))) if (identity, "") in wired.joined else None
            color = self.instances[identity].view(wired.view).color
            self.builder.wire(identity, [End(*end) for end in ends], net, color)
        self._report_rest(wired)
        return self.builder.circuit(name, self.container.digest, "Fritzing", self.sketch.version, wired.view)

    def _net_titles(self, wired: ViewWiring) -> dict[Node, str]:
        """The text of the first net label on each net."""
        found: dict[Node, str] = {}
        for identity, instance in self.instances.items():
            for connector in wired.used.get(identity, ()):
                if (text := _label_text(instance)) and (identity, connector) in wired.joined:
                    found.setdefault(wired.joined.find((identity, connector)), text)
        return found

    def _place(self, identity: str, instance: Instance, wired: ViewWiring, groups: dict[Node, list[End]]) -> None:
        known = self.known[instance.module_id]
        placed = self._placed(identity, instance, wired)
        if lacking := wired.lacking.get(identity):
            self.builder.report_lacking(placed, known, sorted(lacking, key=natural))
        for connector in self.builder.place(placed).connectors:
            node = (identity, known.leaders.get(connector.connectorId, connector.connectorId))
            if node in wired.joined:
                groups.setdefault(wired.joined.find(node), []).append(End(identity, connector.connectorId))

    def _has(self, instance: Instance, connector: str) -> bool:
        return connector in instance.local_names or self.known[instance.module_id].has(connector)

    def _placed(self, identity: str, instance: Instance, wired: ViewWiring) -> Placed:
        known = self.known[instance.module_id]
        return Placed(
            identity=identity,
            part_id=instance.module_id,
            title=instance.title,
            properties=instance.properties,
            used=wired.used.get(identity, ()),
            mentioned=() if known.defined else [c for view in VIEWS for c in instance.view(view).connectors],
            names=instance.local_names,
            line=instance.line,
            hint=instance.file_hint,
            symbol=bool(_symbol_net(instance)),
        )

    def _report_rest(self, wired: ViewWiring) -> None:
        left_out = (
            (self.sketch.without_views, "part without a view", "parts without a view"),
            (wired.ignored_wires, "derived wire", "derived wires"),
            (wired.foreign_wires, "trace of another view", "traces of another view"),
        )
        counted = [quantity(*each) for each in left_out if each[0]]
        if counted:
            self.report(
                "RS205",
                Severity.info,
                f"left out: {', '.join(counted)}",
                without_views=self.sketch.without_views,
                derived_wires=wired.ignored_wires,
                foreign_wires=wired.foreign_wires,
            )
        for instance in wired.too_big:
            self.report(
                "RS213",
                Severity.warning,
                f"'{instance.title or instance.module_id}' has too many holes; the connections of its strips are unknown",
                instance.line,
                "draw a smaller board",
            )
        for instance, index in wired.dangling:
            self.report(
                "RS207",
                Severity.warning,
                f"'{instance.title or instance.module_id}' is connected to {index or 'nothing'}, which does not exist",
                instance.line,
                "open the sketch in Fritzing and check this connection",
            )


# ---- the view that is used


def believed(
    instances: Mapping[str, Instance],
    leaders: Leaders,
    by_bus: Collection[str],
    path: str,
    has: _Has,
    twice: Collection[str] = (),
) -> tuple[ViewWiring, list[Finding]]:
    """The wiring of the view that is used, and findings where another view contradicts it.

    Args:
        instances: the live instances by identity.
        leaders: what parts join inside, by module id.
        by_bus: instances that only join connectors (breadboards), in which the views may differ.
        path: the file, for findings.
        has: whether an instance that is no wire has a connector.
        twice: model indices that several instances have.
    """
    first, second, last = VIEWS
    breadboard = _wiring(first, instances, leaders, has, twice)
    linked = _links_parts(breadboard, instances)
    alike = not breadboard.foreign_wires and all(i.view(first).edges == i.view(second).edges for i in instances.values())
    if linked and alike:
        return breadboard, []
    schematic = _wiring(second, instances, leaders, has, twice)
    if linked:
        return breadboard, _differences(breadboard, schematic, instances, by_bus, path)
    others = (schematic, _wiring(last, instances, leaders, has, twice))
    chosen = next((other for other in others if _links_parts(other, instances)), None)
    if chosen is None:
        message = "no part is connected to another in this drawing"
        return breadboard, [_finding("RS212", message, path, "connect the parts in the breadboard view")]
    message = f"the {_spoken(first)} connects no parts; RoboSMi reads the {_spoken(chosen.view)}"
    return chosen, [_finding("RS201", message, path, "check the connections in the breadboard view")]


def _differences(
    chosen: ViewWiring, other: ViewWiring, instances: Mapping[str, Instance], by_bus: Collection[str], path: str
) -> list[Finding]:
    if not _links_parts(other, instances):
        return []
    here, there = (_partition(wired, instances, by_bus) for wired in (chosen, other))
    if here == there:
        return []
    odd = sorted({f"{identity}.{connector}" for net in here ^ there for identity, connector in net})
    message = f"{_spoken(chosen.view)} and {_spoken(other.view)} differ; RoboSMi reads the {_spoken(chosen.view)}"
    return [_finding("RS202", message, path, "compare the two views in Fritzing", connectors=odd[:20])]


def _finding(rule: str, message: str, path: str, fix: str, **evidence: Json) -> Finding:
    return Finding(rule, Severity.warning, message, Location(path), fix=fix, evidence=evidence)


def _spoken(view: str) -> str:
    return view.removesuffix("View").replace("pcb", "PCB") + " view"


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
        too_big: stripboards with more than `_MAX_HOLES` holes, which are left out.
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


def _wiring(view: str, instances: Mapping[str, Instance], leaders: Leaders, has: _Has, twice: Collection[str] = ()) -> ViewWiring:
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
            if flags & _DERIVED:
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
        return _PCB_TRACE | _SCHEMATIC_TRACE
    return _SCHEMATIC_TRACE if view == "pcbView" else _PCB_TRACE if "pcbView" in wire.elements else 0


def _links_parts(found: ViewWiring, instances: Mapping[str, Instance]) -> bool:
    """Whether the view connects at least two different components."""
    owner: dict[Node, str] = {}
    for identity, leader in list(found.joined.parent):
        if not instances[identity].is_wire and owner.setdefault(found.joined.find((identity, leader)), identity) != identity:
            return True
    return False


def _partition(found: ViewWiring, instances: Mapping[str, Instance], ignore: Iterable[str] = ()) -> set[frozenset[Node]]:
    """The nets as sets of nodes of components, without those of fewer than two nodes, and without instances to ignore."""
    skip = set(ignore)
    sets: dict[Node, set[Node]] = {}
    for node in list(found.joined.parent):
        if node[0] not in skip and not instances[node[0]].is_wire:
            sets.setdefault(found.joined.find(node), set()).add(node)
    return {frozenset(nodes) for nodes in sets.values() if len(nodes) > 1}


_VOLTAGE = re.compile(r"[-+]?\d+(?:\.\d+)?")


def _symbol_net(instance: Instance) -> dict[str, str]:
    """Connector -> the common net it belongs to, for a net label or power symbol; empty for other parts.

    Source: fritzing-app src/items/symbolpaletteitem.cpp.
    """
    module_id, properties = instance.module_id, instance.properties
    number = _VOLTAGE.search(properties.get("voltage", ""))
    voltage = f"voltage {float(number[0]):g}" if number else "voltage ?"
    if label := _label_text(instance):
        return {"connector0": f"label {label}"}
    if module_id == "PowerLabelModuleID":
        return {"connector0": voltage.replace("voltage", "label")}
    if module_id == "GroundModuleID":
        return {"connector0": "ground"}
    if module_id in ("PowerModuleID", "JustPowerModuleID"):
        return {"connector0": voltage, "connector1": "ground"} if module_id == "PowerModuleID" else {"connector0": voltage}
    return {}


def _label_text(instance: Instance) -> str:
    """The text of a net label; empty for other parts."""
    if instance.module_id not in ("NetLabelModuleID", "LeftNetLabelModuleID"):
        return ""
    return instance.properties.get("label", "") or instance.title


def _join_symbols(result: ViewWiring, instances: Mapping[str, Instance]) -> None:
    first: dict[str, Node] = {}
    for identity, instance in instances.items():
        for connector, net in _symbol_net(instance).items():
            if connector in result.used.get(identity, ()):
                result.joined.union(first.setdefault(net, (identity, connector)), (identity, connector))


_STRIPBOARD = re.compile(r"([0-9]{1,9})\.([0-9]{1,9})Stripboard(2?)ModuleID")
_CUT = re.compile(r"([0-9]{1,9})\.([0-9]{1,9})([vh]+)")
_MAX_HOLES = 100_000
"""Holes of all stripboards of a drawing together; the largest that are sold have under 10,000."""

_ROW = 1000  # connector id = connector + (row * 1000 + column), src/items/perfboard.cpp


def _join_strips(result: ViewWiring, instances: Mapping[str, Instance]) -> None:
    room = _MAX_HOLES
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
