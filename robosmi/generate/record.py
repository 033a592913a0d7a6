"""The record of the texts that were made last, which `keep` merges against: a folder with a copy of each."""

from __future__ import annotations

import os
from pathlib import Path

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.model.files import within


class Record:
    """The last texts of one generation.

    Args:
        folder: the output folder.
        place: the record's folder, relative to it; each generation into the folder has one of its own.
    """

    def __init__(self, folder: Path, place: str) -> None:
        if not within(place):
            raise SourceError(
                f"the record '{place}' would lie outside of the output folder",
                location=Location(str(folder)),
                fix="give a path relative to the output folder",
            )
        self.place = place.strip("/")
        self._root = folder / self.place

    def path(self, name: str) -> str:
        """Where the text of a file lies, relative to the output folder."""
        return f"{self.place}/{name}"

    def read(self, name: str) -> bytes | None:
        """The text that was made last, None if there is none."""
        try:
            return inputs.read_bytes(f"{self._root}/{name}", inputs.OUTPUT)
        except (FileNotFoundError, NotADirectoryError):
            return None

    def names(self) -> list[str]:
        """The files that were made, sorted."""
        found: list[str] = []
        for folder, _, files in os.walk(self._root):
            inner = os.path.relpath(folder, self._root)
            found += [name if inner == "." else f"{inner}/{name}".replace(os.sep, "/") for name in files]
        return sorted(found)
