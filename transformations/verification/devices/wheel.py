"""A wheel on a continuous-rotation servo, turned by the pulses at the servo's pin, with an encoder at another pin."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from robosmi.verify.bench import Device, Level

_STEP_US = 1000.0


class Wheel(Device):
    """The wheel.

    Settings: `neutral_us`, the width at which it stands; `ticks_per_s_per_us`, its speed in ticks a second for each
    microsecond beyond (negative where it is mounted the other way round); `ticks_per_s_limit`, the speed that it cannot
    exceed. Each tick is one change of the encoder's level. Without pulses for 50 ms it stands.
    """

    pin_names = ("servo",)
    optional_pin_names = ("encoder",)
    setting_names: ClassVar[Mapping[str, Any]] = {"neutral_us": 1500.0, "ticks_per_s_per_us": 0.64, "ticks_per_s_limit": 200.0}

    def start(self) -> None:
        """Stand still."""
        self._begun: float | None = None
        self._last_pulse = self._speed = self._way = 0.0
        self._level = 0
        if "encoder" in self.pins:
            self.bench.set_level(self.pins["encoder"], 0)
        self.bench.at(_STEP_US, self._turn)

    def pin_changed(self, pin: str, level: Level) -> None:
        """Take a pulse of the program."""
        if pin != self.pins["servo"]:
            return
        if level == 1:
            self._begun = self.bench.now
        elif self._begun is not None:
            width, self._begun, self._last_pulse = self.bench.now - self._begun, None, self.bench.now
            limit = self.settings["ticks_per_s_limit"]
            speed = (width - self.settings["neutral_us"]) * self.settings["ticks_per_s_per_us"]
            self._speed = max(-limit, min(limit, speed))

    def _turn(self) -> None:
        if self.bench.now - self._last_pulse > 50_000:
            self._speed = 0.0
        before = int(self._way)
        self._way += abs(self._speed) * _STEP_US / 1e6
        if int(self._way) != before and "encoder" in self.pins:
            self._level = 1 - self._level
            self.bench.set_level(self.pins["encoder"], self._level)
        self.bench.at(self.bench.now + _STEP_US, self._turn)

    def ended(self) -> None:
        """Note how many ticks it turned."""
        self.note("ticks", int(self._way))
