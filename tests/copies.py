"""Folders that many tests begin with, filled once for all tests of a process: each test gets them as they were filled.

A copy elsewhere (`into`) serves tests of what is in the folder, which must not depend on where it lies; the output of a migration
does not. What a run stores of its user (the way back, the sources of an output folder) names places: it is there in `restored`.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path


class Copies:
    """The filled folders of this process.

    Args:
        place: an empty folder for them.
    """

    def __init__(self, place: Path) -> None:
        self._place = place

    def into(self, folder: Path, name: str, fill: Callable[[Path], None]) -> Path:
        """Put a copy of what `fill` puts into an empty folder into a folder, which is returned.

        Args:
            folder: the folder; it may be there.
            name: of what is filled in; `fill` runs once for each name.
            fill: fills the folder that it gets.
        """
        original = self._place / name
        if not original.exists():
            begun = self._place / f"{name}.begun"
            begun.mkdir()
            fill(begun)
            begun.rename(original)
        shutil.copytree(original, folder, dirs_exist_ok=True, symlinks=True)
        return folder

    def place_of(self, name: str) -> Path:
        """Where `restored` puts a folder."""
        return self._place / f"{name}.used"

    def restored(self, name: str, fill: Callable[[Path], None]) -> Path:
        """The folder that `fill` has filled, as it was then and at the same place; the test before has ended with it.

        Args:
            name: as for `into`.
            fill: fills the folder that it gets.
        """
        folder = self.place_of(name)
        if folder.exists():
            shutil.rmtree(folder)
        original = self._place / name
        if original.exists():
            shutil.copytree(original, folder, symlinks=True)
        else:
            folder.mkdir()
            fill(folder)
            shutil.copytree(folder, original, symlinks=True)
        return folder
