"""Which instructions of a program run on libsimavr, and where it goes on after each: for the coverage of its source.

Ten times slower than running on without looking.
"""

from __future__ import annotations

import ctypes
from collections.abc import Sequence

from msgspec.structs import replace

from robosmi.errors import VerificationError
from robosmi.verify.simulation import PinTrace

_HEAD_WORDS = 128
"""Number of 4-byte words of the library's `avr_t` that are searched; it has more than 16 kB."""
_STRAIGHT = 4
"""Instructions of the start-up code after which the program counter is known."""


class Steps:
    """Runs one instruction after the other and notes which.

    Args:
        library: libsimavr.
        avr: the microcontroller, whose program has not started.
        flash: the runs of bytes of its program, with their addresses.
        ends: the states in which the program has ended.

    The program counter is a field of `avr_t` whose place differs between versions. It is the one that follows the first
    instructions of the start-up code, which runs straight on after the jump from the reset vector.

    Raises:
        VerificationError: no such field is found.
    """

    def __init__(self, library: ctypes.CDLL, avr: int, flash: Sequence[tuple[int, bytes]], ends: frozenset[int]) -> None:
        self._run, self._avr, self._ends = library.avr_run, avr, ends
        self._head = (ctypes.c_uint32 * _HEAD_WORDS).from_address(avr)
        self._begin = at = _first_jump(flash)
        found = set(range(len(self._head)))
        for _ in range(_STRAIGHT):
            library.avr_run(avr)
            found = {each for each in found if self._head[each] == at}
            at += 2
        if len(found) != 1:
            raise VerificationError("this simavr does not show which instructions run", fix="try another engine")
        self._place = found.pop()
        self._passed, self._jumped = set[int](), set[int]()

    def run(self, count: int) -> int:
        """Run so many instructions, fewer if the program ends; returns the last state."""
        run, avr, head, place, begin = self._run, self._avr, self._head, self._place, self._begin
        passed, jumped, ends = self._passed.add, self._jumped.add, self._ends
        state = 0
        after = head[place]
        for _ in range(count):
            before = after
            state = run(avr)
            after = head[place]
            if after == before + 2:
                passed(before)
            elif after >= begin and after != before:  # else it is an interrupt's vector, or the processor sleeps
                jumped(before)
            if state in ends:
                break
        return state

    def noted_in(self, trace: PinTrace) -> PinTrace:
        """A trace with the instructions that ran."""
        passed, jumped = sorted(self._passed), sorted(self._jumped)
        return replace(trace, reached=tuple(sorted({*passed, *jumped})), jumped=tuple(jumped), passed=tuple(passed))


def _first_jump(flash: Sequence[tuple[int, bytes]]) -> int:
    """Where the jump at the reset vector leads: JMP with its address in the next word, or RJMP (AVR instruction set manual)."""
    first, second = (int.from_bytes(flash[0][1][at : at + 2], "little") for at in (0, 2))
    return second * 2 if first == 0x940C else ((first & 0xFFF) + 1) * 2
