"""`Constraint` and the loop that evaluates constraints over a model."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.query import all_contents


def _always(_: Any) -> bool:
    return True


def _nowhere(_: Any) -> Location | None:
    return None


@dataclass(frozen=True)
class Constraint:
    """Something that must hold for every element of a kind (EVL: error = constraint, warning and info = critique).

    Attributes:
        id: stable rule id.
        context: class of the elements it is about, by kind.
        check: whether the element is as it should be.
        message: what is wrong with an element.
        severity: how bad that is.
        guard: for which elements it is evaluated at all.
        fix: what to do, or None.
        location: where the element is, or None.
    """

    id: str
    context: type
    check: Callable[[Any], bool]
    message: Callable[[Any], str]
    severity: Severity = Severity.error
    guard: Callable[[Any], bool] = _always
    fix: str | None = None
    location: Callable[[Any], Location | None] = _nowhere


def check(root: Any, constraints: Iterable[Constraint]) -> list[Finding]:
    """Evaluate constraints over a model.

    Args:
        root: its root element.
        constraints: in the order in which each element is checked.

    Returns:
        A finding for each element that violates a constraint, in containment pre-order.
    """
    listed = list(constraints)
    return [
        Finding(c.id, c.severity, c.message(element), c.location(element), fix=c.fix)
        for element in all_contents(root)
        for c in listed
        if isinstance(element, c.context) and c.guard(element) and not c.check(element)
    ]
