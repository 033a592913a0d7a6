"""What a long command is doing now, and what it knows before its result: told by the working code, received by a listener.

An announcement holds until the next one, as on the progress line; a remark stays. Without a listener neither has an effect. A
listener receives those of its own thread only.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

Listener = Callable[[str], None]
_listener: ContextVar[Listener | None] = ContextVar("robosmi_doing", default=None)
_reader: ContextVar[Listener | None] = ContextVar("robosmi_remarks", default=None)


def announce(what: str) -> None:
    """Announce what is being done from now on, in a few words without a full stop; an empty text announces nothing."""
    listener = _listener.get()
    if listener is not None:
        listener(what)


def remark(what: str) -> None:
    """Tell at once, in a line that stays, what the user need not wait for the result to know."""
    reader = _reader.get()
    if reader is not None:
        reader(what)


@contextmanager
def heard_by(listener: Listener, reader: Listener | None = None) -> Iterator[None]:
    """Context manager: the listener receives the announcements and the reader the remarks, instead of earlier ones."""
    before, before_reader = _listener.set(listener), _reader.set(reader)
    try:
        yield
    finally:
        _reader.reset(before_reader)
        _listener.reset(before)
