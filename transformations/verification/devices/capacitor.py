"""A capacitor at a pin, as in a QTI line sensor: a high output charges it, and it discharges once the pin is an input."""

from __future__ import annotations

from collections.abc import Mapping
from math import inf
from typing import Any, ClassVar

from robosmi.transformations.verification.devices.levels import value_at
from robosmi.verify.bench import Device, Level


class Capacitor(Device):
    """A capacitor that the program charges through its pin; as an input, the pin then reads high for the decay time.

    A pull-up that stays on keeps it charged. Setting `points`: [milliseconds, decay time in microseconds], what the sensor sees
    over time.
    """

    pin_names = ("pin",)
    reacts_to = ("z", "p")
    setting_names: ClassVar[Mapping[str, Any]] = {"points": ...}

    def start(self) -> None:
        """Start without charge."""
        points: list[list[float]] = self.settings["points"]
        decays = [(1000 * at_ms, lasts_us) for at_ms, lasts_us in points]
        self.is_played = self.bench.emulates_capacitor(self.pins["pin"], decays)
        self._charged = False
        self._falls_us = inf
        self.bench.set_level(self.pins["pin"], 0)

    def pin_changed(self, pin: str, level: Level) -> None:
        """Charge at a high output, discharge at a low one, and begin to decay when the pin becomes an input."""
        charged = self._charged and self.bench.now < self._falls_us
        self._falls_us = inf
        if level in (0, 1):
            self._charged = level == 1
            self.bench.set_level(pin, level)  # which it keeps when it is let go
        elif level == "p":
            self._charged = charged
            self.bench.set_level(pin, 1)
        else:
            self._charged = charged
            if charged:
                falls_us = self._falls_us = self.bench.now + value_at(self.settings["points"], self.bench.now)
                self.bench.set_level_at(falls_us, pin, 0, lambda: self._falls_us == falls_us)
