"""What two models are compared by: the features that a file would have, the ids and keys of elements, digests of contents."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Sequence
from pathlib import Path, PurePath
from typing import Any

from robosmi.base.data_text import Json
from robosmi.model.elements import ecore
from robosmi.model.elements.by_name import feature_value
from robosmi.model.elements.ecore import EClass, EObject
from robosmi.model.elements.feature_values import is_stored
from robosmi.model.elements.features import is_of_ecore, opposite
from robosmi.model.elements.fragments import fragment_of, own_id
from robosmi.model.elements.home import home_of
from robosmi.model.elements.proxies import address_of, proxy_uri, uri_from
from robosmi.model.elements.structure import root_of, walk
from robosmi.model.emf import EmfModel
from robosmi.model.xmi.ecore_writer import FEATURES
from robosmi.model.xmi.xmi_layout import CHILDREN, DETAILS, LINKS, VALUE, VALUES, Column, Layouts
from robosmi.model.xmi.xmi_locations import Unplaced, metamodel_uri

NAME = "name"
"""The attribute that is the key of an element where its container's reference declares none (eKeys)."""


class Facts:
    """One of the two models, with what its elements are compared by; the model must not change meanwhile.

    Args:
        model: the model.
    """

    def __init__(self, model: EmfModel) -> None:
        self.model = model
        self.roots: list[EObject] = list(model.roots)
        self.shared_ids: set[str] = set()
        """Ids by which nothing is matched, since several elements of one of the models have them."""
        for root in self.roots:
            if (home := home_of(root)) is not None:
                self.shared_ids.update(home.shared_ids)
        self._ends: dict[str, str] = {}
        self.elements: list[EObject] = [element for root in self.roots for element in walk(root)]
        self.inside = {id(element) for element in self.elements}
        self._layouts = Layouts()
        self._columns: dict[type, list[Column]] = {}
        self._types: dict[EClass, str] = {}
        self._containers: dict[int, tuple[EObject | None, str, int]] = {}
        for container in (None, *self.elements):
            for name, children in self.children(container):
                self._containers.update((id(child), (container, name, index)) for index, child in enumerate(children))
        self._digests: dict[int, int] = {}

    def columns(self, element: EObject) -> list[Column]:
        """The features of an element's class that a file has."""
        cls = element.__class__
        found = self._columns.get(cls)
        if found is None:
            found, eclass = self._layouts.of(element).columns, element.eClass
            if is_of_ecore(eclass) and eclass.name in FEATURES:  # pyecore has more features than Ecore
                names = {name for name, *_ in FEATURES[eclass.name]}
                found = [column for column in found if column.name in names]
            self._columns[cls] = found
        return found

    def type_of(self, element: EObject) -> str:
        """The class of an element, the same in two copies of its metamodel."""
        eclass = element.eClass
        found = self._types.get(eclass)
        if found is None:
            try:
                found = metamodel_uri(eclass)
            except Unplaced:
                found = str(eclass.name)
            self._types[eclass] = found
        return found

    def values(self, element: EObject, column: Column) -> list[Any]:
        """What a feature has, as a list: its values, the elements it contains or refers to, the pairs of an annotation."""
        value: Any = feature_value(element, column.key)
        if column.kind == DETAILS:
            return sorted((str(key), text) for key, text in (value or {}).items())
        if column.many:
            return list(value)
        return [] if value is None else [value]

    def children(self, element: EObject | None) -> Iterator[tuple[str, list[EObject]]]:
        """The features by which an element contains others, with these; for None the roots."""
        if element is None:
            yield "", self.roots
            return
        for column in self.columns(element):
            if column.kind == CHILDREN:
                yield column.name, [child for child in self.values(element, column) if id(child) in self.inside]

    def id_of(self, element: EObject) -> str | None:
        """The id of an element: its xmi:id, or the value of its class's ID attribute; None if others have it, too."""
        own = own_id(element)
        return own if own and own not in self.shared_ids else None

    def key_of(self, element: EObject) -> tuple[str, ...] | None:
        """The values of its key attributes: those that the reference to it declares, else its name; None if one is missing."""
        container = element.eContainer()
        reference = element.eContainmentFeature() if container is not None else None
        keys: list[Any] = list(reference.__dict__.get("eKeys") or ()) if reference is not None else []
        names = [str(key.name) for key in keys] or [NAME]
        known = {column.name: column for column in self.columns(element) if column.kind == VALUE and not column.many}
        texts: list[str] = []
        for name in names:
            values = self.values(element, known[name]) if name in known else []
            if not values or values[0] == "":
                return None
            texts.append(str(values[0]))
        return tuple(texts)

    def digest(self, element: EObject) -> int:
        """A number that is the same for elements with the same values and contents, and names at the ends of references."""
        if not self._digests:
            for one in reversed(self.elements):  # what is contained before what contains it
                self._digests[id(one)] = hash((self.type_of(one), *self._known(one)))
        return self._digests[id(element)]

    def facts(self, element: EObject) -> list[tuple[Any, ...]]:
        """What is known of an element on its own: each value, each name at the end of a reference, each part's digest."""
        self.digest(element)
        return self._known(element)

    def _known(self, element: EObject) -> list[tuple[Any, ...]]:
        found: list[tuple[Any, ...]] = []
        for column in self.columns(element):
            for value in self.values(element, column):
                if column.kind == CHILDREN:
                    found.append((column.name, self._digests.get(id(value), 0)))
                elif column.kind == LINKS:
                    found.append((column.name, self.type_of(value), str(feature_value(value, NAME)) if _is_named(value) else ""))
                elif column.kind != VALUE or value != column.default:
                    found.append((column.name, str(compared(column, value))))
        return found

    def know(self, others: Sequence[Facts]) -> None:
        """Match nothing by ids that several elements of another model have, and tell the same ends in other files by one key."""
        for other in others:
            self.shared_ids.update(other.shared_ids)
        self._ends = others[0]._ends

    def container_of(self, element: EObject) -> tuple[EObject | None, str]:
        """The container of an element and the feature that contains it; none for a root of the model."""
        return self._containers[id(element)][:2]

    # --- as the user reads it

    def position(self, element: EObject) -> str:
        """Where an element is: its container, the feature, and its index there."""
        container, name, index = self._containers[id(element)]
        return f"root {index}" if container is None else f"{self.place_of(container)} {name}[{index}]"

    def place_of(self, element: EObject) -> str:
        """The id or fragment of an element of the model."""
        return fragment_of(element, self.roots)

    def target(self, target: Any) -> str:
        """The end of a reference as the user reads it."""
        return self.place_of(target) if id(target) in self.inside else self.outside(target)

    def end(self, target: Any, owner: Facts) -> int | str:
        """The end of a reference of a model, or what it is matched with in this one: equal for the same end.

        Args:
            target: an element of this model, or one that has no partner here.
            owner: the model that has the reference.
        """
        if id(target) in self.inside:
            return id(target)
        return f"only {id(target)}" if id(target) in owner.inside else owner.outside_key(target)

    def outside(self, target: Any) -> str:
        """Where a target lies that is no element of the model: a URI, seen from the model's folder."""
        return self._outside(target)[0]

    def outside_key(self, target: Any) -> str:
        """What is equal for a target outside of the models that all of them mean: the same URI, or the same file and fragment."""
        text, address = self._outside(target)
        known = self._ends.get(text) or self._ends.get(address) or text
        self._ends.setdefault(text, known)
        self._ends.setdefault(address, known)
        return known

    def _outside(self, target: Any) -> tuple[str, str]:
        """The URI of a target, seen from the model's folder, and the same with the absolute path of its file."""
        folder = self.model.path.parent if self.model.path is not None else Path()
        if isinstance(target, ecore.EObject) and proxy_uri(target) is not None:
            return uri_from(target, folder), address_of(target)
        try:
            if isinstance(target, (type, ecore.EModelElement)):
                uri = metamodel_uri(target)
                return uri, uri
        except Unplaced:
            return repr(target), repr(target)
        root = root_of(target)
        home = home_of(root)
        roots: Sequence[EObject] = list(home.contents) if home is not None else [root]
        fragment = f"#{fragment_of(target, roots)}"
        if home is None or home.place is None:
            return fragment, fragment
        place = os.path.realpath(home.place)
        return f"{PurePath(os.path.relpath(place, os.path.realpath(folder))).as_posix()}{fragment}", f"{place}{fragment}"


def plain(column: Column, value: Any) -> Json:
    """A value as JSON has it; of a type that JSON lacks the text of a file."""
    return value if isinstance(value, float) and math.isfinite(value) else compared(column, value)


def compared(column: Column, value: Any) -> Json:
    """What is equal for equal values: as JSON has it, but for numbers with a fraction the text of a file (0.0 is not -0.0)."""
    if value is None or isinstance(value, (bool, int, str)):
        return value
    if column.kind == DETAILS:
        return [str(value[0]), None if value[1] is None else str(value[1])]
    try:
        return str(column.convert(value))
    except ValueError:
        return repr(value)


def is_compared(column: Column) -> bool:
    """Whether a feature is one that has values or references, not contents."""
    return column.kind in (VALUE, VALUES, LINKS, DETAILS)


def follows(column: Column) -> bool:
    """Whether a reference is the opposite of one that says the same in fewer values; only its order is its own."""
    other = opposite(column.feature)
    if column.kind != LINKS or other is None or other is column.feature or other.transient:
        return False
    if other.derived and not is_stored(other):
        return False
    if column.many != other.many:
        return column.many
    return bool(
        (str(column.name), str(column.feature.eContainingClass.name)) > (str(other.name), str(other.eContainingClass.name))
    )


def _is_named(element: Any) -> bool:
    return isinstance(getattr(element, NAME, None), str)
