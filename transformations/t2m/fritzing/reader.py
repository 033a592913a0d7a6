"""Reads a Fritzing sketch: a file in, a `hardware.Circuit` and findings out.

The order of work: bytes (`container`), records (`document`), definitions in the file (`part_file`) and parts that Fritzing makes
up (`generated_parts`), nets of the view that is used (`nets`). What is known of parts, roles, pins, rails and the
model itself are made as for every tool (`t2m/drawing`). Components are in the order of their model index and connectors in
their part's order, so that the same drawing gives the same model. Of parts that conduct by bus only, such as breadboards, only
the connectors that the drawing uses become elements of the model.

Fritzing stores the connections in each of its views, and they should agree. The breadboard view is used; where it connects no
parts, the schematic and then the PCB view; where the first two disagree, that is a finding. The views are never united, since
that would unite their errors.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from pathlib import Path

from robosmi.base.data_text import Json
from robosmi.base.quantities import quantity
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError
from robosmi.metamodels import hardware
from robosmi.transformations.knowledge.part import Part
from robosmi.transformations.t2m.connectivity import Leaders, Node, natural
from robosmi.transformations.t2m.drawing import CircuitBuilder, End, KnownPart, Placed
from robosmi.transformations.t2m.fritzing import nets
from robosmi.transformations.t2m.fritzing.container import Container, read_container
from robosmi.transformations.t2m.fritzing.document import VIEWS, FritzingSketch, Instance, parse_sketch
from robosmi.transformations.t2m.fritzing.generated_parts import TOOL, generated_part
from robosmi.transformations.t2m.fritzing.nets import Has, ViewWiring, links_parts, partition, wiring
from robosmi.transformations.t2m.fritzing.part_file import parse_part


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

    def _net_titles(self, wired: nets.ViewWiring) -> dict[Node, str]:
        """The text of the first net label on each net."""
        found: dict[Node, str] = {}
        for identity, instance in self.instances.items():
            for connector in wired.used.get(identity, ()):
                if (text := nets.label_text(instance)) and (identity, connector) in wired.joined:
                    found.setdefault(wired.joined.find((identity, connector)), text)
        return found

    def _place(self, identity: str, instance: Instance, wired: nets.ViewWiring, groups: dict[Node, list[End]]) -> None:
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

    def _placed(self, identity: str, instance: Instance, wired: nets.ViewWiring) -> Placed:
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
            symbol=bool(nets.symbol_net(instance)),
        )

    def _report_rest(self, wired: nets.ViewWiring) -> None:
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
    has: Has,
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
    breadboard = wiring(first, instances, leaders, has, twice)
    linked = links_parts(breadboard, instances)
    alike = not breadboard.foreign_wires and all(i.view(first).edges == i.view(second).edges for i in instances.values())
    if linked and alike:
        return breadboard, []
    schematic = wiring(second, instances, leaders, has, twice)
    if linked:
        return breadboard, _differences(breadboard, schematic, instances, by_bus, path)
    others = (schematic, wiring(last, instances, leaders, has, twice))
    chosen = next((other for other in others if links_parts(other, instances)), None)
    if chosen is None:
        message = "no part is connected to another in this drawing"
        return breadboard, [_finding("RS212", message, path, "connect the parts in the breadboard view")]
    message = f"the {_spoken(first)} connects no parts; RoboSMi reads the {_spoken(chosen.view)}"
    return chosen, [_finding("RS201", message, path, "check the connections in the breadboard view")]


def _differences(
    chosen: ViewWiring, other: ViewWiring, instances: Mapping[str, Instance], by_bus: Collection[str], path: str
) -> list[Finding]:
    if not links_parts(other, instances):
        return []
    here, there = (partition(wired, instances, by_bus) for wired in (chosen, other))
    if here == there:
        return []
    odd = sorted({f"{identity}.{connector}" for net in here ^ there for identity, connector in net})
    message = f"{_spoken(chosen.view)} and {_spoken(other.view)} differ; RoboSMi reads the {_spoken(chosen.view)}"
    return [_finding("RS202", message, path, "compare the two views in Fritzing", connectors=odd[:20])]


def _finding(rule: str, message: str, path: str, fix: str, **evidence: Json) -> Finding:
    return Finding(rule, Severity.warning, message, Location(path), fix=fix, evidence=evidence)


def _spoken(view: str) -> str:
    return view.removesuffix("View").replace("pcb", "PCB") + " view"
