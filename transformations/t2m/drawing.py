"""The part of reading a drawing that is the same for every tool: the hardware model made of its parts, nets and wires.

A reader tells, in its tool's own words, which parts are placed (`Placed`), what is known of them (`KnownPart`), which connectors
(`End`) form one net, and which wires there are; `CircuitBuilder` adds what is known of boards, roles with their evidence, pins,
rails and findings about parts. Files, identities and the joining of connectors are left to the readers
(docs/how-to/add-a-drawing-reader.md).

A net is a rail if it holds a supply or ground pin of a board, a terminal of a supply or of a power symbol, or the connectors of
at least two components that are named like a supply or ground: supplies are not always drawn, and a single name may lie. A rail
has its reason and its voltage. The rules are those measured as V2 and V3 on public sketches (docs/method/connector-mapping.md).
"""

from __future__ import annotations

import re
from collections.abc import Container, Iterable, Mapping, Sequence
from fnmatch import fnmatchcase
from pathlib import Path
from typing import NamedTuple

from msgspec import Struct
from msgspec.structs import replace

from robosmi.base.data_text import Json
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import ModelError, did_you_mean
from robosmi.metamodels import hardware
from robosmi.model.elements.strict import enum_literal
from robosmi.transformations.knowledge.drawn_boards import DrawnBoard, drawn_board, normalised_label
from robosmi.transformations.knowledge.drawn_chips import port_of
from robosmi.transformations.knowledge.part import GIVEN, KINDS, ROLES, Part, PartConnector
from robosmi.transformations.knowledge.part_names import (
    conditional_signals,
    conducts_by_bus_only,
    connector_kind,
    controls_supply,
    names,
    rail_named,
)
from robosmi.transformations.knowledge.part_roles import classify, classify_by_id, classify_drawn
from robosmi.transformations.knowledge.parts_catalogue import Catalogue
from robosmi.transformations.t2m.connectivity import bus_leaders, natural
from robosmi.transformations.t2m.given_roles import given_roles

__all__ = ["CircuitBuilder", "End", "KnownPart", "Placed", "free_identity"]

_ROLES = {name: enum_literal(hardware.Role, name) for name in ROLES}
_KINDS = {name: enum_literal(hardware.ConnectorKind, name) for name in KINDS}


class CircuitBuilder:
    """Builds the hardware model of one drawing bottom-up: first its parts, then components, nets and wires, last the circuit.

    Args:
        path: the file, as the user gave it.
        tool: the drawing tool in lower case, as boards, the catalogue and rules name it.
        project: the project folder, whose own data on parts and boards takes precedence; the current folder if None.
    """

    def __init__(self, path: str, tool: str, project: Path | None = None) -> None:
        self.path, self.tool, self.project = path, tool, project
        self.names = names(project)
        self.findings: list[Finding] = []
        self.components: list[hardware.Component] = []
        self.nets: list[hardware.Net] = []
        self.wires: list[hardware.Wire] = []
        self.catalogue = Catalogue(project, tool)
        self._known: dict[str, KnownPart] = {}
        self._given: dict[str, str] = {}
        self._ends: dict[End, tuple[hardware.Connector, Terminal]] = {}
        self._placed: dict[str, str] = {}

    def report(
        self, rule: str, severity: Severity, message: str, line: int | None = None, fix: str | None = None, **evidence: Json
    ) -> None:
        """Add a finding about what is unknown, odd or left out."""
        self.findings.append(Finding(rule, severity, message, Location(self.path, line), fix=fix, evidence=evidence))

    def give_roles(self, roles: Mapping[str, str], titles: Mapping[str, str], former: Mapping[str, str] | None = None) -> None:
        """Set the roles that the user gives, which take precedence over all others.

        Args:
            roles: COMPONENT (title or `#identity`) -> role.
            titles: the title of each component that is placed, by identity.
            former: titles that count where no component has them as its title, by identity.

        Raises:
            UsageError: a role or a component does not exist, or a title is not unique.
        """
        self._given = given_roles(roles, titles, former)

    def know(self, part_id: str, defined: Part | None = None, board: DrawnBoard | None = None, own: bool = False) -> KnownPart:
        """Look up a part, to be called before it is placed.

        Args:
            part_id: its id in the tool's catalogue.
            defined: what the drawing itself says of it; the catalogue's entry takes precedence.
            board: the board that it stands for, where its id does not say it (`drawn_chips`).
            own: whether the user has made it: then its name says nothing about its role.

        Raises:
            PlatformDataError: an entry of the catalogue, a rule or a board is damaged.
        """
        if part_id not in self._known:
            self._known[part_id] = self._looked_up(part_id, defined, board, own)
        return self._known[part_id]

    def _looked_up(self, part_id: str, defined: Part | None, board: DrawnBoard | None, own: bool) -> KnownPart:
        found = self.catalogue.find(part_id) or defined
        part = found or Part(part_id, evidence="the part is neither in the catalogue nor defined in the drawing")
        part, by_name = replace(part, tool=self.tool), board is not None
        if board is None and part.role in ("Unknown", "Board"):
            board = drawn_board(part_id, self.tool, self.project)
        if board is not None and part.role == "Unknown":
            evidence = f"drawn as {board.title} (boards of the platform repository)"
            part = replace(part, role="Board", evidence=evidence, title=part.title or board.title)
        part = classify_by_id(part, self.project) if own else classify(part, self.project)
        if own and part.role == "Unknown":
            part = replace(part, evidence=part.evidence or "it is a custom part")
        if part.role == "Unknown" and not part.evidence:
            told = f"family '{part.family}' and title '{part.title}'" if part.family else f"title '{part.title}'"
            part = replace(part, evidence=f"no rule fits {told}{part.source and ' of ' + part.source}")
        about = f"{part.family} / {part.title} / {part_id}"
        return KnownPart(
            part=part,
            board=board,
            numbered=board is not None or (about in self.names.numbered_labels and about not in self.names.not_numbered_labels),
            by_bus=part.role == "Passive" and conducts_by_bus_only(part.family, self.names, part.title),
            defined=found is not None,
            leaders=bus_leaders(part),
            own=own,
            by_name=by_name,
        )

    def place(self, placed: Placed) -> hardware.Component:
        """Add a component.

        Raises:
            ModelError: its part was not given to `know`, or another component has its identity: a fault of the reader.
        """
        known = self._known.get(placed.part_id)
        if known is None:
            raise self.fault(f"places '{placed.identity}' as part '{placed.part_id}', but did not pass that part to know()")
        if placed.identity in self._placed:
            raise self.fault(f"places two components of the identity '{placed.identity}'")
        self._placed[placed.identity] = placed.title
        facts = self._connectors(placed, known)
        part = self._part(placed, known, facts)
        properties = _properties(part, placed.properties)
        models: dict[str, hardware.Connector] = {}
        for fact in facts:
            pin = self._pin(fact, part, known)
            kind = "signal" if pin and fact.kind == "unknown" else fact.kind
            if not pin and fact.id in placed.used and known.board is not None and part.role == "Board":
                self._report_pinless(placed, known.board, fact, known.by_name)
            model = models[fact.id] = hardware.Connector(connectorId=fact.id, name=fact.name, kind=_KINDS[kind], pin=pin)
            role = "" if part.role == "Power" and controls_supply(fact.name, self.names) else part.role
            terminal = Terminal(placed.identity, placed.title, role, _volts(properties), fact.id, fact.name, kind)
            self._ends[End(placed.identity, fact.id)] = (model, terminal)
        buses = [(bus, [models[m] for m in members if m in models]) for bus, members in part.buses.items()]
        self._report_part(placed, known, part)
        component = hardware.Component(
            elementId=placed.identity,
            title=placed.title,
            partId=placed.listed_as or placed.part_id,
            partTitle=part.title,
            family=part.family,
            tags=part.tags,
            boardName=known.board.name if known.board is not None and part.role == "Board" else "",
            role=_ROLES[part.role],
            roleEvidence=part.evidence,
            driver=part.driver,
            properties=[hardware.Property(name=key, value=value) for key, value in properties.items()],
            connectors=list(models.values()),
            buses=[hardware.Bus(name=bus, connectors=members) for bus, members in buses if len(members) > 1],
        )
        self.components.append(component)
        return component

    def report_lacking(self, placed: Placed, known: KnownPart, lacking: Sequence[str]) -> None:
        """Report that a drawing uses connectors which the component's part lacks (RS208); they are left out."""
        self.report(
            "RS208",
            Severity.warning,
            f"'{placed.title or known.part.title}' is connected at {', '.join(lacking[:5])}{', ...' if len(lacking) > 5 else ''},"
            f" which its part '{known.part.title or placed.part_id}' does not have; the connection was left out",
            placed.line,
            f"check the part, or update it in {self.tool.capitalize()}",
            connectors=[*lacking],
        )

    def connector(self, end: End) -> hardware.Connector | None:
        """The element of a placed component's connector, or None where the component has none of that identity."""
        found = self._ends.get(end)
        return found[0] if found is not None else None

    def net(self, ends: Sequence[End], title: str = "", by_name: bool = False) -> hardware.Net:
        """Add a net; whether it is a rail follows from its connectors.

        Args:
            ends: connectors of components that are placed, at least one, and none that is in another net: what two nets have in
                common makes them one.
            title: the name that the drawing gives it, where it gives one.
            by_name: whether a net that is called like a supply (`VIN`) is a rail, unless it is on a signal pin of a board.

        Raises:
            ModelError: an end is not there, or is in a net already: a fault of the reader.
        """
        if not ends:
            raise self.fault("makes a net without a connector")
        found = [self._placed_end(End(*end)) for end in dict.fromkeys(ends)]
        for model, terminal in found:
            if model.net is not None:
                where = f"{terminal.component or '?'}.{terminal.connector}"
                raise self.fault(f"puts '{where}' into two nets: into '{model.net.name}', and then into another")
        terminals = [terminal for _, terminal in found]
        first = min(terminals, key=lambda t: (natural(t.component), natural(t.connector)))
        why = rail(terminals)
        if why is None and by_name and not any(model.pin for model, _ in found) and (kind := rail_named(title, self.names)):
            stated = title.strip() if _STATED.fullmatch(title.strip()) else ""
            why = Rail(f"the net is called '{title}'", "GND" if kind == "ground" else stated)
        net = hardware.Net(
            name=f"{first.component}.{first.connector}",
            title=title,
            rail=why is not None,
            railEvidence=why.evidence if why else "",
            voltage=why.voltage if why else "",
            connectors=[model for model, _ in found],
        )
        self.nets.append(net)
        return net

    def wire(self, identity: str, ends: Iterable[End], net: hardware.Net | None, color: str = "") -> None:
        """Add a wire as it is drawn.

        Args:
            identity: its identity in the drawing.
            ends: connectors of components that are placed; none where it ends nowhere.
            net: the net that it belongs to, where it belongs to one.
            color: as the drawing has it.

        Raises:
            ModelError: an end is not there: a fault of the reader.
        """
        found = [self._placed_end(End(*end))[0] for end in dict.fromkeys(ends)]
        self.wires.append(hardware.Wire(elementId=identity, color=color, ends=found, net=net))

    def circuit(
        self, name: str, digest: str, tool: str, version: str = "", view: str = "", companions: Sequence[str] = ()
    ) -> hardware.Circuit:
        """The model of all that was added.

        Args:
            name: the circuit's name.
            digest: SHA-256 of the file's bytes, hexadecimal.
            tool: the drawing tool as it writes itself; in lower case it is the one that the builder was made for.
            version: the tool's version as the file has it.
            view: the view that was read, where the tool has several.
            companions: further files of the drawing's folder that were read (`DrawingFolder.companions`).
        """
        return hardware.Circuit(
            name=name, path=self.path, digest=digest, tool=tool, toolVersion=version, view=view, components=self.components,
            nets=self.nets, wires=self.wires, companions=companions,
        )  # fmt: skip

    def _placed_end(self, end: End) -> tuple[hardware.Connector, Terminal]:
        if (found := self._ends.get(end)) is not None:
            return found
        if end.component not in self._placed:
            guess = did_you_mean(end.component, self._placed)
            raise self.fault(f"names the end '{end.component}.{end.connector}', but has not placed '{end.component}'{guess}")
        own = [known.connector for known in self._ends if known.component == end.component]
        raise self.fault(
            f"names the end '{end.component}.{end.connector}', but '{end.component}' has no such connector"
            f"{did_you_mean(end.connector, own)}"
        )

    def fault(self, cause: str) -> ModelError:
        """The error for a reader that breaks the rules of this interface."""
        fix = "report it to the authors of the reader; docs/how-to/add-a-drawing-reader.md has the rules"
        return ModelError(f"the reader of {self.tool} drawings {cause}", location=Location(self.path), fix=fix)

    # ---- one component

    def _part(self, placed: Placed, known: KnownPart, facts: Sequence[PartConnector]) -> Part:
        """The part with its role in this place: given by the user, known, or concluded from its label and pin names."""
        if (role := self._given.get(placed.identity)) is not None:
            return replace(known.part, role=role, evidence=GIVEN)
        if known.part.role != "Unknown" or known.own:
            return known.part if known.own or known.board is not None else self._numbered(placed, known.part)
        named = replace(known.part, connectors={fact.id: fact for fact in facts})
        hint = "" if known.defined else placed.hint
        return classify_drawn(named, placed.title, placed.properties, hint, self.project)

    def _numbered(self, placed: Placed, part: Part) -> Part:
        """The part that the user's part number says: drawn with a general part, it may be something else."""
        number = next(
            (text for key, text in placed.properties.items() if key.lower() in self.names.number_properties and text), ""
        )
        if not number or number in part.properties.values() or part.role not in ("Input", "Output", "Both"):
            return part
        said = classify(Part(number, tool=self.tool, title=number), self.project)
        if said.role not in ("Unknown", "Board") and (said.role, said.driver) != (part.role, part.driver):
            evidence = f"part number '{number}': {said.evidence}"
            return replace(part, role=said.role, driver=said.driver, title=number, evidence=evidence)
        drawn, called = part.family.lower(), number.lower()
        if said.role == "Unknown" and _fits(drawn, self.names.transistors) and not _fits(called, self.names.transistor_numbers):
            evidence = f"it is drawn as '{part.title}', and its part number '{number}' is none of a transistor"
            return replace(part, role="Unknown", driver=False, title=number, evidence=evidence)
        return part

    def _connectors(self, placed: Placed, known: KnownPart) -> list[PartConnector]:
        """The connectors of a component in the part's order, followed by those that only the drawing names."""
        part, used = known.part, {*placed.used}
        pins = known.board.pins if known.board is not None else {}
        if lacking := sorted((c for c in used if c not in placed.names and not known.has(c)), key=natural):
            used.difference_update(lacking)
            self.report_lacking(placed, known, lacking)
        if known.by_bus:
            facts = [part.connectors.get(c) or PartConnector(c) for c in sorted(used, key=natural)]
        else:
            facts = list(part.connectors.values())
            drawn = {*used, *placed.names, *pins}
            if not known.defined:
                drawn.update(placed.mentioned)
            extra = sorted((c for c in drawn - part.connectors.keys() if c), key=natural)
            facts += [PartConnector(c, pins.get(c, "")) for c in extra]
        facts = [self._renamed(fact, placed.names.get(fact.id, "")) for fact in facts] if placed.names else facts
        if known.board is not None and known.board.names:
            facts = [self._renamed(fact, known.board.names.get(fact.id, "")) for fact in facts]
        if len(facts) == 2 and part.role not in ("Power", "Board"):  # + and - of a lamp are no supply
            facts = [replace(f, kind="signal") if f.name.lower() in self.names.names["polarity"] else f for f in facts]
        if signals := conditional_signals((fact.name for fact in facts), self.names):
            facts = [replace(f, kind="signal") if f.name.strip().lower() in signals else f for f in facts]
        return facts

    def _renamed(self, fact: PartConnector, name: str) -> PartConnector:
        return PartConnector(fact.id, name, connector_kind(name, self.names)) if name else fact

    @staticmethod
    def _pin(fact: PartConnector, part: Part, known: KnownPart) -> str:
        if part.role != "Board":
            return ""
        if known.board is not None:
            return known.board.pins.get(fact.id, "")
        return "" if fact.kind in ("supply", "ground") else normalised_label(fact.name, known.numbered)

    def _report_pinless(self, placed: Placed, board: DrawnBoard, fact: PartConnector, by_name: bool) -> None:
        """Report that wires at a connector are lost: it is named like a pin, but the board's data do not list it (RS257)."""
        if fact.kind in ("supply", "ground") or not (label := normalised_label(fact.name or fact.id)):
            return
        if by_name and port_of(fact.name):  # a port of a bare chip: RS216
            return
        self.report(
            "RS257",
            Severity.warning,
            f"'{placed.title or board.title}' is connected at '{fact.id}', which seems to be {label}, but the "
            f"board '{board.name}' has no such pin",
            placed.line,
            "move the wire to a pin that the board has, or describe the board (docs/how-to/add-a-board.md)"
            if by_name
            else f'add {label} = ["{fact.id}"] to [drawn_as.connectors] of tool "{self.tool}" in boards/{board.name}.toml',
            connectors=[fact.id],
        )

    def _report_part(self, placed: Placed, known: KnownPart, part: Part) -> None:
        about = f"{part.family} {part.title}".lower()
        if known.by_bus and "solder" in about and "jumper" in about and len({*placed.used}) > 1:
            self.report(
                "RS217", Severity.info,
                f"the solder jumper '{placed.title}' counts as open: the drawing does not show whether it is closed",
                placed.line, "draw a wire instead if it is closed",
            )  # fmt: skip
        if part.role == "Unknown":
            named = f"'{placed.title}' (#{placed.identity})" if placed.title else f"#{placed.identity}"
            what = f"part '{part.title or placed.part_id}'" + (f" of family '{part.family}'" if part.family else "")
            self.report(
                "RS203",
                Severity.warning,
                f"the role of {named} is unknown: {what}, {part.evidence}",
                placed.line,
                "give its role in robosmi.toml under [roles], or add the part to the catalogue",
                module_id=placed.listed_as or placed.part_id,
                file=placed.hint,
            )
        elif not known.defined and part.role != "Decoration" and not placed.symbol:
            self.report(
                "RS203",
                Severity.info,
                f"the part of '{placed.title or placed.identity}' is not in the catalogue; only the drawing describes it",
                placed.line,
                "add the part to the catalogue",
                module_id=placed.listed_as or placed.part_id,
                file=placed.hint,
            )


def free_identity(name: str, line: int, taken: Container[str]) -> str:
    """A unique identity for a part in a drawing: its name, with a number appended if another part has it.

    Args:
        name: as the drawing has it, empty for none.
        line: the part's line in the file, which names a part without a name.
        taken: the identities that are in use.
    """
    own = identity = name or f"line{line}"
    number = 1
    while identity in taken:
        number += 1
        identity = f"{own}.{number}"
    return identity


def _fits(text: str, patterns: Iterable[str]) -> bool:
    return any(fnmatchcase(text, pattern) for pattern in patterns)


def _properties(part: Part, own: Mapping[str, str]) -> dict[str, str]:
    """The part's properties, overridden by those of the placement; names are compared case-insensitively."""
    given = {key.lower(): (key, value) for key, value in own.items()}
    result = dict(given.pop(key.lower(), (key, value)) for key, value in part.properties.items())
    result.update(given.values())
    return result


def _volts(properties: Mapping[str, str]) -> str:
    value = next((value for key, value in properties.items() if key.lower() == "voltage"), "")
    return f"{value}V" if value and value[-1].isdigit() else value


# ---- rails


class Terminal(Struct, frozen=True):
    """A connector as the rules see it: its component's identity, title, role (none where it only steers a supply) and stated
    voltage, its own id, name and kind."""

    component: str
    title: str
    role: str
    volts: str
    connector: str
    name: str
    kind: str


class Rail(Struct, frozen=True):
    """The reason why a net is a rail, and the label of its supply (empty when unknown)."""

    evidence: str
    voltage: str


_SHOWN = 3
_STATED = re.compile(r"[-+]?(\d[\d.]*) ?v\d*|[+]?(\d)v(\d)", re.IGNORECASE)


def rail(terminals: Sequence[Terminal]) -> Rail | None:
    """The rail that a net of these connectors is, or None for a net that carries a signal.

    Args:
        terminals: the net's connectors, in the order in which they are to be named as evidence.
    """
    powered = [t for t in terminals if t.kind in ("supply", "ground")]
    board = [t for t in powered if t.role == "Board"]
    supplies = [t for t in terminals if t.role == "Power"]
    named = [t for t in powered if t.role not in ("Board", "Power")]
    reasons = list(dict.fromkeys(f"{t.name or t.connector} of {_who(t)}" for t in (*board, *supplies)))
    if not reasons and len({t.component for t in named}) > 1:
        reasons = list(dict.fromkeys(f"{t.name} of {_who(t)}" for t in named))
    if not reasons:
        return None
    more = f" and {len(reasons) - _SHOWN} more" if len(reasons) > _SHOWN else ""
    return Rail(", ".join(reasons[:_SHOWN]) + more, _voltage(board, supplies, named))


def _who(terminal: Terminal) -> str:
    return terminal.title or f"#{terminal.component}"


def _voltage(board: Sequence[Terminal], supplies: Sequence[Terminal], named: Sequence[Terminal]) -> str:
    """The label of a rail: from a board, else from supplies, else from names; supply and ground of one rank are both named.

    So a net keeps the label of its source: 5 V of a board stay that even if the ground of a servo is wired to them.
    """
    supplied = False
    for terminals in (board, supplies, named):
        labels = (str(terminal.volts if terminals is supplies else terminal.name).strip() for terminal in terminals)
        label = next((text for text in labels if _STATED.fullmatch(text)), "")
        grounded = any(terminal.kind == "ground" for terminal in terminals)
        if grounded and not supplied:
            return f"{label}/GND" if label else "GND"
        if label:
            return label
        supplied = supplied or any(terminal.kind == "supply" for terminal in terminals)
    return ""


# ---- records by which a reader describes a drawing


class End(NamedTuple):
    """A connector of a placed part: the part's identity and the connector's."""

    component: str
    connector: str


class Placed(Struct, frozen=True):
    """A part that is placed in a drawing, as the drawing has it.

    Attributes:
        identity: the tool's own identity of it, unique in the drawing; it becomes `#model_index`.
        part_id: the part's id in the tool's catalogue, as given to `know`.
        title: its label in the drawing.
        properties: its own properties.
        used: the connectors that the drawing connects, in any order; those that its part lacks are left out, and said (RS208).
        mentioned: further connectors that the drawing names; they count where nothing defines the part.
        names: names that the drawing gives to connectors of this placement, by connector.
        line: its line in the file, for findings.
        hint: name of the file that its missing definition was in, or empty.
        symbol: whether it only names a net, so that nothing needs to be known of it.
        listed_as: its id in the tool's catalogue, where `part_id` tells of one variant of it; empty: `part_id`.
    """

    identity: str
    part_id: str
    title: str = ""
    properties: Mapping[str, str] = {}
    used: Iterable[str] = ()
    mentioned: Iterable[str] = ()
    names: Mapping[str, str] = {}
    line: int | None = None
    hint: str = ""
    symbol: bool = False
    listed_as: str = ""


class KnownPart(Struct, frozen=True):
    """What is known about a part of a drawing.

    Attributes:
        part: its description, with a role where one is known.
        board: the board that it is drawn as, if any.
        numbered: whether its pin labels are plain numbers, RX and TX included.
        by_bus: whether it only joins connectors by its buses (breadboards, headers): only used ones become elements.
        defined: whether the catalogue or the drawing defines it.
        leaders: connector that it joins to others -> the representative of all of them.
        own: whether the user has made it, so that names say nothing about what it does.
        by_name: whether the board was recognised by the part's name or chip and its pins by labels, not by the tool's id.
    """

    part: Part
    board: DrawnBoard | None
    numbered: bool
    by_bus: bool
    defined: bool
    leaders: dict[str, str]
    own: bool = False
    by_name: bool = False

    def leader(self, connector: str) -> str:
        """The representative (a connector or the name of a strip) of all connectors that the part joins to this one."""
        return self.leaders.get(connector) or self.part.bus_of(connector) or connector

    def has(self, connector: str) -> bool:
        """Whether the part has a connector of that identity; an undefined part may have any."""
        return not self.defined or self.part.has(connector) or (self.board is not None and connector in self.board.pins)
