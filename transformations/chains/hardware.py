"""The chain `hardware`: a drawing to its hardware model, and which board pin drives what."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from robosmi.diagnostics import Finding
from robosmi.metamodels import hardware as hw
from robosmi.metamodels import migration, platform
from robosmi.transformations.chains.reading import read_drawing
from robosmi.transformations.constraints.electrical import electrical_findings
from robosmi.transformations.queries.circuit import boards, hardware_report, the_board


@dataclass(frozen=True)
class HardwareAnalysis:
    """A drawing that was analysed: its hardware model, the connections, the contract's result, the findings."""

    circuit: hw.Circuit
    connections: Sequence[migration.Connection]
    board_models: Mapping[str, platform.Board]
    result: dict[str, Any]
    findings: list[Finding]

    def lines(self) -> list[str]:
        """What a person reads: the components with their roles, what only passes a signal on, and the wiring table."""
        titles = ", ".join(b["title"] for b in self.result["boards"])
        shown = [c for c in self.circuit.components if c.role not in (hw.Role.Decoration, hw.Role.Passive)]
        between = [c for c in self.circuit.components if c.role is hw.Role.Passive]
        lines = [f"{titles}: {len(self.result['components'])} components, {len(self.result['mappings'])} connections", ""]
        rows = [(_title(c), c.partTitle or c.partId, c.role.name + (", driver" if c.driver else "")) for c in shown]
        lines += table(("component", "part", "role"), rows)
        if between:
            lines.append(f"  in between: {', '.join(_title(c) for c in between)}")
        boards = {b["model_index"]: b["title"] for b in self.result["boards"]}
        wires = [
            (
                f"{boards[m['board_model_index']]} {m['pin']}" if len(boards) > 1 else m["pin"],
                m["name"],
                m["signal"],
                " ".join(filter(None, (m["component"] or f"#{m['component_model_index']}", _in_brackets(m["connectors"])))),
                ", ".join(v["title"] for v in m["via"]),
            )
            for m in self.result["mappings"]
        ]
        return [*lines, "", *table(("pin", "name", "signal", "wired to", "through"), wires)]

    def picture(self, *, dot: str | None = None) -> str:
        """The circuit as SVG.

        Args:
            dot: the program of Graphviz that places things; None for the layout of this package.
        """
        from robosmi.transformations.m2t.circuit_picture import svg  # wanted with --svg only

        return svg(self.circuit, dot)

    def pin_table(self, target: Path) -> str:
        """The connections as a pin table, in the form that the file's ending says.

        Raises:
            UsageError: the ending is none of a pin table.
            SourceError: there is more than one board.
        """
        from robosmi.transformations.m2t.pin_table import pin_table  # wanted with --write-table only

        board = the_board(self.circuit)
        model = self.board_models.get(board.elementId)
        return pin_table(self.connections, model.name if model is not None else "", target)


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    """Lines of a table for a terminal, columns as wide as they have to be; the last one is not filled up."""
    cells = [[" ".join(cell.split()) for cell in row] for row in (head, *rows)]
    widths = [min(max(len(row[column]) for row in cells), 48) for column in range(len(head))]
    return [("  " + "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True))).rstrip() for row in cells]


def _title(component: hw.Component) -> str:
    return component.title or component.partTitle or f"#{component.elementId}"


def _in_brackets(connectors: Sequence[Mapping[str, str]]) -> str:
    told = ", ".join(name for c in connectors if (name := c["name"]))
    return f"({told})" if told else ""


def hardware(path: Path, *, roles: Mapping[str, str] | None = None) -> HardwareAnalysis:
    """Analyse a drawing.

    Args:
        path: the drawing.
        roles: COMPONENT -> role, as the project file says.

    Raises:
        SourceError: it cannot be read, or has no board.
    """
    drawing = read_drawing(path, roles or {})
    if not boards(drawing.circuit):
        the_board(drawing.circuit)  # says what is missing
    result = hardware_report(drawing.circuit, drawing.connections)
    findings = [*drawing.findings, *electrical_findings(drawing.circuit)]
    return HardwareAnalysis(drawing.circuit, drawing.connections, drawing.board_models, result, findings)
