"""How far apart two correct programs may take a device that they drive for a time."""

from __future__ import annotations

from math import sqrt

from robosmi.verify.bench import FOR_A_TIME, TO_A_PLACE
from robosmi.verify.goals_of_motions import FRAME_S

_LATE_S = 0.045 - FRAME_S
"""How much later than in a frame a motion may begin: events may be 45 ms late. If an input ends it, it is shorter by that."""
_SURE = 3 / sqrt(2)
"""Three standard deviations of the sum of many motions, each of which is a frame longer, as long, or a frame shorter on the other
side: in the worst case each of the first and the last has a probability of a quarter, so the variance is half a frame squared."""


class Leeway:
    """The distance between two correct programs, which each motion for a time can increase by what the device covers in a frame.

    Args:
        timed: whether the program drives the device for a time, as far as nothing else is told of a motion.
    """

    def __init__(self, timed: bool) -> None:
        self._timed = timed
        self._speed = 0.0
        self._forget()

    def _forget(self) -> None:
        self._changes = self._sum = self._squares = 0.0
        self._fastest = self._fastest_before = 0.0

    def aimed(self, aim: str) -> None:
        """Set how the program drives the device from now on.

        Args:
            aim: one of `robosmi.verify.bench.AIMS`.
        """
        if (aim == FOR_A_TIME) != self._timed:
            self._changes += abs(self._speed)
            self._end()
        self._timed = aim == FOR_A_TIME
        if aim == TO_A_PLACE:
            self._forget()

    def driven(self, speed: float) -> None:
        """Set the speed at which the device is driven.

        Args:
            speed: the speed, negative backwards; 0 to stop.
        """
        before, self._speed = self._speed, speed
        if not self._timed:
            return
        if speed * before > 0:
            self._changes += abs(speed - before)
        elif speed != before:
            self._changes += abs(before)
            if before:
                self._end()
            self._changes += abs(speed)
            if speed:
                self._fastest_before, self._fastest = self._fastest, 0.0
        self._fastest = max(self._fastest, abs(speed))

    def _end(self) -> None:
        distance = FRAME_S * self._changes / 2
        self._sum += distance
        self._squares += distance**2
        self._changes = 0.0

    @property
    def distance(self) -> float:
        """How far apart two correct programs may be now, if this motion ends now."""
        stop = abs(self._speed) if self._timed else 0.0
        distance = FRAME_S * (self._changes + stop) / 2
        late = _LATE_S * max(self._fastest, self._fastest_before)
        return min(self._sum + distance, _SURE * sqrt(self._squares + distance**2)) + late
