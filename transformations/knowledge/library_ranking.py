"""Parts and libraries to recommendations: the shipped index of libraries, opened once, and asked.

Here are the rankers that the registry offers, and the look-up of a library by name or by header with everything that
it depends on and offers. How libraries are ranked is in `robosmi.recommend`; which recommendation becomes an include is decided
by the migration plan (flag, project file, history), never here.
"""

from __future__ import annotations

import re
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec import Struct

from robosmi import resources
from robosmi.errors import PlatformDataError, UsageError, did_you_mean
from robosmi.project import default_text
from robosmi.recommend.device_ranker import DeviceRanker, Knowledge
from robosmi.recommend.index import Library, LibraryIndex
from robosmi.recommend.ranking import Ranker
from robosmi.transformations.knowledge.device_knowledge import device_knowledge, refuse_unknown_usual
from robosmi.transformations.knowledge.target_platform import target_facts

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
        raise UsageError(f"the target '{facts.target}' has no libraries", fix="name the platform that the libraries are for")
    return facts.libraries


def installed_index(platform: str) -> Path:
    """The user's own index of installed libraries, which `libraries import` writes. It need not exist."""
    return resources.user_data() / "platform_repo" / platform / "libraries" / "installed.sqlite"


@lru_cache(maxsize=4)
def _opened(paths: tuple[Path, ...], times: tuple[int, ...]) -> LibraryIndex:  # by time: a rebuilt index is opened anew
    if len(paths) == 1:
        return LibraryIndex(paths[0])
    from robosmi.recommend.layered_index import LayeredIndex  # few have libraries of their own

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
        raise UsageError(f"no library is called '{name}'{hint}", fix="give the name of a library as the index has it")
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
