"""Files outside of an output folder that a run writes in the same commit, such as the project file beside a program.

Their new contents wait beside them under a hidden name. The list of destinations is kept in the user's data and not in the
output folder, since a folder that comes from elsewhere must not be able to name files outside of it. `commit` writes the
waiting files; `recovery` moves them to their destinations together with the folder's files, or removes them. A file that
somebody changed meanwhile is left alone.
"""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from robosmi.base.data_text import Json, as_list, as_table, as_text, json_of, json_written
from robosmi.files.directory_fd import DirectoryFd
from robosmi.files.files import digest
from robosmi.files.run_lock import ELSEWHERE, discard, store, stored
from robosmi.inputs import OUTPUT

ExternalFiles = Mapping[Path, tuple[bytes | None, bytes | None]]
"""Files outside of an output folder that belong to its commit: the old and the new content of each; None for no file."""


class _Waiting(NamedTuple):
    """A file, the hidden name of its new content beside it, and the digests of its old and new content."""

    path: str
    beside: str
    old: str | None
    new: str | None


def changes(files: ExternalFiles) -> ExternalFiles:
    """The files whose content changes, by absolute path."""
    return {Path(os.path.abspath(path)): pair for path, pair in files.items() if pair[0] != pair[1]}


def wait(folder: Path, run: str, files: ExternalFiles) -> None:
    """Write new contents beside their destinations.

    Args:
        folder: the output folder, in which the place for waiting files is there already.
        run: the name of the run, which its journal has, too.
        files: what changes, by absolute paths.

    Raises:
        SourceError: something else than a file is in a place, or there is no place for the record.
        OSError: a folder cannot be written.
    """
    waiting = [
        _Waiting(str(path), f".{path.name}.robosmi-{run}", _digest(old), _digest(new)) for path, (old, new) in files.items()
    ]
    store(folder, ELSEWHERE, json_written({"run": run, "files": waiting}))
    for one, (_, new) in zip(waiting, files.values(), strict=True):
        path = Path(one.path)
        try:
            with DirectoryFd(path.parent) as around:
                around.free_for_file(path.name)
                there = around.look(path.name)
                around.write(one.beside, new or b"", stat.S_IMODE(there.st_mode) if there is not None else None)
        except OSError as error:
            error.filename = one.path  # the user knows the file, not the one beside it
            raise


def take_places(folder: Path, run: object) -> None:
    """Move what waits for a run to its places.

    Args:
        folder: the output folder.
        run: the name of the run that is carried out there.

    Raises:
        OSError: a folder cannot be written.
    """
    for one in _recorded(folder, run):
        path = Path(one.path)
        with suppress(FileNotFoundError, NotADirectoryError), DirectoryFd(path.parent) as around:
            if _found(around, path.name) == one.old:
                if one.new is None:
                    around.remove(path.name)
                else:
                    around.move(one.beside, path.name)
            around.remove(one.beside)


def drop(folder: Path) -> None:
    """Discard what waits elsewhere for a commit into an output folder, and the record of it."""
    for one in _recorded(folder):
        path = Path(one.path)
        with suppress(OSError), DirectoryFd(path.parent) as around:
            around.remove(one.beside)
    discard(folder, ELSEWHERE)


def _recorded(folder: Path, run: object = None) -> Iterator[_Waiting]:
    """The record of an output folder; if a run is named, only if the record is of that run."""
    try:
        known = as_table(json_of(stored(folder, ELSEWHERE)))
        if run is None or known["run"] == run:
            yield from [_waiting(as_list(one)) for one in as_list(known["files"])]
    except (OSError, ValueError, KeyError, TypeError):  # there is none
        return


def _waiting(entry: list[Json]) -> _Waiting:
    path, beside, old, new = (None if each is None else as_text(each) for each in entry)
    if path is None or beside is None:
        raise ValueError("a file that waits has no name")
    return _Waiting(path, beside, old, new)


def _found(around: DirectoryFd, name: str) -> str | None:
    """The digest of a file, None if there is none; empty if it cannot be determined, so that the file is left alone."""
    try:
        return digest(around.read(name, OUTPUT))
    except FileNotFoundError:
        return None
    except OSError:
        return ""


def _digest(data: bytes | None) -> str | None:
    return digest(data) if data is not None else None
