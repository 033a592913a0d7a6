"""Parts and libraries to recommendations: the shipped index of libraries, the knowledge about devices, and the rankers.

Here are the rankers that the registry offers, and the look-up of a library by name or by header with everything that
it depends on and offers. The index is opened once. How libraries are ranked is in `robosmi.recommend`; which recommendation
becomes an include is decided by the migration plan (flag, project file, history), never here.

Besides the index, the default ranker knows device tables, usual libraries, insignificant words and coefficients. The tables of
devices and of usual libraries of all data folders are used, a user's before the shipped ones, so an own entry is one line in an
own file. Of the other files only the first one found is used, as with all data.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Collection, Iterator
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec import Struct

from robosmi import inputs, resources
from robosmi.base.data_tables import DataTable
from robosmi.base.data_text import as_texts
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, UsageError, did_you_mean
from robosmi.project import default_text, read_data
from robosmi.recommend.architectures import ArchitectureFacts, LibrarySubstitute
from robosmi.recommend.decision import DecisionModel
from robosmi.recommend.device_ranker import DeviceRanker, Knowledge
from robosmi.recommend.index import Library, LibraryIndex
from robosmi.recommend.lexicon import Lexicon
from robosmi.recommend.ranking import Ranker
from robosmi.recommend.tokens import StopWords, plain, stem
from robosmi.transformations.knowledge.platforms.target_platform import target_facts

if TYPE_CHECKING:
    from robosmi.recommend.library_api import LibraryApi


_VERSION = re.compile(r"\s*\([^()]*\)\s*$")


class LibraryFacts(Struct, frozen=True):
    """A library as the plan needs it.

    Attributes:
        library: its own facts, as the index has them.
        dependencies: all libraries it depends on, directly or not; nearest first, each once, never itself.
        unknown: names that one of these declares and the index does not have.
    """

    library: Library
    dependencies: tuple[Library, ...]
    unknown: tuple[str, ...]

    @property
    def name(self) -> str:
        """The library's name."""
        return self.library.name

    @property
    def version(self) -> str:
        """Its version, or empty."""
        return self.library.version

    @property
    def header(self) -> str:
        """The bare name of the header that a sketch includes."""
        return self.library.header

    @property
    def architectures(self) -> tuple[str, ...]:
        """The processor architectures it declares; empty if it declares none."""
        return self.library.architectures

    @property
    def depends(self) -> tuple[str, ...]:
        """Names of all libraries it depends on, those that the index does not have last."""
        return (*(library.name for library in self.dependencies), *self.unknown)


def library_index(platform: str | None = None, project: Path | None = None) -> LibraryIndex:
    """The index of a target's libraries, opened once for each state of its files; with it those that the user has imported.

    Args:
        platform: folder of the platform in the repository; that of the default target if None.
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: there is none, or it is damaged.
    """
    platform = platform or default_library_platform()
    paths = [resources.find("platform_repo", f"{platform}/libraries/index.sqlite", project)]
    if (own := installed_index(platform)).is_file():
        paths.append(own)
    try:
        return _opened(tuple(paths), tuple(path.stat().st_mtime_ns for path in paths))
    except OSError as error:
        raise PlatformDataError(f"{paths[0]}: cannot be read: {error.strerror}", fix="install robosmi again") from error


def default_library_platform() -> str:
    """The platform whose libraries the default target uses.

    Raises:
        UsageError: the default target has none.
        PlatformDataError: its data is damaged.
    """
    facts = target_facts(default_text("migrate", "target"))
    if not facts.libraries:
        raise UsageError(f"the target '{facts.target}' has no libraries", fix="give the libraries' platform")
    return facts.libraries


def installed_index(platform: str) -> Path:
    """The user's own index of installed libraries, which `libraries import` writes. It need not exist."""
    return resources.user_data() / "platform_repo" / platform / "libraries" / "installed.sqlite"


@lru_cache(maxsize=4)
def _opened(paths: tuple[Path, ...], times: tuple[int, ...]) -> LibraryIndex:  # by time: a rebuilt index is opened anew
    if len(paths) == 1:
        return LibraryIndex(paths[0])
    from robosmi.recommend.index import LayeredIndex  # few have libraries of their own

    return LayeredIndex(paths)


def tfidf_ranker(platform: str | None = None, *, architecture: str | None = None, project: Path | None = None) -> Ranker:
    """The paper's ranker over a target's libraries; registered as ranker "tfidf".

    Args:
        platform: folder of the platform in the repository; that of the default target if None.
        architecture: the target's architecture as libraries name it (`avr`), for remarks; None for no remarks.
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: there is no index, or it is damaged.
    """
    from robosmi.recommend.tfidf_ranker import TfidfRanker  # the other ranker is the usual one

    return TfidfRanker(library_index(platform, project), architecture)


def device_ranker(platform: str | None = None, *, architecture: str | None = None, project: Path | None = None) -> DeviceRanker:
    """The default ranker over a target's libraries; registered as ranker "devices".

    Args:
        platform: folder of the platform in the repository; that of the default target if None.
        architecture: the target's architecture as libraries name it (`avr`); None if it does not matter.
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: there is no index, or a data file is damaged.
    """
    platform = platform or default_library_platform()
    index = library_index(platform, project)
    made = _device_ranker(index, device_knowledge(platform, project), architecture)
    refuse_unknown_usual(platform, made.libraries, project)
    return made


@lru_cache(maxsize=4)
def _device_ranker(index: LibraryIndex, knowledge: Knowledge, architecture: str | None) -> DeviceRanker:
    return DeviceRanker(index, knowledge, architecture)


def library_by_name(name: str, platform: str | None = None, project: Path | None = None) -> LibraryFacts:
    """The library of that name, letter for letter, else without regard to case if that is unique.

    Raises:
        UsageError: the index has none of that name.
    """
    return library_in(library_index(platform, project), name)


def library_in(index: LibraryIndex, name: str) -> LibraryFacts:
    """`library_by_name` for an index that is at hand."""
    found = index.library_named(name)
    if found is None:
        by_header = _offering(index, name)
        hint = f" (the header {name} belongs to '{by_header[0].name}')" if by_header else did_you_mean(name, index.names())
        raise UsageError(f"unknown library '{name}'{hint}", fix="give a library's name from the index")
    return _with_dependencies(index, found)


def library_api(name: str, platform: str | None = None, project: Path | None = None) -> LibraryApi:
    """What a library offers to a program: classes, methods, functions, constants; nothing where the index knows nothing of it.

    Raises:
        UsageError: the index has none of that name.
        PlatformDataError: the index is damaged.
    """
    from robosmi.recommend.library_api import LibraryApi

    index = library_index(platform, project)
    found = library_in(index, name).library
    return LibraryApi(found.name, found.version, index.api(found.id))


def libraries_by_header(file: str, platform: str | None = None, project: Path | None = None) -> tuple[Library, ...]:
    """The libraries that offer a header of that bare file name; empty if none does.

    Order: those that mean it to be included, then those that are named like it, then the more popular, then by name.
    """
    return _offering(library_index(platform, project), file)


def _offering(index: LibraryIndex, file: str) -> tuple[Library, ...]:
    found = [(header, index.library(header.library)) for header in index.headers_named(file)]
    found.sort(key=lambda pair: (not pair[0].main, not index.named[pair[0].id], -pair[1].copies, pair[1].id))
    return tuple(dict.fromkeys(library for _, library in found))


def _with_dependencies(index: LibraryIndex, start: Library) -> LibraryFacts:
    known: dict[str, Library] = {start.name: start}
    unknown: dict[str, None] = {}
    waiting = [start]
    for library in waiting:  # grows while it is walked: breadth first
        for declared in library.depends:
            name = _VERSION.sub("", declared)
            found = index.library_named(name)
            if found is None:
                unknown[name] = None
            elif found.name not in known:
                known[found.name] = found
                waiting.append(found)
    return LibraryFacts(start, tuple(waiting[1:]), tuple(unknown))


# ---- the default ranker's knowledge

_Files = tuple[tuple[Path, int], ...]

DEVICES = "parts/devices"
"""Folder of the tables of devices; `robosmi.recommend.lexicon` describes their format."""

ARCHITECTURES = "libraries/architectures.toml"
"""On which architectures libraries work: the file of a platform."""

USUAL = "libraries/usual.csv"
"""Table of a platform: device,libraries (apart by |, the most usual first)."""


def device_knowledge(platform: str, project: Path | None = None) -> Knowledge:
    """The knowledge for a target, read once for each state of its files.

    Args:
        platform: folder of the target in the platform repository.
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: a file is missing or damaged.
    """
    folders = list(resources.folders("platform_repo", project))
    tables = [path for folder in folders for path in sorted((folder / DEVICES).glob("*.csv"))]
    usual = [path for folder in folders if (path := folder / platform / USUAL).is_file()]
    single = [
        resources.find("platform_repo", f"{platform}/libraries/{name}", project) for name in ("words.toml", "decision.toml")
    ]
    facts = [path for folder in folders if (path := folder / platform / ARCHITECTURES).is_file()]
    return _knowledge(_states(tables), _states(usual), _states(single), _states(facts))


def _states(paths: list[Path]) -> _Files:
    return tuple((path, path.stat().st_mtime_ns) for path in paths)


@lru_cache(maxsize=4)
def _knowledge(tables: _Files, usual: _Files, single: _Files, facts: _Files) -> Knowledge:
    words, decision = (path for path, _ in single)
    stop = read_data(words)
    return Knowledge(
        stop=StopWords(*(frozenset(stem(each) for each in as_texts(stop.get(key, ()))) for key in ("makers", "common"))),
        lexicon=Lexicon(path for path, _ in tables),
        usual=_usual([path for path, _ in usual]),
        model=DecisionModel.from_data(read_data(decision)),
        architectures=_architecture_facts([path for path, _ in facts]),
    )


def architecture_facts(platform: str | None = None, project: Path | None = None) -> ArchitectureFacts:
    """On which architectures the libraries of a platform work, beyond what they declare.

    Raises:
        PlatformDataError: a file is damaged.
    """
    return device_knowledge(platform or default_library_platform(), project).architectures


def unsuitable(name: str, target: str, architecture: str, project: Path | None = None) -> str:
    """Why a library does not work on an architecture, with what to use there; empty if nothing speaks against it.

    Args:
        name: the library.
        target: folder of the platform whose libraries are meant; empty for a target without libraries.
        architecture: the architecture.
        project: the project folder; the current folder if None.
    """
    found = library_index(target, project).library_named(name) if target else None
    if found is None:
        return "the index of libraries has no such library" if target else "the target has no libraries"
    objection = architecture_facts(target, project).objection(found, architecture)
    return f"{found.name} {objection}" if objection else ""


def _architecture_facts(paths: list[Path]) -> ArchitectureFacts:
    """The facts of the files; those of the first one go before."""
    brings: dict[str, frozenset[str]] = {}
    instead: dict[str, dict[str, LibrarySubstitute]] = {}
    home = ""
    for path in reversed(paths):
        file = DataTable.read(path)
        for key in file.values:
            if key not in ("home", "brings", "instead"):
                raise file.error(key, f"is no key of it{did_you_mean(key, ('home', 'brings', 'instead'))}")
        home = file.text("home", home)
        for kind, needed in (("brings", ("libraries",)), ("instead", ("library", "use", "why"))):
            for table in file.tables(kind, needed=False):
                known = ("architectures", "source", *needed)
                for key in table.values:
                    if key not in known:
                        raise table.error(key, f"is no key of it{did_you_mean(key, known)}")
                table.text("source")  # a fact without one is refused
                for architecture in table.texts("architectures"):
                    if kind == "brings":
                        brings[architecture] = brings.get(architecture, frozenset()) | {*table.texts("libraries")}
                    else:
                        found = LibrarySubstitute(table.text("use"), table.text("why"))
                        instead.setdefault(architecture, {})[table.text("library")] = found
    return ArchitectureFacts(brings, instead, home)


def refuse_unknown_usual(platform: str, libraries: Collection[str], project: Path | None = None) -> None:
    """Refuse a library that a table of the user's own calls usual and that the index does not have.

    The built-in table may name libraries that another index lacks.

    Args:
        platform: folder of the target in the platform repository.
        libraries: the names of all libraries of the index.
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: there is such a library, at its line, or a table is damaged.
    """
    for folder in resources.folders("platform_repo", project):
        path = folder / platform / USUAL
        if folder == resources.built_in("platform_repo") or not path.is_file():
            continue
        for _, names, place in _rows(path):
            if missing := [name for name in names if name not in libraries]:
                raise PlatformDataError(
                    f"the index has no library '{missing[0]}'{did_you_mean(missing[0], libraries)}",
                    location=place,
                    fix="write a library's name from the index; robosmi recommend WORDS lists some",
                )


def _usual(paths: list[Path]) -> dict[str, tuple[str, ...]]:
    found: dict[str, tuple[str, ...]] = {}
    for path in paths:
        for device, libraries, _ in _rows(path):
            found.setdefault(device, libraries)
    return found


def _rows(path: Path) -> Iterator[tuple[str, tuple[str, ...], Location]]:
    """The lines of a table of usual libraries: a device, its libraries, and the place of the line."""
    try:
        with io.StringIO(inputs.read_bytes(path, inputs.DATA).decode(), newline="") as lines:
            table = csv.reader(lines, strict=True)
            for row in table:
                if row and table.line_num > 1:
                    yield *_row(row, place := Location(str(path), table.line_num)), place
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise PlatformDataError(
            f"the table of usual libraries cannot be read: {error}", location=Location(str(path)), fix="correct it"
        ) from error


def _row(row: list[str], place: Location) -> tuple[str, tuple[str, ...]]:
    libraries = tuple(name.strip() for name in row[-1].split("|") if name.strip())
    if len(row) != 2 or not plain(row[0]) or not libraries:
        raise PlatformDataError("this line has no device with its libraries", location=place, fix="write device,library|library")
    return plain(row[0]), libraries
