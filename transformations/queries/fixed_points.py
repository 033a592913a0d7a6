"""Sets that are defined by each other: the least solution of their equations, computed for what is asked and what that needs.

The top-down solver of Le Charlier and Van Hentenryck (A universal top-down fixpoint algorithm, 1992): an equation is evaluated
again only if a set that it has read has grown since. The cost is that of the equations times the number of times that sets grow,
whatever the number of paths between them.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable
from typing import Generic, TypeVar

T = TypeVar("T", int, frozenset[int])
"""A set: the bits of a number, or numbers."""
DEEPEST = 40
"""Equations that may wait for each other, within Python's own stack; what lies deeper is unbounded."""


class FixedPoints(Generic[T]):
    """Solves equations of the form: this set is the union of these parts, which may read other sets and this one.

    Args:
        nothing: the empty set.

    Attributes:
        active: the points whose equations are being evaluated, outermost first.
    """

    def __init__(self, nothing: T) -> None:
        self._nothing: T = nothing
        self.active: dict[Hashable, None] = {}
        self._found: dict[Hashable, T | None] = {}
        self._readers: dict[Hashable, set[Hashable]] = {}
        self._settled: set[Hashable] = set()
        """Points whose sets follow from the present sets of what they read."""

    def of(self, point: Hashable, parts: Callable[[], Iterable[T | None]]) -> T | None:
        """The least solution for a point; while its own equation is evaluated, what has been found so far.

        Args:
            point: identifies the equation.
            parts: computes the sets whose union the point is; one that is None makes the point unbounded.
        """
        self._found.setdefault(point, self._nothing)
        while point not in self._settled and point not in self.active:
            if len(self.active) >= DEEPEST:
                return None
            before = self._found[point]
            self._settled.add(point)
            self.active[point] = None
            for part in parts() if before is not None else ():
                self._found[point] = union([self._found[point], part], self._nothing)  # later parts may read it
                if self._found[point] is None:
                    break
            del self.active[point]
            if self._found[point] != before:
                self._unsettle_readers(point)
        if self.active:
            self._readers.setdefault(point, set()).add(next(reversed(self.active)))
        return self._found[point]

    def _unsettle_readers(self, point: Hashable) -> None:
        """Have everything evaluated again that has read a set, directly or through others."""
        pending = [point]
        while pending:
            read = self._readers.pop(pending.pop(), set()) & self._settled
            self._settled -= read
            pending += read


def union(parts: Iterable[T | None], nothing: T) -> T | None:
    """The union of some sets; None if one of them is unbounded.

    Args:
        parts: the sets.
        nothing: the empty set.
    """
    found = nothing
    for part in parts:
        if part is None:
            return None
        found = found | part
    return found
