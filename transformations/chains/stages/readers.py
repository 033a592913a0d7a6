"""Selects the registered reader for a file: a drawing by its content, a program by its ending.

Endings are data (`[readers]` of defaults.toml, a name or a list of names; entries for whole file names take precedence).
Recognisers that come with the drawing readers examine the first bytes of a file. The ending of a drawing determines which of
them is asked first, and which reader refuses a file that none recognises.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Final

from robosmi import inputs
from robosmi.base.data_text import Json, as_texts
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, SourceError, did_you_mean
from robosmi.model.xmi.text_forms import is_json, names_classes
from robosmi.plugin_contracts import ContentFunction, ContentKind
from robosmi.plugins import content, registry
from robosmi.project import defaults, defaults_place

DRAWING: Final = "drawing reader"
"""The registry's kind of readers of drawings."""

PROGRAM: Final = "program reader"
"""The registry's kind of readers of programs."""

RECOGNISER: Final = "drawing recogniser"
"""The registry's kind of functions, by reader, that tell from a file's first bytes whether it is of that form."""

HEAD = 4096
"""Bytes that a recogniser is given; fewer where the file has fewer."""


def reader_for(path: Path, kind: ContentKind, fallback: str | None = None) -> ContentFunction:
    """The registered reader for a file.

    Args:
        path: the file.
        kind: `program reader` or `drawing reader`.
        fallback: the reader's name for endings nobody knows; None to refuse them.

    Raises:
        SourceError: no reader of that kind takes such a file.
    """
    named = _by_ending(path, kind)
    _check_names(path)
    if kind == DRAWING:
        named = _recognised(path, named) or named
    unknown = path.suffix.lower() not in defaults()["readers"]  # that of another kind of reader is refused
    name = named[0] if named else fallback if unknown else None
    if name is None:
        known = registry().names(kind)
        endings = ", ".join(sorted(ending for ending, names in defaults()["readers"].items() if {*_listed(names)} & {*known}))
        raise SourceError(
            f"no {kind} for '{path.suffix or path.name}' files", location=Location(str(path)), fix=f"give one of: {endings}"
        )
    return content(kind, name)


def is_drawing(path: Path) -> bool:
    """Whether a file is a drawing: by its ending, or, if the ending is not a model's either, by its content.

    A file with a drawing's ending that names the classes of its elements, as models in JSON do, is a model.
    """
    if _by_ending(path, DRAWING):
        return not (is_json(path) and names_classes(_head(path)))
    return path.suffix.lower() not in registry().names("driver") and bool(_recognised(path, []))


def _by_ending(path: Path, kind: ContentKind) -> list[str]:
    readers = defaults()["readers"]
    named = readers.get(path.name.lower(), readers.get(path.suffix.lower(), ()))
    return [name for name in _listed(named) if name in registry().names(kind)]


def _check_names(path: Path) -> None:
    """Raise an error if the data name a reader for the file's ending that is not registered."""
    known = {*registry().names(PROGRAM), *registry().names(DRAWING)}
    for key in (path.name.lower(), path.suffix.lower()):
        for name in _listed(defaults()["readers"].get(key, ())):
            if name not in known:
                raise PlatformDataError(
                    f"unknown reader '{name}' for '{key}'{did_you_mean(name, known)}",
                    location=Location(str(defaults_place("readers", key))),
                    fix=f"use one of: {', '.join(sorted(known))}",
                )


def _listed(names: Json) -> list[str]:
    return [names] if isinstance(names, str) else as_texts(names)


def _recognised(path: Path, first: list[str]) -> list[str]:
    """The drawing readers that recognise a file's content, the preferred ones first; empty if the file cannot be read."""
    head = _head(path)
    if not head:
        return []
    others = [name for name in registry().names(DRAWING) if name not in first]
    return _recognising(first, head) or _recognising(others, head)  # the others' modules are loaded only if they are needed


def _head(path: Path) -> bytes:
    """The first bytes of a file; none if it cannot be read."""
    try:
        return inputs.read_bytes(path, inputs.DRAWING)[:HEAD]  # whole, so that its reader need not open it again
    except (OSError, ValueError):
        return b""


def _recognising(names: list[str], head: bytes) -> list[str]:
    found = []
    for name in names:
        if name in registry().names(RECOGNISER):
            recognises: Callable[[bytes], bool] = content(RECOGNISER, name)
            if recognises(head):
                found.append(name)
    return found
