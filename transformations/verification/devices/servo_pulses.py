"""The common part of devices on a servo's line: they measure its pulses, and stop when no more pulses come."""

from __future__ import annotations

from robosmi.transformations.verification.devices.leeway import Leeway
from robosmi.transformations.verification.devices.places_of_rest import PlacesOfRest
from robosmi.transformations.verification.devices.way_marks import WayMarks
from robosmi.verify.bench import Device, Level

_LONGEST_GAP_US = 50_000


class PulseDriven(Device):
    """A device that is driven by the pulses at its pin `servo`.

    Attributes:
        mark: the distance between two noted marks of its way, in the device's own unit.
        rest_us: the times in microseconds after which the device rests, and surely rests (see `places_of_rest`).
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
        self._marks = WayMarks(self.mark, self.note)
        self._leeway = Leeway(bool(self.settings["timed"]))
        self._rests = PlacesOfRest(*self.rest_us, self.least_motion, self.note)

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
        """Note each mark of the way that is passed as `at`, and one that is only just reached as `barely` (see `way_marks`).

        Places of rest are noted as well (see `places_of_rest`).

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
