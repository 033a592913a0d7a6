"""The files of a program whose platform stays: the text as it is, with the plan's changes, and nothing around it."""

from __future__ import annotations

from robosmi.metamodels import ccode, migration
from robosmi.transformations.m2t.main_text import MainPart
from robosmi.transformations.queries.source_text import Piece, SourceText
from robosmi.transformations.queries.text_changes import decision_of

STORED = "source/"
"""The folder of the models that contains the copies of the program's files, as they lie in the program's own folder."""


def kept_name(unit: ccode.SourceUnit, plan: migration.MigrationPlan) -> str:
    """The place of a unit in the sketch: the one that it has in the program; the first one has the sketch's name."""
    target = plan.targetDescription
    own = str(unit.path).removeprefix(STORED)
    if plan.program is not None and unit is plan.program.units[0] and target is not None:
        return f"{plan.name}{target.fileSuffix}"
    return own


def kept_parts(source: SourceText) -> list[MainPart]:
    """The text of a unit, in runs of whole lines with the elements that they come from."""
    unit = source.unit
    elements = [*unit.includes, *unit.macros, *unit.declarations]
    pieces = list(source.pieces(0, len(source.data), elements))
    return [MainPart(piece.text, "code", "retained code", _elements(unit, piece)) for piece in pieces if piece.text]


def _elements(unit: ccode.SourceUnit, piece: Piece) -> list[ccode.Located | migration.Decision]:
    decisions = [d for change in piece.changes if (d := decision_of(change)) is not None]
    return [*(piece.elements or [unit]), *decisions]
