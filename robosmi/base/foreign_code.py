"""Which code outside of RoboSMi raised an exception: the user's rule that fails, or a function with endless recursion.

Our own code, Python's and that of installed packages are distinguished by module names and folders. The caller decides how to
report the exception; plug-ins, which are installed packages, are handled by `plugins`.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from functools import cache
from types import FrameType

from robosmi.diagnostics import Location

END = "let it come to an end for every element, for example by passing over those that it has seen"
"""The advice for a function with endless recursion."""
_OFTEN = 50
"""A function with this many calls on a full stack counts as one with endless recursion."""


def frames_of(error: BaseException) -> Iterator[tuple[FrameType, int]]:
    """The frames that an exception passed through, from the outermost on, each with the line where it was."""
    step = error.__traceback__
    while step is not None:
        yield step.tb_frame, step.tb_lineno
        step = step.tb_next


def innermost(error: BaseException) -> Location | None:
    """The last line of the user's code that an exception passed through; None if there is none."""
    places = [Location(f.f_code.co_filename, line) for f, line in frames_of(error) if _is_foreign(f)]
    return places[-1] if places else None


def endless(error: RecursionError) -> tuple[str, Location] | None:
    """The user's function that recurses without end, with its name and place; None if it is not the user's."""
    codes = Counter(frame.f_code for frame, _ in frames_of(error) if _is_foreign(frame))
    if not codes:
        return None
    code, times = codes.most_common(1)[0]
    return (code.co_name, Location(code.co_filename, code.co_firstlineno)) if times >= _OFTEN else None


def _is_foreign(frame: FrameType) -> bool:
    """Whether a frame runs code of the user's: in a file, and neither ours nor installed."""
    module, file = str(frame.f_globals.get("__name__", "")), frame.f_code.co_filename
    return module.partition(".")[0] != "robosmi" and not file.startswith(("<", *_installed()))


@cache
def _installed() -> tuple[str, ...]:
    import sysconfig  # wanted only after a mistake

    names = ("stdlib", "platstdlib", "purelib", "platlib")
    return tuple({sysconfig.get_path(name) for name in names if sysconfig.get_path(name)})
