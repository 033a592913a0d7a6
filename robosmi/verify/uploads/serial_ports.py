"""Serial ports of this machine: which there are, and opening one at a baud rate that its board takes as a sign.

Programs are put on boards by tools of their own (`upload`); nothing is sent or read here.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable
from contextlib import suppress
from glob import glob
from pathlib import Path

from robosmi.inputs import flags

_POLL_S = 0.05


def ports(patterns: Iterable[str]) -> list[str]:
    """The serial ports that are there, sorted.

    Args:
        patterns: where they are, as absolute paths with `*`.
    """
    return sorted(path for pattern in patterns for path in glob(pattern))


def probe(port: str) -> None:
    """Open a port and close it.

    Raises:
        OSError: the port is not there, may not be used or is in use.
    """
    os.close(os.open(port, os.O_RDWR | flags("O_NOCTTY", "O_NONBLOCK")))


def touch(port: str, baud: int) -> None:
    """Open a port at a baud rate, let go of its line DTR, and close it.

    Args:
        port: path of the port.
        baud: one of the rates that the system has a constant for.

    Raises:
        OSError: the port is not there, may not be used or is in use, or this system has no such ports.
    """
    try:
        import fcntl
        import termios
    except ImportError as error:
        raise OSError(f"this system cannot open ports at {baud} baud") from error
    handle = os.open(port, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
    try:
        settings = termios.tcgetattr(handle)
        settings[4] = settings[5] = getattr(termios, f"B{baud}")  # input and output speed
        settings[2] |= termios.HUPCL
        termios.tcsetattr(handle, termios.TCSANOW, settings)
        with suppress(OSError):  # a port without such a line
            fcntl.ioctl(handle, termios.TIOCMBIC, termios.TIOCM_DTR.to_bytes(4, "little"))
    except termios.error as error:
        raise OSError(error.args[0], str(error.args[1]), port) from error
    finally:
        os.close(handle)


def comes_back(port: str, patterns: Iterable[str], leaves_s: float, returns_s: float) -> str | None:
    """The port of a board that was asked to start anew: the same one, or a new one in its place; None if it stays away.

    Args:
        port: the port that it had.
        patterns: where ports are.
        leaves_s: seconds in which it leaves; a board that does not keeps its port.
        returns_s: seconds in which it is back after that.
    """
    places = [*patterns, port]
    others = set(ports(places)) - {port}
    if not _within(leaves_s, lambda: not Path(port).exists()):
        return port
    found: list[str] = []

    def back() -> bool:
        there = ports(places)
        found[:] = [port] if port in there else sorted(set(there) - others)
        return bool(found)

    return found[0] if _within(returns_s, back) else None


def _within(seconds: float, happened: Callable[[], bool]) -> bool:
    end = time.monotonic() + seconds
    while not happened():
        if time.monotonic() >= end:
            return False
        time.sleep(_POLL_S)
    return True
