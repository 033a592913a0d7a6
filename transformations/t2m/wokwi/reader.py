"""The transformation itself: a Wokwi `diagram.json` in, a `hardware.Circuit` and findings out.

Parts have the ids that the diagram gives them, which are also their titles; their pins are those of the catalogue
(`parts/wokwi.toml`), or those that the diagram uses where the catalogue has no such type. Nets follow from the connections and
from what parts join inside. A connection to an unknown part or pin, or to an id that stands twice, is left out and reported.
`document` reads the file.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from robosmi.diagnostics import Finding, Severity
from robosmi.errors import did_you_mean
from robosmi.metamodels import hardware
from robosmi.transformations.knowledge.part import Part
from robosmi.transformations.t2m.connectivity import Joined, Node
from robosmi.transformations.t2m.drawing import CircuitBuilder, End, KnownPart, Placed, free_identity
from robosmi.transformations.t2m.wokwi.document import Connection, Diagram, DiagramPart, read_diagram

TOOL = "Wokwi"
_SYMBOLS = {"wokwi-gnd": "GND", "wokwi-vcc": "VCC"}
"""Part types that only name a net -> their pin; all parts of one type are joined."""
_PREFIXES = ("wokwi-", "board-", "chip-")
_BOARD = "board-"
_OWN = "chip-"
"""Prefix of the types of custom chips."""
_NO_PART = "$"
"""Prefix of names that are no parts, such as `$serialMonitor`."""
_NAMED = 12


def read_circuit(
    path: str | Path, project: Path | None = None, roles: Mapping[str, str] | None = None, board: str | None = None
) -> tuple[hardware.Circuit, list[Finding]]:
    """Read a Wokwi diagram.

    Args:
        path: a `diagram.json`.
        project: the project folder, whose own data on parts and boards takes precedence; the current folder if None.
        roles: roles that the user gives to components, by their id or `#id`; they take precedence.
        board: the board where a file does not say which; a diagram always does.

    Returns:
        The circuit, and what was unknown, odd or left out (rules RS203 to RS214).

    Raises:
        SourceError: the file is missing, damaged, or no diagram.
        PlatformDataError: an entry of the catalogue is damaged.
        UsageError: a role or a component in `roles` does not exist, or the title is not unique.
    """
    diagram = read_diagram(Path(path))
    reading = _Reading(diagram, CircuitBuilder(diagram.path, TOOL.lower(), project))
    reading.builder.give_roles(roles or {}, {identity: part.identity for identity, part in reading.parts.items()})
    return reading.circuit(Path(path).stem), reading.builder.findings


class _Reading:
    """Reads one file."""

    def __init__(self, diagram: Diagram, builder: CircuitBuilder) -> None:
        self.diagram = diagram
        self.builder = builder
        self.report = builder.report
        for cause, line in diagram.left_out:
            self.report("RS214", Severity.warning, f"{cause}, and was left out", line, "correct or remove the entry")
        self.twice: set[str] = set()
        self.parts = self._identified()
        self.variants: dict[str, tuple[str, ...]] = {}
        self.known = {identity: self._known(part) for identity, part in self.parts.items()}
        self._take_board()
        self.joined = Joined()
        self.used: dict[str, dict[str, None]] = {}
        self.wires: list[tuple[Connection, tuple[End, End]]] = []

    def _identified(self) -> dict[str, DiagramPart]:
        """The parts by identity: their id, made unique if several parts have it."""
        found: dict[str, DiagramPart] = {}
        for part in self.diagram.parts:
            identity = free_identity(part.identity, part.line, found)
            if identity != part.identity:
                why = f"the id '{part.identity}' occurs twice" if part.identity else "a part has no id"
                lost = "; connections to it are left out" if part.identity else ""
                fix = "give each part a unique id"
                self.report("RS206", Severity.warning, f"{why}: this '{part.kind}' becomes {identity}{lost}", part.line, fix)
                self.twice.add(part.identity)
            found[identity] = part
        return found

    def _known(self, part: DiagramPart) -> tuple[str, KnownPart]:
        """The id under which the part is known, perhaps of a variant of its type, and what is known about it."""
        if part.kind not in self.variants:
            self.variants[part.kind] = self.builder.catalogue.variants(part.kind)
        listed = {f"{name}={value}" for name, value in part.attributes.items()} if self.variants[part.kind] else ()
        part_id = next((f"{part.kind} {told}" for told in self.variants[part.kind] if told in listed), part.kind)
        title = next((part.kind.removeprefix(p) for p in _PREFIXES if part.kind.startswith(p)), part.kind)
        described = Part(part.kind, title, source="the diagram")
        return part_id, self.builder.know(part_id, described, own=part.kind.startswith(_OWN))

    def _take_board(self) -> None:
        """If no part is a known board, take the only part of unknown type that is named like a board for one."""
        if any(known.part.role == "Board" for _, known in self.known.values()):
            return
        called = [i for i, part in self.parts.items() if part.kind.startswith(_BOARD) and not self.known[i][1].part.connectors]
        if len(called) == 1:
            kind = self.parts[called[0]].kind
            evidence = f"no other part is a board, and its type begins with '{_BOARD}'"
            board = Part(kind, kind.removeprefix(_BOARD), role="Board", evidence=evidence, source="the diagram")
            self.known[called[0]] = f"{kind} (board)", self.builder.know(f"{kind} (board)", board)

    def circuit(self, name: str) -> hardware.Circuit:
        """The model, and the findings of the builder with it."""
        for connection in self.diagram.connections:
            self._connect(connection)
        self._join_symbols()
        groups: dict[Node, list[End]] = {}
        for identity, part in self.parts.items():
            self._place(identity, part, groups)
        net_of = {root: self.builder.net(ends) for root, ends in groups.items()}
        for connection, ends in self.wires:
            net = net_of.get(self.joined.find(self._node(ends[0])))
            self.builder.wire(f"connection{connection.number}", list(dict.fromkeys(ends)), net, connection.color)
        if len(self.parts) > 1 and not self.wires:
            self.report("RS212", Severity.warning, "no part is connected to another", fix="connect the parts in Wokwi")
        return self.builder.circuit(name, self.diagram.digest, TOOL, self.diagram.version)

    def _connect(self, connection: Connection) -> None:
        if any(end.startswith(_NO_PART) for end in connection.ends):
            return
        one, other = (self._end(text, connection) for text in connection.ends)
        for end in (one, other):
            if end is not None:
                self.used.setdefault(end.component, {})[end.connector] = None
        if one is not None and other is not None:
            self.joined.union(self._node(one), self._node(other))
            self.wires.append((connection, (one, other)))

    def _end(self, text: str, connection: Connection) -> End | None:
        """The connector at an end of a connection; None, with a finding, if it does not exist."""
        identity, _, pin = text.partition(":")
        if identity not in self.parts and (longer := text.rpartition(":"))[0] in self.parts:
            identity, _, pin = longer
        left_out = "; the connection was left out"
        if identity in self.twice:
            cause = f"'{text}' is ambiguous: the id '{identity}' occurs twice{left_out}"
            self.report("RS206", Severity.warning, cause, connection.line, "give each part a unique id")
            return None
        if identity not in self.parts:
            guess = did_you_mean(identity, self.parts)
            cause = f"a connection leads to '{text}', but no part has the id '{identity}'{guess}{left_out}"
            self.report("RS207", Severity.warning, cause, connection.line, "correct the connection, or add the part")
            return None
        _, known = self.known[identity]
        if not pin or not known.part.has(pin):
            pins = [*known.part.connectors]
            more = ", ..." if len(pins) > _NAMED else ""
            fix = f"use one of its pins: {', '.join(pins[:_NAMED])}{more}" if pins else "use one of its pins"
            cause = f"'{identity}' ({self.parts[identity].kind}) has no pin '{pin}'{did_you_mean(pin, pins)}{left_out}"
            self.report("RS208", Severity.warning, cause, connection.line, fix)
            return None
        return End(identity, pin)

    def _node(self, end: End) -> Node:
        return end.component, self.known[end.component][1].leader(end.connector)

    def _join_symbols(self) -> None:
        first: dict[str, Node] = {}
        for identity, part in self.parts.items():
            pin = _SYMBOLS.get(part.kind)
            if pin is not None and pin in self.used.get(identity, ()):
                self.joined.union(first.setdefault(part.kind, (identity, pin)), (identity, pin))

    def _place(self, identity: str, part: DiagramPart, groups: dict[Node, list[End]]) -> None:
        part_id, known = self.known[identity]
        used = self.used.get(identity, {})
        listed = known.part.connectors or known.part.shapes
        placed = Placed(
            identity=identity,
            part_id=part_id,
            title=part.identity,
            properties=part.attributes,
            used=used,
            names={} if listed else {pin: pin.rpartition(".")[0] or pin if _counted(pin) else pin for pin in used},
            line=part.line,
            symbol=part.kind in _SYMBOLS,
            listed_as=part.kind,
        )
        for connector in self.builder.place(placed).connectors:
            node = (identity, known.leader(connector.connectorId))
            if node in self.joined:
                groups.setdefault(self.joined.find(node), []).append(End(identity, connector.connectorId))


def _counted(pin: str) -> bool:
    """Whether a pin is one of several with the same name (`GND.2`)."""
    return pin.rpartition(".")[2].isdigit() and not pin[0].isdigit()
