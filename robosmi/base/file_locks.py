"""Advisory locks on files and folders by `flock`: the system releases them when the process that holds them ends."""

from __future__ import annotations

import os
from pathlib import Path

try:
    import fcntl
except ImportError:  # not on this system
    fcntl = None  # type: ignore[assignment]

LOCKS = fcntl is not None
"""Whether this system has such locks."""


def lock_now(path: Path, how: int) -> int | None:
    """Open a file or folder and lock it without waiting.

    Args:
        path: the file or folder.
        how: the flags of `os.open`; a file that is created by them is readable by everybody.

    Returns:
        The open handle, for `unlock`; None if another process has the lock, the file cannot be opened, or there are no locks.
    """
    if fcntl is None:
        return None
    try:
        handle = os.open(path, how, 0o644)
    except OSError:
        return None
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(handle)
        return None
    return handle


def unlock(handle: int) -> None:
    """Release a lock that `lock_now` took, and close its handle."""
    fcntl.flock(handle, fcntl.LOCK_UN)
    os.close(handle)
