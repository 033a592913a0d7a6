"""The board that a program runs on today: the user names it, the drawing beside the sketch has it, or it is the usual one."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec import Struct

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError, UsageError, did_you_mean
from robosmi.metamodels import ccode
from robosmi.transformations.chains.stages.reading import read_drawing
from robosmi.transformations.knowledge.board_models import mapped_boards
from robosmi.transformations.knowledge.platforms.board_pins import BoardPins, board_pins
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.platforms.portability_facts import portability_facts
from robosmi.transformations.knowledge.platforms.target_platform import TargetFacts, chip_macros, target_facts
from robosmi.transformations.queries.circuits.circuit import boards
from robosmi.transformations.queries.code import views

if TYPE_CHECKING:
    from robosmi.transformations.queries.portability.analysed_program import PortabilityPlace

ASSUMED = "RS115"


class SourceBoard(Struct, frozen=True):
    """The source board: its name, the macros that its compiler is given, and a finding if the board is a guess."""

    name: str
    facts: TargetFacts
    defines: Sequence[str]
    findings: Sequence[Finding]

    @property
    def pins(self) -> BoardPins | None:
        """How programs name and number its pins."""
        own = self.facts.model.platform
        return board_pins(own.boardMappings) if own is not None else None


def find_source_board(paths: Sequence[Path], api: ApiIndex, named: str | None, target: str | None) -> SourceBoard | None:
    """The board of a program; None on a platform whose programs are not for one of several boards.

    Args:
        paths: the program.
        api: its platform.
        named: the board that the user names.
        target: the target that the program is judged for; without one a guess is no finding.

    Raises:
        UsageError: there is no such board, or the platform has none.
    """
    sketch = api.sketch
    if sketch is None:
        if named is not None:
            raise UsageError(f"--from: programs for '{api.name}' run on one board", fix="leave out --from")
        return None
    name = named or _drawn(paths)
    findings = []
    if name is None:
        name = sketch["board"]
        if target is not None:
            told = f"the board of this sketch is not given: '{name}' is assumed"
            place, fix = Location(str(paths[0])), 'give it with --from NAME, or write from = "NAME" in [migrate] of robosmi.toml'
            findings.append(Finding(ASSUMED, Severity.info, told, place, fix=fix))
    try:
        facts = target_facts(name)
    except UsageError as error:
        known = mapped_boards(api.name)
        raise UsageError(
            f"--from: unknown board '{name}'{did_you_mean(name, known)}", fix=f"use one of: {', '.join(known)}"
        ) from error
    board = facts.board_model
    mapping = next(iter(facts.model.platform.boardMappings), None) if facts.model.platform is not None else None
    chip = board.microcontroller
    defines = [f"ARDUINO_{mapping.define}"] if mapping is not None and mapping.define else []
    if chip is not None and str(chip.architecture) == api.settings.get("architecture"):
        defines += chip_macros(chip)
    return SourceBoard(name, facts, [*defines, f"F_CPU={board.clockHertz}L"], findings)


def _drawn(paths: Sequence[Path]) -> str | None:
    """The board of the one drawing that lies beside the sketch; None where there is none, or several, or it has no such board."""
    folder = paths[0] if paths[0].is_dir() else paths[0].parent
    found = [path for name in ("diagram.json", "*.fzz", "*.fz") for path in sorted(folder.glob(name))]
    if len(found) != 1:
        return None
    try:
        drawn = {str(board.boardName) for board in boards(read_drawing(found[0], {}).circuit) if board.boardName}
    except SourceError:
        return None
    return drawn.pop() if len(drawn) == 1 else None


def places_of(program: ccode.Program, api: ApiIndex, board: SourceBoard | None, target: str) -> list[PortabilityPlace]:
    """The places that may behave differently on a target.

    Raises:
        UsageError: there is no such target, or nothing is known about programs of this platform.
    """
    from robosmi.transformations.queries.portability.board_move import BoardMove, board_side  # only `analyse` asks for places
    from robosmi.transformations.queries.portability.places import portability

    facts = portability_facts(api.name)
    if facts is None or board is None:
        raise UsageError(f"--target: nothing is known about moving programs of '{api.name}' by place", fix="run robosmi migrate")
    move = BoardMove(board_side(board.facts.model), board_side(target_facts(target).model))
    return portability(views(program, api), facts, move)


def bundled_library(path: str, api: ApiIndex) -> str | None:
    """The folder of the library that a sketch brings along and that has a file; None for a file of the sketch's own.

    A library is a folder directly in the sketch's folder of sources with a header of its name: it is replaced as a whole.
    """
    sources = api.sketch["sources"] if api.sketch is not None else ""
    parts = Path(path).parts
    for place in range(len(parts) - 2):
        folder = Path(*parts[: place + 2])
        if parts[place] == sources and (folder / f"{parts[place + 1]}.h").is_file():
            return str(folder)
    return None
