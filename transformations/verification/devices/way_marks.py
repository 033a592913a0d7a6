"""Marks along the way of what turns: which ones it passes, and which it only just comes to.

Two runs of the same program never go exactly as far before they turn round or stand, so that one may come to a mark and the
other stay short of it. Which marks that can be is told here; that they need no counterpart is `robosmi.verify.alignment`'s.
"""

from __future__ import annotations

from collections.abc import Callable
from math import floor

_FIRST = 0.72
"""Where the first mark is, as a part of the distance of two: programs seldom head for a place that is so near to one."""
_BARELY = 0.25
"""What turns round or stands nearer to a mark than this, as a part of the distance of two, only just comes to it, or not."""
_STANDS_US, _STANDS = 100_000.0, 1 / 32
"""What moves by less than this part of the distance of two marks in this time stands."""


class WayMarks:
    """The marks on the way of one device.

    Args:
        distance: of two marks, in the unit of the device's positions.
        note: takes what happens: `at` with a mark that is passed, `barely` with the last such one, once it is known that the
            device only just came to it.
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
        """Note each mark that is passed, so far on both ways.

        Args:
            position: where the device is now.
            now_us: when, in microseconds.
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
        """Note a mark, but for one that was noted last: what comes back over it has made no way."""
        if number == self._passed:
            return
        self._before, self._passed, self._near = self._passed, number, (number, way)
        self._note("at", self._position(number))
        if self._stood is not None and abs(self._stood - number) <= _BARELY:
            self._only_just(number)

    def _look_back(self, place: float, now_us: float) -> None:
        """Tell of the last mark whether the device only just came to it, as soon as that is known."""
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
