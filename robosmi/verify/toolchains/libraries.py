"""Which libraries a sketch needs, and where they are: installed ones first, stand-ins of the repository after them.

An installed library that does not list the board's architecture comes last.

The preprocessor itself names the headers it cannot find, so conditions and macros count and comments do not. For each such
header a library that offers it is added, until no header is missing or nothing offers it. Compiling is done by `build`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

from robosmi import inputs
from robosmi.base.data_tables import DataTable, find_files
from robosmi.verify.toolchains.toolchain_data import Toolchain, fill, places

INSTALLED, STAND_IN = "installed", "stand-in"
"""Where a library comes from, as reports say it."""


class CompiledLibrary(NamedTuple):
    """A library that can be compiled against.

    Attributes:
        name: its name as library managers know it.
        version: its version; of a stand-in, the version it is compatible with.
        source: `INSTALLED` or `STAND_IN`.
        folder: where it lies.
        include: the folder that headers are found in.
        deep: whether sources count at any depth of `include`.
        flat: without `deep`, the sub-folders of `include` whose sources count, too.
        others: the architectures that it lists, if that of the board is not among them.
    """

    name: str
    version: str
    source: str
    folder: Path
    include: Path
    deep: bool
    flat: tuple[str, ...]
    others: tuple[str, ...] = ()

    def own_includes(self) -> list[Path]:
        """The folders that its own sources find headers in, `include` first."""
        inner = [] if self.deep else [self.include / name for name in self.flat]
        return [self.include, *(folder for folder in inner if folder.is_dir())]

    def files(self, suffixes: Iterable[str]) -> list[Path]:
        """Its source files of these suffixes, sorted."""
        wanted = tuple(suffixes)
        flat = (path for folder in self.own_includes() for path in folder.glob("*"))
        found = self.include.rglob("*") if self.deep else flat
        return sorted(path for path in found if path.suffix in wanted and path.is_file())

    def to_json(self) -> dict[str, str]:
        """The contract's form, with version and folder added."""
        return {"name": self.name, "source": self.source, "version": self.version, "folder": str(self.folder)}


class LibraryFolders:
    """Finds the library that offers a header, for one toolchain on one machine.

    Args:
        toolchain: whose libraries.
        core: the core's folder.
        project: the project folder; the current folder if None.
        stand_in_core: whether the core is a stand-in, and so its libraries.
    """

    def __init__(self, toolchain: Toolchain, core: Path, project: Path | None = None, stand_in_core: bool = False) -> None:
        self._toolchain = toolchain
        self._core = core
        self._project = project
        self._stand_in_core = stand_in_core

    @cached_property
    def folders(self) -> list[Path]:
        """The folders of libraries, in search order."""
        data = self._toolchain.libraries
        texts = fill(data.texts("places"), {"core": str(self._core)})
        return places(texts, data.text("env"))

    @cached_property
    def installed(self) -> list[CompiledLibrary]:
        """The installed libraries, in search order."""
        return [self._installed(path) for folder in self.folders for path in sorted(folder.iterdir()) if path.is_dir()]

    @cached_property
    def stand_ins(self) -> list[tuple[CompiledLibrary, tuple[str, ...]]]:
        """The stand-ins of the repository for this architecture, with the headers that they offer."""
        pattern = f"{self._toolchain.platform}/stand_ins/*/stand_in.toml"
        tables = [DataTable.read(path) for path in find_files(pattern, self._project)]
        fitting = {self._toolchain.architecture, "*"}
        return [self._stand_in(table) for table in tables if fitting & set(table.texts("architectures"))]

    def find(self, header: str) -> CompiledLibrary | None:
        """The library that offers a header, e.g. `Servo.h`, or None. One that bears the header's name goes first."""
        installed = [library for library in self.installed if (library.include / header).is_file()]
        offers = [library for library in installed if not library.others]
        offers = offers or [library for library, headers in self.stand_ins if header in headers] or installed
        stem = Path(header).stem
        return min(offers, key=lambda library: stem not in (library.name, library.folder.name), default=None)

    def _installed(self, folder: Path) -> CompiledLibrary:
        data = self._toolchain.libraries
        properties = properties_of(folder / data.text("properties"))
        known = tuple(word.strip() for word in (properties.get("architectures") or "*").split(","))
        others = () if {"*", self._toolchain.architecture} & {*known} else known
        inner = folder / data.text("recursive")
        deep = bool(properties) and inner.is_dir()
        name, version = properties.get("name") or folder.name, properties.get("version", "")
        source = STAND_IN if self._stand_in_core and folder.is_relative_to(self._core) else INSTALLED
        return CompiledLibrary(name, version, source, folder, inner if deep else folder, deep, data.texts("flat", ()), others)

    @staticmethod
    def _stand_in(table: DataTable) -> tuple[CompiledLibrary, tuple[str, ...]]:
        path = table.path
        library = CompiledLibrary(table.text("library"), table.text("version"), STAND_IN, path.parent, path.parent, False, ())
        headers = table.texts("headers")
        for header in headers:
            if not (path.parent / header).is_file():
                raise table.error("headers", f"names {header}, which is not in the folder")
        return library, headers


def properties_of(path: Path) -> dict[str, str]:
    """The `key=value` lines of a library's description; empty if there is none."""
    return properties_in(inputs.read_text(path, inputs.SETTINGS, errors="replace")) if path.is_file() else {}


def properties_in(text: str) -> dict[str, str]:
    """The `key=value` lines of a text."""
    return {key.strip(): value.strip() for key, sep, value in (line.partition("=") for line in text.splitlines()) if sep}


def resolve(
    sources: Iterable[Path],
    index: LibraryFolders,
    suffixes: Iterable[str],
    missing: Callable[[Path, list[CompiledLibrary]], list[str]],
) -> list[CompiledLibrary]:
    """The libraries that sources need, and those that these need, in the order they were found.

    Args:
        sources: the sketch's own files that are compiled.
        index: where libraries are found.
        suffixes: of the sources of a library.
        missing: runs the preprocessor on a file with the libraries so far; the headers it did not find.
    """
    used: list[CompiledLibrary] = []
    waiting = list(sources)
    while waiting:
        source = waiting.pop(0)
        while True:
            # One at a time: a library may bring the other headers with it.
            offers = (index.find(header) for header in missing(source, used))
            found = next((library for library in offers if library and library not in used), None)
            if found is None:
                break
            used.append(found)
            waiting += found.files(suffixes)
    return used


def read_files(rule: str) -> list[str]:
    """The files that a make rule names behind its target.

    Args:
        rule: `x.o: a.h b.h`, as a preprocessor prints the files it read. A blank behind 2N + 1 backslashes is N backslashes and
            that blank of a name, one behind 2N backslashes ends a name with N backslashes (GNU make).
    """
    text = rule.replace("\\\n", " ").partition(": ")[2] + " "
    names, name, done = [], "", 0
    for ending in re.finditer(r"(?<!\\)(\\*)(\s)", text):
        name += text[done : ending.start()] + "\\" * (len(ending[1]) // 2)
        done = ending.end()
        if len(ending[1]) % 2:
            name += ending[2]
        else:
            names.append(name)
            name = ""
    return [name.replace("$$", "$").replace("\\#", "#") for name in names if name]


def missing_headers(rule: str, cwd: Path) -> list[str]:
    """The headers that a make rule names and that are no files.

    Args:
        rule: see `read_files`.
        cwd: the folder that relative names are relative to.
    """
    return [name for name in read_files(rule) if not (cwd / name).is_file()]
