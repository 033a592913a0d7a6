"""The library libsimavr for ctypes: where it is, its functions, and the few parts of its structures that are used.

`simavr` is the engine that uses it. No layout of its structures is relied on, except for the head of `elf_firmware_t`, which
versions 1.4 to 1.8 have in common.
"""

from __future__ import annotations

import ctypes
import ctypes.util
from collections.abc import Callable
from functools import cache

_IN_A_ROW = 64
"""Cycles that the library may run before it checks its timers, earlier if one is due: a third faster."""
_LOOKS = 16
_HEAD_WORDS = 64
"""Number of 8-byte words of the library's `avr_t` that are searched; it has more than 16 kB."""

NOTIFY = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_uint32, ctypes.c_void_p)
TIMER = ctypes.CFUNCTYPE(ctypes.c_uint64, ctypes.c_void_p, ctypes.c_uint64, ctypes.c_void_p)
LOGGER = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_int, ctypes.c_char_p)


class Firmware(ctypes.Structure):
    """The head of `elf_firmware_t`; the last field is room for the rest of it."""

    _fields_ = (
        ("mmcu", ctypes.c_char * 64), ("frequency", ctypes.c_uint32), ("vcc", ctypes.c_uint32), ("avcc", ctypes.c_uint32),
        ("aref", ctypes.c_uint32), ("rest", ctypes.c_char * 16384),
    )  # fmt: skip


@cache
def installed_library() -> ctypes.CDLL | None:
    """The library with its functions declared, or None where it is not installed."""
    for name in ("libsimavr.so.2", ctypes.util.find_library("simavr"), "libsimavr.so"):
        try:
            library = ctypes.CDLL(name) if name else None
        except OSError:
            continue
        if library is not None:
            return _declared(library)
    return None


def _declared(library: ctypes.CDLL) -> ctypes.CDLL:
    pointer, number, wide = ctypes.c_void_p, ctypes.c_uint32, ctypes.c_uint64
    for name, result, arguments in (
        ("avr_make_mcu_by_name", pointer, [ctypes.c_char_p]),
        ("avr_init", ctypes.c_int, [pointer]),
        ("elf_read_firmware", ctypes.c_int, [ctypes.c_char_p, pointer]),
        ("avr_load_firmware", None, [pointer, pointer]),
        ("avr_run", ctypes.c_int, [pointer]),
        ("avr_terminate", None, [pointer]),
        ("avr_io_getirq", pointer, [pointer, number, ctypes.c_int]),
        ("avr_iomem_getirq", pointer, [pointer, ctypes.c_uint16, ctypes.c_char_p, ctypes.c_int]),
        ("avr_irq_register_notify", None, [pointer, NOTIFY, pointer]),
        ("avr_raise_irq", None, [pointer, number]),
        ("avr_ioctl", ctypes.c_int, [pointer, number, pointer]),
        ("avr_cycle_timer_register", None, [pointer, wide, TIMER, pointer]),
        ("avr_cycle_timer_status", wide, [pointer, TIMER, pointer]),
        ("avr_global_logger_set", None, [pointer]),
        ("avr_core_watch_write", None, [pointer, ctypes.c_uint16, ctypes.c_uint8]),
        ("avr_core_watch_read", ctypes.c_uint8, [pointer, ctypes.c_uint16]),
        ("avr_twi_irq_msg", number, [ctypes.c_uint8, ctypes.c_uint8, ctypes.c_uint8]),
    ):
        function = getattr(library, name)
        function.restype, function.argtypes = result, arguments
    return library


SILENT = LOGGER(lambda avr, level, text: None)  # kept for ever: the library keeps the pointer


def run_in_a_row(found_library: ctypes.CDLL, avr: int, cycle: Callable[[], int]) -> int:
    """Let the library run several instructions per call; returns how many cycles these may take.

    The field of `avr_t` that limits the cycles (run_cycle_limit) follows those of the remaining cycles (run_cycle_count) and of
    the clock (cycle). Versions have them at different offsets: they are searched while the first instructions run, and nothing
    is changed unless exactly one place fits.

    Args:
        found_library: the library.
        avr: the microcontroller, whose program may have started.
        cycle: returns its clock.
    """
    head = (ctypes.c_uint64 * _HEAD_WORDS).from_address(avr)
    found = set(range(_HEAD_WORDS - 2))
    for _ in range(_LOOKS):
        found_library.avr_run(avr)
        now = cycle()
        found = {at for at in found if head[at] == now and head[at + 1] <= 1 and head[at + 2] == 1}
    if len(found) != 1:
        return 1
    head[found.pop() + 2] = _IN_A_ROW
    return _IN_A_ROW
