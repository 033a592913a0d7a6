"""Restricts paths named by untrusted callers to one folder: resolved, without links, relative to it.

The target of a path may change after the check; whoever runs a command with it confines the process, too (`confined`).
"""

from __future__ import annotations

import os
import stat
from pathlib import Path

from robosmi.diagnostics import Location
from robosmi.errors import SourceError, UsageError

LONGEST = 4096
"""Characters that a path may have."""


class RootFolder:
    """The folder outside of which nothing is read or written.

    Args:
        path: the folder; it may be named by a link, what is in it may not.

    Raises:
        SourceError: it is not there, or no folder.
    """

    def __init__(self, path: Path) -> None:
        try:
            self.path = path.resolve(strict=True)
        except (OSError, RuntimeError) as error:
            raise SourceError(
                f"the folder does not exist: {error}", location=Location(str(path)), fix="create it first"
            ) from error
        if not self.path.is_dir():
            raise SourceError("this is not a folder", location=Location(str(path)), fix="give a folder")

    def relative(self, text: str) -> str:
        """A path below the folder, relative to it, as a word of a command line that is no option.

        Args:
            text: as it was named, relative to the folder or absolute; it need not be there.

        Raises:
            UsageError: it leads out of the folder, passes a link, or is no path.
        """
        if len(text) > LONGEST:
            raise UsageError(
                f"'{text[:60]}...' is not a path: it has {len(text)} characters", fix="give a file below the root folder"
            )
        if not text.strip() or not is_text(text):
            raise UsageError("a path is empty or invalid", fix="give a file below the root folder")
        whole = Path(os.path.normpath(self.path / text))
        if not whole.is_relative_to(self.path):
            raise UsageError(f"'{text}' is outside the root folder", fix="give a file below it")
        below = whole.relative_to(self.path)
        place = self.path
        for part in below.parts:
            place = place / part
            try:
                mode = os.lstat(place).st_mode
            except FileNotFoundError:
                break
            except OSError as error:
                raise UsageError(f"'{text}' cannot be reached: {error.strerror}", fix="give a readable file") from error
            if stat.S_ISLNK(mode):
                raise UsageError(f"'{text}' goes through a link, '{place.name}'", fix="give the path without links")
        shown = below.as_posix()
        return f"./{shown}" if shown.startswith("-") else shown


def is_text(word: str) -> bool:
    """Whether a word can be passed to a program: it has no NUL and no lone surrogate."""
    return "\0" not in word and not any("\ud800" <= character <= "\udfff" for character in word)
