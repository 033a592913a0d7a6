"""The signals that ask a process to end."""

from __future__ import annotations

import signal

_NAMES = ("SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT")


def ending_signals() -> list[signal.Signals]:
    """Those that this system has, Ctrl-C first; Windows lacks some."""
    return [signal.Signals[name] for name in _NAMES if name in signal.Signals.__members__]
