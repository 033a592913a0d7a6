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

from robosmi.errors import ModelError
from robosmi.model.elements.compact_slots import prepare
from robosmi.model.elements.ecore import EAttribute, EObject, EReference
from robosmi.model.elements.feature_errors import REFUSAL
from robosmi.model.elements.fragments import fragment_of, own_id, resolve
from robosmi.model.elements.home import home_of
from robosmi.model.elements.structure import root_of

_PLACE = "_proxy"
AS_READ = "_as_read"
"""Field of an element: its links whose own text is kept, by feature and the identity of their targets."""
_ABSOLUTE = re.compile("[A-Za-z][A-Za-z0-9+.-]*:|/")
_FILE = re.compile("file:(?://[^/]*)?(?=/)", re.IGNORECASE)


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
    as_proxy(made, uri, folder)
    made.__dict__[REFUSAL] = _refusal
    return made


def as_proxy(element: EObject, uri: str, folder: Path) -> None:
    """Let an element stand for one that was not found; see `new_proxy`."""
    element.__dict__[_PLACE] = _Place(uri, folder, "#" not in uri.strip("#"))


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


def address_of(element: EObject) -> str:
    """Where a proxy leads, the same however the place of its file is written."""
    place: _Place = element.__dict__[_PLACE]
    path, mark, fragment = _FILE.sub("", place.uri).partition("#")
    if place.is_local or not path or (_ABSOLUTE.match(path) and not path.startswith("/")):
        return place.uri
    return f"{os.path.realpath(os.path.join(place.folder, unquote(path)))}{mark}{fragment}"


def preserve_link(owner: EObject, key: str, target: EObject, link: EObject | None, is_fixed: bool) -> None:
    """Note that an element's reference to a target is written as the file has it, as long as it leads there.

    Args:
        owner: the element that refers.
        key: the key of the reference's slot.
        target: what was found for the reference.
        link: the proxy that would stand for it, had it not been found; None if only the other side's file says it.
        is_fixed: whether the fragment says nothing about the target's place, as a hook made of it what it likes.
    """
    kept = owner.__dict__.setdefault(AS_READ, {})
    kept[key, id(target)] = [target, link, is_fixed]  # the target is held, so that its id stays its own


def as_read(owner: EObject, key: str, target: EObject) -> EObject | None:
    """What is written as the target of an element's reference: itself if no link to it is kept, None if nothing is."""
    noted = owner.__dict__.get(AS_READ, {}).get((key, id(target)))
    if noted is None:
        return target
    if not noted[2] and not _leads_to(uri := proxy_uri(noted[1]) or "", target):  # it has moved in its file
        place: _Place = noted[1].__dict__[_PLACE]
        moved = f"{uri.partition('#')[0]}#{fragment_of(target, _roots(target))}"
        noted[1] = new_proxy(type(noted[1]).__mro__[1], moved, place.folder)
    found: EObject | None = noted[1]
    return found


def _leads_to(uri: str, target: EObject) -> bool:
    fragment = uri.partition("#")[2]
    if not fragment.startswith("/"):
        return own_id(target) in (fragment, unquote(fragment))
    try:
        return resolve(fragment, _roots(target)) is target
    except ModelError:
        return False


def _roots(target: EObject) -> list[Any]:
    outermost = root_of(target)
    home = home_of(outermost)
    return list(home.contents) if home is not None else [outermost]


@cache
def _class(cls: Any) -> Any:
    """The class of proxies for elements of a class; being a subclass, they are accepted wherever it is."""
    quiet: Any = type("Quiet", (cls.__class__,), {"__init__": type.__init__})  # it becomes part of no metamodel
    made = quiet(cls.__name__, (cls,), {"__repr__": _shown, "__setattr__": _set, "__module__": cls.__module__})
    prepare(made)
    return made


def _set(self: EObject, name: str, value: object) -> None:
    feature = getattr(type(self), name, None)
    is_link = isinstance(feature, EReference) and not feature.containment and feature.eOpposite is not None
    if isinstance(feature, (EAttribute, EReference)) and not is_link:
        raise _refusal(self, name)
    super(type(self), self).__setattr__(name, value)


def _refusal(self: EObject, name: str) -> ModelError:
    return ModelError(
        f"{self!r} stands for an element that was not found, so '{name}' cannot be set",
        fix="let the reference lead to an element of a file that is there",
    )


def _shown(self: EObject) -> str:
    return f"<{type(self).__name__} proxy {proxy_uri(self)!r}>"
