"""A BME680 air sensor on a synchronous serial bus (its data sheet): two pages of registers, one sensor's coefficients."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any, ClassVar

from robosmi.transformations.verification.devices.serial_registers import SerialRegisters

_PAGE, _MEASURED, _IDENTITY = 0x73, 0x1D, 0xD0
_NEW_DATA, _IS_BME680, _GAS_VALID = 0x80, 0x61, 0x30
_COEFFICIENTS = {
    0x89: bytes.fromhex("00 1466 03 f3 998f 40 d7 58 00 c420 a0ff 20 1e 0000 c3f3 78f2 1e 78"),
    0xE1: bytes.fromhex("3f af 2c 00 2d 14 78 9c 7665 51d4 e3 12 00 00"),
    0x00: bytes.fromhex("2b 00 16 00 33"),
}
"""Address of a register -> the calibration bytes from there on, which differ between sensors; these are typical ones."""


class Bme680(SerialRegisters):
    """The sensor.

    Setting `points`: [milliseconds, [pressure, temperature, humidity, gas]] in steps of its converter (20, 20, 16 and 10 bits).
    """

    setting_names: ClassVar[Mapping[str, Any]] = {**SerialRegisters.setting_names, "page": _PAGE, "step": True, "points": ...}

    def start(self) -> None:
        """Wait for the chip select, and begin to measure."""
        super().start()
        for register, cells in _COEFFICIENTS.items():
            self.memory[register : register + len(cells)] = cells
        self.memory[_IDENTITY] = _IS_BME680
        for at_ms, steps in self.settings["points"]:
            self.bench.at(at_ms * 1000, partial(self._measure, steps))

    def _measure(self, steps: list[int]) -> None:
        pressure, temperature, humidity, gas = steps
        found = bytes([_NEW_DATA, 0, *(byte for word in (pressure, temperature) for byte in (word << 4).to_bytes(3, "big"))])
        found += humidity.to_bytes(2, "big") + bytes(3) + bytes([gas >> 2, (gas & 3) << 6 | _GAS_VALID | 5])
        self.memory[_MEASURED : _MEASURED + len(found)] = found
