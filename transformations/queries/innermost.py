"""Finds the smallest of many spans of a text that contains a place, in the time of a search in a sorted list."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable
from heapq import heappop, heappush
from typing import Generic, TypeVar

Place = TypeVar("Place", int, tuple[int, int])
Thing = TypeVar("Thing")


class Innermost(Generic[Place, Thing]):
    """Things by the spans of text that they take; spans may contain each other and overlap.

    Args:
        spans: of each thing its first place, the place after its last, its size, and the thing itself. Places are byte offsets,
            lines, or pairs of a line and a column.
    """

    def __init__(self, spans: Iterable[tuple[Place, Place, int, Thing]]) -> None:
        given = list(spans)
        order = sorted(range(len(given)), key=lambda number: given[number][0], reverse=True)
        self._bounds: list[Place] = sorted({bound for start, end, _, _ in given for bound in (start, end)})
        self._things: list[Thing | None] = []
        open_spans: list[tuple[int, int]] = []  # a heap by size, and the earlier one of two alike first
        for bound in self._bounds:
            while order and given[order[-1]][0] <= bound:
                number = order.pop()
                heappush(open_spans, (given[number][2], number))
            while open_spans and given[open_spans[0][1]][1] <= bound:
                heappop(open_spans)
            self._things.append(given[open_spans[0][1]][3] if open_spans else None)

    def at(self, place: Place) -> Thing | None:
        """The thing with the smallest span that contains a place, the first of two alike; None if there is none."""
        number = bisect_right(self._bounds, place) - 1
        return self._things[number] if number >= 0 else None
