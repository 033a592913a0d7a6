"""The default ranker's knowledge besides the index: device tables, usual libraries, insignificant words, coefficients.

The tables of devices and of usual libraries of all data folders are used, a user's before the shipped ones, so an own entry is
one line in an own file. Of the other files only the first one found is used, as with all data.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Collection, Iterator
from functools import lru_cache
from pathlib import Path

from robosmi import inputs, resources
from robosmi.data_text import as_texts
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, did_you_mean
from robosmi.project import read_data
from robosmi.recommend.decision import DecisionModel
from robosmi.recommend.device_ranker import Knowledge
from robosmi.recommend.lexicon import Lexicon
from robosmi.recommend.words import StopWords, plain, stem

_Files = tuple[tuple[Path, int], ...]

DEVICES = "parts/devices"
"""Folder of the tables of devices; `robosmi.recommend.lexicon` describes their format."""

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
    return _knowledge(_states(tables), _states(usual), _states(single))


def _states(paths: list[Path]) -> _Files:
    return tuple((path, path.stat().st_mtime_ns) for path in paths)


@lru_cache(maxsize=4)
def _knowledge(tables: _Files, usual: _Files, single: _Files) -> Knowledge:
    words, decision = (path for path, _ in single)
    stop = read_data(words)
    return Knowledge(
        stop=StopWords(*(frozenset(stem(each) for each in as_texts(stop.get(key, ()))) for key in ("makers", "common"))),
        lexicon=Lexicon(path for path, _ in tables),
        usual=_usual([path for path, _ in usual]),
        model=DecisionModel.from_data(read_data(decision)),
    )


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
                    fix="write the name of a library as the index has it: robosmi recommend WORDS lists some",
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
        raise PlatformDataError("this line names no device and its libraries", location=place, fix="write device,library|library")
    return plain(row[0]), libraries
