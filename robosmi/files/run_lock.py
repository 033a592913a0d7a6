"""Which run is at work in an output folder, and what in it is of this user's runs: kept outside of the folder, by its real path.

A lock lets one run of a user after the other into a folder. A record holds the digest of the journal that this user's run
carries out there, so that a journal that came with a folder from somebody else is told apart; the same for the lists of what was
made (`note`) and the folders where files wait (`own_stage`). Writing itself is `commit`'s.
"""

from __future__ import annotations

import hashlib
import os
import stat
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from robosmi import resources
from robosmi.base.file_locks import lock_now, unlock
from robosmi.base.user_cache import read_own, write_own
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, StoppedError
from robosmi.inputs import OUTPUT, RECORD, flags, read_text

PATIENCE = 60.0
"""Seconds that a run waits for another one in the same folder."""

_held = threading.local()


@contextmanager
def alone(folder: Path, patience: float | None = None) -> Iterator[None]:
    """Keep other runs of this user out of a folder; a run that is in already goes on. The system frees the lock of a killed run.

    Args:
        folder: the output folder; it need not exist.
        patience: seconds to wait for another run; `PATIENCE` if None.

    Raises:
        StoppedError: another run is still at work after that time.
        SourceError: there is no place for the lock.
    """
    real = os.path.realpath(folder)
    path = _place(real.casefold(), "lock")  # one folder has several spellings on some systems
    mine: set[Path] = _held.__dict__.setdefault("paths", set())
    if path in mine:
        yield
        return
    release = _locked_at_once(path) or _locked(path, PATIENCE if patience is None else patience, folder)
    mine.add(path)
    try:
        _store(_who(path), str(os.getpid()))
        yield
    finally:
        mine.discard(path)
        release()


def _locked_at_once(path: Path) -> Callable[[], None] | None:
    """What frees a lock that nobody had, taken without loading filelock (a fiftieth of a migration) and as filelock takes it.

    None where somebody has it, and where the system locks in another way or not at all: filelock knows what to do then.
    """
    handle = lock_now(path, os.O_RDWR | os.O_CREAT | flags("O_NOFOLLOW", "O_CLOEXEC"))
    return partial(unlock, handle) if handle is not None else None


def _locked(path: Path, patience: float, folder: Path) -> Callable[[], None]:
    """What frees a lock, which was waited for.

    Raises:
        StoppedError: another run still has it after that many seconds.
        SourceError: there is no place for it.
    """
    from filelock import FileLock, Timeout

    lock = FileLock(path, timeout=patience)
    try:
        lock.acquire()
    except Timeout:
        try:
            name = f"another run (process {int(read_text(_who(path), RECORD))})"
        except (OSError, ValueError):
            name = "another run"
        raise StoppedError(
            f"{name} is active in this folder; nothing was written", location=Location(str(folder)),
            fix="wait for it, then run again",
        ) from None  # fmt: skip
    except OSError as error:
        raise _no_place(path, error) from error
    return lock.release


def _who(path: Path) -> Path:
    """The file beside a lock that says which process has it."""
    return path.with_suffix(".who")


def bind(folder: Path, journal: bytes) -> None:
    """Note that a journal is about to be carried out in a folder by a run of this user.

    Raises:
        SourceError: there is no place for the note.
    """
    _store(_place(os.path.realpath(folder), "journal"), hashlib.sha256(journal).hexdigest())


def is_bound(folder: Path, journal: bytes) -> bool:
    """Whether a run of this user has made that journal for that folder, where the folder is now."""
    try:
        noted = read_own(_place(os.path.realpath(folder), "journal"), RECORD).decode()
    except (OSError, ValueError):
        return False
    return noted == hashlib.sha256(journal).hexdigest()


def release(folder: Path) -> None:
    """Forget the journal of a folder: it was carried out."""
    _place(os.path.realpath(folder), "journal").unlink(missing_ok=True)


def note(path: Path, *versions: bytes) -> None:
    """Note that a run of this user has written a file, or is about to.

    Args:
        path: the file, such as the manifest of an output folder.
        versions: what it may hold: its new bytes, and those that it has until these are in place.

    Raises:
        SourceError: there is no place for the note.
    """
    _store(_record_of(path), " ".join(hashlib.sha256(data).hexdigest() for data in versions))


def is_noted(path: Path, data: bytes) -> bool:
    """Whether a run of this user has written these bytes into that file, where the file is now."""
    try:
        noted = read_own(_record_of(path), RECORD).decode()
    except (OSError, ValueError):
        return False
    return hashlib.sha256(data).hexdigest() in noted.split()


STATE, SOURCES, ELSEWHERE = "undo", "sources", "elsewhere"
"""What is kept of output folders: what one held before its last change, where the sources of its migration lie, and which files
outside of it wait for the commit that is going on."""
_KEPT = {STATE: OUTPUT, SOURCES: RECORD, ELSEWHERE: RECORD}


def store(folder: Path, what: str, text: str) -> None:
    """Keep something of an output folder (`STATE`, `SOURCES` or `ELSEWHERE`) in the user's data.

    Raises:
        SourceError: there is no place for it.
    """
    _store(place_of(folder, what), text)


def place_of(folder: Path, what: str) -> Path:
    """Where something of an output folder (`STATE`, `SOURCES` or `ELSEWHERE`) is kept.

    Raises:
        SourceError: there is no place for it.
    """
    return _place(os.path.realpath(folder), what)


def stored(folder: Path, what: str) -> str:
    """What `store` kept of an output folder that is where it was then.

    Raises:
        OSError: nothing was kept by this user, or it cannot be read.
        ValueError: it is no text.
    """
    return read_own(place_of(folder, what), _KEPT[what]).decode()


def note_place(folder: Path) -> None:
    """Note where a folder is, so that what is kept of it is found after it was moved (`stored_of`).

    Raises:
        SourceError: there is no place for the note.
    """
    _store(_place(_identity(os.stat(folder)).decode(), "folder"), os.path.realpath(folder))


def stored_of(folder: Path, what: str) -> str:
    """What `store` kept of an output folder where the last run was at work in it, from where it may have been moved.

    The number that the file system gives a folder stays when it is moved, and not when it is copied or sent. What is kept for
    the folder's present place may be older than that, if the folder was here before, too, or of another folder.

    Raises:
        OSError: nothing was kept by this user, something else is where the folder was, or it cannot be read.
        ValueError: it is no text.
    """
    try:
        place = Path(read_own(_place(_identity(os.stat(folder)).decode(), "folder"), RECORD).decode())
    except OSError:  # an undo has removed the folder, or no run has noted its place
        return stored(folder, what)
    if os.path.lexists(place) and not os.path.samefile(place, folder):
        raise FileNotFoundError(place)
    return stored(place, what)


def discard(folder: Path, what: str) -> None:
    """Forget what `store` kept of an output folder."""
    place_of(folder, what).unlink(missing_ok=True)


def own_stage(folder: Path, found: os.stat_result | None = None) -> None:
    """Note that a run of this user has made a folder in which files wait.

    Args:
        folder: the folder.
        found: what the system says of it; asked of the path if None.

    Raises:
        SourceError: there is no place for the note.
        OSError: the folder is not there.
    """
    note(folder, _identity(found or folder.lstat()))


def is_own_stage(folder: Path, found: os.stat_result) -> bool:
    """Whether a run of this user has made that very folder, so that it may be thrown away with all that is in it.

    Args:
        folder: the folder.
        found: what the system says of the one that is held open.
    """
    return is_noted(folder, _identity(found))


def forget(path: Path) -> None:
    """Forget what was noted of a file or folder."""
    _record_of(path).unlink(missing_ok=True)


def _identity(found: os.stat_result) -> bytes:
    return f"folder {found.st_dev} {found.st_ino}".encode()


def _record_of(path: Path) -> Path:
    return _place(f"{os.path.realpath(path.parent)}/{path.name}", "made")


def _store(path: Path, text: str) -> None:
    try:
        write_own(path, text)
    except OSError as error:
        raise _no_place(path, error) from error


def _place(key: str, ending: str) -> Path:
    return _state() / f"{hashlib.sha256(os.fsencode(key)).hexdigest()}.{ending}"


_elsewhere: Path | None = None
"""See `records_in`."""


@contextmanager
def records_in(folder: Path) -> Iterator[None]:
    """Context manager: this process keeps its locks and records in a folder, of which later runs know nothing."""
    global _elsewhere
    _elsewhere = folder
    try:
        yield
    finally:
        _elsewhere = None


def _state() -> Path:
    """The folder of locks and records: among the user's data, or, for a user who has no place, in the temporary folder.

    Raises:
        SourceError: there is neither.
    """
    folder = _elsewhere or resources.user_data() / "runs"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if os.access(folder, os.W_OK):
            return folder
    except OSError:
        pass
    import tempfile  # slow to load, and wanted only by a user without a place

    owner = os.getuid() if hasattr(os, "getuid") else 0
    folder = Path(tempfile.gettempdir()) / f"robosmi-{owner}"
    try:
        folder.mkdir(mode=0o700, exist_ok=True)
        found = folder.lstat()
    except OSError as error:
        raise _no_place(folder, error) from error
    if not stat.S_ISDIR(found.st_mode) or (hasattr(os, "getuid") and (found.st_uid != owner or found.st_mode & 0o077)):
        raise _no_place(folder, PermissionError("it belongs to another user, or others may write there"))
    return folder


def _no_place(path: Path, error: OSError) -> SourceError:
    return SourceError(
        f"the lock of a run cannot be written here: {error.strerror or error}", location=Location(str(path)),
        fix="set ROBOSMI_HOME to a writable folder of your own",
    )  # fmt: skip
