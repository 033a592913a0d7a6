"""Turns system failures that end a command into errors with a cause and advice.

Examples are a full disk, no memory, too deeply nested text, an incomplete installation, and a removed folder. Any other
unexpected exception is a bug of ours.
"""

from __future__ import annotations

import os

from robosmi import foreign_code, plugins
from robosmi.diagnostics import Location
from robosmi.errors import InternalError, RobosmiError, RuleError, SourceError
from robosmi.foreign_code import END
from robosmi.inputs import fix_of


def as_error(error: BaseException) -> RobosmiError:
    """The error to report for whatever a command ended with.

    Args:
        error: what was raised.
    """
    if isinstance(error, RobosmiError):
        return error
    if isinstance(error, OSError):
        return _of_system(error)
    if isinstance(error, MemoryError):
        return SourceError("there is not enough memory for this input", fix="give a smaller input, or more memory")
    if isinstance(error, RecursionError):
        if (found := foreign_code.endless(error)) is not None:
            return RuleError(f"the function '{found[0]}' calls itself without end", location=found[1], fix=END)
        return SourceError("the input is nested too deeply to be read", fix="look for brackets or elements within each other")
    if (missing := plugins.unloadable(error)) is not None:
        return missing
    if isinstance(error, UnicodeEncodeError):
        return _unwritable_text(error)
    if (raised := plugins.raised_by(error)) is not None:
        return raised
    if not isinstance(error, (Exception, SystemExit)) and (place := foreign_code.innermost(error)) is not None:
        return RuleError(f"{type(error).__name__}: {error}", location=place, fix="let this code raise an Exception, or nothing")
    return InternalError(
        f"{type(error).__name__}: {error}",
        fix="this is a bug of robosmi: please report it; ROBOSMI_DEBUG=1 shows where it happened",
    )


def _of_system(error: OSError) -> SourceError:
    if not _current_folder_is_there():
        return SourceError("the current folder is no longer there", fix="change to a folder that is, and run the command again")
    place = Location(os.fsdecode(error.filename)) if isinstance(error.filename, (str, bytes, os.PathLike)) else None
    fix = fix_of(error, "check the path, the permissions and the space on the disk")
    return SourceError(f"the system refuses: {error.strerror or error}", location=place, fix=fix)


def _current_folder_is_there() -> bool:
    try:
        os.getcwd()
    except OSError:
        return False
    return True


def _unwritable_text(error: UnicodeEncodeError) -> SourceError:
    """A text that cannot be stored: half of a pair of UTF-16, which is how Python holds a byte of a name that is no UTF-8."""
    shown = str(error.object)[max(0, error.start - 40) : error.end + 40].encode("ascii", "backslashreplace").decode()
    return SourceError(
        f"a name or text cannot be stored as {error.encoding.upper()}: '{shown}'",
        fix="rename the file or correct the text, so that it is UTF-8",
    )
