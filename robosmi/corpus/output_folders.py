"""The folder for a program's results: those of an earlier run stand aside until it is known whether new ones replace them."""

from __future__ import annotations

import os
import shutil
from contextlib import suppress

from robosmi.corpus.jobs import OutsideError


def _aside(output: str) -> str:
    return f"{output}.before"


def begin_with(output: str) -> None:
    """Put the results of an earlier run aside; what a killed run has left is removed.

    Args:
        output: the folder of the program.

    Raises:
        OutsideError: they cannot be moved.
    """
    if not os.path.lexists(output):
        return
    try:
        if os.path.lexists(_aside(output)):
            shutil.rmtree(output)
        else:
            os.rename(output, _aside(output))
    except OSError as error:
        raise OutsideError(f"the results of the earlier run cannot be replaced: {error.strerror}") from error


def end_with(output: str, *, new: bool) -> None:
    """Remove the results of the earlier run, or put them back.

    Args:
        output: the folder of the program.
        new: whether the new results are those that are stored.
    """
    if not os.path.lexists(_aside(output)):
        return
    shutil.rmtree(_aside(output) if new else output, ignore_errors=True)
    if not new:
        with suppress(OSError):
            os.rename(_aside(output), output)
