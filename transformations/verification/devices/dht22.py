"""A DHT22 (AM2302) humidity and temperature sensor, which sends 40 bits on one wire when asked (its data sheet)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from robosmi.transformations.verification.devices.levels import value_at
from robosmi.verify.bench import Device, Level

_ASKED_US = 800.0
"""How long the program has to hold the line low to ask."""


class Dht22(Device):
    """The sensor.

    Settings `humidity` and `celsius`: points [milliseconds, value] in percent and degrees; null where it does not answer.
    """

    pin_names = ("signal",)
    setting_names: ClassVar[Mapping[str, Any]] = {"humidity": ..., "celsius": ...}

    def start(self) -> None:
        """Let the line be pulled high."""
        self._low: float | None = None
        self.bench.set_level(self.pins["signal"], 1)

    def pin_changed(self, pin: str, level: Level) -> None:
        """Answer when the line is let go after it was held low long enough."""
        if level == 0:
            self._low = self.bench.now
        elif self._low is not None:
            held, self._low = self.bench.now - self._low, None
            humidity, celsius = (value_at(self.settings[name], self.bench.now) for name in ("humidity", "celsius"))
            if held >= _ASKED_US and humidity is not None and celsius is not None:
                self.note("asked", [humidity, celsius])
                self._answer(_frame(humidity, celsius))

    def _answer(self, frame: bytes) -> None:
        at_us = self.bench.now + 30.0
        spans = [(80.0, 80.0)]
        spans += [(50.0, 70.0 if byte >> bit & 1 else 26.0) for byte in frame for bit in range(7, -1, -1)]
        for low, high in (*spans, (50.0, 0.0)):
            self._set(at_us, 0)
            self._set(at_us + low, 1)
            at_us += low + high

    def _set(self, at_us: float, level: int) -> None:
        self.bench.at(at_us, lambda: self.bench.set_level(self.pins["signal"], level))


def _frame(humidity: float, celsius: float) -> bytes:
    """The five bytes: humidity and temperature in tenths, the sign of the temperature in its highest bit, and their sum."""
    words = (round(humidity * 10), round(abs(celsius) * 10) | (0x8000 if celsius < 0 else 0))
    data = b"".join(word.to_bytes(2, "big") for word in words)
    return data + bytes([sum(data) & 0xFF])
