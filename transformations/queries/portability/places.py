"""The places of a program that may behave otherwise on another board: each kind by its rule.

A kind of `portability.toml` has the rule of its name in `kinds`, else the one for names, headers and types. Rules only find
places; what a kind is called and when it behaves the same is data.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from robosmi.transformations.knowledge.platforms.portability_facts import PlaceKind, PortabilityFacts
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.portability.analysed_program import AnalysedProgram, PortabilityPlace
from robosmi.transformations.queries.portability.board_move import BoardMove
from robosmi.transformations.queries.portability.kinds import RULES, named


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
