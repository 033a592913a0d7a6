"""An LIS3DH accelerometer on a synchronous serial bus (its data sheet), with registers that show the acceleration."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

from robosmi.transformations.verification.devices.levels import value_at
from robosmi.transformations.verification.devices.serial_registers import SerialRegisters
from robosmi.verify.bench import Level

_WHO_AM_I, _STATUS, _OUT = 0x0F, 0x27, 0x28
_IDENTITY, _NEW_DATA = 0x33, 0x0F
_STEPS_BY_RANGE = (16, 8, 4, 1.34)
_RANGE_REGISTER = 0x23


class Lis3dh(SerialRegisters):
    """The sensor. Setting `points`: [milliseconds, [x, y, z]] in thousandths of g, the earth's gravity."""

    setting_names: ClassVar[Mapping[str, Any]] = {**SerialRegisters.setting_names, "points": ...}

    def start(self) -> None:
        """Wait for the chip select."""
        super().start()
        self.memory[_WHO_AM_I], self.memory[_STATUS] = _IDENTITY, _NEW_DATA

    def pin_changed(self, pin: str, level: Level) -> None:
        """Set the result registers when a transfer begins, scaled by the range that the program has chosen."""
        if pin == self.pins["select"] and level == 0:
            self._feel(value_at(self.settings["points"], self.bench.now))
        super().pin_changed(pin, level)

    def _feel(self, felt: Sequence[float]) -> None:
        steps = _STEPS_BY_RANGE[self.memory[_RANGE_REGISTER] >> 4 & 3]
        for number, milligravity in enumerate(felt):
            value = max(-32768, min(32767, round(milligravity * steps)))
            self.memory[_OUT + 2 * number : _OUT + 2 * number + 2] = (value & 0xFFFF).to_bytes(2, "little")
