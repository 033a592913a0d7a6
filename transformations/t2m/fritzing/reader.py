"""The transformation itself: a Fritzing file in, a `hardware.Circuit` and findings out.

The order of work: bytes (`container`), records (`document`), what each part is (catalogue, definition in the file, rules),
nets of the view that is believed (`nets`, `rails`), and the model at the end, bottom-up. Components are in the order of their
model index and connectors in their part's order, so that the same drawing gives the same model. Of parts that conduct by
bus only, such as breadboards, only the connectors that the drawing uses become elements of the model.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError
from robosmi.metamodels import hardware
from robosmi.transformations.knowledge.part import Part, PartConnector
from robosmi.transformations.knowledge.part_names import Names, conducts_by_bus_only, connector_kind, names
from robosmi.transformations.knowledge.part_roles import classify, classify_drawn, generated_part
from robosmi.transformations.knowledge.parts_catalogue import Catalogue
from robosmi.transformations.knowledge.rails import Terminal, rail
from robosmi.transformations.t2m.boards import DrawnBoard, drawn_board, normalised_label
from robosmi.transformations.t2m.fritzing import nets
from robosmi.transformations.t2m.fritzing.container import Container, read_container
from robosmi.transformations.t2m.fritzing.document import VIEWS, Instance, Sketch, natural, parse_sketch
from robosmi.transformations.t2m.fritzing.part_file import parse_part
from robosmi.transformations.t2m.fritzing.views import believed
from robosmi.transformations.t2m.given_roles import given_roles

TOOL = "fritzing"
"""The drawing tool as board entries name it."""

_ROLES = {
    literal.name: literal
    for literal in (
        getattr(hardware.Role, name) for name in ("Unknown", "Board", "Input", "Output", "Both", "Passive", "Power", "Decoration")
    )
}
_KINDS = {name: getattr(hardware.ConnectorKind, name) for name in ("unknown", "signal", "supply", "ground")}


@dataclass(slots=True)
class _Known:
    """A part with what the reader needs to know about it beyond the catalogue's facts."""

    part: Part
    board: DrawnBoard | None
    arduino: bool
    used_only: bool
    defined: bool
    leaders: dict[str, str]


def read_circuit(
    path: str | Path, project: Path | None = None, roles: Mapping[str, str] | None = None
) -> tuple[hardware.Circuit, list[Finding]]:
    """Read a Fritzing sketch.

    Args:
        path: a `.fz` or `.fzz` file.
        project: the project folder, whose own data on parts and boards goes first; the current folder if None.
        roles: roles that the user gives to components, by title or `#model_index`; they go before all else.

    Returns:
        The circuit, and what was unknown, odd or left out (rules RS201 to RS213).

    Raises:
        SourceError: the file is missing, damaged, or no Fritzing sketch.
        PlatformDataError: an entry of the catalogue is damaged.
        UsageError: a role or a component in `roles` does not exist, or the title is not unique.
    """
    container = read_container(Path(path))
    sketch = parse_sketch(container.sketch, container.path, container.sketch_name)
    reading = _Reading(container, sketch, names(project), project)
    placed = {identity: instance.title for identity, instance in reading.instances.items() if not instance.is_wire}
    reading.given = given_roles(roles or {}, placed)
    return reading.circuit(Path(path).stem), reading.findings


class _Reading:
    """The reading of one file."""

    def __init__(self, container: Container, sketch: Sketch, known: Names, project: Path | None) -> None:
        self.path = container.path
        self.container = container
        self.sketch = sketch
        self.names = known
        self.project = project
        self.catalogue = Catalogue(project)
        self.findings: list[Finding] = list(container.findings)
        self.embedded = self._embedded()
        self.instances = self._identified()
        self.given: dict[str, str] = {}
        self.known: dict[str, _Known] = {}
        for instance in self.instances.values():
            if not instance.is_wire and instance.module_id not in self.known:
                self.known[instance.module_id] = self._know(instance.module_id)

    def _report(
        self, rule: str, severity: Severity, message: str, line: int | None = None, fix: str | None = None, **evidence: object
    ) -> None:
        self.findings.append(Finding(rule, severity, message, Location(self.path, line), fix=fix, evidence=evidence))

    def _embedded(self) -> dict[str, Part]:
        parts: dict[str, Part] = {}
        for name, data in self.container.parts:
            try:
                part = parse_part(data, self.path, name, self.names)
            except SourceError as error:
                self._report(
                    "RS204", Severity.warning, f"a part definition in the drawing was left out: {error.message}", fix=error.fix
                )
                continue
            if part is None:
                self._report("RS204", Severity.warning, f"'{name}' in the drawing was left out: it is no part definition")
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
                why = f"the model index {instance.index} stands twice" if instance.index else "a part has no model index"
                self._report(
                    "RS206",
                    Severity.warning,
                    f"{why}; '{instance.title or instance.module_id}' is read as {identity}, its connections may be wrong",
                    instance.line,
                    "open the sketch in Fritzing and save it again",
                )
            found[identity] = instance
        return dict(sorted(found.items(), key=lambda item: natural(item[0])))

    def _know(self, module_id: str) -> _Known:
        part = self.catalogue.find(module_id) or self.embedded.get(module_id) or generated_part(module_id, self.names)
        defined = part is not None
        part = part or Part(module_id, evidence="no entry in the catalogue of parts and no definition in the drawing")
        board = drawn_board(module_id, TOOL, self.project) if part.role in ("Unknown", "Board") else None
        if board is not None and part.role == "Unknown":
            part = replace(
                part,
                role="Board",
                evidence=f"drawn as {board.title} (boards of the platform repository)",
                title=part.title or board.title,
            )
        part = classify(part, self.project)
        if part.role == "Unknown" and not part.evidence:
            part = replace(part, evidence=f"no rule fits family '{part.family}' and title '{part.title}' of {part.source}")
        about = f"{part.family} / {part.title} / {module_id}"
        return _Known(
            part=part,
            board=board,
            arduino=board is not None or (about in self.names.arduino_labels and about not in self.names.not_arduino_labels),
            used_only=part.role == "Passive" and conducts_by_bus_only(part.family, self.names),
            defined=defined,
            leaders=nets.bus_leaders(part),
        )

    # ---- the model

    def circuit(self, name: str) -> hardware.Circuit:
        leaders = {module_id: known.leaders for module_id, known in self.known.items()}
        by_bus = {
            i for i, instance in self.instances.items() if not instance.is_wire and self.known[instance.module_id].used_only
        }
        wired, odd = believed(self.instances, leaders, by_bus, self.path)
        self.findings += odd
        groups: dict[nets.Node, list[tuple[hardware.Connector, Terminal]]] = {}
        components = [
            self._component(i, instance, wired, groups) for i, instance in self.instances.items() if not instance.is_wire
        ]
        by_end = {(c.component, c.connector): model for group in groups.values() for model, c in group}
        net_of: dict[nets.Node, hardware.Net] = {root: _net(group) for root, group in groups.items()}
        wires = [self._wire(identity, wired, by_end, net_of) for identity in wired.wires]
        self._report_rest(wired)
        return hardware.Circuit(
            name=name,
            path=self.path,
            digest=self.container.digest,
            tool="Fritzing",
            toolVersion=self.sketch.version,
            view=wired.view,
            components=components,
            nets=list(net_of.values()),
            wires=wires,
        )

    def _component(
        self,
        identity: str,
        instance: Instance,
        wired: nets.Wiring,
        groups: dict[nets.Node, list[tuple[hardware.Connector, Terminal]]],
    ) -> hardware.Component:
        known = self.known[instance.module_id]
        used = wired.used.get(identity, {})
        facts = self._connectors(instance, known, used)
        known = replace(known, part=self._role(identity, instance, known, facts))
        part = known.part
        properties = _properties(part, instance)
        leaders = known.leaders
        models: dict[str, hardware.Connector] = {}
        for fact in facts:
            pin = _pin(fact, known)
            kind = "signal" if pin and fact.kind == "unknown" else fact.kind
            model = models[fact.id] = hardware.Connector(connectorId=fact.id, name=fact.name, kind=_KINDS[kind], pin=pin)
            node = (identity, leaders.get(fact.id, fact.id))
            if node in wired.joined:
                terminal = Terminal(identity, instance.title, part.role, _volts(properties), fact.id, fact.name, kind)
                groups.setdefault(wired.joined.find(node), []).append((model, terminal))
        buses = [(bus, [models[m] for m in members if m in models]) for bus, members in part.buses.items()]
        self._report_part(identity, instance, known)
        return hardware.Component(
            elementId=identity,
            title=instance.title,
            partId=instance.module_id,
            partTitle=part.title,
            family=part.family,
            tags=part.tags,
            role=_ROLES[part.role],
            roleEvidence=part.evidence,
            driver=part.driver,
            properties=[hardware.Property(name=key, value=value) for key, value in properties.items()],
            connectors=list(models.values()),
            buses=[hardware.Bus(name=bus, connectors=members) for bus, members in buses if len(members) > 1],
        )

    def _role(self, identity: str, instance: Instance, known: _Known, facts: list[PartConnector]) -> Part:
        """The part with the role that it has in this place: given by the user, known, or told by label and pin names."""
        part = known.part
        if (role := self.given.get(identity)) is not None:
            return replace(part, role=role, evidence="given by the user")
        if part.role != "Unknown":
            return part
        named = replace(part, connectors={fact.id: fact for fact in facts})
        hint = "" if known.defined else instance.file_hint
        return classify_drawn(named, instance.title, instance.properties, hint, self.project)

    def _connectors(self, instance: Instance, known: _Known, used: Mapping[str, None]) -> list[PartConnector]:
        """The connectors of an instance, in the part's order, those that only the drawing knows after them."""
        part = known.part
        if known.used_only:
            facts = [part.connectors.get(c) or PartConnector(c) for c in sorted(used, key=natural)]
        else:
            facts = list(part.connectors.values())
            drawn = {*used, *instance.local_names, *(known.board.pins if known.board else ())}
            if not known.defined:
                drawn.update(c for view in VIEWS for c in instance.view(view).connectors)
            extra = sorted((c for c in drawn - part.connectors.keys() if c), key=natural)
            facts += [PartConnector(c, known.board.pins.get(c, "") if known.board else "") for c in extra]
            if known.defined and part.connectors and (odd := [c for c in extra if c in used]):
                self._report(
                    "RS208",
                    Severity.info,
                    f"'{instance.title or part.title}' is connected at {', '.join(odd[:5])}, which its part has not",
                    instance.line,
                    "update the part in Fritzing",
                    connectors=odd,
                )
        if instance.local_names:
            facts = [self._renamed(fact, instance.local_names.get(fact.id, "")) for fact in facts]
        if len(facts) == 2 and part.role not in ("Power", "Board"):  # + and - of a lamp are no supply
            facts = [replace(f, kind="signal") if f.name.lower() in self.names.names["polarity"] else f for f in facts]
        return facts

    def _renamed(self, fact: PartConnector, name: str) -> PartConnector:
        return PartConnector(fact.id, name, connector_kind(name, self.names)) if name else fact

    def _wire(
        self,
        identity: str,
        wired: nets.Wiring,
        ends: Mapping[tuple[str, str], hardware.Connector],
        net_of: Mapping[nets.Node, hardware.Net],
    ) -> hardware.Wire:
        found = sorted(wired.wire_ends.get(identity, ()), key=lambda end: (natural(end[0]), natural(end[1])))
        net = net_of.get(wired.joined.find((identity, ""))) if (identity, "") in wired.joined else None
        color = self.instances[identity].view(wired.view).color
        return hardware.Wire(elementId=identity, color=color, ends=[ends[end] for end in found if end in ends], net=net)

    # ---- findings

    def _report_part(self, identity: str, instance: Instance, known: _Known) -> None:
        part = known.part
        if part.role == "Unknown":
            named = f"'{instance.title}' (#{identity})" if instance.title else f"#{identity}"
            what = f"part '{part.title or instance.module_id}'" + (f" of family '{part.family}'" if part.family else "")
            self._report(
                "RS203",
                Severity.warning,
                f"what {named} does is unknown: {what}, {part.evidence}",
                instance.line,
                "give its role in robosmi.toml under [roles], or add the part to the catalogue",
                module_id=instance.module_id,
                file=instance.file_hint,
            )
        elif not known.defined and part.role not in ("Decoration",) and not nets.symbol_net(instance):
            self._report(
                "RS203",
                Severity.info,
                f"the part of '{instance.title or identity}' is not in the catalogue; known is what the drawing says",
                instance.line,
                "add the part to the catalogue",
                module_id=instance.module_id,
                file=instance.file_hint,
            )

    def _report_rest(self, wired: nets.Wiring) -> None:
        if self.sketch.without_views or wired.ignored_wires:
            self._report(
                "RS205",
                Severity.info,
                f"left out: {self.sketch.without_views} parts without a view and {wired.ignored_wires} derived wires",
                without_views=self.sketch.without_views,
                derived_wires=wired.ignored_wires,
            )
        for instance in wired.too_big:
            self._report(
                "RS213",
                Severity.warning,
                f"'{instance.title or instance.module_id}' has more holes than are followed; what its strips join is not known",
                instance.line,
                "draw a smaller board",
            )
        for instance, index in wired.dangling:
            self._report(
                "RS207",
                Severity.warning,
                f"'{instance.title or instance.module_id}' is connected to {index or 'nothing'}, which is not there",
                instance.line,
                "open the sketch in Fritzing and check this connection",
            )


def _pin(fact: PartConnector, known: _Known) -> str:
    if known.part.role != "Board":
        return ""
    if known.board is not None:
        return known.board.pins.get(fact.id, "")
    return "" if fact.kind in ("supply", "ground") else normalised_label(fact.name, known.arduino)


def _properties(part: Part, instance: Instance) -> dict[str, str]:
    """Properties of the part, those of the instance in their place (names are compared without case)."""
    own = {key.lower(): (key, value) for key, value in instance.properties.items()}
    result = dict(own.pop(key.lower(), (key, value)) for key, value in part.properties.items())
    result.update(own.values())
    return result


def _volts(properties: Mapping[str, str]) -> str:
    value = next((value for key, value in properties.items() if key.lower() == "voltage"), "")
    return f"{value}V" if value and value[-1].isdigit() else value


def _net(group: list[tuple[hardware.Connector, Terminal]]) -> hardware.Net:
    terminals = [terminal for _, terminal in group]
    first = min(terminals, key=lambda t: (natural(t.component), natural(t.connector)))
    found = rail(terminals)
    return hardware.Net(
        name=f"{first.component}.{first.connector}",
        rail=found is not None,
        railEvidence=found.evidence if found else "",
        voltage=found.voltage if found else "",
        connectors=[model for model, _ in group],
    )
