"""Which registered reader reads a file: by its ending, and where that says nothing or too much, by what the file begins with.

Endings are data (`[readers]` of defaults.toml, a name or a list of names); what a file begins with is told by recognisers that
drawing readers bring along. Nothing is read here but the first bytes of a file whose ending does not decide.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.plugins import content, registry
from robosmi.project import defaults

DRAWING = "drawing reader"
"""The registry's kind of readers of drawings."""

RECOGNISER = "drawing recogniser"
"""The registry's kind of functions, by reader, that tell from a file's first bytes whether it is of that form."""

HEAD = 4096
"""Bytes that a recogniser is given; fewer where the file has fewer."""


def reader_for(path: Path, kind: str, fallback: str | None = None) -> Any:
    """The registered reader for a file.

    Args:
        path: the file.
        kind: `program reader` or `drawing reader`.
        fallback: the reader's name for endings nobody knows; None to refuse them.

    Raises:
        SourceError: no reader of that kind takes such a file.
    """
    named = _by_ending(path, kind)
    if len(named) != 1 and kind == DRAWING:
        named = _recognised(path, named or registry().names(kind)) or named[:1]
    unknown = path.suffix.lower() not in defaults()["readers"]  # that of another kind of reader is refused
    name = named[0] if named else fallback if unknown else None
    if name is None:
        known = registry().names(kind)
        endings = ", ".join(sorted(ending for ending, names in defaults()["readers"].items() if {*_listed(names)} & {*known}))
        raise SourceError(
            f"no {kind} takes a '{path.suffix or path.name}' file", location=Location(str(path)), fix=f"give one of: {endings}"
        )
    return content(kind, name)


def is_drawing(path: Path) -> bool:
    """Whether a file is a drawing: by its ending, or by what it begins with where the ending is that of no model either."""
    if _by_ending(path, DRAWING):
        return True
    return path.suffix.lower() not in registry().names("driver") and bool(_recognised(path, registry().names(DRAWING)))


def _by_ending(path: Path, kind: str) -> list[str]:
    return [name for name in _listed(defaults()["readers"].get(path.suffix.lower(), ())) if name in registry().names(kind)]


def _listed(names: Any) -> list[str]:
    return [names] if isinstance(names, str) else [*names]


def _recognised(path: Path, names: list[str]) -> list[str]:
    """The readers that take a file by what it begins with; none where it cannot be read, which its reader says better."""
    try:
        with inputs.open_file(path) as stream:
            head = stream.read(HEAD)
    except (OSError, ValueError):
        return []
    found = []
    for name in names:
        if name in registry().names(RECOGNISER):
            recognises: Callable[[bytes], bool] = content(RECOGNISER, name)
            if recognises(head):
                found.append(name)
    return found
