"""Compiled cores and libraries, kept between runs: made once per board, tool version and content.

An archive's name holds a digest of all that it is made of, so it is never out of date. It is written beside its place and put
there in one step; of two processes that make it at once the first wins, and what is there never changes, so nothing is locked.
Where the cache folder cannot be written, the archive stays in the build folder.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import tempfile
from collections.abc import Iterable
from pathlib import Path

from robosmi import inputs, resources


def digest(files: Iterable[Path], *more: object) -> str:
    """A short digest of files (names and content) and of further values.

    Args:
        files: in a stable order.
        more: anything whose `repr` tells it apart.
    """
    result = hashlib.sha256(repr(more).encode())
    for path in files:
        content = inputs.read_bytes(path, inputs.OUTPUT)
        result.update(f"\0{path}\0{len(content)}\0".encode(errors="surrogateescape"))
        result.update(content)
    return result.hexdigest()[:16]


def files_below(folder: Path) -> list[Path]:
    """All files in a folder at any depth, sorted."""
    return sorted(path for path in folder.rglob("*") if path.is_file())


def cached(name: str) -> Path | None:
    """The archive of that name in the cache, or None."""
    path = resources.cache_dir() / "archives" / name
    return path if path.is_file() else None


def keep(archive: Path, name: str) -> Path:
    """Put an archive into the cache, all of it or nothing; its place there, or where it was if the cache cannot be written.

    An archive that is there already stays as it is: another process may be linking with it, and a linker that optimises opens
    it twice.

    Args:
        archive: the finished archive.
        name: its name in the cache.
    """
    folder = resources.cache_dir() / "archives"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".new-", dir=folder) as temporary:
            copy = Path(shutil.copy(archive, temporary))
            _place(copy, folder / name)
    except OSError:
        return archive
    return folder / name


def _place(copy: Path, target: Path) -> None:
    try:
        os.link(copy, target)
    except FileExistsError:
        pass
    except OSError:  # a file system without hard links
        if not target.exists():
            os.replace(copy, target)
