"""The chain `hardware`: a drawing to its hardware model, and which board pin drives what."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from robosmi.diagnostics import Finding
from robosmi.metamodels import hardware as hw
from robosmi.transformations.chains.reading import read_drawing
from robosmi.transformations.queries.circuit import boards, hardware_report, the_board


@dataclass(frozen=True)
class HardwareAnalysis:
    """A drawing that was analysed: its hardware model, the contract's result, the findings."""

    circuit: hw.Circuit
    result: dict[str, Any]
    findings: list[Finding]

    def lines(self) -> list[str]:
        """What a person reads."""
        titles = ", ".join(b["title"] for b in self.result["boards"])
        lines = [f"{titles}: {len(self.result['components'])} components, {len(self.result['mappings'])} connections"]
        for mapping in self.result["mappings"]:
            via = "".join(f" through {v['title']}" for v in mapping["via"])
            names = ", ".join(c["name"] for c in mapping["connectors"])
            lines.append(f"  {mapping['pin']:4} {mapping['name']:28} {mapping['component']} ({names}){via}")
        return lines


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
    return HardwareAnalysis(drawing.circuit, hardware_report(drawing.circuit, drawing.connections), drawing.findings)
