"""The signals that ask a process to end."""

from __future__ import annotations

import signal

from robosmi.typed import attribute_of

_NAMES = ("SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT")


def ending_signals() -> list[signal.Signals]:
    """Those that this system has, Ctrl-C first; Windows lacks some."""
    return [number for name in _NAMES if (number := attribute_of(signal, name, signal.Signals)) is not None]
