"""Limits of memory, processor time and length of files for the compilers that read a stranger's texts, and what started them.

Templates, constant expressions, macros and large arrays of a few lines let a compiler take gigabytes. Linux enforces the limits
(`prlimit`); on other systems only the clock ends a compiler.
"""

from __future__ import annotations

import errno
import os
import re
import signal
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from robosmi import inputs
from robosmi.verify.toolchains.processor_time import ticks_asleep

MEMORY_MB, PROCESSOR_S, FILE_MB = 500, 10, 256
"""Limits of each process: of its address space, of its processor time, and of the length of a file that it writes."""
WAITS_LOOKS = 5
"""Looks, one each second, after which a process that only sleeps is taken to wait for ever."""

_WORDS = {
    re.compile(rf"out of memory|memory exhausted|{re.escape(os.strerror(errno.ENOMEM))}|std::bad_alloc"): (
        "RLIMIT_AS",
        f"{MEMORY_MB} MB of memory",
    ),
    re.compile(re.escape(signal.strsignal(signal.SIGXCPU) or "SIGXCPU") if hasattr(signal, "SIGXCPU") else r"(?!)"): (
        "RLIMIT_CPU",
        f"{PROCESSOR_S} s of processor time",
    ),
    re.compile(
        rf"{re.escape(signal.strsignal(signal.SIGXFSZ) or 'SIGXFSZ')}|{re.escape(os.strerror(errno.EFBIG))}"
        if hasattr(signal, "SIGXFSZ")
        else r"(?!)"
    ): ("RLIMIT_FSIZE", f"{FILE_MB} MB in a file"),
}
"""What compilers say when they reach a limit -> the limit, and what it allows."""
_OF_THE_PROGRAM = re.compile(r"^\s*\d* \||:\d+(?::\d+)?: (?:error|warning|note): ")
"""A line that quotes the program, or is about a line of it: `#error` may use any words."""
_VALUES = {"RLIMIT_AS": MEMORY_MB << 20, "RLIMIT_CPU": PROCESSOR_S, "RLIMIT_FSIZE": FILE_MB << 20}


def limit(process: int) -> frozenset[str]:
    """Limit a process that was just started, and those that it has started meanwhile; any later one inherits the limits.

    Args:
        process: its number.

    Returns:
        The names of the limits that are tighter than those that it had.
    """
    try:
        from resource import RLIM_INFINITY, getrlimit, prlimit
    except ImportError:
        return frozenset()
    import resource

    tighter: set[str] = set()
    todo = [process]
    while todo:
        one = todo.pop()
        for name, most in _VALUES.items():
            kind = getattr(resource, name)
            soft, hard = getrlimit(kind)
            if soft == RLIM_INFINITY or soft > most:
                tighter.add(name)
                with suppress(OSError):  # it has ended
                    prlimit(one, kind, (most, hard))
        todo += _started_by(one)  # after the limits, so that none is missed
    return frozenset(tighter)


def _started_by(process: int) -> Iterator[int]:
    with suppress(OSError):
        for task in Path(f"/proc/{process}/task").iterdir():
            with suppress(OSError):
                yield from map(int, inputs.read_text(task / "children", inputs.RECORD).split())


class IdleWatch:
    """Tells whether a process waits for something that never comes, as a compiler does that opens a named pipe."""

    def __init__(self, process: int) -> None:
        self.process = process
        self.seen: dict[int, int | None] = {}
        self.looks = 0

    def look(self) -> bool:
        """Whether it, and all that it has started, slept and used no processor time at each of the last `WAITS_LOOKS` looks."""
        now = dict(_sleeping(self.process))
        self.looks = self.looks + 1 if now and now == self.seen and None not in now.values() else 0
        self.seen = now
        return self.looks >= WAITS_LOOKS


def _sleeping(process: int) -> Iterator[tuple[int, int | None]]:
    """A process and those that it has started, each with its ticks of processor time; None for one that does not sleep."""
    todo = [process]
    while todo:
        one = todo.pop()
        with suppress(OSError):  # it has ended, or this system does not tell
            yield one, ticks_asleep(one)
        todo += _started_by(one)


def exceeded(tighter: frozenset[str], code: int, complained: str) -> str:
    """What a process took more of than it may, as words for a message; empty if it did not.

    Args:
        tighter: the limits that are ours, as `limit` gives them.
        code: the exit code of the process.
        complained: what it wrote to its errors.
    """
    if code == 0:
        return ""
    said = [line for line in complained.splitlines() if not _OF_THE_PROGRAM.search(line)]
    if code < 0:
        said.append(signal.strsignal(-code) or "")
    for words, (name, allowed) in _WORDS.items():
        if name in tighter and any(words.search(line) for line in said):
            return allowed
    return ""
