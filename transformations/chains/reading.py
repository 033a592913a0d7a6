"""What several chains begin with: a program read and prepared for storing, a drawing read and mapped."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from robosmi.diagnostics import Finding, Location
from robosmi.errors import SourceError, UsageError
from robosmi.metamodels import ccode, hardware, migration, platform
from robosmi.plugins import content
from robosmi.project import defaults
from robosmi.transformations.m2m.connector_mapping import map_connectors
from robosmi.transformations.queries.circuit import boards
from robosmi.transformations.t2m.boards import drawn_board, load_board


def reader_for(path: Path, fallback: str | None = None) -> object:
    """The registered reader for a file's ending.

    Args:
        path: the file.
        fallback: the reader's name for endings nobody knows; None to refuse them.

    Raises:
        SourceError: no reader takes such a file.
    """
    readers = defaults()["readers"]
    name = readers.get(path.suffix.lower(), fallback)
    if name is None:
        known = ", ".join(sorted(readers))
        raise SourceError(f"no reader takes a '{path.suffix or path.name}' file", location=Location(str(path)), fix=f"give one of: {known}")
    return content("reader", name)


def read_program(
    paths: Sequence[Path], platform_name: str, include_dirs: Sequence[Path], defines: Sequence[str]
) -> tuple[ccode.Program, list[Finding]]:
    """Read the source files of one program.

    Raises:
        SourceError: a file cannot be read as a program.
        UsageError: a file is given twice.
    """
    seen: set[Path] = set()
    for path in paths:
        if path.resolve() in seen:
            raise UsageError(f"'{path}' is given twice", fix="give each source file once")
        seen.add(path.resolve())
    read = content("reader", defaults()["readers"].get(paths[0].suffix.lower(), "c_source"))
    program: ccode.Program
    findings: list[Finding]
    program, findings = read(paths, platform=platform_name, include_dirs=include_dirs, defines=defines)
    return program, findings


@dataclass(frozen=True)
class Drawing:
    """A drawing that was read and mapped.

    Attributes:
        circuit: the hardware model.
        board_models: element id of a board component -> the platform's board.
        connections: of all its boards.
        findings: what was odd.
    """

    circuit: hardware.Circuit
    board_models: Mapping[str, platform.Board]
    connections: Sequence[migration.Connection]
    findings: list[Finding]


def read_drawing(path: Path, roles: Mapping[str, str]) -> Drawing:
    """Read a drawing and map its boards' pins to its components.

    Args:
        path: the drawing.
        roles: COMPONENT -> role, as the project file says.

    Raises:
        SourceError: it cannot be read.
        UsageError: a role or component does not exist.
    """
    read = reader_for(path)
    circuit: hardware.Circuit
    circuit, findings = read(path, roles=roles)  # type: ignore[operator]
    models: dict[str, platform.Board] = {}
    for board in boards(circuit):
        drawn = drawn_board(board.partId, circuit.tool.lower())
        if drawn is not None:
            models[board.elementId] = load_board(drawn.name)
    connections, odd = map_connectors(circuit, models)
    return Drawing(circuit, models, connections, [*findings, *odd])
