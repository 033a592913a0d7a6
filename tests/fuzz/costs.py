"""What an input may cost: 10 s of processor time and 500 MB, also on a machine that does other work meanwhile.

Time on the clock grows with what else a machine does. So it is processor time that is judged, of a process and of those that it
has started; the clock only ends what waits for something, after twelve times as long. A class of inputs prints both.
"""

from __future__ import annotations

import os
import resource
import signal
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import FrameType

SECONDS = 10.0
"""Limit of processor seconds for one input of under 100 kB."""
PATIENCE = 12 * SECONDS
"""Seconds on the clock after which an input is aborted."""
MEGABYTES = 500


class TooLong(BaseException):
    """An input exceeded the limit; not an `Exception`, so that no handler on the way catches it."""


def spent() -> float:
    """Processor seconds of this process and of its children that have ended."""
    found = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(usage.ru_utime + usage.ru_stime for usage in found)


def spent_by(process: int) -> float:
    """Processor seconds of another process; 0 if this system does not tell."""
    try:
        fields = Path(f"/proc/{process}/stat").read_text().rpartition(") ")[2].split()
    except OSError:
        return 0.0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def megabytes() -> int:
    """Peak memory in megabytes of this process or of one of its children."""
    return max(resource.getrusage(who).ru_maxrss for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)) // 1024


@dataclass
class Costs:
    """What the inputs of a class have cost.

    Attributes:
        slowest: seconds of processor time of the slowest input.
        longest: seconds on the clock of the one that took longest.
        memory: megabytes that other processes have reported; this one is asked at the end.
    """

    slowest: float = 0.0
    longest: float = 0.0
    memory: int = 0

    @contextmanager
    def input(self, seconds: float = SECONDS) -> Iterator[None]:
        """Measure one input.

        Args:
            seconds: of processor time that it may take.

        Raises:
            TooLong: it takes longer than the limit.
        """
        before, begun = spent(), time.monotonic()
        for kind, timer, limit in ((signal.SIGPROF, signal.ITIMER_PROF, seconds), (signal.SIGALRM, signal.ITIMER_REAL, PATIENCE)):
            signal.signal(kind, _stop)
            signal.setitimer(timer, limit)
        try:
            yield
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0)
            signal.setitimer(signal.ITIMER_REAL, 0)
            took = spent() - before
            self.add(took, time.monotonic() - begun)
        if took > seconds:
            raise TooLong(f"{took:.1f} s of processor time")

    def add(self, seconds: float, clock: float, memory: int = 0) -> None:
        """Add the cost of an input that was measured elsewhere."""
        self.slowest, self.longest = max(self.slowest, seconds), max(self.longest, clock)
        self.memory = max(self.memory, memory)

    def over(self) -> bool:
        """Whether a process has exceeded the memory limit."""
        return max(self.memory, megabytes()) > MEGABYTES

    def __str__(self) -> str:
        memory = max(self.memory, megabytes())
        return f"slowest {self.slowest:.2f} s of processor time ({self.longest:.2f} s on the clock), at most {memory} MB"


def _stop(number: int, frame: FrameType | None) -> None:
    raise TooLong(f"{SECONDS} s of processor time" if number == signal.SIGPROF else f"{PATIENCE} s on the clock")
