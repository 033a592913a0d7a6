"""The places of a program that may behave otherwise on another board: each kind by its rule.

A kind of `portability.toml` has the rule of its name in `kinds`, else the one for names, headers and types. Rules only find
places; what a kind is called and when it behaves the same is data.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.platforms.portability_facts import PlaceKind, PortabilityFacts
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.library_pins import may_be_pin
from robosmi.transformations.queries.portability.analysed_program import AnalysedProgram, PortabilityPlace
from robosmi.transformations.queries.portability.board_move import BoardMove
from robosmi.transformations.queries.portability.kinds import RULES, named

_KIND = "unknown_argument"


def portability(
    views: Sequence[CodeView], facts: PortabilityFacts, move: BoardMove, sources: Mapping[str, bytes] | None = None
) -> list[PortabilityPlace]:
    """The places, by file and line; each line once for a kind.

    Args:
        views: a view of each unit of the program.
        facts: the facts about programs of the source platform.
        move: from which board to which.
        sources: path of a unit -> its bytes; None to read the files.
    """
    seen = AnalysedProgram(views, facts, move, sources)
    order = {id(view.unit): number for number, view in enumerate(views)}
    paths = {str(view.unit.path): order[id(view.unit)] for view in views}
    found: dict[tuple[str, str, int], PortabilityPlace] = {}
    for name, kind in facts.kinds.items():
        for place in _places(name, kind, seen) if kind.when == "analyse" else ():
            found.setdefault((name, place.path, place.line), place)
    return sorted(found.values(), key=lambda place: (paths.get(place.path, 0), place.line))


def _places(name: str, kind: PlaceKind, seen: AnalysedProgram) -> Iterator[PortabilityPlace]:
    if _alike(kind, seen.move):
        return
    for at, what in RULES.get(name, named)(kind, seen):
        text = kind.what.format(name=what, target=seen.move.target.title)
        yield PortabilityPlace(name, seen.path_of(at), at.line, text, kind.cure, what)


def _alike(kind: PlaceKind, move: BoardMove) -> bool:
    source, target = move.source, move.target
    same_chip = source.chip == target.chip
    return (kind.alike == "microcontroller" and same_chip) or (
        kind.alike == "architecture" and source.architecture == target.architecture
    )


def unknown_arguments(views: Sequence[CodeView], move: BoardMove) -> Iterator[PortabilityPlace]:
    """The constructions of objects of unknown classes with numbers that mean other pins on the other board, by line.

    One of the numbers may be a pin, and would be a wrong one.

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
                yield PortabilityPlace(_KIND, str(view.unit.path), int(made.line), what, "task", name)


def _number(argument: ccode.Expression, view: CodeView) -> int | None:
    """The number that an argument is; None for one that is followed as a pin, and for what is no number."""
    if isinstance(argument, ccode.NameReference) and may_be_pin(str(argument.name)):
        return None
    if not isinstance(argument, (ccode.IntegerLiteral, ccode.NameReference)):
        return None
    values = view.values.of(argument)
    return values[0].number if len(values) == 1 else None
