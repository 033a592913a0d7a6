"""A chain of RGB lights with a controller each (WS2812 and similar): bits by the width of pulses on one line."""

from __future__ import annotations

from typing import Any

from robosmi.verify.bench import Bench, Device, Level
from robosmi.verify.simulation import DeviceEvent

_ONE_US = 0.5
"""Pulse width in us above which a bit is 1, between the longest 0 (0.38 and tolerance) and the shortest 1 (0.6) of data
sheets.
"""
_SHORTEST_US, _LONGEST_US = 0.15, 5.0
_LATCH_US = 50.0
"""Microseconds of low level after which the bits sent are latched and shown.

Newer chips need 280 us, but no program pauses within a picture for as long as the older ones need.
"""


class LightChain(Device):
    """The lights. Pin: `data`.

    Each picture that differs from the previous one is noted as `colours`: 6 hexadecimal digits for each light, in the order in
    which its bytes are sent. Bits that make no whole light, and pulses that are too long or short, are appended as they are.
    """

    pin_names = ("data",)
    reacts_to = ()

    def __init__(self, bench: Bench, number: int, pins: Any, settings: Any) -> None:
        super().__init__(bench, number, pins, settings)
        self._bits: list[str] = []
        self._up: float | None = None
        self._fell = 0.0
        self._shown = ""

    def pin_changed(self, pin: str, level: Level) -> None:
        """Read a bit at the end of its pulse, and show what was sent before a long pause."""
        now = self.bench.now
        if level == 1:
            self._latch(now)
            self._up = now
        elif self._up is not None:
            width, self._up, self._fell = now - self._up, None, now
            self._bits.append("?" if not _SHORTEST_US <= width <= _LONGEST_US else "1" if width > _ONE_US else "0")

    def ended(self) -> None:
        """Show what was sent last, if it is latched by now."""
        self._latch(self.bench.now)

    def _latch(self, now: float) -> None:
        if not self._bits or now - self._fell < _LATCH_US:
            return
        text = "".join(self._bits)
        whole = [text[at : at + 24] for at in range(0, len(text) - 23, 24)]
        rest = text[24 * len(whole) :]
        told = " ".join([*(f"{int(bits, 2):06x}" if "?" not in bits else bits for bits in whole), *([rest] if rest else [])])
        self._bits.clear()
        if told != self._shown:
            self._shown = told
            self.bench.events.append(DeviceEvent(self._fell, self.number, "colours", told))
