"""A folder that is kept open while a run writes in it: its files are accessed relative to it, without following links.

A path is resolved anew each time it is used, so somebody with write access could replace a folder by a link between a check and
the write. Here each folder on the path is opened from its parent, without following links. Links that existed before and stay
inside are resolved first. On systems where folders cannot be opened, paths are checked and then used. `commit` and `recovery`
decide what is written in which order.
"""

from __future__ import annotations

import errno
import os
import shutil
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import TracebackType

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, StoppedError

_HELD = {os.open, os.mkdir, os.rename, os.unlink, os.stat, os.rmdir} <= os.supports_dir_fd and hasattr(os, "O_NOFOLLOW")
_FOLDER = os.O_RDONLY | inputs.flags("O_DIRECTORY", "O_NOFOLLOW", "O_CLOEXEC")
_NEW = os.O_WRONLY | os.O_CREAT | os.O_EXCL | inputs.flags("O_NOFOLLOW", "O_CLOEXEC")
_KEPT = 4
"""Limit on the subfolders kept open, since a process may open few files."""
_ODD = {stat.S_IFDIR: "a folder", stat.S_IFLNK: "a link"}


class DirectoryFd:
    """A folder and what is below it; names are relative to it, with slashes. To be used in a `with` statement.

    Args:
        path: the folder; it may be a link itself.

    Raises:
        OSError: it is no folder, or may not be read.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._root = os.path.realpath(path)
        self._own = os.open(self._root, _FOLDER) if _HELD else -1
        self._open: dict[str, int] = {}
        self._real: dict[str, str] = {}

    def __enter__(self) -> DirectoryFd:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self._let_go()
        if self._own >= 0:
            os.close(self._own)

    # --- looking

    def look(self, name: str) -> os.stat_result | None:
        """The system's status of a file, folder or link; None if there is none.

        Raises:
            SourceError: a link leads out of the folder.
            OSError: it may not be looked at.
        """
        with self._named(name):
            try:
                own, above = self._place(name)
                return os.stat(own, dir_fd=above, follow_symlinks=False)
            except (FileNotFoundError, NotADirectoryError):
                return None

    def has(self, name: str, data: bytes) -> bool:
        """Whether there is an ordinary file with these bytes.

        Raises:
            SourceError: a link leads out of the folder.
        """
        try:
            found = self.look(name)
            return found is not None and found.st_size == len(data) and stat.S_ISREG(found.st_mode) and self.read(name) == data
        except OSError:
            return False

    def is_empty(self) -> bool:
        """Whether nothing is in the folder itself."""
        with os.scandir(self._own if self._own >= 0 else self._root) as found:
            return next(found, None) is None

    def read(self, name: str, kind: inputs.Kind = inputs.OUTPUT) -> bytes:
        """The bytes of an ordinary file.

        Raises:
            SourceError: a link leads out of the folder.
            OSError: it cannot be read, or is a link.
        """
        with self._named(name):
            own, above = self._place(name)
            return inputs.read_bytes(own, kind, follow=False, dir_fd=above)

    def free_for_file(self, name: str) -> None:
        """Make sure that a file can be moved to a place.

        Raises:
            SourceError: something else is there, or on the way to it, or a link leads out of the folder.
            OSError: the folder cannot be written.
        """
        parent = ""
        for part in name.split("/")[:-1]:
            parent = f"{parent}/{part}".lstrip("/")
            found = self.look(parent)
            if found is None:
                break
            if not stat.S_ISDIR(found.st_mode) and not os.path.isdir(f"{self.path}/{parent}"):
                raise in_the_way(f"{self.path}/{parent}", "a file is in the place of a folder")
            if not os.access(f"{self.path}/{parent}", os.W_OK):
                raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), f"{self.path}/{parent}")
        found = self.look(name)
        if found is not None and not stat.S_ISREG(found.st_mode):
            what = _ODD.get(stat.S_IFMT(found.st_mode), "something that is not a file")
            raise in_the_way(f"{self.path}/{name}", f"{what} is in the place of a file")
        self.may_go(name)

    def may_go(self, name: str) -> None:
        """Make sure that a file can be replaced or removed, if it is there.

        Raises:
            SourceError: a link leads out of the folder.
            OSError: it is another account's in a folder where only its own files may go, or no file there may be changed.
        """
        found = self.look(name)
        if found is None or not hasattr(os, "geteuid"):
            return
        with self._named(name):
            own, above = self._place(name)
            around = self.identity() if above in (None, self._own) else os.fstat(above)
            user = os.geteuid()
            if around.st_mode & stat.S_ISVTX and user not in (0, found.st_uid, around.st_uid):
                raise PermissionError(errno.EPERM, "the file belongs to another account, and only that account can replace it")
            if user in (0, found.st_uid) and found.st_mode & 0o200 and not os.access(own, os.W_OK, dir_fd=above):
                raise PermissionError(errno.EPERM, "the file is protected by the file system")

    # --- changing

    def make_folder(self, name: str) -> None:
        """Make a folder that is not there yet.

        Raises:
            OSError: there is something, or it cannot be made.
        """
        with self._named(name):
            own, above = self._place(name)
            os.mkdir(own, dir_fd=above)

    def inner(self, name: str) -> DirectoryFd:
        """A folder below this one, held open for itself; not where its place was taken by a link.

        Raises:
            OSError: it is a link or no folder.
        """
        with self._named(name):
            own, above = self._place(name)
            if not _HELD and os.path.islink(own):
                raise OSError(errno.ELOOP, os.strerror(errno.ELOOP), own)
            folder = DirectoryFd.__new__(DirectoryFd)
            folder.path, folder._root = Path(f"{self.path}/{name}"), f"{self._root}/{name}"
            folder._open, folder._real = {}, {}
            folder._own = os.open(own, _FOLDER, dir_fd=above) if _HELD else -1
            return folder

    def identity(self) -> os.stat_result:
        """What the system says of the folder itself."""
        return os.fstat(self._own) if self._own >= 0 else os.lstat(self._root)

    def write(self, name: str, data: bytes, mode: int | None = None) -> None:
        """Write a file that is not there yet; folders on the way to it are made.

        Args:
            name: the file.
            data: its bytes.
            mode: its permissions; those that the system gives a new file if None.

        Raises:
            OSError: there is something, or it cannot be written.
        """
        with self._named(name):
            own, above = self._place(name, make=True)
            with os.fdopen(os.open(own, _NEW, 0o666, dir_fd=above), "wb") as file:
                file.write(data)
                if mode is not None and hasattr(os, "fchmod"):
                    os.fchmod(file.fileno(), mode)

    def move(self, name: str, target: str) -> None:
        """Move a file over another one, or to where there is none; folders on the way there are made.

        Raises:
            SourceError: a link leads out of the folder.
            OSError: it cannot be moved.
        """
        with self._named(target):
            own, above = self._place(name)
            new, there = self._place(target, make=True)
            os.replace(own, new, src_dir_fd=above, dst_dir_fd=there)

    def remove(self, name: str) -> None:
        """Remove a file or link, if it is there, and the folders that it leaves empty.

        Raises:
            SourceError: a link leads out of the folder.
            OSError: it cannot be removed.
        """
        with self._named(name):
            try:
                own, above = self._place(name)
                os.unlink(own, dir_fd=above)
            except (FileNotFoundError, NotADirectoryError):
                pass
        parent = name.rpartition("/")[0]
        while parent:
            try:
                own, above = self._place(parent)
                os.rmdir(own, dir_fd=above)
            except FileNotFoundError:
                pass
            except OSError:  # it is not empty
                break
            parent = parent.rpartition("/")[0]
        self._let_go()

    def remove_folder(self, name: str) -> None:
        """Remove a folder with all that is in it; links in it are removed and not followed.

        Raises:
            OSError: it is a link, or cannot be removed.
        """
        with self._named(name):
            own, above = self._place(name)
            self._let_go(but=above)
            shutil.rmtree(own, dir_fd=above)

    @contextmanager
    def locked(self) -> Iterator[None]:
        """Keep other runs out of the folder. The system lets go of the lock when the process ends, however it ends.

        Raises:
            StoppedError: another run is writing there.
        """
        try:
            import fcntl
        except ImportError:  # no such locks on this system
            yield
            return
        if self._own < 0:
            yield
            return
        try:
            fcntl.flock(self._own, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise StoppedError(
                "another run is writing into this folder", location=Location(str(self.path)), fix="wait for it, then run again"
            ) from None
        try:
            yield
        finally:
            fcntl.flock(self._own, fcntl.LOCK_UN)

    # --- places

    @contextmanager
    def _named(self, name: str) -> Iterator[None]:
        """Errors of the system name the path as the user knows it."""
        try:
            yield
        except OSError as error:
            error.filename, error.filename2 = f"{self.path}/{name}", None
            raise

    def _place(self, name: str, *, make: bool = False) -> tuple[str, int | None]:
        """A name for calls of the system, and the descriptor of the folder that it is in (None: it is a whole path).

        Raises:
            SourceError: a link leads out of the folder.
            OSError: a folder on the way is missing, or has become a link.
        """
        parent, _, own = name.rpartition("/")
        real = self._real.get(parent)
        if real is None:
            real = os.path.relpath(os.path.realpath(f"{self._root}/{parent}"), self._root) if parent else "."
            if real.split(os.sep)[0] == os.pardir or os.path.isabs(real):
                raise in_the_way(f"{self.path}/{parent}", "a link leads out of the output folder")
            self._real[parent] = real
        if not _HELD:
            above = os.path.normpath(f"{self._root}/{real}")
            if make:
                os.makedirs(above, exist_ok=True)
            return os.path.join(above, own), None
        if real == ".":
            return own, self._own
        found = self._open.pop(real, None)
        if found is None:
            found = self._opened(real, make)
            while len(self._open) >= _KEPT:
                os.close(self._open.pop(next(iter(self._open))))
        self._open[real] = found
        return own, found

    def _opened(self, name: str, make: bool) -> int:
        above = self._own
        for part in name.split(os.sep):
            try:
                try:
                    found = os.open(part, _FOLDER, dir_fd=above)
                except FileNotFoundError:
                    if not make:
                        raise
                    with suppress(FileExistsError):
                        os.mkdir(part, dir_fd=above)
                    found = os.open(part, _FOLDER, dir_fd=above)
            finally:
                if above != self._own:
                    os.close(above)
            above = found
        return above

    def _let_go(self, but: int | None = None) -> None:
        """Close the folders below, whose names may soon mean others."""
        self._real.clear()
        for name, found in [*self._open.items()]:
            if found != but:
                os.close(self._open.pop(name))


def in_the_way(path: str, message: str) -> SourceError:
    """The error for something that stands in the way of what is to be written.

    Args:
        path: where it stands.
        message: what it is.
    """
    return SourceError(message, location=Location(path), fix="move it away, or give another output folder")
