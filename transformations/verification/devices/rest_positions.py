"""The places at which a turning device rests between two motions."""

from __future__ import annotations

from collections.abc import Callable

from robosmi.base.data_text import Json
from robosmi.verify.bench import FOR_A_TIME


class RestPositions:
    """The places at which one device rests.

    A place is the mean position during the rest, since a control loop settles there and oscillates slightly. It is noted once
    the next motion has begun, or at the end of the run.

    Args:
        rests_us: the device rests if it has not been driven for this time, in microseconds.
        surely_us: if a rest is shorter than this time, another run may not rest there.
        least: the shortest path that counts as a motion. After a path below twice this length, a rest counts as marginal.
        note: called with "rests" and a list: the position relative to the initial one, the length of the path since the
            previous rest, the sum of all absolute changes of speed on it, the begin of the rest in microseconds, whether
            another run of the same program may not rest here, if it is known how the program drove the device, a list: the
            path length and the changes of speed while it was driven for a time, and how it was driven last, and how far it went
            on without being driven.
    """

    def __init__(self, rests_us: float, surely_us: float, least: float, note: Callable[[str, Json], None]) -> None:
        self._rests_us, self._surely_us, self._least = rests_us, surely_us, least
        self._note = note
        self._aim = ""
        self.begin(0.0)

    def begin(self, position: float) -> None:
        """Set the initial position.

        Args:
            position: the initial position.
        """
        self._first = self._position = position
        self._driven_us: float | None = None
        self._forget_motion()
        self._resting = True
        self._rest: tuple[float, float, float, Json, float] | None = None
        """The path length, changes of speed, begin and further facts of a rest that is not noted yet."""
        self._sum, self._count = 0.0, 0

    def _forget_motion(self) -> None:
        self._way = self._speed = self._changes = self._timed_way = self._timed_changes = self._beyond = 0.0

    def aimed(self, aim: str) -> None:
        """Set how the program drives the device from now on.

        A device that is driven otherwise while it moves has been driven for a time as if that had ended, or begun, at a stand.

        Args:
            aim: one of `robosmi.verify.bench.AIMS`.
        """
        if not self._resting and (aim == FOR_A_TIME) != self._timed:
            self._timed_changes += abs(self._speed)
        self._aim = aim

    @property
    def _timed(self) -> bool:
        return self._aim == FOR_A_TIME

    @property
    def speed(self) -> float:
        """How fast it is driven, whichever way."""
        return abs(self._speed)

    def went_on(self, gap_s: float) -> None:
        """Say that the device went on at its speed for that time, in seconds, without being driven."""
        self._beyond = self.speed * gap_s

    def driven(self, speed: float, now_us: float) -> None:
        """Set the speed at which the device is driven.

        Args:
            speed: the speed, negative backwards; 0 to stop.
            now_us: the current time in microseconds.
        """
        if speed and self._resting:
            self._resting = False
            self._forget_motion()
        if speed:
            self._driven_us, self._beyond = now_us, 0.0
        change = abs(speed - self._speed)
        self._changes += change
        self._timed_changes += change if self._timed else 0.0
        self._speed = speed

    def moved(self, position: float, now_us: float) -> None:
        """Set the current position.

        Args:
            position: the current position.
            now_us: the current time in microseconds.
        """
        way = abs(position - self._position)
        self._way += way
        self._timed_way += way if self._timed else 0.0
        self._position = position
        if self._resting:
            self._sum, self._count = self._sum + position, self._count + 1
        if self._resting or self._driven_us is None:
            return
        if self._way >= self._least:
            self.ended(now_us)
        if now_us - self._driven_us >= self._rests_us:
            self._resting = True
            if self._way >= self._least:
                self._sum, self._count = position, 1
                stop = abs(self._speed)
                timed: Json = None
                if self._aim:
                    timed = [round(self._timed_way, 3), round(self._timed_changes + (stop if self._timed else 0.0), 3), self._aim]
                self._rest = self._way, self._changes + stop, self._driven_us, timed, self._beyond

    def ended(self, now_us: float) -> None:
        """Note the last rest, if it is not noted yet, since it or the run has ended.

        Args:
            now_us: the current time in microseconds.
        """
        if self._rest is None:
            return
        way, changes, since_us, timed, beyond = self._rest
        self._rest = None
        place = self._sum / self._count - self._first
        barely = now_us - since_us < self._surely_us or way < 2 * self._least
        self._note("rests", [round(place, 3), round(way, 3), round(changes, 3), since_us, barely, timed, round(beyond, 3)])
