"""The common part of devices on a servo's line: they measure its pulses, and stop when no more pulses come.

Two correct programs may take a device that they drive for a time to places that differ a little; `MotionTolerance` computes how
far apart.
"""

from __future__ import annotations

from math import sqrt

from robosmi.transformations.verification.devices.rest_positions import RestPositions
from robosmi.transformations.verification.devices.waypoints import Waypoints
from robosmi.verify.bench import FOR_A_TIME, TO_A_PLACE, Device, Level
from robosmi.verify.traces.goals_of_motions import FRAME_S

LONGEST_GAP_S = 0.05


class PulseDriven(Device):
    """A device that is driven by the pulses at its pin `servo`.

    Attributes:
        mark: the distance between two noted marks of its way, in the device's own unit.
        rest_us: the times in microseconds after which the device rests, and surely rests (see `rest_positions`).
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
        """Note each mark of the way that is passed as `at`, and one that is only just reached as `barely` (see `waypoints`).

        Places of rest are noted as well (see `rest_positions`).

        Args:
            position: where the device is now, in its own unit.
        """
        self._marks.leeway = self._leeway.distance + self._rests.speed * max(0.0, self.alone_us / 1e6 - FRAME_S)
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

    def left(self) -> None:
        """Stop, since no pulse comes any more: a motor would have stopped with the last one."""
        self._rests.went_on(LONGEST_GAP_S)
        self.driven(0.0)

    def ended(self) -> None:
        """Note the last place of rest."""
        self._rests.ended(self.bench.now)

    @property
    def alone_us(self) -> float:
        """The time since the last pulse."""
        return self.bench.now - self._last_pulse

    @property
    def left_alone(self) -> bool:
        """Whether no pulse has come for so long that the device stops."""
        return self.alone_us > LONGEST_GAP_S * 1e6


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
