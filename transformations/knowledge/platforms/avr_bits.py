"""Names and numbers of bits in registers of AVR microcontrollers, and the registers of timers that tick (`avr_bits.toml`)."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import cache

from msgspec import Struct, convert

from robosmi import resources
from robosmi.project import read_data

_OF_PORT = re.compile(r"(?:P|DD|PORT|PIN)[A-L]([0-7])")
_OF_CHANGE = re.compile(r"PCINT(\d{1,2})")
_BINARY = re.compile(r"B([01]{1,8})")


class TickingTimer(Struct, frozen=True):
    """A timer that starts again at a compare register and then calls an interrupt function.

    Attributes:
        registers: what a register does -> its name.
        mode_a, mode_b: the mode bits of the two control registers.
        mask_b: which bits of the second control register are mode bits; those of the first are its two lowest.
        prescalers: divisor of the clock by the clock select bits; 0 for a stopped or external clock.
    """

    registers: Mapping[str, str]
    mode_a: int
    mode_b: int
    mask_b: int
    prescalers: Sequence[int]


class PinChanges(Struct, frozen=True):
    """A pin change interrupt: its mask register, its bit in the register that enables it, and the port of its pins."""

    mask: str
    enable: int
    port: str


class Converter(Struct, frozen=True):
    """The registers of the analogue converter, and bits of them.

    Attributes:
        select, control: the registers that select the channel, and that start a conversion.
        results: the names of the register with the result.
        channel_mask: the bits of the channel in `select`.
        reference_mask, supply: the bits of the reference there, and their value for the supply.
        left: the bit for a result that is aligned left.
    """

    select: str
    control: str
    results: Sequence[str]
    channel_mask: int
    supply: int
    reference_mask: int
    left: int


class PwmTimer(Struct, frozen=True):
    """A timer that drives pins.

    Attributes:
        registers: what a register does -> its name.
        begin: what the core writes into the two control registers before a sketch begins.
        mode_mask: the mode bits of the second control register, moved down by three; those of the first are its two lowest.
        outputs: compare register -> its pin, and the lower one of the two bits of the first control register that connect it.
        modes: value of the mode bits -> the top (0: in the register `top`) and how often the counter passes it in a period.
        prescalers: divisor of the clock by the clock select bits; 0 for a stopped or external clock.
        interrupts: how the names of its interrupt vectors begin.
    """

    registers: Mapping[str, str]
    begin: tuple[int, int]
    mode_mask: int
    outputs: Mapping[str, tuple[str, int]]
    modes: Mapping[int, tuple[int, int]]
    prescalers: Sequence[int]
    interrupts: str


class Sleep(Struct, frozen=True):
    """The calls that sleep.

    Attributes:
        header: declares them.
        calls: all of them.
        sleeps: those that sleep at once.
        select: the one that chooses the mode.
        idle: the mode that every interrupt ends; the one without a choice, too.
    """

    header: str
    calls: Sequence[str]
    sleeps: Sequence[str]
    select: str
    idle: str


class AvrBits(Struct, frozen=True):
    """The facts of the file."""

    bits: Mapping[str, int]
    ticks: Mapping[str, TickingTimer]
    watchdog: Mapping[str, int]
    pin_changes: Mapping[str, PinChanges]
    converter: Converter
    pwm: Mapping[str, PwmTimer]
    sleep: Sleep

    def value(self, name: str) -> int | None:
        """The number that a name stands for: a bit of a register, or a constant such as B0101; None for any other name."""
        if (found := self.bits.get(name)) is not None:
            return found
        if (port := _OF_PORT.fullmatch(name)) is not None:
            return int(port[1])
        if (change := _OF_CHANGE.fullmatch(name)) is not None:
            return int(change[1]) % 8
        binary = _BINARY.fullmatch(name)
        return int(binary[1], 2) if binary is not None else None


@cache
def avr_bits() -> AvrBits:
    """The facts."""
    return convert(read_data(resources.find("platform_repo", "arduino/avr_bits.toml")), AvrBits, strict=False)
