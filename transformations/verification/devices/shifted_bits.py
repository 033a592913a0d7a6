"""The other end of a clock line and a data line (`shift_out`, `shift_in`): it reads bits, and outputs some."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from robosmi.base.data_text import Json
from robosmi.transformations.verification.devices.levels import value_at
from robosmi.verify.bench import Device, Level
from robosmi.verify.simulation import DeviceEvent

_PAUSE_US = 5_000.0
"""Microseconds without a clock edge after which a transfer is over."""


class ShiftedBits(Device):
    """A device that exchanges bits without knowing what they mean.

    Pins: `clock`; `data_out`, which the program drives; `data_in`, which it reads; the two may be one pin. A bit is read at
    each rising edge of the clock. The first bit is output before the first edge, and each further one after a falling edge: the
    bits of the value of `points`, [milliseconds, number of 8 bits], highest first, repeated endlessly. Each transfer that
    differs from the previous one is noted as `bits`: in hexadecimal if they are whole bytes, else bit by bit, where `.` is a
    bit that the program did not drive.
    """

    pin_names = ("clock",)
    optional_pin_names = ("data_out", "data_in")
    setting_names: ClassVar[Mapping[str, Json]] = {"points": ()}
    reacts_to = (0,)

    def start(self) -> None:
        """Output the first bit."""
        self._bits: list[str] = []
        self._last = self._begun = 0.0
        self._shown, self._given = "", 0
        self._give(0)

    def pin_changed(self, pin: str, level: Level) -> None:
        """Read a bit at a rising edge, output one at a falling edge."""
        if pin != self.pins["clock"] or level not in (0, 1):
            return
        now = self.bench.now
        if now - self._last >= _PAUSE_US:
            self._end(now)
        if level == 1:
            self._begun = self._begun if self._bits else now
            driven = self.bench.driven[self.pins["data_out"]] if "data_out" in self.pins else "z"
            self._bits.append(str(driven) if driven in (0, 1) else ".")
        elif self._bits:
            self._give(self._given + 1)
            if "data_in" in self.pins:
                self.bench.at(now + _PAUSE_US, lambda: self._rest(now))
        self._last = now

    def ended(self) -> None:
        """Note the last transfer, if it is over by now."""
        self._end(self.bench.now)

    def _give(self, number: int) -> None:
        self._given = number
        if "data_in" in self.pins and self.settings["points"]:
            value = int(value_at(self.settings["points"], self.bench.now))
            self.bench.set_level(self.pins["data_in"], value >> 7 - number % 8 & 1)

    def _rest(self, since: float) -> None:
        if since == self._last:
            self._end(self.bench.now)

    def _end(self, now: float) -> None:
        if not self._bits or now - self._last < _PAUSE_US:
            return
        bits = "".join(self._bits)
        whole = len(bits) % 8 == 0 and "." not in bits
        told = " ".join(f"{int(bits[at : at + 8], 2):02x}" for at in range(0, len(bits), 8)) if whole else bits
        self._bits.clear()
        self._give(0)
        if told != self._shown:
            self._shown = told
            self.bench.events.append(DeviceEvent(self._begun, self.number, "bits", told))
