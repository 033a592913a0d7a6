"""Regular expressions of modules, kept as code from one run of the command to the next: compiling them takes a tenth of a run.

Python makes a pattern in two steps: its library makes code of the text, in Python, and its engine an object of the code, in C.
The first step takes thirty times as long. Its results are kept in the user's cache folder for the patterns that modules compile
while they are imported; all others are compiled as ever. What is kept counts for one build of Python.

Nothing of this is promised by Python. So a code is kept only if what the engine makes of it equals the pattern that Python has
made, and where a name of Python's that is needed here is missing, patterns are compiled as without this.
"""

from __future__ import annotations

import atexit
import marshal
import os
import re
import sys
import zlib
from collections.abc import Callable
from types import FrameType
from typing import TypeAlias

from robosmi.user_cache import keep, read_kept

try:
    import _sre  # type: ignore[import-not-found, unused-ignore]
    from re import _compiler, _parser  # type: ignore[attr-defined, unused-ignore]
except ImportError:  # another Python than CPython, or a later one
    _sre = None

Text: TypeAlias = "str | bytes"
Pattern: TypeAlias = "re.Pattern[str] | re.Pattern[bytes]"
Code: TypeAlias = tuple[int, bytes, int, dict[str, int], tuple[str | None, ...]]
"""What the engine makes a pattern of: all its flags, its code, how many groups it has, their names, and the names by number."""
Codes: TypeAlias = dict[tuple[Text, int], Code]
"""Text of a pattern and the flags beside it -> its code."""

NAME = f"patterns-{sys.implementation.cache_tag}"
"""The file of the cache folder."""
MOST = 5000
"""Patterns that are kept at most; all commands together have a fifth of that."""
_OWN = os.path.dirname(re.__file__)
OF_FUNCTIONS = 1
"""Flag of the code of functions (CO_OPTIMIZED), which modules and the bodies of classes do not have."""


def _build() -> bytes:
    """What a code counts for: the build of Python, and the version of its engine."""
    return f"1 {sys.version} {_sre.MAGIC} {_sre.CODESIZE}\n".replace("\n", " ").encode() + b"\n"


def _read() -> Codes:
    """The codes that were kept for this Python, or none."""
    build, _, rest = (read_kept(NAME) or b"").partition(b"\n")
    if build + b"\n" != _build() or rest[:4] != zlib.crc32(rest[4:]).to_bytes(4, "big"):
        return {}
    found: Codes = marshal.loads(rest[4:])
    return found


def _write(codes: Codes) -> None:
    data = marshal.dumps(codes)
    keep(NAME, _build() + zlib.crc32(data).to_bytes(4, "big") + data)


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


def _of_module(frame: FrameType | None) -> bool:
    """Whether a pattern is compiled by the code of a module that is imported, and not by a function."""
    while frame is not None and os.path.dirname(frame.f_code.co_filename) == _OWN:
        frame = frame.f_back
    return frame is not None and not frame.f_code.co_flags & OF_FUNCTIONS


def keep_patterns() -> None:
    """Let this process take the patterns of modules from the cache folder, and keep new ones when it ends."""
    if _sre is None or memoryview(b"").cast("I").itemsize != _sre.CODESIZE:
        return
    compiled: Callable[[Text, int], Pattern] = _compiler.compile
    known, new = _read(), dict[tuple[Text, int], Pattern]()

    def made(text: Text, flags: int = 0) -> Pattern:
        code = known.get((text, flags)) if isinstance(text, (str, bytes)) else None
        if code is not None:
            return _pattern_of(text, code)
        found = compiled(text, flags)
        if isinstance(text, (str, bytes)) and not flags & re.DEBUG and _of_module(sys._getframe(1)):
            new[text, flags] = found
        return found

    def store() -> None:
        codes = {key: _code_of(*key) for key in new}
        told = {key: code for key, code in codes.items() if _pattern_of(key[0], code) == new[key]}
        if told and len(known) + len(told) <= MOST:
            _write({**_read(), **told})

    _compiler.compile = made
    atexit.register(store)
