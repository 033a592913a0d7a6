"""A sensor with registers on a synchronous serial bus of three or four wires (SPI, mode 0 or 3)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from robosmi.base.data_text import Json
from robosmi.verify.bench import Device, Level


class SerialRegisters(Device):
    """A device of 128 registers of a byte each, such as the LIS3DH.

    While `select` is low, the first byte is an address with bit 7 for reading and, where `step` is null, bit 6 for going on
    to the next register; then bytes come or go, highest bit first: taken at a rising edge of `clock`, given at a falling one.
    With one data line `data_in` and `data_out` are the same pin. Settings: `content`, the bytes from register 0 on; `step`,
    whether each byte is of the next register; `page`, a register that is in both of two pages of 128 and chooses one with bit 4:
    the upper page when the bit is 0, as in the BME680. A byte written is noted as `written`, with its register.
    """

    pin_names = ("select", "clock", "data_in", "data_out")
    setting_names: ClassVar[Mapping[str, Json]] = {"content": (), "step": None, "page": None}

    def start(self) -> None:
        """Wait for the chip select."""
        content = bytes(self.settings["content"])
        self.memory = bytearray(content + bytes(256 - len(content)))
        self._selected, self._bits, self._byte, self._address = False, 0, 0, 0

    def pin_changed(self, pin: str, level: Level) -> None:
        """Read a bit at a rising edge of the clock, output one at a falling edge."""
        if pin == self.pins["select"]:
            self._selected, self._bits, self._byte = level == 0, 0, 0
            self.bench.set_level(self.pins["data_out"], None)
        elif pin == self.pins["clock"] and self._selected and level in (0, 1):
            if level == 1:
                self._take()
            elif self._bits >= 8 and self._address & 0x80:
                self.bench.set_level(self.pins["data_out"], self.memory[self._register()] >> (7 - self._bits % 8) & 1)

    def _take(self) -> None:
        self._byte = (self._byte << 1 | (self.bench.driven[self.pins["data_in"]] == 1)) & 0xFF
        self._bits += 1
        if self._bits == 8:
            self._address = self._byte
        elif self._bits % 8 == 0 and not self._address & 0x80:
            register = self._register(self._bits // 8 - 2)
            self.memory[register] = self._byte
            self.note("written", [register, self._byte])

    def _register(self, number: int | None = None) -> int:
        number = self._bits // 8 - 1 if number is None else number
        step = bool(self._address & 0x40) if self.settings["step"] is None else self.settings["step"]
        first = self._address & (0x3F if self.settings["step"] is None else 0x7F)
        register = (first + number * step) % 128
        page = self.settings["page"]
        return register + 128 if page not in (None, register) and not self.memory[page] & 0x10 else register
