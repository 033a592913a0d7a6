"""A plug-in for tests: a drawing reader with its ending, a target, and ports of a part, offered by one entry point."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from robosmi.diagnostics import Finding
from robosmi.metamodels import hardware
from robosmi.plugins import Registry
from robosmi.transformations.t2m import pin_table


def register(registry: Registry) -> None:
    """The value of the entry point."""
    registry.add("drawing reader", "beacon", "beacon_plugin:read_circuit")
    registry.add_data(str(Path(__file__).parent / "beacon_data"))


def read_circuit(
    path: Path, project: Path | None = None, roles: Mapping[str, str] | None = None, board: str | None = None
) -> tuple[hardware.Circuit, list[Finding]]:
    """Read a file `.beacon`: lines `PIN PART`."""
    table = path.with_suffix(".csv")
    rows = [",".join(line.split(" ", 1)) for line in path.read_text().splitlines()]
    table.write_text("\n".join(["pin,part", *rows]) + "\n")
    return pin_table.read_circuit(table, project, roles, board)
