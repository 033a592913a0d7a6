"""The process's own streams, as the world hands them over: closed, on a full disk, or read by nobody any more.

What a command prints goes through `print_result`, so that an output that cannot be written is an error with a cause and never a
trace of the interpreter. What is printed is the commands' business.
"""

from __future__ import annotations

import io
import os
import sys

from robosmi.errors import SourceError
from robosmi.quoting import terminal_lines


def prepare() -> None:
    """Make the standard streams usable, once for a process.

    A number of a stream that is closed is taken by a folder of nothing, or the next file that is opened would get it, and
    be written to by whoever prints. A file name may hold what a terminal cannot show: it is shown as an escape then.
    """
    for number in (0, 1, 2):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDONLY if number == 0 else os.O_WRONLY)  # takes the lowest number that is free
    if sys.stderr is None:
        sys.stderr = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115 - it stays open to the end of the process
    if sys.stdin is None:
        sys.stdin = open(os.devnull, encoding="utf-8")  # noqa: SIM115 - as above
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


class Shown(io.TextIOBase):
    """Standard error for what a query prints: texts of models stay text there, line feeds are meant."""

    def __init__(self) -> None:
        self._stream = sys.stderr

    def write(self, text: str) -> int:
        """Write a text with escapes for what would act on a terminal; a reader that has gone is no error."""
        try:
            self._stream.write(terminal_lines(text))
        except BrokenPipeError:
            let_go(self._stream)
        return len(text)


def print_result(text: str) -> None:
    """Write the result of a command to standard output, all of it, or as much as is read.

    A reader that has closed its pipe, as `head` does, is no error: the rest goes nowhere, and what the command has found out,
    its exit code too, stays as it is.

    Raises:
        SourceError: it cannot be written.
    """
    fix = "redirect it to a writable file, pipe or terminal"
    if sys.stdout is None:
        raise SourceError("the output cannot be written: standard output is closed", fix=fix)
    try:
        print(text)
        sys.stdout.flush()
    except BrokenPipeError:
        let_go(sys.stdout)
    except (OSError, ValueError) as error:
        let_go(sys.stdout)
        cause = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise SourceError(f"the output cannot be written: {cause}", fix=fix) from error


def complain(text: str) -> None:
    """Write a message to standard error; where that cannot be written nobody can read it."""
    try:
        print(text, file=sys.stderr)
        sys.stderr.flush()
    except (OSError, ValueError):
        let_go(sys.stderr)


def let_go(stream: object) -> None:
    """Send what a stream still holds nowhere, or the interpreter would complain of it at its end."""
    try:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, stream.fileno())  # type: ignore[attr-defined]
        os.close(nowhere)
    except (OSError, ValueError, AttributeError):  # it is no stream of the process, or closed
        pass
