"""Runs work in a process of its own and ends all that it has started, however that detaches itself (Linux).

The supervisor is the reaper of all processes that come from the work (`PR_SET_CHILD_SUBREAPER`, prctl(2)): one that leaves its
session and its parent becomes a child of the supervisor, and is killed when the work has ended.
"""

from __future__ import annotations

import ctypes
import os
import signal
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from types import FrameType

from robosmi import inputs

_DEATH_SIGNAL, _SUBREAPER = 1, 36  # linux/prctl.h
GRACE_S = 5.0
"""Seconds that the work has to end in order after it was asked to; then it is killed."""
_LOOK_S, _AT_ONCE = 0.001, 10_000
"""Seconds between two looks at the children, after so many looks without a pause."""


def supervised(work: Callable[[], int]) -> int:
    """Do work in a child process, and kill all that it leaves behind.

    A request to end (SIGTERM), and the death of the process that started this one, are passed on to the work.

    Args:
        work: gives its exit code.

    Returns:
        That code; 128 and the number of the signal that ended the work.
    """
    library = ctypes.CDLL(None)
    library.prctl(_SUBREAPER, 1, 0, 0, 0)
    library.prctl(_DEATH_SIGNAL, signal.SIGTERM, 0, 0, 0)
    child = os.fork()
    if child == 0:
        library.prctl(_DEATH_SIGNAL, signal.SIGKILL, 0, 0, 0)
        os.setpgid(0, 0)
        code = 70
        try:
            code = work()
            sys.stdout.flush()
            sys.stderr.flush()
        finally:
            os._exit(code)

    def pass_on(number: int, _: FrameType | None) -> None:
        os.kill(child, number)
        signal.setitimer(signal.ITIMER_REAL, GRACE_S)

    signal.signal(signal.SIGALRM, lambda *_: os.kill(child, signal.SIGKILL))
    signal.signal(signal.SIGTERM, pass_on)
    code = 0
    for ended, status in iter(_waited, (0, 0)):
        if ended == child:
            code = os.waitstatus_to_exitcode(status)
            break
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    signal.setitimer(signal.ITIMER_REAL, 0)
    _kill_what_is_left(child)
    return code if code >= 0 else 128 - code


def _waited() -> tuple[int, int]:
    """The number of a child that has ended and its status; zeros if there is no child."""
    try:
        return os.waitpid(-1, 0)
    except ChildProcessError:
        return 0, 0


def _kill_what_is_left(group: int) -> None:
    """Kill a group at once, and then the children until there is none: those of a killed one become children here.

    A process may start the next and end, again and again. No signal to a group misses one; of a chain whose processes also
    leave the group, one is met in time, since the kernel lists the children at once.
    """
    with suppress(ProcessLookupError):
        os.killpg(group, signal.SIGKILL)
    tries = 0
    with suppress(ChildProcessError):
        while True:
            if os.waitpid(-1, os.WNOHANG) == (0, 0):
                for number in _children():
                    with suppress(ProcessLookupError):
                        os.kill(number, signal.SIGKILL)
                if (tries := tries + 1) > _AT_ONCE:
                    time.sleep(_LOOK_S)


def _children() -> Iterator[int]:
    with suppress(OSError):  # a kernel without CONFIG_PROC_CHILDREN
        listed = inputs.read_text(Path(f"/proc/self/task/{os.getpid()}/children"), inputs.SETTINGS)
        yield from map(int, listed.split())
        return
    for place in Path("/proc").iterdir():
        if place.name.isdecimal():
            with suppress(OSError):
                state = inputs.read_text(place / "stat", inputs.SETTINGS, errors="replace")
                if int(state.rpartition(")")[2].split()[1]) == os.getpid():  # proc_pid_stat(5): state, number of the parent
                    yield int(place.name)
