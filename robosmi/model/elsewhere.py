"""Files outside of an output folder that a run writes in the same commit: the project file beside a program, the way back.

Their new contents wait beside them under a hidden name. What is to go where is kept in the user's data and not in the output
folder, since nothing that comes with a folder may name a file elsewhere. `commit` lets them wait; `recovery` lets them take their
places with the files of the folder, or go. A file that somebody has changed in between stays as it is.
"""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from robosmi.data_text import Json, as_list, as_table, as_text, json_of, json_written
from robosmi.inputs import OUTPUT
from robosmi.model.files import digest
from robosmi.model.open_folder import OpenFolder
from robosmi.model.runs import ELSEWHERE, keep, kept, unkeep
from robosmi.typed import paired

Elsewhere = Mapping[Path, tuple[bytes | None, bytes | None]]
"""Files outside of an output folder that belong to its commit: what each holds, and what it is to hold; None for no file."""


class _Waiting(NamedTuple):
    """A file, the name that its new content waits under beside it, and the digests of what it holds and is to hold."""

    path: str
    beside: str
    old: str | None
    new: str | None


def changes(files: Elsewhere) -> Elsewhere:
    """Those of the files that are to hold something else than they do, by absolute paths."""
    return {Path(os.path.abspath(path)): pair for path, pair in files.items() if pair[0] != pair[1]}


def wait(folder: Path, run: str, files: Elsewhere) -> None:
    """Put new contents beside their places.

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
    keep(folder, ELSEWHERE, json_written({"run": run, "files": waiting}))
    for one, (_, new) in paired(waiting, files.values()):
        path = Path(one.path)
        try:
            with OpenFolder(path.parent) as around:
                around.free_for_file(path.name)
                there = around.look(path.name)
                around.write(one.beside, new or b"", stat.S_IMODE(there.st_mode) if there is not None else None)
        except OSError as error:
            error.filename = one.path  # a person knows the file, not the one beside it
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
        with suppress(FileNotFoundError, NotADirectoryError), OpenFolder(path.parent) as around:
            if _found(around, path.name) == one.old:
                if one.new is None:
                    around.remove(path.name)
                else:
                    around.move(one.beside, path.name)
            around.remove(one.beside)


def drop(folder: Path) -> None:
    """Throw away what waits elsewhere for a run into an output folder, and what is known of it."""
    for one in _recorded(folder):
        path = Path(one.path)
        with suppress(OSError), OpenFolder(path.parent) as around:
            around.remove(one.beside)
    unkeep(folder, ELSEWHERE)


def _recorded(folder: Path, run: object = None) -> Iterator[_Waiting]:
    """What the record of an output folder says; where a run is named, only if it is of that run."""
    try:
        known = as_table(json_of(kept(folder, ELSEWHERE)))
        if run is None or known["run"] == run:
            yield from [_waiting(as_list(one)) for one in as_list(known["files"])]
    except (OSError, ValueError, KeyError, TypeError):  # there is none
        return


def _waiting(entry: list[Json]) -> _Waiting:
    path, beside, old, new = (None if each is None else as_text(each) for each in entry)
    if path is None or beside is None:
        raise ValueError("a file that waits has no name")
    return _Waiting(path, beside, old, new)


def _found(around: OpenFolder, name: str) -> str | None:
    """The digest of a file, None where there is none; empty where it cannot be told, so that the file is left alone."""
    try:
        return digest(around.read(name, OUTPUT))
    except FileNotFoundError:
        return None
    except OSError:
        return ""


def _digest(data: bytes | None) -> str | None:
    return digest(data) if data is not None else None
