"""Marks along the way of a turning device: which ones it passes, and which ones it only just reaches or passes slowly.

Two correct programs never take a device to exactly the same place. How far apart they may be is the leeway, a distance. So
where a device turns back or stops within the leeway of a mark, one of them may reach the mark and the other may not; and if a
device passes a mark slowly, they pass it as far apart in time as it takes to cover the leeway. This module notes both; marks of
the first kind may lack a counterpart (`robosmi.verify.traces.alignment`), and the time is tolerated
(`robosmi.verify.traces.comparison`).
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from math import floor

from robosmi.base.data_text import Json

_FIRST = 0.72
"""Place of the first mark, in distances between marks: programs seldom stop so near to such a place."""
_LEEWAY = 0.25
"""The least leeway, in distances between marks."""
_STANDS_US, _STANDS = 100_000.0, 1 / 32
"""A device that moves less than this part of the distance between marks in this many microseconds stands still. It turns back if
it comes back so far, and has passed a mark if it is so far behind it."""
_SPEED_OVER = 8
"""The speed of a device is taken over this many such parts."""


class _Passed:
    """A mark that was passed, and behind which the device has not come by the leeway yet."""

    def __init__(self, number: int, way: int, at_us: float, since_us: float) -> None:
        self.number, self.way, self.at_us, self.since_us = number, way, at_us, since_us


class Waypoints:
    """The marks on the way of one device.

    Args:
        distance: distance between two marks, in the unit of the device's positions.
        note: receives the events: `at` with a mark that is passed, and once it is known, `barely` with that mark if the device
            has only just reached it, or `slowly` with a list: the mark, and how much longer than at its highest speed so far the
            device takes to cover the leeway before or behind the mark, in microseconds.

    Attributes:
        leeway: how far apart two correct programs may be now, in the unit of the positions, beyond the least leeway.
    """

    def __init__(self, distance: float, note: Callable[[str, Json], None]) -> None:
        self.leeway = 0.0
        self._distance = distance
        self._note = note
        self._below: int | None = None
        self._passed: list[_Passed] = []
        self._steps: deque[tuple[float, float]] = deque(maxlen=4096)
        """Time and place of each small step since the device turned back or stood."""
        self._begun: tuple[float, float] | None = None
        """Where it turned back or stood, and the leeway there."""
        self._furthest, self._way = 0.0, 0
        self._slowness = 0.0
        """The least time per distance."""
        self._since = (0.0, 0.0)

    def moved(self, position: float, now_us: float) -> None:
        """Note each mark between the previous position and this one, in either direction.

        Args:
            position: where the device is now.
            now_us: the time in microseconds.
        """
        place = position / self._distance - _FIRST
        if self._below is None:
            self._below = floor(place)
            self._furthest = place
            self._since = (now_us, place)
        self._turn(place)
        self._step(place, now_us)
        while self._below + 1 <= place - _STANDS:
            self._below += 1
            self._pass(self._below, 1, now_us)
        while self._below >= place + _STANDS:
            self._pass(self._below, -1, now_us)
            self._below -= 1
        self._look_back(place, now_us)

    @property
    def _near(self) -> float:
        """The leeway, in distances between marks."""
        return _LEEWAY + self.leeway / self._distance

    def _turn(self, place: float) -> None:
        """Take notice if the device has turned back."""
        if self._way == 0:
            if abs(place - self._furthest) > _STANDS:
                self._way = 1 if place > self._furthest else -1
                self._furthest = place
        elif (place - self._furthest) * self._way >= 0:
            self._furthest = place
        elif (self._furthest - place) * self._way > _STANDS:
            self._begin(self._furthest)
            self._way, self._furthest = -self._way, place

    def _begin(self, place: float) -> None:
        """A way ends and another begins: the marks that it has only just passed are known now."""
        for passed in self._passed:
            self._note("barely", self._position(passed.number))
        self._passed.clear()
        self._steps.clear()
        self._begun = place, self._near

    def _step(self, place: float, now_us: float) -> None:
        if self._steps and abs(place - self._steps[-1][1]) <= _STANDS:
            return
        self._steps.append((now_us, place))
        if len(self._steps) > _SPEED_OVER:
            before_us, before = self._steps[-1 - _SPEED_OVER]
            slowness = (now_us - before_us) / abs(place - before) if place != before else 0.0
            self._slowness = min(self._slowness, slowness) if self._slowness else slowness

    def _pass(self, number: int, way: int, now_us: float) -> None:
        self._note("at", self._position(number))
        if self._begun is not None and abs(self._begun[0] - number) <= self._begun[1]:
            self._note("barely", self._position(number))
            return
        near = self._near
        before = [at_us for at_us, place in self._steps if (number - place) * way >= near]
        since_us = before[-1] if before else self._steps[0][0] if self._steps else now_us
        self._passed.append(_Passed(number, way, now_us, since_us))

    def _look_back(self, place: float, now_us: float) -> None:
        """Find the marks that the device has left behind, and whether it stands."""
        while self._passed and (place - self._passed[0].number) * self._passed[0].way > self._near:
            passed = self._passed.pop(0)
            quickest_us = self._slowness * (self._near + 2 * _STANDS)  # known to a step at both ends
            longest_us = max(now_us - passed.at_us, passed.at_us - passed.since_us) - quickest_us
            if quickest_us and longest_us > 0:
                self._note("slowly", [self._position(passed.number), round(longest_us)])
        if abs(place - self._since[1]) > _STANDS:
            self._since = (now_us, place)
        elif now_us - self._since[0] >= _STANDS_US:
            self._begin(place)
            self._way, self._furthest = 0, place

    def _position(self, number: int) -> int:
        return round((number + _FIRST) * self._distance)
