"""Ultrasonic distance sensors: a short high pulse triggers them, the width of the echo is the answer.

Times are those of the data sheets of Parallax #28015 (PING)))) and of the HC-SR04.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from robosmi.transformations.verification.devices.levels import value_at
from robosmi.verify.bench import Device, Level

_ROUND_TRIP_US = 58.0
"""Microseconds of echo per centimetre of distance, for the way there and back at 20 degrees Celsius."""


class _Ranger(Device):
    """The common part of distance sensors.

    Settings: `points`, [milliseconds, centimetres], null where there is no echo; `asks`, the shortest trigger pulse in
    microseconds.
    """

    setting_names: ClassVar[Mapping[str, Any]] = {"points": ..., "asks": 2.0}
    hold_off_us: float
    trigger: str
    echo: str

    def start(self) -> None:
        """Start without an echo."""
        self._begun: float | None = None
        self._answered_us: float | None = None
        self.bench.set_level(self.pins[self.echo], 0)

    def pin_changed(self, pin: str, level: Level) -> None:
        """Answer at the end of a trigger pulse."""
        if pin != self.pins[self.trigger]:
            return
        if level == 1:
            self._begun = self.bench.now
        elif self._begun is not None:
            width, self._begun = self.bench.now - self._begun, None
            distance = value_at(self.settings["points"], self.bench.now)
            if width >= self.settings["asks"]:
                self.note("asked", distance)
                if self._answered_us is not None and self._answered_us < self.bench.now:
                    self.note("pause", round(self.bench.now - self._answered_us, 3))
                self._answered_us = None
                if distance is not None:
                    self._answer(self.bench.now + self.hold_off_us, distance * _ROUND_TRIP_US)

    def _answer(self, at_us: float, width_us: float) -> None:
        pin = self.pins[self.echo]
        self.bench.set_level_at(at_us, pin, 1)
        self.bench.set_level_at(at_us + width_us, pin, 0)
        self._answered_us = at_us + width_us


class Ranger(_Ranger):
    """A sensor with one pin for trigger and echo, such as Parallax's PING))).

    The program sends the trigger pulse, releases the pin, and measures the echo there.
    """

    pin_names = ("signal",)
    hold_off_us = 750.0
    trigger = echo = "signal"


class TwoPinRanger(_Ranger):
    """A sensor with separate pins for trigger and echo, such as the HC-SR04, whose trigger pulse lasts 10 us."""

    pin_names = ("trigger", "echo")
    setting_names: ClassVar[Mapping[str, Any]] = {"points": ..., "asks": 9.0}
    hold_off_us = 450.0
    trigger, echo = "trigger", "echo"
