"""Restricts the paths of generated files, and of files read from an output folder, to those inside it, whatever links exist."""

from __future__ import annotations

import os
from pathlib import Path, PurePosixPath

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.files.files import within
from robosmi.files.recovery import STAGE


class Places:
    """The paths of one output folder.

    Args:
        folder: the folder; it need not exist.
        what: what it is, for messages.

    Attributes:
        seen: what `look` has found, by name.
    """

    def __init__(self, folder: Path, what: str = "output folder") -> None:
        self.folder = folder
        self._what = what
        self._root = os.path.realpath(folder)
        self._parents: set[str] = set()
        self.seen: dict[str, bytes | None] = {}

    def read(self, name: str) -> bytes | None:
        """The bytes of a file, None if it is not there.

        Args:
            name: relative to the folder, with slashes.

        Raises:
            SourceError: it lies outside of the folder (`..`, absolute, by a link), something is in its way, or it cannot be read.
        """
        path = f"{self.folder}/{name}"
        parent, _, own = path.rpartition("/")
        if own in ("", ".", "..") or parent not in self._parents:
            self._check(name, parent)
            self._parents.add(parent)
        try:
            return inputs.read_bytes(path, inputs.OUTPUT, follow=False)
        except FileNotFoundError:
            return None
        except IsADirectoryError as error:
            raise self._in_the_way(path, "a folder is in the place of a file") from error
        except OSError as error:
            if os.path.islink(path):
                raise SourceError(
                    "the file is a link, which generating would replace; nothing was written",
                    location=Location(path),
                    fix="replace the link with a copy of the file, or move the link away",
                ) from error
            raise self._unreadable(path, error) from error

    def look(self, name: str) -> bytes | None:
        """Like `read`, but cached; `commit` checks that nobody has changed what was found."""
        if name not in self.seen:
            self.seen[name] = self.read(name)
        return self.seen[name]

    def check_inside(self, name: str) -> None:
        """Make sure that a file or folder, which need not exist, is inside once all links are followed, and so is all below it.

        Args:
            name: relative to the folder, with slashes.

        Raises:
            SourceError: it is not.
        """
        self._check_link(name, f"{self.folder}/{name}")
        walked: set[str] = set()  # a link may lead to a folder above it
        for above, folders, files in os.walk(f"{self.folder}/{name}", followlinks=True):
            walked.add(os.path.realpath(above))
            for path in (os.path.join(above, own) for own in (*folders, *files)):
                if os.path.islink(path):
                    self._check_link(os.path.relpath(path, self.folder), path)
            folders[:] = [own for own in folders if os.path.realpath(os.path.join(above, own)) not in walked]

    def _unreadable(self, path: str, error: OSError) -> SourceError:
        return SourceError(
            f"the existing file cannot be read: {error.strerror}", location=Location(path),
            fix=inputs.fix_of(error, "check its permissions"),
        )  # fmt: skip

    def check_name(self, name: str) -> None:
        """Make sure that a path may be a file's, whatever there is in the folder.

        Raises:
            SourceError: it is not a file name, or lies outside of the folder.
        """
        if not name or name.endswith("/"):
            raise self._refused(name, "is not a file name")
        if not within(name):
            raise self._refused(name, f"is outside the {self._what}")
        if name.partition("/")[0] == STAGE:
            raise self._refused(name, "is reserved for files that wait to be written")

    def _check(self, name: str, parent: str) -> None:
        self.check_name(name)
        self._check_link(name, parent)
        for inner in PurePosixPath(name).parents:
            above = f"{self.folder}/{inner}"
            if inner.parts and os.path.lexists(above) and not os.path.isdir(above):
                raise self._in_the_way(above, "a file is in the place of a folder")

    def _check_link(self, name: str, path: str) -> None:
        if os.path.commonpath([os.path.realpath(path), self._root]) != self._root:
            raise SourceError(
                f"'{name}' is outside the {self._what}, behind a link; nothing was written",
                location=Location(f"{self.folder}/{name}"), fix="replace the link with a copy of its target",
            )  # fmt: skip

    def _in_the_way(self, path: str, message: str) -> SourceError:
        return SourceError(
            f"{message}; nothing was written", location=Location(path), fix="move it away, or give another output folder"
        )

    def _refused(self, name: str, why: str) -> SourceError:
        return SourceError(
            f"the target '{name}' {why}; nothing was written",
            location=Location(f"{self.folder}/{name}"),
            fix="correct the target of the rule: a path relative to the output folder, with slashes",
        )


def before_conflicts(folder: Path, name: str) -> list[str]:
    """The contents of a file before each conflict marked in it, from the old files beside it that still exist.

    Args:
        folder: the folder.
        name: of the file, relative to it.
    """
    found, number, path = [], 1, folder / f"{name}.orig"
    while path.is_file():
        found.append(inputs.read_bytes(path, inputs.OUTPUT).decode("latin-1").replace("\r\n", "\n"))
        number += 1
        path = folder / f"{name}.orig.{number}"
    return found
