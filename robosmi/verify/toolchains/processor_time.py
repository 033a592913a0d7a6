"""The processor time of runs, by which they are limited: other work on this machine must decide no verdict.

A process that waits for ever uses no processor time, so that the clock remains the outer limit, `HANGS` times as long.
"""

from __future__ import annotations

import math
import os
from pathlib import Path

from robosmi import inputs

HANGS = 10
"""How many times its processor time a run may take by the clock, beside other work."""


def used_s() -> float:
    """The seconds of processor time that this process has used until now, with all its children that have ended."""
    used = os.times()
    return used.user + used.system + used.children_user + used.children_system


def ticks_asleep(process: int) -> int | None:
    """The ticks of processor time that a process has used, if it sleeps; None if it does not.

    Raises:
        OSError: it has ended, or this system does not tell.
    """
    told = inputs.read_text(Path(f"/proc/{process}/stat"), inputs.RECORD, errors="replace")
    state, *numbers = told.rpartition(") ")[2].split()
    return int(numbers[10]) + int(numbers[11]) if state == "S" else None


def bound_own(seconds: float) -> None:
    """End this process, and any that it starts, when it has used so many seconds of processor time, rounded up.

    The signal SIGXCPU ends them. On a system without such limits nothing happens.
    """
    try:
        import resource
    except ImportError:
        return
    _, most = resource.getrlimit(resource.RLIMIT_CPU)
    wanted = math.ceil(seconds)
    # the signal would leave a file; the greatest limit stays, as the sandbox sets its own
    resource.setrlimit(resource.RLIMIT_CORE, (0, resource.getrlimit(resource.RLIMIT_CORE)[1]))
    resource.setrlimit(resource.RLIMIT_CPU, (wanted if most == resource.RLIM_INFINITY else min(wanted, most), most))
