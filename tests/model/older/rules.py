"""Gates have labels; and a migration that forgets that doors are gates."""

from __future__ import annotations

from typing import Any

from robosmi.query import ModelView
from robosmi.transform import Flock
from robosmi.validate import EVL, Fail, Fix


def named(v: EVL, house: ModelView) -> None:
    """Each gate has a label, and the fix gives it one."""

    @v.context(house.Gate).constraint
    def Named(gate: Any) -> Any:
        return gate.label is not None or Fail("a gate has no label", Fix("side", lambda: setattr(gate, "label", "side")))


def nothing(f: Flock, old: ModelView, new: ModelView) -> None:
    """Copy what the new metamodel has."""
