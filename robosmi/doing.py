"""What a long command does now: said by whoever does it, heard by whoever listens, such as the command line's progress.

Nobody has to listen, and what is said changes nothing. A listener is heard in its own thread alone.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

Listener = Callable[[str], None]
_listener: ContextVar[Listener | None] = ContextVar("robosmi_doing", default=None)


def doing(what: str) -> None:
    """Say what is being done from now on, in a few words without a full stop; an empty text for nothing worth saying."""
    listener = _listener.get()
    if listener is not None:
        listener(what)


@contextmanager
def heard_by(listener: Listener) -> Iterator[None]:
    """Within this, a listener hears what is said; one that listened before does not."""
    before = _listener.set(listener)
    try:
        yield
    finally:
        _listener.reset(before)
