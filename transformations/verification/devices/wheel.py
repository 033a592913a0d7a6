"""A wheel on a continuous-rotation servo, driven by the pulses at the servo's pin, with an encoder at another pin."""

from __future__ import annotations

from collections.abc import Mapping
from math import floor
from typing import ClassVar

from robosmi.base.data_text import Json
from robosmi.transformations.verification.devices.servo_pulses import PulseDriven

_STEP_US = 1000.0


class Wheel(PulseDriven):
    """The wheel.

    Settings: `neutral_us`, the pulse width at which it stands still; `ticks_per_s_per_us`, its speed in ticks per second for
    each microsecond of difference (negative if it is mounted the other way round); `ticks_per_s_limit`, its greatest speed;
    `starts_at`, its initial position as a fraction of a tick. The encoder's level changes at each whole tick in either
    direction, so a wheel that turns back just after a tick meets the same one again. Without pulses for 50 ms it stops. It
    notes each 16th tick of its way in either direction as `at`, and where it comes to rest, in ticks, as `rests`.
    """

    mark = 16.0
    rest_us = (130_000.0, 135_000.0)  # within one motion drive_goto waits for six frames, 120 ms; between two for seven at least
    least_motion = 0.5

    optional_pin_names: tuple[str, ...] = ("encoder",)
    setting_names: ClassVar[Mapping[str, Json]] = {
        "neutral_us": 1500.0, "ticks_per_s_per_us": 0.64, "ticks_per_s_limit": 200.0, "starts_at": 0.5, "timed": 1,
    }  # fmt: skip

    def start(self) -> None:
        """Stand still."""
        super().start()
        self._speed = 0.0
        self._place = float(self.settings["starts_at"])
        self._tick, self._turned = floor(self._place), 0
        self.put_down_at(self._tick)
        if "encoder" in self.pins:
            self.bench.set_level(self.pins["encoder"], self._tick % 2)
        self.bench.at(_STEP_US, self._turn)

    def pulse(self, width_us: float) -> None:
        """Set the speed that a pulse of that width asks for."""
        limit = self.settings["ticks_per_s_limit"]
        speed = (width_us - self.settings["neutral_us"]) * self.settings["ticks_per_s_per_us"]
        self._speed = max(-limit, min(limit, speed))
        self.driven(self._speed)

    def _turn(self) -> None:
        if self.left_alone and self._speed:
            self._speed = 0.0
            self.left()
        self._place += self._speed * _STEP_US / 1e6
        self.moved_to(self._place)
        if floor(self._place) != self._tick:
            self._turned += abs(floor(self._place) - self._tick)
            self._tick = floor(self._place)
            if "encoder" in self.pins:
                self.bench.set_level(self.pins["encoder"], self._tick % 2)
        self.bench.at(self.bench.now + _STEP_US, self._turn)

    def ended(self) -> None:
        """Note how many ticks it turned."""
        super().ended()
        self.note("ticks", self._turned)
