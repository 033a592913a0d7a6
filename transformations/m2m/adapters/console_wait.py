"""Sets how long a program waits for its console, where the console is USB and a computer has to open it first.

The wait is a statement of the adapter that has the console (`setup`); a robot without a computer must start all the same.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from robosmi.metamodels import platform

_WAIT = re.compile(r"(while \(!Serial && millis\(\) < )\d+(\) \{\})")
"""The statement, with its milliseconds after the start."""


def set_console_wait(pieces: Iterable[platform.Adapter], milliseconds: int) -> None:
    """Give the statements that wait for a console another time.

    Args:
        pieces: of the adapters of a plan.
        milliseconds: the time; 0 for no wait.
    """
    for piece in pieces:
        waits = [_WAIT.sub(rf"\g<1>{milliseconds}\2", str(statement)) for statement in piece.setup]
        statements = [statement for statement in waits if milliseconds or not _WAIT.fullmatch(statement)]
        if statements != list(piece.setup):
            piece.setup.clear()
            piece.setup.extend(statements)
