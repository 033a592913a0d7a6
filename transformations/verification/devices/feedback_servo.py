"""A servo that turns continuously and reports its angle, such as Parallax's Feedback 360 (data sheet of #900-00360)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from robosmi.base.data_text import Json
from robosmi.transformations.verification.devices.servo_pulses import PulseDriven

_HZ, _HZ_APART = 910.0, 0.013
"""Frequency of the feedback signal in hertz (data sheet, within 5 %), and by which part of it two servos differ."""
_LEAST_DUTY, _MOST_DUTY = 0.029, 0.971


class FeedbackServo(PulseDriven):
    """The servo: pulses at `servo` turn it, the duty cycle at `feedback` shows its angle: 2.9 % to 97.1 % at 910 Hz.

    Settings: `degrees`, its initial position, counted counter-clockwise; `neutral_us` and `dead_us`, the pulse width at which
    it stands still and by how much a pulse must differ from it to turn the servo; `degrees_per_s_per_us`, its speed for each
    further microsecond; longer pulses turn it counter-clockwise. The signals of two servos are never in phase, since their
    frequencies differ by about a per cent. Without pulses for 50 ms it stops. It notes each 30 degrees of its way as `at`,
    where it comes to rest as `rests`, and its final position as `degrees`.
    """

    mark = 30.0
    rest_us = (400_000.0, 700_000.0)  # so that slow motions, by `least_motion` at a time, are no rests
    least_motion = 3.0  # a loop that holds a place in 64 parts of a turn corrects it by half a part to either side

    pin_names = ("servo", "feedback")
    setting_names: ClassVar[Mapping[str, Json]] = {
        "degrees": 90.0, "neutral_us": 1500.0, "dead_us": 20.0, "degrees_per_s_per_us": 4.88,
        "timed": 1,
    }  # fmt: skip

    def start(self) -> None:
        """Stand still, and begin to report the angle."""
        super().start()
        self._speed = self._told = 0.0
        self._degrees = float(self.settings["degrees"])
        self._held = self._degrees
        self.put_down_at(self._degrees)
        self._cycle_us = 1e6 / (_HZ * (1 + _HZ_APART * self.number))
        self._tell()

    def pulse(self, width_us: float) -> None:
        """Set the speed that a pulse of that width asks for."""
        beyond = width_us - self.settings["neutral_us"]
        turning = max(0.0, abs(beyond) - self.settings["dead_us"]) * self.settings["degrees_per_s_per_us"]
        self._speed = turning if beyond > 0 else -turning
        if not turning:
            self.driven(0.0)

    def _tell(self) -> None:
        if self.left_alone and self._speed:
            self._speed = 0.0
            self.left()
        self._degrees += self._speed * (self.bench.now - self._told) / 1e6
        self._told = self.bench.now
        if abs(self._degrees - self._held) > self.least_motion:
            self._held = self._degrees
            self.driven(self._speed)
        self.moved_to(self._degrees)
        duty = _MOST_DUTY - self._degrees % 360 / 360 * (_MOST_DUTY - _LEAST_DUTY)
        self.bench.set_level(self.pins["feedback"], 1)
        self.bench.set_level_at(self.bench.now + duty * self._cycle_us, self.pins["feedback"], 0)
        self.bench.at(self.bench.now + self._cycle_us, self._tell)

    def ended(self) -> None:
        """Note the final position."""
        super().ended()
        self.note("degrees", self._degrees)
