"""Marks along the way of a turning device: which ones it passes, and which ones it only just reaches.

Two runs of the same program never go exactly as far before they turn back or stop, so that one may reach a mark and the other
may not. This module finds the marks for which that can happen; `robosmi.verify.alignment` lets them be without a counterpart.
"""

from __future__ import annotations

from collections.abc import Callable
from math import floor

_FIRST = 0.72
"""Place of the first mark, in distances between marks: programs seldom stop so near to such a place."""
_BARELY = 0.25
"""Distance from a mark, in distances between marks, within which a device that turns back or stops only just reaches it."""
_STANDS_US, _STANDS = 100_000.0, 1 / 32
"""A device that moves less than this part of the distance between marks in this many microseconds stands still."""


class WayMarks:
    """The marks on the way of one device.

    Args:
        distance: distance between two marks, in the unit of the device's positions.
        note: receives the events: `at` with a mark that is passed, and `barely` with the last such mark once it is known that
            the device has only just reached it.
    """

    def __init__(self, distance: float, note: Callable[[str, int], None]) -> None:
        self._distance = distance
        self._note = note
        self._below: int | None = None
        self._passed: int | None = None
        self._before: int | None = None
        self._near: tuple[int, int] | None = None
        self._since = (0.0, 0.0)
        self._stood: float | None = None

    def moved(self, position: float, now_us: float) -> None:
        """Note each mark between the previous position and this one, in either direction.

        Args:
            position: where the device is now.
            now_us: the time in microseconds.
        """
        place = position / self._distance - _FIRST
        if self._below is None:
            self._below = floor(place)
        while self._below < floor(place):
            self._below += 1
            self._pass(self._below, 1)
        while self._below > floor(place):
            self._pass(self._below, -1)
            self._below -= 1
        self._look_back(place, now_us)

    def _pass(self, number: int, way: int) -> None:
        """Note a mark, unless it was the last one noted: a device that comes back over it has made no way."""
        if number == self._passed:
            return
        self._before, self._passed, self._near = self._passed, number, (number, way)
        self._note("at", self._position(number))
        if self._stood is not None and abs(self._stood - number) <= _BARELY:
            self._only_just(number)

    def _look_back(self, place: float, now_us: float) -> None:
        """Decide, as soon as possible, whether the device has only just reached the last mark."""
        if abs(place - self._since[1]) > _STANDS:
            self._since = (now_us, place)
        stands = now_us - self._since[0] >= _STANDS_US
        if stands:
            self._stood = place
        elif self._stood is not None and abs(place - self._stood) > 2 * _BARELY:
            self._stood = None
        if self._near is None:
            return
        number, way = self._near
        beyond = (place - number) * way
        if beyond > _BARELY:
            self._near = None
        elif beyond < -_BARELY:
            self._passed = self._before  # as if it had not come there: another run may have turned round before
            self._only_just(number)
        elif stands:
            self._only_just(number)

    def _only_just(self, number: int) -> None:
        self._near = None
        self._note("barely", self._position(number))

    def _position(self, number: int) -> int:
        return round((number + _FIRST) * self._distance)
