"""A program as the rules for portability see it: its views, the names it uses, the facts and the move."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.platforms.portability_facts import PortabilityFacts
from robosmi.transformations.queries.code import CodeView, unit_of
from robosmi.transformations.queries.portability.board_move import BoardMove
from robosmi.transformations.queries.portability.names import ForeignName, foreign_names
from robosmi.transformations.queries.portability.pin_origins import PinOrigin, PinOrigins

DIFFERS = "RS346"
"""The rule of a place that behaves differently on the target, and that no rule of `m2m.sketches` changes."""


class PortabilityPlace(Struct, frozen=True):
    """A place that may behave otherwise: contract `portability[]`."""

    kind: str
    path: str
    line: int
    what: str
    cure: str
    name: str = ""


class At(Struct, frozen=True):
    """A line of a unit."""

    unit: ccode.SourceUnit
    line: int


class AnalysedProgram:
    """What the rules ask for, each answered once.

    Args:
        views: a view of each unit.
        facts: the facts about programs of the platform.
        move: from which board to which.
        sources: path of a unit -> its bytes; None to read the files.
    """

    def __init__(
        self, views: Sequence[CodeView], facts: PortabilityFacts, move: BoardMove, sources: Mapping[str, bytes] | None = None
    ) -> None:
        self.views, self.facts, self.move, self._sources = views, facts, move, sources

    @cached_property
    def names(self) -> Mapping[int, Sequence[ForeignName]]:
        """Number of a view -> the names in it that the program does not declare."""
        return {number: foreign_names(view, self._sources) for number, view in enumerate(self.views)}

    @cached_property
    def origins(self) -> PinOrigins:
        """Follows arguments to where their numbers are written."""
        return PinOrigins(self.views)

    @cached_property
    def pin_numbers(self) -> Sequence[PinOrigin]:
        """Where the program writes numbers of pins."""
        return [origin for view in self.views for origin in self.origins.of_calls(view)]

    def at(self, element: ccode.Located) -> At | None:
        """The line of an element; None for one of no unit."""
        unit = unit_of(element)
        return At(unit, int(element.line)) if unit is not None else None

    def path_of(self, at: At) -> str:
        """The path of a line's file."""
        return str(at.unit.path)
