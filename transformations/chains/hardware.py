"""The chain `hardware`: reads a drawing into its hardware model and determines which board pin drives what."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from robosmi.base.quantities import quantity
from robosmi.chain import Chain
from robosmi.chain.run import Progress
from robosmi.diagnostics import Finding
from robosmi.inputs import read_once
from robosmi.metamodels import hardware as hw, migration, platform
from robosmi.resources import project_of_input
from robosmi.transformations.chains.stages.constraint_sets import added_hardware_findings
from robosmi.transformations.chains.stages.reading import HEADERS_ONLY, NO_BOARD, Drawing, read_drawing
from robosmi.transformations.constraints.electrical import electrical_findings
from robosmi.transformations.queries.circuits.circuit import boards, hardware_report, of_board, pin_label, the_board
from robosmi.transformations.queries.circuits.connector_names import ConnectorNames

if TYPE_CHECKING:
    from robosmi.transformations.knowledge.platforms.target_platform import TargetFacts


class HardwareAnalysis(Struct, frozen=True):
    """A drawing that was analysed: its hardware model, the connections, the contract's result, the findings."""

    circuit: hw.Circuit
    connections: Sequence[migration.Connection]
    board_models: Mapping[str, platform.Board]
    result: dict[str, Any]
    findings: list[Finding]

    def lines(self) -> list[str]:
        """The text for the user: the components with their roles, parts that only pass a signal on, and the wiring table."""
        drawn, known = boards(self.circuit), ConnectorNames()
        titles = ", ".join(b.title for b in drawn)
        shown = [c for c in self.circuit.components if c.role not in (hw.Role.Decoration, hw.Role.Passive)]
        between = [c for c in self.circuit.components if c.role is hw.Role.Passive]
        counts = f"{quantity(len(self.circuit.components), 'component')}, {quantity(len(self.connections), 'connection')}"
        lines = [f"{titles or 'no board'}: {counts}", ""]
        rows = [(_title(c), c.partTitle or c.partId, c.role.name + (", driver" if c.driver else "")) for c in shown]
        lines += table(("component", "part", "role"), rows)
        if between:
            lines.append(f"  in between: {', '.join(_title(c) for c in between)}")
        if not drawn:
            nets = [(net.title or net.voltage or net.name, _pins(net, known)) for net in self.circuit.nets]
            return [*lines, "", *table(("net", "pins"), nets)]
        wires = [_wire(connection, known, len(drawn) > 1) for connection in self.connections]
        return [*lines, "", *table(("pin", "name", "signal", "wired to", "through"), wires)]

    def picture(self) -> str:
        """The circuit as SVG, with the findings at their places."""
        from robosmi.transformations.m2t.circuits.circuit_picture import svg  # wanted with --svg only

        return svg(self.circuit, self.findings)

    def pin_table(self, target: Path) -> str:
        """The connections as a pin table, in the format that the file's ending selects.

        Raises:
            UsageError: the ending is none of a pin table.
            SourceError: there is more than one board.
        """
        from robosmi.transformations.knowledge.electrical_facts import rests_beyond_names
        from robosmi.transformations.m2t.pin_table import pin_table  # wanted with --write-table only
        from robosmi.transformations.queries.circuits.electrical import fed_parts

        board = the_board(self.circuit)
        model = self.board_models.get(board.elementId)
        name = model.name if model is not None else ""
        rests, volts = rests_beyond_names(self.circuit.components), fed_parts(self.circuit)
        return pin_table(of_board(self.connections, board), name, target, rests, volts)


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    """The lines of a table for a terminal, with columns as wide as necessary; the last column is not padded."""
    cells = [[" ".join(cell.split()) for cell in row] for row in (head, *rows)]
    widths = [min(max(len(row[column]) for row in cells), 48) for column in range(len(head))]
    return [("  " + "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True))).rstrip() for row in cells]


def _title(component: hw.Component) -> str:
    return component.title or component.partTitle or f"#{component.elementId}"


def _wire(connection: migration.Connection, known: ConnectorNames, several: bool) -> tuple[str, str, str, str, str]:
    """A row of the wiring table; if there are several boards, the pin names the board."""
    board = connection.boardConnectors[0].component if connection.boardConnectors else None
    component = connection.component
    names = ", ".join(filter(None, map(known.of, connection.connectors)))
    wired_to = component.title or f"#{component.elementId}" if component is not None else "#"
    return (
        f"{board.title} {pin_label(connection)}" if several and board is not None else pin_label(connection),
        connection.name,
        connection.signal.name,
        f"{wired_to} ({names})" if names else wired_to,
        ", ".join(c.title for c in connection.via),
    )


def _pins(net: hw.Net, known: ConnectorNames) -> str:
    placed = [(c, c.component) for c in net.connectors if c.component is not None]
    return ", ".join(f"{part.title or '#' + part.elementId} {known.of(c) or c.connectorId}" for c, part in placed)


def hardware_chain() -> Chain:
    """The steps from a drawing to the value `analysis`; each can be replaced by its name (`Chain.replace`)."""
    chain = Chain(None, "hardware")
    chain.given("path", "roles", target_name=None)
    chain.call(drawing, makes="drawing", step="read the drawing")
    chain.call(faults, makes="faults", step="check the circuit")
    chain.call(analysed, makes="analysis", step="put the result together")
    return chain


def drawing(path: Path, roles: Mapping[str, str], target_name: str | None) -> Drawing:
    """The circuit with its connections.

    A schematic may be one sheet of several, so one without a board is read, too; the reader has reported that.

    Raises:
        SourceError: the drawing cannot be read, has no board and is no schematic, or has another board than the target's.
        UsageError: there is no such target.
    """
    made = drawing_for(path, roles, target_name)
    if not boards(made.circuit) and not any(finding.rule in (HEADERS_ONLY, NO_BOARD) for finding in made.findings):
        the_board(made.circuit)  # says what is missing
    return made


def drawing_for(path: Path, roles: Mapping[str, str], target_name: str | None) -> Drawing:
    """A drawing of the target's board, if there is a target.

    Raises:
        SourceError: the drawing cannot be read, or has another board than the target's.
        UsageError: there is no such target.
    """
    if not target_name:
        return read_drawing(path, roles)
    from robosmi.transformations.knowledge.platforms.target_platform import target_facts  # wanted with --target only

    facts = target_facts(target_name)
    made = read_drawing(path, roles, facts.board)
    _check_target(made, facts, path)
    return made


def _check_target(made: Drawing, facts: TargetFacts, path: Path) -> None:
    """Refuse a drawing with boards of which none is the target's."""
    from robosmi.transformations.chains.stages.hardware_stage import checked_board  # wanted with --target only

    drawn = [(board, made.board_models.get(board.elementId)) for board in boards(made.circuit)]
    if drawn and not any(model is not None and model.name == facts.board for _, model in drawn):
        checked_board(*drawn[0], facts, path)


def faults(drawing: Drawing) -> list[Finding]:
    """What the electrical constraints find, and those of plug-ins."""
    return [*electrical_findings(drawing.circuit), *added_hardware_findings(drawing.circuit)]


def analysed(drawing: Drawing, faults: list[Finding]) -> HardwareAnalysis:
    """Which board pin drives what, with all findings."""
    result = hardware_report(drawing.circuit, drawing.connections)
    findings = [*drawing.findings, *faults]
    return HardwareAnalysis(drawing.circuit, drawing.connections, drawing.board_models, result, findings)


def hardware(
    path: Path,
    *,
    roles: Mapping[str, str] | None = None,
    target: str | None = None,
    progress: Progress | None = None,
    chain: Chain | None = None,
) -> HardwareAnalysis:
    """Analyse a drawing.

    Args:
        path: the drawing.
        roles: COMPONENT -> role, as the project file says.
        target: the target whose board it has, for a file that does not say which; if None that of the project file beside it.
        progress: told of each step.
        chain: steps of one's own, which make `analysis`; `hardware_chain()` if None.

    Raises:
        SourceError: it cannot be read, has no board and is no schematic, or has another board than the target's.
        UsageError: there is no such target.
    """
    run = (chain or hardware_chain()).start(progress=progress, path=path, roles=roles or {}, target_name=target)
    with project_of_input(path), read_once():
        return run.value("analysis", HardwareAnalysis)
