"""What devices on a servo's line have in common: they take the widths of its pulses, and stand when none come any more."""

from __future__ import annotations

from robosmi.transformations.verification.devices.places_of_rest import PlacesOfRest
from robosmi.transformations.verification.devices.way_marks import WayMarks
from robosmi.verify.bench import Device, Level

_LONGEST_GAP_US = 50_000


class PulseDriven(Device):
    """A device that the pulses at its pin `servo` drive.

    Attributes:
        mark: the distance of two marks of its way that are noted.
        rest_us: the times after which the device rests, and surely does so (see `places_of_rest`), in microseconds.
        least_motion: the shortest path that counts as a motion.
    """

    pin_names: tuple[str, ...] = ("servo",)
    reacts_to = ()
    mark: float
    rest_us: tuple[float, float]
    least_motion: float

    def start(self) -> None:
        """Have seen no pulse yet."""
        self._begun: float | None = None
        self._last_pulse = 0.0
        self._marks = WayMarks(self.mark, self.note)
        self._rests = PlacesOfRest(*self.rest_us, self.least_motion, self.note)

    def pin_changed(self, pin: str, level: Level) -> None:
        """Take a pulse of the program when it ends."""
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
        """Note as `at` each mark of the way that is passed, and as `barely` one that it only just comes to (see `way_marks`).

        Where it rests is noted, too (see `places_of_rest`).

        Args:
            position: where the device is now, in its own unit, marks being `mark` apart.
        """
        self._marks.moved(position, self.bench.now)
        self._rests.moved(position, self.bench.now)

    def put_down_at(self, position: float) -> None:
        """Take where the device stands at first, from which places of rest are counted.

        Args:
            position: where that is, in its own unit.
        """
        self._rests.begin(position)

    def driven(self, speed: float) -> None:
        """Take the speed at which the device is driven now.

        Args:
            speed: in its own unit a second, negative backwards; 0 where a pulse lets it stand.
        """
        self._rests.driven(speed, self.bench.now)

    def ended(self) -> None:
        """Note where it rests."""
        self._rests.ended(self.bench.now)

    @property
    def left_alone(self) -> bool:
        """Whether no pulse has come for so long that the device stands."""
        return self.bench.now - self._last_pulse > _LONGEST_GAP_US
