"""The cache of compiled cores and libraries: each is compiled once for a board, tool version and content.

An archive's name contains a digest of everything it is made from, so it is never out of date. It is written to a temporary file
and moved into place; if two processes make it at once, the first wins, and existing archives never change, so no lock is
needed. If the cache folder cannot be written, or has another user's file in its place, the archive stays in the build folder.

What is cached is code that goes onto a board or runs here. It is cached since compiling a core takes ten seconds for each build.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import tempfile
from collections.abc import Iterable
from pathlib import Path

from robosmi import inputs, resources
from robosmi.base.user_cache import is_own


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
    """The archive of that name in the cache, or None; one that another user can have written is none."""
    path = resources.cache_dir() / "archives" / name
    return path if is_own(path) else None


def store(archive: Path, name: str) -> Path:
    """Move an archive into the cache atomically; returns its path there, or its old path if the cache cannot be written.

    An existing archive is not replaced: another process may be linking with it, and an optimising linker opens it twice.

    Args:
        archive: the finished archive.
        name: its name in the cache.
    """
    folder = resources.cache_dir() / "archives"
    try:
        folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        with tempfile.TemporaryDirectory(prefix=".new-", dir=folder) as temporary:
            copy = Path(shutil.copy(archive, temporary))
            copy.chmod(copy.stat().st_mode & ~0o022)
            _place(copy, folder / name)
    except OSError:
        return archive
    return cached(name) or archive


def _place(copy: Path, target: Path) -> None:
    try:
        os.link(copy, target)
    except FileExistsError:
        pass
    except OSError:  # a file system without hard links
        if not target.exists():
            os.replace(copy, target)
