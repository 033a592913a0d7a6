"""Further files that belong to a drawing (sheets, libraries, caches): read from the drawing's folder, and recorded.

A drawing refers to them by paths relative to its own file. Such a path is followed only below that folder: a path or a link
that leads out, and an absolute one, are not read, so that a drawing from elsewhere can open nothing else on the machine. The
files that were read are recorded in the model (`Circuit.companions`), and a migration copies them to `models/source`. Their
contents are interpreted by each reader.
"""

from __future__ import annotations

import os
from pathlib import Path, PurePosixPath, PureWindowsPath

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, TooLargeError
from robosmi.files.files import within

MOST_FILES = 1_000
"""Companions of one drawing; the largest public one has under a hundred sheets."""


class DrawingFolder:
    """The folder of a drawing, as its reader may see it.

    Args:
        path: the drawing, as the user gave it.

    Attributes:
        companions: the files that were read, in the order of their first reading, relative to the folder with forward slashes.
    """

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        self.companions: list[str] = []
        self._room = inputs.DRAWING.most
        self._read: dict[str, bytes] = {}

    def name(self, named: str, beside: str = "") -> str | None:
        """A path of the drawing, normalised relative to the folder with forward slashes; None if it leads out of the folder.

        Args:
            named: the path as it is written, with slashes of either kind.
            beside: the companion that names it; paths are relative to the file that they are written in.
        """
        text = named.replace("\\", "/")
        if not text or text.startswith("/") or PureWindowsPath(text).drive:
            return None
        joined = os.path.normpath((PurePosixPath(beside).parent / text).as_posix())
        return joined if within(joined) else None

    def read(self, named: str, beside: str = "") -> bytes | None:
        """The bytes of a companion; None where there is no such file below the folder.

        Args:
            named: the path as it is written.
            beside: the companion that names it, empty for the drawing itself.

        Raises:
            SourceError: there is such a file, but it is no ordinary one or too large, or the companions together are too many.
        """
        name = self.name(named, beside)
        if name is None:
            return None
        if name in self._read:
            return self._read[name]
        file = self.path.parent / name
        folder, real = os.path.realpath(self.path.parent), os.path.realpath(file)
        if os.path.commonpath([folder, real]) != folder or not os.path.lexists(file):
            return None
        place = Location(str(file))
        try:
            data = inputs.read_bytes(file, inputs.DRAWING)
        except IsADirectoryError:
            return None
        except OSError as error:
            cause = f"a file that the drawing names cannot be read: {error.strerror or error}"
            fix = inputs.fix_of(error, "check the permissions of the file")
            raise SourceError(cause, location=place, fix=fix) from error
        self._room -= len(data)
        if self._room < 0 or len(self.companions) >= MOST_FILES:
            most = f"{MOST_FILES:,} files and {inputs.DRAWING.limit}"
            raise TooLargeError(f"the drawing has more than {most}", location=place, fix="split the drawing")
        self._read[name] = data
        self.companions.append(name)
        return data
