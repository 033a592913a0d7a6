"""The adapter files for a source platform on a target platform, read when a program needs them.

They lie in `<target platform>/adapters/<source platform>/` of the platform repository, one for each header, named like it
(`sys/time.cpp` is for `sys/time.h`); files of a project, of a person and of plug-ins go before the built-in ones, piece by
piece. Which pieces a program needs is told in `queries.adapter_needs`.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from pathlib import Path, PurePosixPath

from robosmi import resources
from robosmi.errors import PlatformDataError
from robosmi.transformations.knowledge.adapter_data import adapter_paths, load
from robosmi.transformations.knowledge.adapter_files import AdapterFile, AdapterPiece


class AdapterIndex:
    """The adapter files of some folders.

    Args:
        folders: those that count first in front.
    """

    def __init__(self, folders: Sequence[Path]) -> None:
        self.folders = list(folders)
        self._files: dict[str, list[AdapterFile]] = {}

    @property
    def headers(self) -> list[str]:
        """The headers that files are for, in the order of their names."""
        return sorted({header for folder in self.folders for header, _ in _listed(folder)})

    def files(self, header: str) -> list[AdapterFile]:
        """The files for a header, the one that counts first in front.

        Raises:
            PlatformDataError: a file cannot be read, says something wrong, or is for another header than its name says.
        """
        known = self._files.get(header)
        if known is None:
            known = self._files[header] = []
            for folder in self.folders:
                known += [_checked(path, header) for named, path in _listed(folder) if named == header]
        return known

    def of(self, header: str) -> list[list[AdapterPiece]]:
        """The pieces for a header, file by file."""
        return [file.pieces for file in self.files(header)]

    def unsupported(self, header: str) -> str:
        """Why the target cannot serve a header; empty where a file has pieces for it, or nothing is said."""
        files = self.files(header)
        return "" if any(file.pieces for file in files) else next((f.unsupported for f in files if f.unsupported), "")


def adapter_index(target: str, source: str, project: Path | None = None) -> AdapterIndex:
    """The adapter files of the platform repository.

    Args:
        target: name of the target platform.
        source: name of the source platform.
        project: the project folder; the current folder if None.
    """
    relative = PurePosixPath(target, "adapters", source)
    return AdapterIndex(
        [place for folder in resources.folders("platform_repo", project) if (place := folder / relative).is_dir()]
    )


@cache
def _listed(folder: Path) -> tuple[tuple[str, Path], ...]:
    """The adapter files of a folder with the headers that they are named like."""
    return tuple((path.relative_to(folder).with_suffix(".h").as_posix(), path) for path in adapter_paths(folder))


def _checked(path: Path, header: str) -> AdapterFile:
    file = load(path)
    if file.header != header:
        raise PlatformDataError(
            f"the adapter file {path} is for '{file.header}'", fix=f"call it {file.header.removesuffix('.h')}{path.suffix}"
        )
    return file
