"""The hardware's side of a migration: the drawing with the board of the target, as it is stored."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from msgspec import Struct

from robosmi import inputs
from robosmi.diagnostics import Finding, Location
from robosmi.errors import SourceError
from robosmi.metamodels import hardware as hw, platform
from robosmi.transformations.chains.stages.reading import HEADERS_ONLY, Drawing, read_drawing
from robosmi.transformations.knowledge.platforms.target_platform import TargetFacts
from robosmi.transformations.m2m.circuits.driven_devices import motor_channels
from robosmi.transformations.m2m.migration_plan import Hardware
from robosmi.transformations.queries.circuits.circuit import of_board, the_board


class StoredDrawing(Struct, frozen=True):
    """A drawing that was read and mapped, whose circuit refers to the stored copy.

    Attributes:
        hardware: the circuit, its board component, the connections.
        board: the board's model.
        given: path of the file as given.
        copy: path of its copy, relative to the models' folder.
        files: bytes of the drawing and of its companion files, each with the path of its copy.
        findings: the findings about the drawing.
    """

    hardware: Hardware
    board: platform.Board
    given: str
    copy: str
    files: Mapping[str, bytes]
    findings: list[Finding]


def stored_drawing(path: Path, roles: Mapping[str, str], target: TargetFacts) -> StoredDrawing:
    """Read the drawing of a migration's hardware.

    Args:
        path: the drawing.
        roles: COMPONENT -> role, as the project file says.
        target: the target, whose board it must have.

    Raises:
        SourceError: it cannot be read, has another board or none, or wires a part to a pin that the board has not.
        UsageError: a role or component does not exist.
    """
    drawing = read_drawing(path, roles, target.board)
    component = _board_of(drawing)
    connections = of_board(drawing.connections, component)
    board = checked_board(component, drawing.board_models.get(component.elementId), target, path)
    lost = next((finding for finding in drawing.findings if finding.rule == "RS223"), None)
    if lost is not None and any(connection.pin is None for connection in connections):
        labels = ", ".join(pin.label for pin in board.pins)
        raise SourceError(lost.message, location=Location(str(path)), fix=f"wire it to one of the board's pins: {labels}")
    drawing.circuit.path = copy = f"source/{path.name}"
    files = {copy: inputs.read_bytes(path, inputs.DRAWING)}
    for name in drawing.circuit.companions:
        files[f"source/{name}"] = inputs.read_bytes(path.parent / name, inputs.DRAWING)
    return StoredDrawing(
        Hardware(drawing.circuit, component, connections, motor_channels(connections)),
        board,
        str(path),
        copy,
        files,
        drawing.findings,
    )


def _board_of(drawing: Drawing) -> hw.Component:
    """The single board of a drawing; if there is none, the error repeats the reader's explanation, if it gave one.

    Raises:
        SourceError: there is none, or more than one; in the words of the reader where it has told why.
    """
    told = next((finding for finding in drawing.findings if finding.rule == HEADERS_ONLY), None)
    if told is not None:
        raise SourceError(told.message, location=told.location, fix=told.fix)
    return the_board(drawing.circuit)


def _tool(component: hw.Component) -> str:
    return str(component.circuit.tool) if component.circuit is not None else "the tool"


def checked_board(component: hw.Component, board: platform.Board | None, facts: TargetFacts, path: Path) -> platform.Board:
    """The drawn board, if it is known and is the target's.

    Raises:
        SourceError: it is one of these.
    """
    what = f"the board '{component.title}'"
    if board is None:
        raise SourceError(
            f"unknown board '{component.title}' ({component.partTitle or component.partId})",
            location=Location(str(path)),
            fix=f"use a board of the target '{facts.target}' there, or add its name in {_tool(component)}: [[drawn_as]] in "
            f"boards/NAME.toml, with modules = ['{component.partId}']",
        )  # fmt: skip
    if board.name != facts.board and not facts.any_board:
        raise SourceError(
            f"{path.name} has {what} ({board.title}), the target is '{facts.target}'",
            location=Location(str(path)), fix=f"give --target {board.name}, or the hardware of the target '{facts.target}'",
        )  # fmt: skip
    return board
