"""The step of `migrate` for a program whose platform stays: what behaves differently on the other board, and what changes it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from msgspec import Struct

from robosmi.metamodels import ccode, platform
from robosmi.transform import Trace
from robosmi.transformations.chains.source_board import SourceBoard
from robosmi.transformations.chains.stages.program import StoredProgram
from robosmi.transformations.knowledge.platforms.board_pins import board_pins
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.platforms.portability_facts import portability_facts
from robosmi.transformations.knowledge.platforms.target_platform import TargetFacts
from robosmi.transformations.m2m.partition.platform_dependence import Dependence
from robosmi.transformations.m2m.sketches.pin_proposals import NewBoard
from robosmi.transformations.queries.plans.bus_pins import taken_by_buses

if TYPE_CHECKING:
    from robosmi.transformations.queries.portability.analysed_program import PortabilityPlace
    from robosmi.transformations.queries.portability.board_move import BoardMove


class RetainedProgram(Struct, frozen=True):
    """A program whose platform stays.

    Attributes:
        move: from which board to which.
        judged: what happens to each of its elements, and the trace of what this was made from.
        left: the places that behave differently and that no edit cures.
    """

    move: BoardMove
    judged: tuple[Dependence, Trace]
    left: Sequence[PortabilityPlace]


def new_board(
    program: StoredProgram, api: ApiIndex, target: TargetFacts, board: platform.Board, source_board: SourceBoard | None
) -> NewBoard | None:
    """The board that pins are proposed on for a program whose platform stays; None for any other program."""
    own = target.model.platform
    pins = board_pins(own.boardMappings) if own is not None else None
    if target.platform != api.name or source_board is None or api.board is None or pins is None:
        return None
    headers = {str(include.header) for view in program.views for include in view.unit.includes}
    settings = api.settings.get("ports", {})
    names = {str(each.name) for view in program.views for each in view.of_kind(ccode.NameReference)}
    labels = {*taken_by_buses(board, settings, headers, names).values()}
    return NewBoard(board, pins, api.board, source_board.facts.board_model, settings.get("abilities", {}), labels)


def retained_program(
    program: StoredProgram, api: ApiIndex, target: TargetFacts, board: platform.Board, source_board: SourceBoard | None
) -> RetainedProgram | None:
    """What happens to a program whose platform stays; None for a program of another platform than the target's."""
    facts = portability_facts(api.name)
    if target.platform != api.name or source_board is None or facts is None:
        return None
    # a program that changes its platform needs none of these
    from robosmi.transformations.m2m.sketches.retained_platform import retain_platform
    from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch
    from robosmi.transformations.queries.portability.board_move import BoardMove, board_side
    from robosmi.transformations.queries.portability.places import portability, unknown_arguments

    move = BoardMove(board_side(source_board.facts.model), board_side(target.model))
    places = [*portability(program.views, facts, move, program.copies), *unknown_arguments(program.views, move)]
    own, trace = source_board.facts.model.platform, Trace()
    source, there = move.source, move.target
    different = facts.move_between((source.chip, source.architecture), (there.chip, there.architecture))
    mappings = list(own.boardMappings) if own is not None else []
    clock_hz = int(source_board.facts.board_model.clockHertz)
    sketch = MovedSketch(program.views, program.copies, move, places, mappings, different, clock_hz, facts.kinds)
    dependence, left = retain_platform(sketch, trace)
    return RetainedProgram(move, (dependence, trace), left)
