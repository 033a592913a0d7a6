"""Where what turns comes to rest between two motions: what a robot that drives by encoders is about."""

from __future__ import annotations

from collections.abc import Callable

from robosmi.data_text import Json

_RESTS_US, _SURELY_US = 150_000.0, 250_000.0
"""What was not driven for the first time rests: libraries wait for up to 120 ms between two steps of one motion. What rests for
less than the second one may not do so in another run."""


class PlacesOfRest:
    """The places at which one device rests.

    Each is told when the next motion has begun, or the run ends, and is the mean of where the device was while it rested: a loop
    that holds a place settles there, and trembles.

    Args:
        least: what moves by less, in the unit of its positions, makes no motion; by less than twice as much, hardly one.
        note: takes for each place: from where it was put down, the length of the way since the rest before, the sum of all
            changes of its speed on it, in its unit a second, when the rest begins, in microseconds, and whether another run of
            the same program may do without it.
    """

    def __init__(self, least: float, note: Callable[[str, Json], None]) -> None:
        self._least = least
        self._note = note
        self.begin(0.0)

    def begin(self, position: float) -> None:
        """Take where the device stands at first.

        Args:
            position: where that is.
        """
        self._first = self._position = position
        self._driven_us: float | None = None
        self._way = self._speed = self._changes = 0.0
        self._resting = True
        self._rest: tuple[float, float, float] | None = None
        """The way and the changes of speed up to the rest that is not told yet, and when that begins."""
        self._sum, self._count = 0.0, 0

    def driven(self, speed: float, now_us: float) -> None:
        """Take that the device is driven at a speed, which may be 0.

        Args:
            speed: the speed, negative backwards.
            now_us: when, in microseconds.
        """
        if speed and self._resting:
            self._resting = False
            self._way = self._speed = self._changes = 0.0
        if speed:
            self._driven_us = now_us
        self._changes += abs(speed - self._speed)
        self._speed = speed

    def moved(self, position: float, now_us: float) -> None:
        """Take where the device is.

        Args:
            position: where it is now.
            now_us: when, in microseconds.
        """
        self._way += abs(position - self._position)
        self._position = position
        if self._resting:
            self._sum, self._count = self._sum + position, self._count + 1
        if self._resting or self._driven_us is None:
            return
        if self._way >= self._least:
            self.ended(now_us)
        if now_us - self._driven_us >= _RESTS_US:
            self._resting = True
            if self._way >= self._least:
                self._sum, self._count = position, 1
                self._rest = self._way, self._changes + abs(self._speed), self._driven_us

    def ended(self, now_us: float) -> None:
        """Tell where the device rested last, if that is not told yet: it rests no longer, or the run ends.

        Args:
            now_us: when that is, in microseconds.
        """
        if self._rest is None:
            return
        way, changes, since_us = self._rest
        self._rest = None
        place = self._sum / self._count - self._first
        barely = now_us - since_us < _SURELY_US or way < 2 * self._least
        self._note("rests", [round(place, 3), round(way, 3), round(changes, 3), since_us, barely])
