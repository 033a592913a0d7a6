"""The wiring of a plan as a Wokwi diagram: how parts are drawn, which pins are wired, and which parts Wokwi lacks.

A net is drawn as wires from one pin, the board's if it has one; breadboards are left out. A passive part that Wokwi lacks and
that carries a signal is replaced by a wire and listed; any other such part is listed and not drawn. Types and pins of parts are
in `knowledge/wokwi_types`; the file is written by `m2t/wokwi_project`.
"""

from __future__ import annotations

from collections import Counter
from pathlib import Path

from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.metamodels import hardware, migration
from robosmi.transformations.knowledge.described_circuit import joins_by_bus_only
from robosmi.transformations.knowledge.drawn_boards import PIN_TABLE
from robosmi.transformations.knowledge.wokwi_diagram import DrawnPart, NotDrawn, WokwiWiring
from robosmi.transformations.knowledge.wokwi_types import WokwiBoard, WokwiPart, boards_of_wokwi, wokwi_board, wokwi_part
from robosmi.transformations.queries.connector_names import told_name

_GROUND, _SUPPLY = "GND", "5V"


def wokwi_wiring(plan: migration.MigrationPlan, project: Path | None = None) -> WokwiWiring:
    """The wiring of a plan.

    Args:
        plan: a plan with a circuit and a board.
        project: the project folder, whose own data goes first; the current folder if None.

    Raises:
        SourceError: the plan has no drawing, or Wokwi does not draw its board.
    """
    circuit, component, board = plan.circuit, plan.boardComponent, plan.board
    if circuit is None or component is None or board is None:
        raise SourceError("the plan has no drawing, and so no wiring", fix="run migrate with --hardware SKETCH")
    drawn = wokwi_board(board.name, project)
    if drawn is None:
        known = ", ".join(boards_of_wokwi(project))
        raise SourceError(
            f"Wokwi has no board '{board.title}'", location=Location(circuit.path), fix=f"it has: {known}; take another form"
        )
    return _Wiring(plan, circuit, component, drawn, project).made()


class _Wiring:
    """Builds the wiring of one plan."""

    def __init__(
        self,
        plan: migration.MigrationPlan,
        circuit: hardware.Circuit,
        board: hardware.Component,
        drawn: WokwiBoard,
        project: Path | None,
    ) -> None:
        self.plan, self.circuit, self.board, self.drawn, self.project = plan, circuit, board, drawn, project
        self.result = WokwiWiring()
        self.names: dict[hardware.Component, str] = {}
        self.parts: dict[hardware.Component, WokwiPart] = {}
        self.same: dict[int, int] = {}
        """Nets by their identity -> the one that stands for them: those that a wire in place of a part joins."""

    def made(self) -> WokwiWiring:
        self._name(self.board)
        self.result.parts.append(DrawnPart(self.names[self.board], self.drawn.kind, {}))
        for component in self.circuit.components:
            if component is not self.board:
                self._draw(component)
        self._wire()
        if self.circuit.tool == PIN_TABLE:
            self._supply()
        return self.result

    # ---- parts

    def _draw(self, component: hardware.Component) -> None:
        connected = [c for c in component.connectors if c.net is not None]
        joins = component.role is hardware.Role.Passive and joins_by_bus_only(component)
        if component.role is hardware.Role.Decoration or not connected or joins:
            return
        if component.role is hardware.Role.Board:
            self._list(component, "it is a board of its own")
            return
        part = wokwi_part(component, connected, self.project)
        if part is None:
            self._list(component, "Wokwi's elements have no part that stands for it")
            return
        mapped = {c.connectorId: c for n in self.plan.connections if n.component is component for c in n.connectors}
        if lost := [told_name(c) or c.connectorId for identity, c in mapped.items() if identity not in part.pins]:
            self._list(component, f"its {', '.join(lost)} is no pin of {part.kind}")
            return
        self._name(component)
        self.parts[component] = part
        self.result.parts.append(DrawnPart(self.names[component], part.kind, dict(part.attributes)))

    def _name(self, component: hardware.Component) -> None:
        wanted = (component.title or component.partTitle or f"part{component.elementId}").replace(":", "_").lstrip("$") or "part"
        name, number = wanted, 1
        while name in self.names.values():
            number += 1
            name = f"{wanted} ({number})"
        self.names[component] = name

    def _list(self, component: hardware.Component, why: str) -> None:
        pins = [_label(n) for n in self.plan.connections if n.component is component or component in n.via]
        bridged = component.role is hardware.Role.Passive and any(component in n.via for n in self.plan.connections)
        if bridged:
            nets = list(dict.fromkeys(id(c.net) for c in component.connectors if c.net is not None and not c.net.rail))
            for other in nets[1:]:
                self.same[self._root(other)] = self._root(nets[0])
            why += "; a wire stands in its place"
        title = component.title or component.partTitle or f"#{component.elementId}"
        part = component.partTitle or component.partId
        self.result.not_drawn.append(NotDrawn(title, component.elementId, part, tuple(dict.fromkeys(pins)), why))

    # ---- wires

    def _wire(self) -> None:
        groups: dict[int, list[hardware.Net]] = {}
        for net in self.circuit.nets:
            groups.setdefault(self._root(id(net)), []).append(net)
        for nets in groups.values():
            ends = list(dict.fromkeys(end for net in nets for c in net.connectors if (end := self._end(c)) is not None))
            if (tied := self._tied(nets)) is not None and tied not in ends:
                ends.append(tied)
            ends.sort(key=lambda end: not end.startswith(f"{self.names[self.board]}:"))
            carried = next((net.voltage or "supply" for net in nets if net.rail), "")
            self.result.wires += [(ends[0], other, carried) for other in ends[1:]]

    def _tied(self, nets: list[hardware.Net]) -> str | None:
        """The board's supply pin for a supply net that one of its pins is tied to; the drawing's supply symbol is not drawn."""
        rail = next((net for net in nets if net.rail), None)
        if rail is None or not any(c.component is self.board and c.pin for net in nets for c in net.connectors):
            return None
        pin = self.drawn.supplies.get(rail.voltage) or self.drawn.supplies.get(_SUPPLY)
        return f"{self.names[self.board]}:{pin}" if pin else None

    def _root(self, net: int) -> int:
        while net in self.same:
            net = self.same[net]
        return net

    def _end(self, connector: hardware.Connector) -> str | None:
        component = connector.component
        if component is None or component not in self.names:
            return None
        pin = self._board_pin(connector) if component is self.board else self.parts[component].pins.get(connector.connectorId)
        return f"{self.names[component]}:{pin}" if pin else None

    def _board_pin(self, connector: hardware.Connector) -> str | None:
        if connector.pin:
            return self.drawn.pins.get(connector.pin)
        if connector.kind is hardware.ConnectorKind.ground:
            return self.drawn.supplies.get(_GROUND)
        name = connector.name.upper().replace("3V3", "3.3V").lstrip("+")
        return self.drawn.supplies.get(name) if connector.kind is hardware.ConnectorKind.supply else None

    def _supply(self) -> None:
        """Add wires from the parts' supply and ground pins to the board, which a pin table does not mention."""
        used = {end for wire in self.result.wires for end in wire[:2]}
        board = self.names[self.board]
        for component, part in self.parts.items():
            name = self.names[component]
            rest = {pin: _GROUND if kind == "ground" else _SUPPLY for pin, kind in part.supplies.items()}
            if all(f"{name}:{pin}" in used for pin in part.returns):
                rest |= dict.fromkeys(part.feeds, _SUPPLY)
            for pin, carried in (rest | dict(part.returns)).items():
                end, own = f"{name}:{pin}", self.drawn.supplies.get(carried)
                if end not in used and own is not None:
                    self.result.wires.append((f"{board}:{own}", end, carried))
                    self.result.added += 1
        ends = Counter(end.rpartition(":")[0] for wire in self.result.wires for end in wire[:2])
        self.result.loose = [name for component in self.parts if ends[name := self.names[component]] == 1]


def _label(connection: migration.Connection) -> str:
    if connection.pin is not None:
        return str(connection.pin.label)
    return str(connection.boardConnectors[0].pin) if connection.boardConnectors else ""
