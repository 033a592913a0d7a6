"""Folders that many tests begin with, filled once for all tests of a process: each test gets a copy that it may change.

What is in the folder must not depend on where it lies; the output of a migration does not.
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
