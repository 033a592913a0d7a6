"""Sketches: programs whose main files the platform's tools join to one text. Which files belong to one.

Source: Arduino CLI, "Sketch specification".
"""

from __future__ import annotations

import os

from msgspec import Struct

from robosmi.transformations.knowledge.api_data import SketchSettings

SOURCES = (".c", ".cc", ".cpp", ".cxx")
HEADERS = (".h", ".hh", ".hpp")


class SketchFiles(Struct, frozen=True):
    """The files of a sketch.

    Attributes:
        tabs: the joined files, in their order.
        sources: the other sources that are compiled with them.
        headers: the headers beside them, which are read for what they contain.
    """

    tabs: tuple[str, ...]
    sources: tuple[str, ...]
    headers: tuple[str, ...]

    @property
    def files(self) -> tuple[str, ...]:
        """All files, the tabs first."""
        return (*self.tabs, *self.sources, *self.headers)


def is_tab(path: str, settings: SketchSettings | None) -> bool:
    """Whether a file is one that the platform's tools join to others."""
    return settings is not None and path.lower().endswith(tuple(settings["endings"]))


def sketch_of(path: str, settings: SketchSettings) -> SketchFiles:
    """The sketch that a tab belongs to: all of its folder, and the sources below its folder `sources`.

    The first tab is the one with the folder's name, else the given one.
    """
    folder = os.path.dirname(path)
    beside = [os.path.join(folder, name) for name in _names(folder)]
    below = [
        os.path.join(at, name) for at, _, names in os.walk(os.path.join(folder, settings["sources"])) for name in sorted(names)
    ]
    tabs = [file for file in beside if is_tab(file, settings)]
    named = os.path.basename(os.path.abspath(folder))
    main = next((tab for tab in tabs if os.path.splitext(os.path.basename(tab))[0] == named), path)
    own = [*beside, *sorted(below)]
    return SketchFiles(
        (main, *(tab for tab in tabs if os.path.realpath(tab) != os.path.realpath(main))),
        tuple(file for file in own if file.lower().endswith(SOURCES)),
        tuple(file for file in own if file.lower().endswith(HEADERS)),
    )


def _names(folder: str) -> list[str]:
    """The names of a folder's visible files, in alphabetical order; none if it cannot be read, which the given file will tell."""
    try:
        names = os.listdir(folder or os.curdir)
    except OSError:
        return []
    return sorted(name for name in names if not name.startswith(".") and os.path.isfile(os.path.join(folder, name)))
