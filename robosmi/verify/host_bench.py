"""The bench of a program that runs in a host model: it takes the records that come from its process, and makes the answers.

`original_run` starts the process, and carries both.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Collection, Sequence

from robosmi.errors import UsageError, VerificationError
from robosmi.verify.bench import AIMS, Bench, Level
from robosmi.verify.original_build import OriginalProgram
from robosmi.verify.simulation import ConsoleByte, Wave

_COMMAND = struct.Struct("<iiq")
_DECAY_FOR = struct.Struct("<dd")
_FLOAT = struct.Struct("<f")
_WORD = struct.Struct("<I")
PIN, _WAVE, _CONSOLE, _SYNC, _BUS_START, _BUS_WRITE, _BUS_READ, _BUS_STOP, END, _CALL, _AIM, _COMPARED = range(1, 13)
_GO, _LEVEL, _VOLTAGE, _TYPED, _JOIN, _PART, _LEVEL_AHEAD, _DECAY = range(8)
_LET_GO = 2
LEVELS: tuple[Level, ...] = (0, 1, "z")
"""What the process calls 0, 1 and 2."""
_MOST_DECAYS = 1024
"""So many the process can keep of all pins."""
NEVER = (1 << 62) - 1
"""A time that does not come, in ticks."""
_TOGETHER_US = 45_000.0
"""Cores that print within this time print concurrently, since a line may be this much later in another run (see `comparison`)."""


def _float(bits: int) -> float:
    """The number whose bits came as a word."""
    number: float = _FLOAT.unpack(_WORD.pack(bits))[0]
    return number


class HostBench(Bench):
    """The bench of a program that runs in a host model: its cycles are the ticks of the virtual time."""

    def __init__(self, program: OriginalProgram) -> None:
        model = program.model
        super().__init__([*model.pins, *model.channels], model.clock_hz)
        self.labels = model.pins
        self.numbers = {label: number for names in (model.pins, model.channels) for number, label in enumerate(names)}
        self.channels = frozenset(model.channels)
        self.commands: list[bytes] = []
        self.waves: list[Wave] = []
        self.console: list[ConsoleByte] = []
        self.calls: list[tuple[float, int, int, bool]] = []
        self.mixed_text_us: list[float] = []
        self.compared: dict[int, tuple[float, float]] = {}
        self._speaker = 0
        self.tick = 0
        self.next_wake = NEVER
        self._addressed: dict[int, int] = {}  # bus -> address
        self._with_charge: set[str] = set()
        self._decays = 0

    @property
    def cycle(self) -> int:
        """The ticks since the first statement of main."""
        return self.tick

    @property
    def watched(self) -> int:
        """The pins at which a device is, as bits."""
        return self.bits(self._at_pin)

    def bits(self, pins: Collection[str]) -> int:
        """Pins as bits."""
        return sum(1 << number for number, label in enumerate(self.labels) if label in pins)

    @property
    def unheeded(self) -> dict[int, str]:
        """Number -> label of each pin at which no device has to be told of a change."""
        heeded = {pin for pin, devices in self._at_pin.items() if not all(device.is_played for device in devices)}
        return {number: label for number, label in enumerate(self.labels) if label not in heeded}

    @property
    def asking(self) -> tuple[int, int, int]:
        """Bit masks of the pins whose devices must react at once when the pin is driven low, driven high, or released."""
        found = [
            sum(1 << number for number, label in enumerate(self.labels) if self._reacts(label, level)) for level in (0, 1, "z")
        ]
        return found[0], found[1], found[2]

    def _reacts(self, pin: str, level: Level) -> bool:
        return any(level in device.reacts_to and not device.is_played for device in self._at_pin.get(pin, ()))

    def join(self, pin: str, other: str) -> None:
        """Close a contact between two pins."""
        self._command(_JOIN, self.numbers[pin], self.numbers[other])

    def part(self, pin: str, other: str) -> None:
        """Open the contact between two pins."""
        self._command(_PART, self.numbers[pin], self.numbers[other])

    def wake_at(self, cycle: int) -> None:
        """Request a call of `wake` at a cycle earlier than any requested before."""
        self.next_wake = cycle

    def set_level(self, pin: str, level: int | None) -> None:
        """Drive a pin from outside, low or high; None releases it."""
        self._command(_LEVEL, self.numbers[pin], _LET_GO if level is None else level)

    def set_level_at(self, at_us: float, pin: str, level: int | None, holds: Callable[[], bool] = lambda: True) -> None:
        """Tell the process ahead, which saves one exchange of messages; it forgets it when the pin's level is set before."""
        cycle = round(at_us * self.clock_hz / 1e6)
        if cycle <= self.cycle:
            self.set_level(pin, level)
        else:
            self._command(_LEVEL_AHEAD, self.numbers[pin] | (_LET_GO if level is None else level) << 5, cycle)

    def keeps_charge(self, pin: str, decays: Sequence[tuple[float, float]]) -> bool:
        """Let the process play a capacitor, as far as it can keep so many decays."""
        if not decays or pin in self._with_charge or self._decays + len(decays) > _MOST_DECAYS:
            return False
        self._with_charge.add(pin)
        self._decays += len(decays)
        for from_us, lasts_us in decays:
            self._command(_DECAY, self.numbers[pin], 0)
            self.commands.append(_DECAY_FOR.pack(from_us, lasts_us))
        return True

    def set_voltage(self, pin: str, millivolts: float) -> None:
        """Set the voltage at a channel of the converter."""
        if pin not in self.channels:
            raise UsageError(f"there is no converter at '{pin}'", fix=f"use one of: {', '.join(sorted(self.channels))}")
        self._command(_VOLTAGE, self.numbers[pin], round(millivolts))

    def send(self, data: bytes) -> None:
        """Let bytes arrive on the program's console."""
        for byte in data:
            self._command(_TYPED, byte, 0)

    def _command(self, kind: int, which: int, value: int) -> None:
        self.commands.append(_COMMAND.pack(kind, which, value))

    def answer(self, value: int = 0) -> bytes:
        """The command to the process: what the devices have done since it last asked, and when they act next."""
        said = b"".join(self.commands) + _COMMAND.pack(_GO, value, self.next_wake)
        self.commands.clear()
        return said

    def told(self, kind: int, a: int, b: int, c: int) -> int | None:
        """Take a record; the value to answer with, None if it asks for no answer."""
        if kind == PIN:
            pin, level = self.labels[a], LEVELS[b]
            self.pin_changed(pin, level)
            return 0 if self._reacts(pin, level) else None
        if kind == _WAVE:
            self.waves.append(Wave(self.now, self.labels[a], _float(b), _float(c)))
            return None
        if kind == _CONSOLE:
            if self.console and self._speaker != b and self.now - self.console[-1].at_us < _TOGETHER_US:
                self.mixed_text_us.append(self.now)
            self._speaker = b
            self.console.append(ConsoleByte(self.now, a))
            return None
        if kind == _COMPARED:
            self.compared[a] = (_float(b), _float(c))
            return None
        if kind == _CALL:
            if not self.calls or self.calls[-1][1:] != (a, b, bool(c)):
                self.calls.append((self.now, a, b, bool(c)))
            return None
        if kind == _AIM:
            self.aimed(self.labels[a], AIMS[b])
            return None
        if kind == _SYNC:
            due = self.wake()
            self.next_wake = NEVER if due is None else due
            return 0
        if kind == _BUS_START:
            self._addressed[a] = b >> 1
            return int(self.bus_start(b >> 1, bool(b & 1)))
        if kind == _BUS_WRITE:
            return int(self.bus_write(self._addressed.get(a, -1), b))
        if kind == _BUS_READ:
            return self.bus_read(self._addressed.get(a, -1))
        if kind == _BUS_STOP:
            self.bus_stop(self._addressed.get(a, -1))
            return 0
        raise VerificationError(
            "what the original program tells of its pins cannot be read: it writes to files that it has not opened",
            fix="take out what writes by the number of a file, or by the system's own calls",
        )
