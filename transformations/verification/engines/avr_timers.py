"""The waveforms that an AVR's timers make at its pins, computed from the bytes that a program writes into their registers.

Simulators report such waveforms differently or not at all, but all report register writes. The facts about a microcontroller's
timers come with the job (`platform_repo/simulation/avr.toml`). The modes are those of the data sheet of the ATmega328P, tables
15-8 and 16-4.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from robosmi.base.data_text import Json
from robosmi.verify.simulation import Wave

FAST, PHASE, CLEAR, NORMAL = "fast", "phase", "clear", "normal"

_MODES_8: Mapping[int, tuple[str, int | str]] = {
    0: (NORMAL, 0xFF), 1: (PHASE, 0xFF), 2: (CLEAR, "compare"), 3: (FAST, 0xFF), 5: (PHASE, "compare"), 7: (FAST, "compare"),
}  # fmt: skip
_MODES_16: Mapping[int, tuple[str, int | str]] = {
    0: (NORMAL, 0xFFFF), 1: (PHASE, 0xFF), 2: (PHASE, 0x1FF), 3: (PHASE, 0x3FF), 4: (CLEAR, "compare"), 5: (FAST, 0xFF),
    6: (FAST, 0x1FF), 7: (FAST, 0x3FF), 8: (PHASE, "top"), 9: (PHASE, "compare"), 10: (PHASE, "top"), 11: (PHASE, "compare"),
    12: (CLEAR, "top"), 14: (FAST, "top"), 15: (FAST, "compare"),
}  # fmt: skip
"""Waveform generation mode -> its kind, and the value at which the counter turns:

a number, the first compare register (OCRnA), or the top register (ICRn).
"""

_ONE_CHANGE_US = 5.0
"""Microseconds between register writes that count as one change of a waveform:

`analogWrite` needs less than 1 us at 16 MHz.
"""


class Timers:
    """Follows the registers of all timers.

    Args:
        facts: timer -> its registers, channels and prescalers, as in `platform_repo/simulation/avr.toml`.
        pins: label of each pin -> port letter and bit.
        clock_hz: clock of the microcontroller in hertz.
        changed: called with a pin's label, and the frequency and duty cycle of each new waveform there.

    Attributes:
        waves: the waveforms found, by time.
        registers: the addresses whose writes have to be reported.
    """

    def __init__(
        self,
        facts: Mapping[str, Mapping[str, Json]],
        pins: Mapping[str, str],
        clock_hz: int,
        changed: Callable[[str, float, float], None],
    ) -> None:
        self._changed = changed
        self.waves: list[Wave] = []
        self._clock_hz = clock_hz
        self._labels = {port: label for label, port in pins.items()}
        self._timers = [(timer, _registers(timer)) for timer in facts.values()]
        self._values: dict[int, int] = {}
        self._now: dict[str, tuple[float, float]] = {}

    @property
    def registers(self) -> Sequence[int]:
        """The addresses whose writes have to be reported, sorted."""
        return sorted({address for _, addresses in self._timers for address in addresses})

    def written(self, at_us: float, address: int, value: int) -> None:
        """Record that the program wrote a byte into a register, and add the waveforms that follow from it."""
        self._values[address] = value
        for timer, addresses in self._timers:
            if address in addresses:
                self._work_out(at_us, timer)

    def _work_out(self, at_us: float, timer: Mapping[str, Any]) -> None:
        for channel in timer["channels"]:
            label = self._labels.get(channel["port"])
            if label is None:
                continue  # the board does not lead this pin out
            wave = self._wave(timer, channel)
            if wave != self._now.get(label, (0.0, 0.0)):
                self._now[label] = wave
                if self.waves and self.waves[-1].pin == label and at_us - self.waves[-1].at_us < _ONE_CHANGE_US:
                    self.waves.pop()  # a wave is set up register by register
                self.waves.append(Wave(at_us, label, *wave))
                self._changed(label, *wave)

    def _wave(self, timer: Mapping[str, Any], channel: Mapping[str, Any]) -> tuple[float, float]:
        """Frequency (Hz) and duty cycle (0 to 1) of a channel; zeros when it makes no waveform."""
        control_a, control_b = self._values.get(timer["control_a"], 0), self._values.get(timer["control_b"], 0)
        output = control_a >> channel["com"] & 3
        divisor = timer["prescalers"][control_b & 7]
        wide = timer["bits"] == 16
        mode = control_a & 3 | (control_b >> 3 & (3 if wide else 1)) << 2
        kind, turn = (_MODES_16 if wide else _MODES_8).get(mode, (NORMAL, 0))
        if not output or not divisor:
            return 0.0, 0.0
        first = timer["channels"][0]["compare"]
        top = turn if isinstance(turn, int) else self._value(first if turn == "compare" else timer["top"], wide)
        ticks = self._clock_hz / divisor
        if kind in (CLEAR, NORMAL):
            return (ticks / (2 * (top + 1)), 0.5) if output == 1 else (0.0, 0.0)
        compare = self._value(channel["compare"], wide)
        if output == 1:  # toggles; in these modes only the first channel of some can
            return 0.0, 0.0
        if kind == FAST:
            hz, duty = ticks / (top + 1), min(1.0, (compare + 1) / (top + 1))
        else:
            hz, duty = ticks / (2 * top) if top else 0.0, min(1.0, compare / top) if top else 0.0
        return hz, duty if output == 2 else 1.0 - duty

    def _value(self, address: int, wide: bool) -> int:
        low = self._values.get(address, 0)
        return low | self._values.get(address + 1, 0) << 8 if wide else low


def _registers(timer: Mapping[str, Any]) -> frozenset[int]:
    addresses = [timer["control_a"], timer["control_b"], *(channel["compare"] for channel in timer["channels"])]
    if timer["bits"] == 16:
        addresses.append(timer["top"])
        addresses += [address + 1 for address in addresses if address not in (timer["control_a"], timer["control_b"])]
    return frozenset(addresses)
