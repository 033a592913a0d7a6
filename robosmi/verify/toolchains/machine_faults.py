"""Tells a compiler that the machine let down, by a full disk or a limit, from one that does not take the program.

The former says nothing about the program. Compilers print the system's own words for such an error (`strerror`, `strsignal`).
"""

from __future__ import annotations

import errno
import os
import re
import shutil
import signal
import subprocess
import tempfile
from pathlib import Path

from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.verify.toolchains.temporary import MAKE_SPACE

_WRITABLE = "make that folder writable, or set TMPDIR to another one"
_MEMORY = "free memory, or raise its limit (ulimit -v), then run again"
_FILES = "raise the limit of open files (ulimit -n), then run again"
_LENGTH = "raise the file size limit (ulimit -f), then run again"
_ENDED = "find out what ends processes here (too little memory, or limits), then run again"

_ERRORS = {
    "ENOSPC": MAKE_SPACE, "EDQUOT": MAKE_SPACE, "EROFS": _WRITABLE, "EIO": MAKE_SPACE, "EFBIG": _LENGTH, "ENOMEM": _MEMORY,
    "EMFILE": _FILES, "ENFILE": _FILES,
}  # fmt: skip
"""Name of an error of the system -> what to do. A file that may not be read is none: the program may include one."""
_SIGNALS = {"SIGKILL": _ENDED, "SIGTERM": _ENDED, "SIGHUP": _ENDED, "SIGXCPU": _ENDED, "SIGXFSZ": _LENGTH}
"""Name of a signal that comes from outside -> what to do. A compiler that crashes by itself may do so for the program."""

_ADVICE = {os.strerror(number): _ERRORS[name] for number, name in errno.errorcode.items() if name in _ERRORS}
_SIGNAL_WORDS = {each: signal.strsignal(each) or each.name for each in signal.Signals if each.name in _SIGNALS}
_ENDINGS = {words: _SIGNALS[each.name] for each, words in _SIGNAL_WORDS.items()}


def _one_of(words: dict[str, str]) -> str:
    return "|".join(re.escape(each) for each in sorted(words))


_ABOUT_THE_PROGRAM = r"(?!\d+ \||.*:\d+(?::\d+)?: (?i:error|warning|note): )(?=\S)"
"""Not a line that quotes the program, nor a message about a line of it (`#error` may use any words)."""
_SAID = re.compile(rf"^{_ABOUT_THE_PROGRAM}.*: ['\"]?({_one_of(_ADVICE)})['\"]?\.?$", re.MULTILINE)
_KILLED = re.compile(
    r"^\S+: (?:fatal error|internal compiler error): "
    rf"({_one_of(_ENDINGS)})(?:: \d+)? (?:signal terminated program |\(program )",
    re.MULTILINE,
)
"""A compiler's driver tells of a part of it that was ended; in other words before version 9 of GCC."""


_UNTOLD = re.compile(r"^lto-wrapper: fatal error: .* returned \d+ exit status$", re.MULTILINE)
"""The optimiser of whole programs keeps to itself what the compilers said that it started."""
_LITTLE_SPACE = 2**20
"""Bytes that do not do for the temporary files of a link."""


def check_machine(tool: str, done: subprocess.CompletedProcess[str]) -> subprocess.CompletedProcess[str]:
    """What a tool did, unless the machine let it down.

    Args:
        tool: the tool, or its path.
        done: a run of it, which has ended.

    Raises:
        SourceError: it failed as it could not write its files, had no memory, or was ended from outside.
    """
    if done.returncode == 0:
        return done
    name, folder = Path(tool).name, Location(tempfile.gettempdir())
    for words in _SAID.findall(done.stderr):
        raise SourceError(f"'{name}' cannot work in this folder: {words}", location=folder, fix=_ADVICE[words])
    if _UNTOLD.search(done.stderr) and shutil.disk_usage(folder.path).free < _LITTLE_SPACE:
        words = os.strerror(errno.ENOSPC)
        raise SourceError(f"'{name}' failed without a message; probable cause: {words}", location=folder, fix=_ADVICE[words])
    from_outside = next((words for number, words in _SIGNAL_WORDS.items() if done.returncode == -number), "")
    for ended in [from_outside] if from_outside else _KILLED.findall(done.stderr):
        raise SourceError(f"'{name}': the system ended it: {ended}", location=folder, fix=_ENDINGS[ended])
    return done
