"""What devices on a servo's line have in common: they take the widths of its pulses, and stand when none come any more."""

from __future__ import annotations

from math import floor

from robosmi.verify.bench import Device, Level

_LONGEST_GAP_US = 50_000
_FIRST_MARK = 0.72
"""Where the first mark is, as a part of the distance of two: programs seldom head for a place that is so near to one."""


class PulseDriven(Device):
    """A device that the pulses at its pin `servo` drive."""

    pin_names: tuple[str, ...] = ("servo",)
    reacts_to = ()
    mark: float

    def start(self) -> None:
        """Have seen no pulse yet."""
        self._begun: float | None = None
        self._last_pulse = 0.0
        self._passed: int | None = None
        self._below: int | None = None

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
        """Note as `at` each mark of the way that is passed: so far on both ways, whatever the last tick is.

        Args:
            position: where the device is now, in its own unit, marks being `mark` apart.
        """
        below = floor(position / self.mark - _FIRST_MARK)
        if self._below is None:
            self._below = below
        while self._below < below:
            self._below += 1
            self._pass(self._below)
        while self._below > below:
            self._pass(self._below)
            self._below -= 1

    def _pass(self, number: int) -> None:
        """Note a mark, but for one that was noted last: a device that comes back over it has made no way."""
        if number != self._passed:
            self._passed = number
            self.note("at", round((number + _FIRST_MARK) * self.mark))

    @property
    def left_alone(self) -> bool:
        """Whether no pulse has come for so long that the device stands."""
        return self.bench.now - self._last_pulse > _LONGEST_GAP_US
