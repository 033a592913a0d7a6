"""Proxies: elements that stand for what a reference leads to and was not found, as in EMF; they are kept when a model is saved.

A proxy is of the type that the reference has, its features are empty, and `proxy_uri` says where it leads.
"""

from __future__ import annotations

import os
import re
from functools import cache
from pathlib import Path, PurePath
from typing import Any
from urllib.parse import quote, unquote

from msgspec import Struct

from robosmi.model.elements.compact_slots import prepare
from robosmi.model.elements.ecore import EObject

_PLACE = "_proxy"
_ABSOLUTE = re.compile("[A-Za-z][A-Za-z0-9+.-]*:|/")


class _Place(Struct, frozen=True):
    """Where a proxy leads: a URI, relative to a folder; whether it was a reference inside of one file."""

    uri: str
    folder: Path
    is_local: bool


def new_proxy(cls: type, uri: str, folder: Path) -> Any:
    """An element of a class that stands for one that was not found.

    Args:
        cls: the Python class of the elements that the reference takes.
        uri: the URI as the file has it.
        folder: the folder that it is relative to.
    """
    made = object.__new__(_class(cls))
    made.__dict__[_PLACE] = _Place(uri, folder, "#" not in uri.strip("#"))
    return made


def proxy_uri(element: EObject) -> str | None:
    """The URI of what a proxy stands for, as its file has it; None for any other element."""
    place: _Place | None = element.__dict__.get(_PLACE)
    return place.uri if place is not None else None


def is_local(element: EObject) -> bool:
    """Whether an element is a proxy for something of its own file."""
    place: _Place | None = element.__dict__.get(_PLACE)
    return place is not None and place.is_local


def uri_from(element: EObject, folder: Path | None) -> str:
    """The URI of a proxy, seen from another folder."""
    place: _Place = element.__dict__[_PLACE]
    path, mark, fragment = place.uri.partition("#")
    if folder is None or place.is_local or not path or _ABSOLUTE.match(path):
        return place.uri
    here = os.path.realpath(folder)
    if here == os.path.realpath(place.folder):
        return place.uri
    moved = PurePath(os.path.relpath(os.path.join(os.path.realpath(place.folder), unquote(path)), here)).as_posix()
    return f"{quote(moved, safe='/@!$&,;=+()~')}{mark}{fragment}"


@cache
def _class(cls: Any) -> Any:
    """The class of proxies for elements of a class; being a subclass, they are accepted wherever it is."""
    quiet: Any = type("Quiet", (cls.__class__,), {"__init__": type.__init__})  # it becomes part of no metamodel
    made = quiet(cls.__name__, (cls,), {"__repr__": _shown, "__module__": cls.__module__})
    prepare(made)
    return made


def _shown(self: EObject) -> str:
    return f"<{type(self).__name__} proxy {proxy_uri(self)!r}>"
