"""The other end of a serial line at two pins (8 data bits, no parity, 1 stop bit)."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any, ClassVar

from robosmi.verify.bench import Device, Level


class SerialLine(Device):
    """The other end. Settings: `baud`; `points`: [milliseconds, text] that it sends.

    Pins, seen from the program: `receive`, where it listens, and `transmit`, where it sends. Each byte read is noted as
    `byte`; one whose stop bit is low as `framing`.
    """

    optional_pin_names = ("receive", "transmit")
    setting_names: ClassVar[Mapping[str, Any]] = {"baud": 9600, "points": ()}

    def start(self) -> None:
        """Idle high, and send at each point."""
        self._bit_us = 1e6 / self.settings["baud"]
        self._reading = False
        if "receive" in self.pins:
            self.bench.set_level(self.pins["receive"], 1)
        for at_ms, text in self.settings["points"]:
            for number, byte in enumerate(text.encode()):
                self._send(at_ms * 1000 + number * 10 * self._bit_us, byte)

    def _send(self, at_us: float, byte: int) -> None:
        for number, level in enumerate((0, *(byte >> bit & 1 for bit in range(8)), 1)):
            self.bench.at(at_us + number * self._bit_us, partial(self.bench.set_level, self.pins["receive"], level))

    def pin_changed(self, pin: str, level: Level) -> None:
        """Begin to read at a start bit."""
        if pin == self.pins.get("transmit") and level == 0 and not self._reading:
            self._reading, self._byte = True, 0
            for number in range(9):
                self.bench.at(self.bench.now + (1.5 + number) * self._bit_us, partial(self._sample, number))

    def _sample(self, number: int) -> None:
        high = self.bench.driven[self.pins["transmit"]] != 0
        if number < 8:
            self._byte |= high << number
        else:
            self._reading = False
            self.note("byte" if high else "framing", self._byte)
