"""The adapter files for a source platform on a target platform, read when a program needs them.

They lie in `<target platform>/adapters/<source platform>/` of the platform repository, one for each header, named like it
(`sys/time.cpp` is for `sys/time.h`); files of a project, of a person and of plug-ins go before the built-in ones, piece by
piece. Which pieces a program needs is told in `queries.adapter_needs`.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache
from pathlib import Path, PurePosixPath

from robosmi import resources
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, did_you_mean
from robosmi.transformations.knowledge.adapter_data import adapter_paths, load
from robosmi.transformations.knowledge.adapter_files import AdapterFile, AdapterPiece


class AdapterIndex:
    """The adapter files of some folders.

    Args:
        folders: those that count first in front.
        mcus: the microcontrollers that there are, which variants can be for; any if none are given.
    """

    def __init__(self, folders: Sequence[Path], mcus: Iterable[str] = ()) -> None:
        self.folders = list(folders)
        self.mcus = sorted(mcus)
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
                known += [self._checked(path, header) for named, path in _listed(folder) if named == header]
        return known

    def _checked(self, path: Path, header: str) -> AdapterFile:
        file = load(path)
        if file.header != header:
            fix = f"call it {file.header.removesuffix('.h')}{path.suffix}"
            raise PlatformDataError(f"the adapter file is for '{file.header}'", location=Location(str(path), 1), fix=fix)
        for piece in file.pieces:
            for mcu in piece.mcus if self.mcus else ():
                if mcu not in self.mcus:
                    message = f"'{piece.name}' is a variant for '{mcu}', a microcontroller of which nothing is known"
                    raise PlatformDataError(
                        f"{message}{did_you_mean(mcu, self.mcus)}", location=piece.location, fix=f"use: {', '.join(self.mcus)}"
                    )
        return file

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
    folders = list(resources.folders("platform_repo", project))
    mcus = {path.stem for folder in folders for path in (folder / "mcus").glob("*.toml")}
    return AdapterIndex([place for folder in folders if (place := folder / relative).is_dir()], mcus)


@cache
def _listed(folder: Path) -> tuple[tuple[str, Path], ...]:
    """The adapter files of a folder with the headers that they are named like."""
    return tuple((path.relative_to(folder).with_suffix(".h").as_posix(), path) for path in adapter_paths(folder))
