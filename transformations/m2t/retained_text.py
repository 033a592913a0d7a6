"""The files of a program whose platform stays: the text as it is, with the plan's changes, and nothing around it."""

from __future__ import annotations

from typing import Any

from msgspec import Struct

from robosmi.metamodels import ccode, migration
from robosmi.transformations.m2t.main_text import MainPart
from robosmi.transformations.queries.plans.port_pins import UNBOUND, port_text
from robosmi.transformations.queries.plans.retained_pins import retained_pins
from robosmi.transformations.queries.source_text import Piece, SourceText
from robosmi.transformations.queries.text_changes import decision_of

LOOK_UP = "port-look-up"
"""The rule of the changes that look up a pin (`m2m.ports.port_texts`)."""
MOVED_PINS = "moved_pins.h"
"""The name of the header in which pins are looked up."""
STORED = "source/"
"""The folder of the models that contains the copies of the program's files, as they lie in the program's own folder."""


def retained_name(unit: ccode.SourceUnit, plan: migration.MigrationPlan) -> str:
    """The place of a unit in the sketch: the one that it has in the program; the first one has the sketch's name."""
    target = plan.targetDescription
    own = str(unit.path).removeprefix(STORED)
    if plan.program is not None and unit is plan.program.units[0] and target is not None:
        return f"{plan.name}{target.fileSuffix}"
    return own


class MovedPin(Struct, frozen=True):
    """A pin of the source board in the table: its number and label there, and how the text writes the pin here."""

    number: int
    label: str
    literal: str


def moved_pins(plan: migration.MigrationPlan) -> dict[str, Any]:
    """The values of the header in which a program looks up pins that it has as numbers."""
    kept = retained_pins(plan)
    assert kept is not None
    found = {int(b.sourcePin): text for b in plan.portBindings if b.sourcePin >= 0 and (text := port_text(b)) is not None}
    labels = kept.source.labels
    return {
        "pins": [MovedPin(number, labels.get(number, ""), found.get(number, UNBOUND)) for number in range(kept.source.count)],
        "unbound": UNBOUND,
        "channels": len(kept.source.channels),
        "first_channel": kept.source.channels.get(0, 0),
    }


def retained_parts(source: SourceText) -> list[MainPart]:
    """The text of a unit, in runs of whole lines with the elements that they come from.

    A unit that looks up pins begins with an include of the header that has them.
    """
    unit = source.unit
    looks_up = any(change.rule == LOOK_UP for change in source.changes)
    elements = [*unit.includes, *unit.macros, *unit.declarations]
    pieces = list(source.pieces(0, len(source.data), elements))
    head = [MainPart(f'#include "{MOVED_PINS}"\n', "hardware", "pins include", [unit])] if looks_up else []
    return [*head, *(MainPart(piece.text, "code", "retained code", _elements(unit, piece)) for piece in pieces if piece.text)]


def _elements(unit: ccode.SourceUnit, piece: Piece) -> list[ccode.Located | migration.Decision]:
    decisions = [d for change in piece.changes if (d := decision_of(change)) is not None]
    return [*(piece.elements or [unit]), *decisions]
