"""The addresses of elements in files: fragments (`//@units.0`), ids, hrefs to other files and to metamodels.

It follows EMF's rules: an xmi:id or the value of the ID attribute if there is one, else the path from the root. An id that EMF
could not read back in a reference (with a space, `#` or `:`, or beginning with `/`) is not used. Elements in no file are
reported to the writer.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Collection, Mapping, Sequence
from functools import lru_cache
from pathlib import Path, PurePosixPath
from typing import Any, TypeAlias
from urllib.parse import quote

from msgspec import Struct

from robosmi.errors import ModelError
from robosmi.model.elements import datatypes, ecore
from robosmi.model.elements.compact_slots import plain_value
from robosmi.model.elements.ecore import EClass, EModelElement, EObject, EPackage, EStructuralFeature, EValue, Scalar
from robosmi.model.elements.features import as_package, id_attribute, is_of_ecore, root_package
from robosmi.model.elements.fragments import segment
from robosmi.model.elements.home import home_of
from robosmi.model.elements.pyecore_internals import (
    container_of,
    containing_feature_of,
    is_value,
    key_of,
    own_resource_of,
    value_in,
    xmi_id_of,
)

_ODD_ID = re.compile(r"^/|^\?|[\s#:]|^$")
is_plain_id = re.compile(r"[A-Za-z0-9_.-]+").fullmatch
"""Whether a text is an id as nearly all are: an address as it is, and without markup."""
_NOT_IN_PATHS = re.compile(r"(?![A-Za-z0-9/_.!~*'()@=+$,;-])[\x00-\x9f]")  # as EMF's URI.createFileURI, but for & and :


Neighbour: TypeAlias = "Callable[[EObject], tuple[str, Sequence[EObject]] | None]"
"""A root -> the name of its file and all roots there, None where it has none."""


class Unplaced(Exception):
    """An element that is in none of the written files, or not where its container says."""


class UnusableId(ValueError):
    """An id that begins with `/`: EMF takes it for a way from the root."""


class XmiLocations:
    """Finds the place of any element of a set of models.

    Args:
        models: file name, relative to a common folder -> roots.
        folder: the folder that the names are relative to, for proxies.
        neighbour: finds the file of a root that is in none of these models, and adds it to them; None for none.
    """

    def __init__(
        self, models: Mapping[str, Sequence[EObject]], neighbour: Neighbour | None = None, folder: Path | None = None
    ) -> None:
        self.folder = folder
        self.names_more_types = True
        """Whether a proxy's type is written though the declared class has elements; a target's own never is, by EMF's rule."""
        self._neighbour = neighbour
        self._known: dict[int, tuple[str, str]] = {}
        self.roots: dict[int, str] = {}
        self.shared_ids: set[str] = set()
        """Ids that several elements have in a file that was read: the first one has it as its address, the others their paths."""
        self._roots_of: dict[str, Sequence[EObject]] = {}
        self._holders: dict[str, dict[str, EObject]] = {}
        self._ids: dict[type[EObject], _Identity | None] = {}
        self._steps: dict[EStructuralFeature, _Step] = {}
        self.nested = {id(root) for roots in models.values() for root in roots if root.eContainer() is not None}
        for name, roots in models.items():
            self._add(name, roots)

    def _add(self, name: str, roots: Sequence[EObject]) -> None:
        self._roots_of[name] = roots
        for index, root in enumerate(roots):
            if id(root) in self.roots:
                raise ModelError(
                    f"{shown(root)} is a root of '{self.roots[id(root)]}' and of '{name}'",
                    fix="keep it in one of these models",
                )
            self.roots[id(root)] = name
            if (home := home_of(root)) is not None:
                self.shared_ids.update(home.shared_ids)
            self._known[id(root)] = (name, f"/{index}" if len(roots) > 1 else "/")

    def retain(self, files: Collection[str]) -> None:
        """Forget the addresses in all files except these, whose elements have not moved when the models are written again."""
        roots = {key: place for key, place in self._known.items() if key in self.roots}
        self._known = roots | {key: place for key, place in self._known.items() if place[0] in files}
        self._holders.clear()

    def find(self, target: EObject) -> tuple[str, str]:
        """File and fragment of an element; the file is empty for what has a URI of its own, which is then the fragment.

        Raises:
            Unplaced: it is nowhere.
            UnusableId: its id cannot be one.
        """
        known = self._known.get(id(target))
        if known is None and (identified := self._by_id(target)) is not None:
            return identified
        file, way = known or self._way(target)
        identity = self.identity(target) if file and not isinstance(target, type) else None
        if identity in self.shared_ids and self._holder(file, str(identity)) is not target:
            return file, way
        return file, way if identity is None or _ODD_ID.search(identity) else identity

    def _by_id(self, target: EObject) -> tuple[str, str] | None:
        """File and id of a target whose container has a known address, or None: a path that is not written is not built."""
        container = container_of(target)
        around = self._known.get(id(container))
        if container is None or around is None or isinstance(target, (type, ecore.EModelElement)):
            return None
        identity, feature = xmi_id_of(target), containing_feature_of(target)
        if identity.__class__ is not str:
            identity = self.identity(target)
        if identity is None or feature is None or identity in self.shared_ids:
            return None
        if not is_plain_id(identity) and _ODD_ID.search(identity):
            return None
        step = self._steps.get(feature) or self._step_of(feature)
        slot = container.__dict__.get(step.key)
        if not step.is_plain or slot is None:
            return None
        index, items = slot.map.get(target, -1), slot.items
        return (around[0], identity) if 0 <= index < len(items) and items[index] is target else None

    def in_metamodel(self, element: EModelElement | type) -> tuple[str, str]:
        """File and fragment of an element of a metamodel: `//Class`, or `/1/Class` if the file has several packages.

        The file is empty if the outermost package is none of the models.

        Raises:
            Unplaced: it is in no package.
        """
        package, fragment = metamodel_place(element)
        file, root = self._known.get(id(package), ("", "/"))
        return file, fragment if root == "/" else f"{root}{fragment[1:]}"

    def identity(self, element: EObject) -> str | None:
        """The xmi:id of an element or the value of its ID attribute, or None."""
        own = xmi_id_of(element)
        if own is not None:
            return str(own)
        cls = element.__class__
        if cls not in self._ids:
            self._ids[cls] = _identity_of(element.eClass)
        known = self._ids[cls]
        slot = element.__dict__.get(known.key) if known is not None else None
        value = plain_value(slot) if slot is not None else None
        if known is None or value is None or value == known.default:
            return None
        identity = str(known.convert(value))
        if identity[:1] == "/":
            raise UnusableId(identity)
        return identity

    def _holder(self, file: str, identity: str) -> EObject | None:
        """The first element of a file that has an id which several have, in the order in which they are written."""
        holders = self._holders.get(file)
        if holders is None:
            holders = self._holders[file] = {}
            waiting = [*reversed(self._roots_of[file])]
            while waiting:
                one = waiting.pop()
                if (own := self.identity(one)) in self.shared_ids:
                    holders.setdefault(str(own), one)
                waiting += [each for each in reversed(list(one.eContents)) if self.roots.get(id(each), file) == file]
        return holders.get(identity)

    def _way(self, target: EObject) -> tuple[str, str]:
        """Climb to the nearest element with a known address, and store the addresses of all elements on the way back."""
        climbed: list[EObject] = []
        one = target
        while id(one) not in self._known:
            if isinstance(one, type) or (isinstance(one, ecore.EModelElement) and is_of_ecore(one.eClass)):
                file, fragment = self.in_metamodel(one)  # a metamodel that is one of the models has a file
                return file, fragment if file else metamodel_uri(one)
            if self._neighbour is not None and own_resource_of(one) is not None and (found := self._neighbour(one)):
                self._add(*found)
                continue
            climbed.append(one)
            container = container_of(one)
            if container is None or len(climbed) > 10_000_000:
                raise Unplaced
            one = container
        known = self._known
        file, way = known[id(one)]
        for child in reversed(climbed):
            feature = containing_feature_of(child)
            assert feature is not None  # what has a container lies in a feature of it
            step = self._steps.get(feature) or self._step_of(feature)
            slot = one.__dict__.get(step.key)
            if step.is_plain and slot is not None:
                index = slot.map.get(child, -1)
                items = slot.items
                if not 0 <= index < len(items) or items[index] is not child:  # pyecore's own map goes wrong after pop()
                    index = _index(items, child)
                way = f"{way}{step.text}{index}"
            else:
                way = f"{way}{step.text}{_rest(step, slot, child)}"
            if child is not target:  # whoever asks keeps that
                known[id(child)] = (file, way)
            one = child
        return file, way

    def _step_of(self, feature: EStructuralFeature) -> _Step:
        step = self._steps[feature] = _Step(feature)
        return step


class _Identity(Struct, frozen=True):
    """How the elements of a class tell their id: the key of its slot, what makes a text of the value, and the default."""

    key: str
    convert: datatypes.ToText
    default: Scalar


def _identity_of(eclass: EClass) -> _Identity | None:
    attribute = id_attribute(eclass)
    if attribute is None:
        return None
    kind = attribute.eType
    assert isinstance(kind, ecore.EDataType)
    return _Identity(key_of(attribute), datatypes.to_text(kind), datatypes.default(attribute, kind))


class _Step:
    """How a containment feature appears in a fragment: `/@units.` before the index."""

    __slots__ = ("is_plain", "key", "keys", "many", "text")

    def __init__(self, feature: EStructuralFeature) -> None:
        self.key = key_of(feature)
        self.many = feature.many
        self.keys: list[ecore.EAttribute] = list(feature.__dict__.get("eKeys") or ())  # which pyecore does not know
        self.is_plain = self.many and feature.unique and feature.ordered and not self.keys
        self.text = f"/@{feature.name}{'.' if self.many and not self.keys else ''}"


def shown(element: EObject | None) -> str:
    """An element as errors name it; pyecore's own classes only say where in memory it is."""
    text = repr(element)
    if " object at 0x" not in text:
        return text
    name = element.__dict__.get("name")
    value = value_in(name) if is_value(name) else name if isinstance(name, str) else None
    return f"<{type(element).__name__}{f' name={value!r}' if value is not None else ''}>"


def _rest(step: _Step, slot: EValue | Sequence[EObject] | None, child: EObject) -> str:
    """The part of a fragment after the feature's name, if it is not an index of an ordered set."""
    if not step.many:
        if slot is None or not is_value(slot) or value_in(slot) is not child:
            raise Unplaced
        return ""
    index = _index(list(slot) if isinstance(slot, Sequence) else [], child)
    if not step.keys:
        return str(index)
    pairs = [f"{key.name}='{quote(str(child.eGet(key)), safe='')}'" for key in step.keys]
    return f"[{','.join(pairs)}]"


def _index(items: list[EObject], child: EObject) -> int:
    """The place of a child among its siblings.

    Raises:
        Unplaced: it is not among them.
    """
    for index, one in enumerate(items):
        if one is child:
            return index
    raise Unplaced


def metamodel_uri(element: EModelElement | type) -> str:
    """The URI of an element of a metamodel, by the namespace of its outermost package: `http://lab/m#//Class/feature`.

    Raises:
        Unplaced: it is in no package, or its package has no namespace.
    """
    package, fragment = metamodel_place(element)
    if not package.nsURI:
        raise Unplaced
    return f"{package.nsURI}#{fragment}"


def metamodel_place(element: EModelElement | type) -> tuple[EPackage, str]:
    """The outermost package of an element of a metamodel, and its fragment in there: `//Class/feature`.

    Raises:
        Unplaced: it is in no package.
    """
    one: Any = getattr(element, "eClass", None) if isinstance(element, type) else element
    steps: list[str] = []
    while not isinstance(one, ecore.EPackage):
        container = one.eContainer()
        if container is None and one.name in ("EStringToStringMapEntry", "EFactory"):  # ours, since pyecore has none
            container = ecore.eClass
        if container is None:
            raise Unplaced
        steps.append(segment(str(one.name)))
        one = container
    package, root = as_package(one), root_package(one)
    while package is not root and package.eSuperPackage is not None:
        steps.append(segment(str(package.name)))
        package = as_package(package.eSuperPackage)
    return root, f"/{''.join(f'/{step}' for step in reversed(steps))}"


@lru_cache(maxsize=256)
def relative(source: str, target: str) -> str:
    """The URI of one file seen from another, both relative to the same folder."""
    folder = PurePosixPath(source).parent
    path = target if folder == PurePosixPath(".") else os.path.relpath(target, folder)
    return _NOT_IN_PATHS.sub(lambda m: quote(m.group(), safe=""), path)
