"""Regular expressions of modules, kept as code from one run of the command to the next: compiling them takes a tenth of a run.

Python makes a pattern in two steps: its library makes code of the text, in Python, and its engine an object of the code, in C.
The first step takes thirty times as long. Its results are kept in the user's cache folder for the patterns that are compiled
while modules are imported; all others are compiled as ever. What is kept counts for one build of Python.

Nothing of this is promised by Python. So a code is kept only if what the engine makes of it equals the pattern that Python has
made, and where a name of Python's that is needed here is missing, patterns are compiled as without this.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from types import FrameType
from typing import TypeAlias

from robosmi.user_cache import KeptResults

try:
    import _sre  # type: ignore[import-not-found, unused-ignore]
    from re import _compiler, _parser  # type: ignore[attr-defined, unused-ignore]
except ImportError:  # another Python than CPython, or a later one
    _sre = None

Text: TypeAlias = "str | bytes"
Pattern: TypeAlias = "re.Pattern[str] | re.Pattern[bytes]"
Code: TypeAlias = tuple[int, bytes, int, dict[str, int], tuple[str | None, ...]]
"""What the engine makes a pattern of: all its flags, its code, how many groups it has, their names, and the names by number."""

NAME = "patterns"
"""The file of the cache folder."""
MOST = 5000
"""Patterns that are kept at most; all commands together have a fifth of that."""
_IMPORTER = "<frozen importlib._bootstrap>"
"""File name of the code that imports modules."""


def _code_of(text: Text, flags: int) -> Code:
    """The code of a pattern, as Python makes it."""
    parsed = _parser.parse(text, flags)
    names: dict[str, int] = parsed.state.groupdict
    by_number: list[str | None] = [None] * parsed.state.groups
    for name, number in names.items():
        by_number[number] = name
    words = b"".join(word.to_bytes(_sre.CODESIZE, sys.byteorder) for word in _compiler._code(parsed, flags))
    return flags | parsed.state.flags, words, parsed.state.groups - 1, names, tuple(by_number)


def _pattern_of(text: Text, code: Code) -> Pattern:
    """The pattern that the engine makes of a code."""
    flags, words, groups, names, by_number = code
    made: Pattern = _sre.compile(text, flags, memoryview(words).cast("I").tolist(), groups, names, by_number)
    return made


def _while_importing(frame: FrameType | None) -> bool:
    """Whether a pattern is compiled while a module is imported, also by a function or an extension module, and not later."""
    while frame is not None and frame.f_code.co_filename != _IMPORTER:
        frame = frame.f_back
    return frame is not None


def keep_patterns() -> None:
    """Let this process take the patterns of modules from the cache folder, and keep new ones when it ends."""
    if _sre is None or memoryview(b"").cast("I").itemsize != _sre.CODESIZE:
        return
    compiled: Callable[[Text, int], Pattern] = _compiler.compile
    kept: KeptResults[tuple[Text, int], Code] = KeptResults(NAME, f"1 {_sre.MAGIC} {_sre.CODESIZE}", MOST)

    def made(text: Text, flags: int = 0) -> Pattern:
        if not isinstance(text, (str, bytes)) or flags & re.DEBUG:
            return compiled(text, flags)
        if (code := kept.get((text, flags))) is not None:
            return _pattern_of(text, code)
        found = compiled(text, flags)
        if _while_importing(sys._getframe(1)):
            fresh = _code_of(text, flags)
            if _pattern_of(text, fresh) == found:
                kept.put((text, flags), fresh)
        return found

    _compiler.compile = made
