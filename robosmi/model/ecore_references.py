"""The .ecore files that metamodels consist of: those that are named, and those that these refer to, however far."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path

from robosmi.errors import SourceError
from robosmi.model.ecore_description import Package
from robosmi.model.ecore_files import EcoreFile, EcoreFiles

_REFERRING = ("eClassifier", "eExceptions", "eKeys", "eOpposite", "eRawType", "eSuperTypes", "eType", "eTypeParameter", "href")
"""The attributes of a node that hold references."""


def files_of(paths: Iterable[Path]) -> list[Path]:
    """The files of metamodels, each once: the given ones in order, then those that they refer to.

    A file that cannot be read refers to nothing; whoever loads it is told.
    """
    files = EcoreFiles()
    found: dict[Path, Path] = {}
    pending = list(paths)
    while pending:
        path = pending.pop(0)
        if (place := Path(os.path.realpath(path))) in found:
            continue
        found[place] = path
        try:
            pending += _referred(files.load(path), files)
        except (SourceError, OSError):
            continue
    return list(found.values())


def _referred(file: EcoreFile, files: EcoreFiles) -> list[Path]:
    """The files that one refers to."""
    led: dict[Path, None] = {}
    for uri in dict.fromkeys(_uris(file)):
        try:
            there = files.find(uri, file)
        except (SourceError, OSError):
            continue
        if there is not None and not isinstance(there, Package):
            led[there[0].path] = None
    return list(led)


def _uris(file: EcoreFile) -> Iterator[str]:
    for root in file.roots:
        for node in root.walk():
            for name in _REFERRING:
                for word in node.get(name).split():
                    uri, mark, _ = word.rpartition("#")
                    if mark and uri:
                        yield uri
