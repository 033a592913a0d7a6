"""A sketch as it lies on disk: its folder, its files, its project file. Nothing is written and nothing is run.

A sketch is a folder `<name>` with `<name><suffix>` in it; the suffix and everything else that depends on a platform comes from
the toolchain's data. What a run has made is read only where no link leads out of its output folder; a person's own sketch may
have links to anywhere.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, SourceError, UsageError
from robosmi.generate.manifest import NAME as MANIFEST
from robosmi.generate.places import Places
from robosmi.verify.boards import Board, find_board
from robosmi.verify.project_file import PROJECT_KEYS, ProjectFile, read_project_file, search_project_file
from robosmi.verify.tables import DataTable
from robosmi.verify.toolchain_data import Toolchain


class Sketch(NamedTuple):
    """A sketch's files.

    Attributes:
        folder: its folder, as the caller named it.
        main: its main file.
        parts: further files of the same suffix, which continue the main file, by name.
        sources: files that are compiled on their own.
        project_file: what its project file says, or None if there is none.
    """

    folder: Path
    main: Path
    parts: tuple[Path, ...]
    sources: tuple[Path, ...]
    project_file: ProjectFile | None

    @property
    def well_named(self) -> bool:
        """Whether the main file bears the folder's name, as the platform's own tools demand."""
        return self.main.stem == self.folder.resolve().name

    def text(self, toolchain: Toolchain) -> str:
        """The program text that is compiled: the toolchain's prologue, then each file under its own name.

        Raises:
            SourceError: a file cannot be read.
        """
        line = toolchain.sketch.text("line")
        text = toolchain.sketch.text("prologue")
        for path in (self.main, *self.parts):
            try:
                content = inputs.read_text(path, inputs.OUTPUT, "utf-8-sig", "surrogateescape")
            except OSError as error:
                raise SourceError(f"the file cannot be read: {error}", location=Location(str(path))) from error
            text += line.replace("{file}", path.name) + content + ("" if content.endswith("\n") else "\n")
        return text


def find_sketch(path: Path, toolchains: Sequence[Toolchain]) -> tuple[Sketch, Toolchain]:
    """The sketch at a path: its main file, its folder, or the folder above that (what was generated).

    Args:
        path: file or folder.
        toolchains: whose sketches count.

    Raises:
        SourceError: there is none, or a link leads out of the output folder that it is in.
        UsageError: there are several.
    """
    if not path.exists():
        nowhere = "a link that leads nowhere is there" if path.is_symlink() else "there is no such file or folder"
        raise SourceError(nowhere, location=Location(str(path)), fix="give the output folder of `robosmi migrate`, or a sketch")
    for toolchain in toolchains:
        suffix = toolchain.sketch.text("suffix")
        if path.is_file() and path.suffix == suffix:
            return _sketch(path, toolchain), toolchain
        if path.is_dir() and (main := _main(path, toolchain.sketch)):
            return _sketch(main, toolchain), toolchain
    found: list[tuple[Path, Toolchain]] = []
    if path.is_dir():
        for toolchain in toolchains:
            suffix = toolchain.sketch.text("suffix")
            mains = (sub / f"{sub.name}{suffix}" for sub in sorted(path.iterdir()) if sub.is_dir())
            known = {main.parent for main, _ in found}  # a folder is a sketch of the first toolchain that knows it
            found += [(main, toolchain) for main in mains if main.is_file() and main.parent not in known]
    if len(found) > 1:
        names = ", ".join(main.parent.name for main, _ in found)
        raise UsageError(
            f"there are several sketches: {names}", location=Location(str(path)), fix="name the folder of one of them"
        )
    if not found:
        wanted = " or ".join(f"<name>/<name>{toolchain.sketch.text('suffix')}" for toolchain in toolchains)
        raise SourceError("there is no sketch", location=Location(str(path)), fix=f"name a folder that holds {wanted}")
    return _sketch(found[0][0], found[0][1]), found[0][1]


def _main(folder: Path, data: DataTable) -> Path | None:
    """The main file of a sketch's folder: the one that bears its name, else the only one.

    Raises:
        UsageError: there are several, which together would be a sketch if one bore the folder's name.
    """
    suffix = data.text("suffix")
    named = folder / f"{folder.resolve().name}{suffix}"
    if named.is_file():
        return named
    found = sorted(path for path in folder.glob(f"*{suffix}") if path.is_file())
    if len(found) > 1:
        if not data.flag("parts", True):
            return None
        raise UsageError(
            f"none of the {len(found)} files *{suffix} bears the folder's name",
            location=Location(str(folder)),
            fix=f"name the main file {named.name}, or name one file to be compiled",
        )
    return found[0] if found else None


def check_inside(folder: Path) -> None:
    """Make sure that a folder in an output folder, and what is in it, lies inside; any other folder may have links.

    Args:
        folder: a sketch's folder, or one beside it.

    Raises:
        SourceError: a link leads out of the output folder.
    """
    as_named = Path(os.path.abspath(folder))
    for own in {as_named, as_named.resolve()}:
        if os.path.lexists(own.parent / MANIFEST):
            Places(own.parent).check_inside(own.name)


def _sketch(main: Path, toolchain: Toolchain) -> Sketch:
    folder, data = main.parent, toolchain.sketch
    check_inside(folder)
    joined = data.flag("parts", True)
    parts = sorted(path for path in folder.glob(f"*{data.text('suffix')}") if path.is_file() and path != main) if joined else []
    deep = folder / data.text("recursive")
    files = [*folder.glob("*"), *(deep.rglob("*") if deep.is_dir() else ())]
    sources = sorted(path for path in files if path.suffix in toolchain.suffixes and path.is_file() and path != main)
    name = data.text("project_file", "")
    project_file = _project_file(folder / name, data) if name and (folder / name).is_file() else None
    return Sketch(folder, main, tuple(parts), tuple(sources), project_file)


def _project_file(path: Path, data: DataTable) -> ProjectFile:
    if "project_patterns" in data.values:
        return search_project_file(path, data.table("project_patterns").pattern("board"))
    keys = data.table("project_keys")
    return read_project_file(path, {key: keys.text(key) for key in PROJECT_KEYS})


def choose_board(sketch: Sketch, boards: list[Board], toolchain: Toolchain, wanted: str | None = None) -> Board:
    """The board to compile for: the one asked for, else the project file's, else the toolchain's default.

    Raises:
        UsageError: no board is called as asked for.
        SourceError: no board is called as the project file says.
        PlatformDataError: the toolchain's default is no board.
    """
    if wanted is not None:
        return find_board(wanted, boards)
    given = sketch.project_file
    if given is not None and given.board is not None:
        try:
            return find_board(given.board, boards)
        except UsageError as error:
            raise SourceError(error.message, location=Location(str(given.path), given.board_line), fix=error.fix) from error
    try:
        return find_board(toolchain.default_board, boards)
    except UsageError as error:
        place = Location(str(toolchain.path))
        raise PlatformDataError(f"'default_board': {error.message}", location=place, fix=error.fix) from error
