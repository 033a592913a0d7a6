"""What a long command is doing now: announced by the working code, and received by a listener such as the progress line.

Without a listener an announcement has no effect. A listener receives those of its own thread only.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

Listener = Callable[[str], None]
_listener: ContextVar[Listener | None] = ContextVar("robosmi_doing", default=None)


def announce(what: str) -> None:
    """Announce what is being done from now on, in a few words without a full stop; an empty text announces nothing."""
    listener = _listener.get()
    if listener is not None:
        listener(what)


@contextmanager
def heard_by(listener: Listener) -> Iterator[None]:
    """Context manager: the listener receives the announcements, instead of an earlier one."""
    before = _listener.set(listener)
    try:
        yield
    finally:
        _listener.reset(before)
