"""The common part of devices on a servo's line: they measure its pulses, and stop when no more pulses come.

Two correct programs may take a device that they drive for a time to places that differ a little; `MotionTolerance` computes how
far apart.

`RestPositions` has the places at which a turning device rests between two motions; `Waypoints` the marks along its way: which
ones it passes, and which ones it only just reaches or passes slowly. Two correct programs never take a device to exactly the
same place. How far apart they may be is the leeway, a distance. So where a device turns back or stops within the leeway of a
mark, one of them may reach the mark and the other may not; and if a device passes a mark slowly, they pass it as far apart in
time as it takes to cover the leeway. `Waypoints` notes both; marks of the first kind may lack a counterpart
(`robosmi.verify.traces.alignment`), and the time is tolerated (`robosmi.verify.traces.comparison`).
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from math import floor, sqrt

from robosmi.base.data_text import Json
from robosmi.verify.bench import FOR_A_TIME, TO_A_PLACE, Device, Level
from robosmi.verify.traces.goals_of_motions import FRAME_S

_LONGEST_GAP_US = 50_000

_FIRST = 0.72
"""Place of the first mark, in distances between marks: programs seldom stop so near to such a place."""
_LEEWAY = 0.25
"""The least leeway, in distances between marks."""
_STANDS_US, _STANDS = 100_000.0, 1 / 32
"""A device that moves less than this part of the distance between marks in this many microseconds stands still. It turns back if
it comes back so far, and has passed a mark if it is so far behind it."""
_SPEED_OVER = 8
"""The speed of a device is taken over this many such parts."""


class PulseDriven(Device):
    """A device that is driven by the pulses at its pin `servo`.

    Attributes:
        mark: the distance between two noted marks of its way, in the device's own unit.
        rest_us: the times in microseconds after which the device rests, and surely rests (see `RestPositions`).
        least_motion: the shortest path that counts as a motion.
    """

    pin_names: tuple[str, ...] = ("servo",)
    reacts_to = ()
    mark: float
    rest_us: tuple[float, float]
    least_motion: float

    def start(self) -> None:
        """Start without a pulse."""
        self._begun: float | None = None
        self._last_pulse = 0.0
        self._marks = Waypoints(self.mark, self.note)
        self._leeway = MotionTolerance(bool(self.settings["timed"]))
        self._rests = RestPositions(*self.rest_us, self.least_motion, self.note)

    def pin_changed(self, pin: str, level: Level) -> None:
        """Measure a pulse of the program when it ends."""
        if pin != self.pins["servo"]:
            return
        if level == 1:
            self._begun = self.bench.now
        elif self._begun is not None:
            width, self._begun, self._last_pulse = self.bench.now - self._begun, None, self.bench.now
            self.pulse(width)

    def pulse(self, width_us: float) -> None:
        """React to a pulse of that width."""

    def moved_to(self, position: float) -> None:
        """Note each mark of the way that is passed as `at`, and one that is only just reached as `barely` (see `Waypoints`).

        Places of rest are noted as well (see `RestPositions`).

        Args:
            position: where the device is now, in its own unit.
        """
        self._marks.leeway = self._leeway.distance
        self._marks.moved(position, self.bench.now)
        self._rests.moved(position, self.bench.now)

    def put_down_at(self, position: float) -> None:
        """Set the initial position, from which places of rest are counted.

        Args:
            position: the initial position, in the device's own unit.
        """
        self._rests.begin(position)

    def aimed(self, aim: str) -> None:
        """Take how the program drives the device from now on.

        Args:
            aim: one of `robosmi.verify.bench.AIMS`.
        """
        self._rests.aimed(aim)
        self._leeway.aimed(aim)

    def driven(self, speed: float) -> None:
        """Set the speed at which the device is driven.

        Args:
            speed: in the device's own unit per second, negative backwards; 0 if it is to stand still.
        """
        self._rests.driven(speed, self.bench.now)
        self._leeway.driven(speed)

    def ended(self) -> None:
        """Note the last place of rest."""
        self._rests.ended(self.bench.now)

    @property
    def left_alone(self) -> bool:
        """Whether no pulse has come for so long that the device stops."""
        return self.bench.now - self._last_pulse > _LONGEST_GAP_US


_LATE_S = 0.045 - FRAME_S
"""How much later than in a frame a motion may begin: events may be 45 ms late. If an input ends it, it is shorter by that."""
_SURE = 3 / sqrt(2)
"""Three standard deviations of the sum of many motions, each of which is a frame longer, as long, or a frame shorter on the other
side: in the worst case each of the first and the last has a probability of a quarter, so the variance is half a frame squared."""


class MotionTolerance:
    """The distance between two correct programs, which each motion for a time can increase by what the device covers in a frame.

    Args:
        timed: whether the program drives the device for a time, as far as nothing else is known of a motion.
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
            another run of the same program may not rest here, and, if it is known how the program drove the device, a list:
            the path length and the changes of speed while it was driven for a time, and how it was driven last.
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
        self._rest: tuple[float, float, float, Json] | None = None
        """The path length, changes of speed, begin and further facts of a rest that is not noted yet."""
        self._sum, self._count = 0.0, 0

    def _forget_motion(self) -> None:
        self._way = self._speed = self._changes = self._timed_way = self._timed_changes = 0.0

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
            self._driven_us = now_us
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
                self._rest = self._way, self._changes + stop, self._driven_us, timed

    def ended(self, now_us: float) -> None:
        """Note the last rest, if it is not noted yet, since it or the run has ended.

        Args:
            now_us: the current time in microseconds.
        """
        if self._rest is None:
            return
        way, changes, since_us, timed = self._rest
        self._rest = None
        place = self._sum / self._count - self._first
        barely = now_us - since_us < self._surely_us or way < 2 * self._least
        self._note("rests", [round(place, 3), round(way, 3), round(changes, 3), since_us, barely, timed])


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
