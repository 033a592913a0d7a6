"""A Sony remote control, seen by an infrared receiver whose output is low while it sees the carrier (SIRC, 12 bits)."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any, ClassVar

from robosmi.verify.bench import Device

_FRAME_US = 45000.0
_START_US, _ONE_US, _ZERO_US, _GAP_US = 2400.0, 1200.0, 600.0, 600.0


class SonyRemote(Device):
    """The receiver of a remote control; its output is low while it sees the carrier.

    Setting `points`: [milliseconds, [command, device]]; each key press is three frames, 45 ms apart.
    """

    pin_names = ("signal",)
    setting_names: ClassVar[Mapping[str, Any]] = {"points": ..., "frames": 3}

    def start(self) -> None:
        """Hold the output high, and send the frames of each point at its time."""
        self.bench.set_level(self.pins["signal"], 1)
        for at_ms, (command, device) in self.settings["points"]:
            for frame in range(self.settings["frames"]):
                self.bench.at(at_ms * 1000 + frame * _FRAME_US, partial(self._send, command & 0x7F | (device & 0x1F) << 7))

    def _send(self, code: int) -> None:
        self.note("sent", code)
        at_us = self.bench.now
        for low in (_START_US, *(_ONE_US if code >> bit & 1 else _ZERO_US for bit in range(12))):
            self.bench.at(at_us, partial(self.bench.set_level, self.pins["signal"], 0))
            self.bench.at(at_us + low, partial(self.bench.set_level, self.pins["signal"], 1))
            at_us += low + _GAP_US
