"""Numbers that a sketch gives to classes that nobody knows: one of them may be a pin, and would be a wrong one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from robosmi.metamodels import ccode
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.library_pins import may_be_pin
from robosmi.transformations.queries.portability.analysed_program import PortabilityPlace
from robosmi.transformations.queries.portability.board_move import BoardMove

KIND = "unknown_argument"


def unknown_arguments(views: Sequence[CodeView], move: BoardMove) -> Iterator[PortabilityPlace]:
    """The constructions of objects of unknown classes with numbers that mean other pins on the other board, by line.

    Args:
        views: a view of each unit of the program.
        move: from which board to which.
    """
    own = {str(record.name) for view in views for record in view.of_kind(ccode.Record)}
    here, there = move.source.numbers, move.target.numbers
    for view in views:
        for made in view.of_kind(ccode.ConstructorCall):
            name = str(made.className)
            if not name or name in own or view.resolve(name) is not None or view.api.pins(name, "") is not None:
                continue
            numbers = [number for argument in made.arguments if (number := _number(argument, view)) is not None]
            moved = [str(number) for number in numbers if number in here and here[number] != there.get(number)]
            if moved:
                what = f"{', '.join(moved)} {'are' if len(moved) > 1 else 'is'} given to '{name}', which is unknown"
                what += f": if {'these are pins' if len(moved) > 1 else 'this is a pin'}, write {move.target.title}'s"
                yield PortabilityPlace(KIND, str(view.unit.path), int(made.line), what, "task", name)


def _number(argument: ccode.Expression, view: CodeView) -> int | None:
    """The number that an argument is; None for one that is followed as a pin, and for what is no number."""
    if isinstance(argument, ccode.NameReference) and may_be_pin(str(argument.name)):
        return None
    if not isinstance(argument, (ccode.IntegerLiteral, ccode.NameReference)):
        return None
    values = view.values.of(argument)
    return values[0].number if len(values) == 1 else None
