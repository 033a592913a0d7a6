"""Progress on standard error: on a terminal what is being done, once a command takes longer than a moment.

That is the step of a chain, or what is said within it (`robosmi.base.progress_events`), as which scenario is run. In a log it is
one line, once a command takes long. Remarks stay in both.
"""

from __future__ import annotations

import shutil
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from time import monotonic
from typing import TYPE_CHECKING

from robosmi.base.progress_events import heard_by
from robosmi.quoting import terminal

if TYPE_CHECKING:  # a command that uses no chain does not wait for chains
    from robosmi.chain.run import Progress
    from robosmi.chain.steps import Step, StepResult

QUIET = 1.0
"""Seconds in which nothing is said."""
LONG = 10.0
"""Seconds after which a log gets its line."""


@contextmanager
def progress() -> Iterator[Progress | None]:
    """Where a chain reports its progress, None where standard error is no terminal; the line is wiped at the end.

    What is said in between is shown, too (see `robosmi.base.progress_events`). Within another one, this one is heard.
    """
    if not sys.stderr.isatty():
        log = _Log()
        with heard_by(log.said, log.noted):
            yield None
        return
    shown = _Line()
    timer = threading.Timer(QUIET, shown.begin)
    timer.daemon = True
    timer.start()
    try:
        with heard_by(shown.said, shown.noted):
            yield shown.told
    finally:
        timer.cancel()
        shown.end()


class _Log:
    """The lines in a log or pipe."""

    def __init__(self) -> None:
        self.begun = monotonic()
        self.told = False

    def said(self, what: str) -> None:
        """Something is being done now: the first that takes the command beyond `LONG` is written."""
        if what and not self.told and monotonic() - self.begun >= LONG:
            self.told = True
            self.noted(f"{what} ...")

    def noted(self, what: str) -> None:
        """Write a line."""
        sys.stderr.write(f"{terminal(what)}\n")
        sys.stderr.flush()


class _Line:
    """The one line of a terminal that says what is being done."""

    def __init__(self) -> None:
        self.lock = threading.Lock()
        self.step = ""
        self.written = ""
        self.visible = False
        self.over = False

    def begin(self) -> None:
        """The moment is over: show the step that is being done."""
        with self.lock:
            self.visible = not self.over
            self.show()

    def told(self, step: Step, result: StepResult | None) -> None:
        """A step begins (without a result) or has ended."""
        with self.lock:
            self.step = step.name if result is None else ""
            self.show()

    def said(self, what: str) -> None:
        """Something is being done now, within a step or without one."""
        with self.lock:
            self.step = what
            self.show()

    def noted(self, what: str) -> None:
        """Write a line that stays, above the one that is being written over."""
        with self.lock:
            sys.stderr.write(f"\r\x1b[K{terminal(what)}\n" if self.written else f"{terminal(what)}\n")
            sys.stderr.flush()
            self.written = ""
            self.show()

    def show(self) -> None:
        """Write the step over what the line had."""
        width = max(20, shutil.get_terminal_size().columns) - 5  # a line that is broken in two cannot be wiped
        text = f"{terminal(self.step)[:width]} ..." if self.step else ""
        if self.visible and text != self.written:
            sys.stderr.write(f"\r\x1b[K{text}")
            sys.stderr.flush()
            self.written = text

    def end(self) -> None:
        """Wipe the line."""
        with self.lock:
            self.step, self.over = "", True
            self.show()
            self.visible = False
