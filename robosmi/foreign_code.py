"""Which code that is not ours an exception came out of: a person's rule that raises, a function that calls itself without end.

What is ours, Python's own and an installed package's is told by module names and folders. What becomes of the exception is the
caller's business; plug-ins, which are installed packages, are `plugins`' business.
"""

from __future__ import annotations

import sysconfig
import traceback
from collections import Counter
from types import FrameType

from robosmi.diagnostics import Location
from robosmi.typed import kept

END = "let it come to an end for every element, for example by passing over those that it has seen"
"""What to do about a function that calls itself without end."""
_OFTEN = 50
"""Calls of one function on the stack that make it one that calls itself without end, when the stack is full."""


def innermost(error: BaseException) -> Location | None:
    """The last line of a person's code that an exception passed through; None where there was none."""
    places = [Location(f.f_code.co_filename, line) for f, line in traceback.walk_tb(error.__traceback__) if _is_foreign(f)]
    return places[-1] if places else None


def endless(error: RecursionError) -> tuple[str, Location] | None:
    """The function of a person's that calls itself without end, by its name and place; None where it is not theirs."""
    codes = Counter(frame.f_code for frame, _ in traceback.walk_tb(error.__traceback__) if _is_foreign(frame))
    if not codes:
        return None
    code, times = codes.most_common(1)[0]
    return (code.co_name, Location(code.co_filename, code.co_firstlineno)) if times >= _OFTEN else None


def _is_foreign(frame: FrameType) -> bool:
    """Whether a frame runs code of a person's: in a file, and neither ours nor installed."""
    module, file = str(frame.f_globals.get("__name__", "")), frame.f_code.co_filename
    return module.partition(".")[0] != "robosmi" and not file.startswith(("<", *_installed()))


@kept
def _installed() -> tuple[str, ...]:
    names = ("stdlib", "platstdlib", "purelib", "platlib")
    return tuple({sysconfig.get_path(name) for name in names if sysconfig.get_path(name)})
