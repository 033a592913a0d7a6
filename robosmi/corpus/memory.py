"""The processes that a process has started, their end, and the memory that they take, as Linux tells it in /proc; other systems
tell nothing here.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path

from robosmi import inputs

MB = 1 << 20
_PAGE = os.sysconf("SC_PAGE_SIZE") if hasattr(os, "sysconf") else 4096


def descendants(process: int) -> Iterator[int]:
    """The processes that a process has started, and those that these have started."""
    with suppress(OSError, ValueError):
        for task in os.listdir(f"/proc/{process}/task"):
            with suppress(OSError, ValueError):
                for child in map(int, inputs.read_text(f"/proc/{process}/task/{task}/children", inputs.SETTINGS).split()):
                    yield child
                    yield from descendants(child)


def kill(processes: Iterable[int]) -> None:
    """Kill processes, some of which may have ended."""
    for each in list(processes):
        with suppress(ProcessLookupError, PermissionError):
            os.kill(each, signal.SIGKILL)


def resident(process: int) -> int:
    """The bytes of a process that are in memory; 0 if it is not there or the system does not tell."""
    with suppress(OSError, ValueError, IndexError):
        return int(inputs.read_text(f"/proc/{process}/statm", inputs.SETTINGS).split()[1]) * _PAGE
    return 0


def of_all(process: int) -> int:
    """The bytes in memory of a process and all that it has started; what they share counts for each."""
    return resident(process) + sum(resident(each) for each in descendants(process))


def reset_peak() -> None:
    """Begin anew to note the most memory of this process (proc(5), `clear_refs`)."""
    with suppress(OSError):
        Path("/proc/self/clear_refs").write_text("5", encoding="ascii")


def peak_mb() -> float | None:
    """The most memory that this process has had since `reset_peak`, in 2^20 bytes; None if the system does not tell."""
    with suppress(OSError, ValueError):
        for line in inputs.read_text("/proc/self/status", inputs.SETTINGS).splitlines():
            if line.startswith("VmHWM:"):
                return int(line.split()[1]) / 1024
    return None


def growth_mb(before: float | None) -> float | None:
    """The most memory that this process has had above what it had before, in 2^20 bytes.

    Args:
        before: `peak_mb` right after `reset_peak`.
    """
    now = peak_mb()
    return None if now is None or before is None else round(max(0.0, now - before), 1)


def limit_own(megabytes: int) -> None:
    """Let this process get no more memory than that on top of what it has; a request for more fails.

    It guards the machine against a program that takes it all at once, between two looks of the process that watches.
    """
    if sys.platform != "linux":
        return
    import resource

    with suppress(OSError, ValueError):
        held = int(inputs.read_text("/proc/self/statm", inputs.SETTINGS).split()[5]) * _PAGE
        _, hard = resource.getrlimit(resource.RLIMIT_DATA)
        wanted = held + megabytes * MB
        resource.setrlimit(resource.RLIMIT_DATA, (wanted if hard == resource.RLIM_INFINITY else min(wanted, hard), hard))
