"""Digests of what the results of a program depend on: its files, the settings, the version of the tool."""

from __future__ import annotations

import hashlib
import os
import stat
from collections.abc import Iterator, Mapping
from contextlib import suppress
from pathlib import Path

import robosmi
from robosmi import inputs
from robosmi.base.user_folders import named
from robosmi.plugins import registry

ABSENT = ""
"""The digest of a path at which there is no file."""
_PART = 1 << 20
_LARGEST = 64 << 20
"""Bytes of a file that count; of a larger one also its size and the time of its last change."""


def digest_of(path: str) -> str:
    """The digest of a file's content, of all files below a folder, or `ABSENT`.

    Args:
        path: the file or folder.
    """
    try:
        found = os.stat(path)
    except (OSError, ValueError):
        return ABSENT
    if stat.S_ISDIR(found.st_mode):
        return _of_parts(f"{name}\0{digest_of(place)}" for name, place in _below(path))
    made = hashlib.sha256()
    try:
        with inputs.open_file(path) as stream:
            left = _LARGEST
            while left > 0 and (data := stream.read(_PART)):
                made.update(data)
                left -= len(data)
    except OSError as error:
        return f"unreadable: {error.errno}"
    if found.st_size > _LARGEST:
        made.update(f"{found.st_size} {found.st_mtime_ns}".encode())
    return made.hexdigest()


def _below(folder: str) -> Iterator[tuple[str, str]]:
    """Name and path of each file below a folder, sorted; links to folders are not followed."""
    for root, folders, files in os.walk(folder):
        folders.sort()
        for name in sorted(files):
            place = os.path.join(root, name)
            yield os.path.relpath(place, folder), place


def _of_parts(parts: Iterator[str]) -> str:
    made = hashlib.sha256()
    for part in parts:
        made.update(part.encode(errors="surrogateescape") + b"\n")
    return made.hexdigest()


class Digests:
    """Digests of files, each read once: many programs share their headers. The object lives as long as one look at them."""

    def __init__(self) -> None:
        self._known: dict[str, str] = {}

    def of(self, path: str) -> str:
        """See `digest_of`."""
        if (known := self._known.get(path)) is None:
            known = self._known[path] = digest_of(path)
        return known


def digest_of_files(files: Mapping[str, str]) -> str:
    """The digest of a program: of the paths and digests of its files."""
    return _of_parts(f"{path}\0{files[path]}" for path in sorted(files))


def digest_of_text(text: str) -> str:
    """The digest of a text."""
    return hashlib.sha256(text.encode(errors="surrogateescape")).hexdigest()


def tool_version() -> str:
    """A text that changes with the tool: its version and its plug-ins', and the data of the user's own that it reads."""
    plugins = sorted(registry().plugins)
    own = [digest for folder in named() if (digest := _own_data(Path(folder))) != ABSENT]
    return " ".join([robosmi.__version__, *(f"+{each}" for each in plugins), *(f"~{digest[:12]}" for digest in own)])


def _own_data(folder: Path) -> str:
    """The digest of the data in a folder of the user's; what runs keep there, such as the history, does not count."""
    parts = []
    for kind in ("platform_repo", "templates", "metamodels", "adapters"):
        with suppress(OSError):
            if (folder / kind).is_dir():
                parts.append(f"{kind}\0{digest_of(str(folder / kind))}")
    return _of_parts(iter(parts)) if parts else ABSENT
