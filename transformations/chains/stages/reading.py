"""The first steps of several chains: reads a program and prepares it for storing, or reads a drawing and maps it."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from msgspec import Struct

from robosmi import resources
from robosmi.diagnostics import Finding, Location
from robosmi.errors import SourceError, UsageError, did_you_mean
from robosmi.plugin_contracts import ContentFunction, wrong_result
from robosmi.project import default_text, defaults
from robosmi.transformations.chains.stages.readers import DRAWING, reader_for
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.knowledge.described_circuit import describe
from robosmi.transformations.m2m.circuits.connector_mapping import map_connectors
from robosmi.transformations.queries.circuits.circuit import boards

M = TypeVar("M")
HEADERS_ONLY, NO_BOARD = "RS219", "RS229"
"""The readers' rules for a schematic without a board: it seems to be drawn as headers, or has none."""

if TYPE_CHECKING:
    from robosmi.metamodels import ccode, hardware, migration, platform


def read_program(
    paths: Sequence[Path], platform_name: str, include_dirs: Sequence[Path], defines: Sequence[str]
) -> tuple[ccode.Program, list[Finding]]:
    """Read the source files of one program.

    Raises:
        SourceError: a file cannot be read as a program, or is of another kind than the first.
        UsageError: a file is given twice, or there is no such platform.
    """
    check_source_platform(platform_name)
    seen: set[str] = set()
    readers = [reader_for(path, "program reader", "c_source") for path in paths]
    for path, reader in zip(paths, readers, strict=True):
        if os.path.realpath(path) in seen:
            raise UsageError(f"'{path}' is given twice", fix="give each source file once")
        seen.add(os.path.realpath(path))
        if reader != readers[0]:
            raise SourceError(
                "this file is in another language than the first", location=Location(str(path)), fix="give files of one language"
            )
    from robosmi.metamodels import ccode

    made = readers[0](paths, platform=platform_name, include_dirs=include_dirs, defines=defines)
    return _read(made, readers[0], ccode.Program, paths[0])


def check_source_platform(name: str) -> None:
    """Refuse a source platform that the repository does not have.

    Raises:
        UsageError: there is none of that name.
    """
    platforms = source_platforms()
    if name not in platforms:
        raise UsageError(
            f"unknown source platform '{name}'{did_you_mean(name, platforms)}", fix=f"use one of: {', '.join(platforms)}"
        )


def platform_of_files(paths: Sequence[Path]) -> str:
    """The source platform of a program by its files' endings, those directly in a folder included, else the default one."""
    settings = defaults()
    names = (name for path in paths for name in ([entry.name for entry in path.iterdir()] if path.is_dir() else [path.name]))
    endings = {os.path.splitext(name)[1].lower() for name in names}
    found = next((str(name) for ending, name in settings.get("source_platforms", {}).items() if ending in endings), None)
    return found or default_text("migrate", "source_platform")


def source_platforms() -> list[str]:
    """The platforms whose API the repository knows, sorted."""
    return sorted({api.parent.name for folder in resources.folders("platform_repo") for api in folder.glob("*/api.json")})


class Drawing(Struct, frozen=True):
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


def read_drawing(path: Path, roles: Mapping[str, str], board_name: str | None = None) -> Drawing:
    """Read a drawing and map its boards' pins to its components.

    Args:
        path: the drawing.
        roles: COMPONENT -> role, as the project file says.
        board_name: the board where the file does not say which; if None that of the project's target, or the default one.

    Raises:
        SourceError: it cannot be read.
        UsageError: a role or component does not exist.
        RuleError: its reader gives something else than a circuit and findings.
    """
    from robosmi.metamodels import hardware  # programs without a drawing need none

    reader = reader_for(path, DRAWING)
    circuit, findings = _read(reader(path, roles=roles, board=board_name), reader, hardware.Circuit, path)
    describe(circuit)
    models: dict[str, platform.Board] = {}
    for board in boards(circuit):
        if board.boardName:
            models[board.elementId] = load_board(board.boardName)
    connections, odd = map_connectors(circuit, models)
    return Drawing(circuit, models, connections, [*findings, *odd])


def _read(made: object, reader: ContentFunction, kind: type[M], path: Path) -> tuple[M, list[Finding]]:
    """The result of a reader, if it has the required form: a model of the given kind, and findings."""
    match made:
        case (model, [*given]) if isinstance(model, kind):
            findings = [each for each in given if isinstance(each, Finding)]
            if len(findings) == len(given):
                return model, findings
    raise wrong_result(reader, made, f"a {kind.__name__.lower()} and its findings", path)
