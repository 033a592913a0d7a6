"""What RoboSMi leans on in pyecore that pyecore does not promise: its private fields, and how values lie in its elements.

No other module reads or writes a private name of pyecore's; a structure test holds that. `tests/model/pyecore_contract.py` says
for any version of pyecore which of the facts below hold there. Nothing is decided here: how elements are built without empty
containers is `compact_slots`'s part.

The facts, in the order of this module:

- An element keeps in its `__dict__` its container, the feature that contains it, its resource, its xmi:id, the features that
  were set and the inverse references (pairs of element and feature) of references without opposite.
- The slot of a feature is the entry of that `__dict__` under the feature's key, which is made when the feature is first read.
- A slot holds an `EValue` or a collection. Reading a feature calls `_get` of what lies in the slot and takes anything without
  that method for the value itself; assigning calls `_set`.
- Unique collections are an `OrderedSet`: a list `items`, and a dictionary `map` from item to position.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from operator import attrgetter, methodcaller
from typing import TYPE_CHECKING, Any, TypeGuard

from pyecore.innerutils import InternalSet

from robosmi.model.elements.ecore import (
    Argument,
    DynamicEObject,
    EClassifier,
    EObject,
    EReference,
    EStructuralFeature,
    EValue,
    Listener,
    ReadResource,
    Resource,
    Scalar,
)

if TYPE_CHECKING:
    from types import ModuleType

    class Features(dict[EStructuralFeature, None]):
        """Features in the order in which they were added."""

        def add(self, feature: EStructuralFeature) -> None:
            """Append a feature, unless it is present."""


CONTAINER = "_container"
"""Field of an element: its container, or None."""
CONTAINING_FEATURE = "_containment_feature"
"""Field of an element: the feature of its container that holds it, or None."""
RESOURCE = "_eresource"
"""Field of an element: the resource whose root it is, or None."""
IDENTITY = "_internal_id"
"""Field of an element: its xmi:id, or None."""
SET_FEATURES = "_isset"
"""Field of an element: the features that were given a value."""
INVERSE_REFERENCES = "_inverse_rels"
"""Field of an element: pairs of an element and its feature that refer to this one and have no opposite."""
FIRST_LISTENERS = "_eternal_listener"
"""Field of elements and resources: the listeners notified before `listeners`."""
IS_STATIC = "_staticEClass"
"""Field of a class: whether it was generated, and is not changed when its EClass is."""
FIELDS = frozenset(
    {
        CONTAINER, CONTAINING_FEATURE, RESOURCE, IDENTITY, SET_FEATURES, INVERSE_REFERENCES, FIRST_LISTENERS, IS_STATIC,
        "_instances",
    }
)  # fmt: skip
"""Private names that every element has for itself: no feature may have one of them as its Python name."""
ASSIGN = "_set"
"""Name of the method of a slot that assigns."""


def _reader(field: str) -> Callable[[Any], Any]:
    """A function, implemented in C, that reads a field; its result is documented where it is used."""
    return attrgetter(field)


container_of: Callable[[EObject], DynamicEObject | None] = _reader(CONTAINER)
"""The container of an element, or None; `eContainer()` without the call."""
containing_feature_of: Callable[[EObject], EReference | None] = _reader(CONTAINING_FEATURE)
"""The feature of its container that holds an element, or None."""
own_resource_of: Callable[[EObject], Resource | None] = _reader(RESOURCE)
"""The resource whose root an element is, or None; `eResource` is that of the outermost container."""
xmi_id_of: Callable[[EObject], str | None] = _reader(IDENTITY)
"""The xmi:id of an element, or None."""
set_features_of: Callable[[EObject], Features] = _reader(SET_FEATURES)
"""The features of an element that were given a value, as the keys of a dictionary."""
inverse_references_of: Callable[[EObject], set[tuple[EObject, EStructuralFeature]]] = _reader(INVERSE_REFERENCES)
"""The pairs of an element and its feature without opposite that refer to an element."""
first_listeners_of: Callable[[EObject], list[Listener | EObject]] = _reader(FIRST_LISTENERS)
"""The listeners of an element that are notified first."""
key_of: Callable[[EStructuralFeature], str] = _reader("_name")
"""The key of a feature's slot: the feature's name, or another one if that is taken."""
declared_type_of: Callable[[EStructuralFeature], EClassifier | None] = _reader("_eType")
"""The `eType` of a feature as it was declared, a proxy unresolved; None if it has a generic type."""
value_in: Callable[[EValue], Scalar] = _reader("_value")
"""The value that an `EValue` holds."""
target_in: Callable[[EValue], EObject | None] = _reader("_value")
"""The element that an `EValue` of a reference holds."""
read: Callable[[Any], Any] = methodcaller("_get")
"""The value of a slot, or the collection in it."""
proxied: Callable[[EObject], Any] = _reader("_wrapped")
"""The element that a resolved proxy stands for."""
proxy_place: Callable[[EObject], tuple[str, ReadResource | None]] = attrgetter("_proxy_path", "_proxy_resource")
"""The URI of a proxy, and the resource that resolves it."""

FeatureSet: type = InternalSet
"""Class of the features that were set: a dictionary from feature to None, with `add`."""


def is_element(value: Any) -> TypeGuard[Any]:
    """Whether a value is an element with fields of its own: no unresolved proxy, no package that is a Python module."""
    return hasattr(value, SET_FEATURES)


def is_value(slot: Any) -> TypeGuard[EValue]:
    """Whether a slot holds one value, and no collection."""
    return hasattr(slot, "_value")


def is_static(cls: type) -> bool:
    """Whether a class was generated."""
    return getattr(cls, IS_STATIC, False) is True


def set_slot(holder: EValue, value: Argument) -> None:
    """Store a value in an `EValue` without check and notification."""
    held: Any = holder
    held._value = value


def contain(element: Any, container: EObject | ModuleType, feature: EStructuralFeature) -> None:
    """Set the container of an element (for a generated class, the module of its package) without changing the container."""
    element._container = container
    element._containment_feature = feature


def set_key(feature: Any, key: str) -> None:
    """Give a feature's slot another key than its name."""
    feature._name = key


_FIELDS = {"name": "_name", "eType": "_eType", "upperBound": "_many_cache"}
"""Attribute of a feature -> the field that follows it, which pyecore sets when it is notified."""


def update_field(feature: EStructuralFeature, key: str, value: Argument) -> None:
    """Update the field of a feature that follows the attribute of that key, if there is one."""
    if key in _FIELDS:
        setattr(feature, _FIELDS[key], not 0 <= value <= 1 if isinstance(value, int) else value)


def set_own_resource(element: Any, resource: Any) -> None:
    """Make an element a root of a resource, or of none."""
    element._eresource = resource


def set_xmi_id(element: Any, identity: str | None) -> None:
    """Give an element an xmi:id."""
    element._internal_id = identity


def empty_ordered_set(collection: Any) -> None:
    """Make an ordered set that was made without its constructor ready for use."""
    collection.items = []
    collection.map = {}


def add_silently(collection: Any, value: Scalar) -> bool:
    """Add a value at the end of a collection, without check, opposite and notification.

    Returns:
        False if the collection takes each value once and has this one.
    """
    if isinstance(collection, list):
        list.append(collection, value)
        return True
    if value in collection.map:
        return False
    collection.map[value] = len(collection.items)
    collection.items.append(value)
    return True


def fill_ordered_set(collection: Any, values: Iterable[Scalar]) -> None:
    """Add values to an empty ordered set, without check, opposite and notification."""
    collection.map = positions = dict.fromkeys(values)
    collection.items = [*positions]
    positions.update(zip(collection.items, range(len(positions)), strict=True))


def fill_silently(collection: Any, values: Sequence[Scalar]) -> None:
    """Set the content of a collection without check, opposite and notification."""
    if isinstance(collection, list):
        list.clear(collection)
        list.extend(collection, values)
        return
    collection.items[:] = values
    collection.map.clear()
    collection.map.update((value, place) for place, value in enumerate(values))


class Slot:
    """Base of what lies in a slot and is neither an `EValue` nor a collection of pyecore's."""

    __slots__ = ()

    def _get(self) -> Any:
        return self.read()

    def _set(self, value: Any, update_opposite: bool = True) -> None:
        self.assign(value)

    def read(self) -> Any:
        """The value; called whenever the feature is read."""
        raise NotImplementedError

    def assign(self, value: Any) -> None:
        """Called when the feature is assigned."""
        raise NotImplementedError


class GuardedValue(EValue):
    """A holder of one value with an assignment method of its own."""

    def _set(self, value: Any, update_opposite: bool = True) -> None:
        self.assign(value)

    def assign(self, value: Any) -> None:
        """Called when the feature is assigned."""
        raise NotImplementedError


class ListenedTo:
    """The attribute that pyecore's notifications need of a resource: its listeners."""

    def __init__(self, listeners: list[Any]) -> None:
        self.listeners = listeners
        self._eternal_listener: list[Any] = []
