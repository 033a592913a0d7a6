"""What the rules for programs whose platform stays take and give: the program with its move, and edits of its text."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

from msgspec import Struct

from robosmi.metamodels import ccode, platform
from robosmi.query import ancestor_of_kind
from robosmi.transformations.knowledge.platforms.portability_facts import MoveFacts, PlaceKind
from robosmi.transformations.knowledge.replacements import Replacement
from robosmi.transformations.queries.block_braces import inside, is_torn
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.portability.analysed_program import PortabilityPlace
from robosmi.transformations.queries.portability.board_move import BoardMove


class MovedSketch(Struct, frozen=True):
    """A program whose platform stays, and the move of its board.

    Attributes:
        views: a view of each unit; paths of units are relative to the models' folder.
        sources: path of a unit -> its bytes.
        move: from which board to which.
        places: the places that may behave differently there.
        board: how the platform calls the source board and its pins.
        facts: what is different on the target board.
        clock_hz: the clock of the source board.
        kinds: name of a kind of places -> its facts.
    """

    views: Sequence[CodeView]
    sources: Mapping[str, bytes]
    move: BoardMove
    places: Sequence[PortabilityPlace]
    board: Sequence[platform.BoardMapping] = ()
    facts: MoveFacts = MoveFacts()
    clock_hz: int = 0
    kinds: Mapping[str, PlaceKind] = {}

    def lines(self, kind: str, view: CodeView) -> frozenset[int]:
        """The lines of a unit with places of a kind."""
        path = str(view.unit.path)
        return frozenset(place.line for place in self.places if place.kind == kind and place.path == path)

    def place(self, kind: str, element: ccode.Located, name: str) -> PortabilityPlace:
        """A place that a rule has found and cannot change."""
        unit = ancestor_of_kind(element, ccode.SourceUnit)
        return self.place_at(kind, str(unit.path) if unit is not None else "", int(element.line), name)

    def place_at(self, kind: str, path: str, line: int, name: str) -> PortabilityPlace:
        """The same by its line."""
        told = self.kinds[kind]
        return PortabilityPlace(kind, path, line, told.what.format(name=name, target=self.move.target.title), told.cure, name)


class SketchEdit(Struct, frozen=True):
    """A change of a program's text by which it behaves on the other board as on its own.

    Attributes:
        element: what is changed; it stands in the unit whose text changes.
        rule: the rule, as dispositions name it.
        reason: why, a sentence for the report.
        replacements: the changes of the unit's text.
        kind: the kind of places that it cures; empty for an edit that cures none.
        lines: the lines of these places, in the element's unit.
    """

    element: ccode.Located | ccode.SourceUnit
    rule: str
    reason: str
    replacements: tuple[Replacement, ...]
    kind: str = ""
    lines: tuple[int, ...] = ()


def setup_start(
    views: Sequence[CodeView], sources: Mapping[str, bytes], name: str = "setup"
) -> tuple[CodeView, ccode.Function, int] | None:
    """The function that runs first, with its unit and the offset behind its opening brace; None if its braces are not its own."""
    for view in views:
        for function in view.of_kind(ccode.Function):
            if function.name == name and function.body is not None and isinstance(function.eContainer(), ccode.SourceUnit):
                if is_torn(function.body):
                    return None
                return view, function, inside(sources[str(view.unit.path)], function.body)[0]
    return None


SketchRule = Callable[[MovedSketch], Iterator[SketchEdit | PortabilityPlace]]
"""A rule: from a program to its edits, and to the places that it finds and cannot change."""


def is_written(view: CodeView, expression: ccode.Expression) -> bool:
    """Whether an expression stands in the text as it is, and not in the body or an argument of a macro."""
    start, end = int(expression.startOffset), int(expression.endOffset)
    named = isinstance(expression, ccode.NameReference)
    around = (
        use
        for use in view.unit.macroUses
        if int(use.startOffset) <= start
        and end <= int(use.endOffset)
        and not (named and (start, end) == (int(use.startOffset), int(use.endOffset)))
    )
    return start < end and not any(True for _ in around)
