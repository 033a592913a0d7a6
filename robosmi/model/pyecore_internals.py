"""What RoboSMi leans on in pyecore that pyecore does not promise: its private fields, and how values lie in its elements.

No other module reads or writes a private name of pyecore's; a structure test holds that. `tests/model/pyecore_contract.py` says
for any version of pyecore which of the facts below hold there. Nothing is decided here: how elements are built without empty
containers is `lean`'s part.

The facts, in the order of this module:

- An element keeps in its `__dict__` its container, the feature that contains it, its resource, its xmi:id, the features that
  were set and the inverse references (pairs of element and feature) of references without opposite.
- The slot of a feature is the entry of that `__dict__` under the feature's key, which is made when the feature is first read.
- A slot holds an `EValue` or a collection. Reading a feature calls `_get` of what lies in the slot and takes anything without
  that method for the value itself; assigning calls `_set`.
- Unique collections are an `OrderedSet`: a list `items`, and a dictionary `map` from item to position.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from operator import attrgetter, methodcaller
from typing import TYPE_CHECKING, Any, TypeGuard, TypeVar

from pyecore.innerutils import InternalSet

from robosmi.model.ecore import (
    Argument,
    DynamicEObject,
    EAttribute,
    EClass,
    EClassifier,
    EDataType,
    EObject,
    EReference,
    EStructuralFeature,
    EValue,
    Listener,
    ReadResource,
    Resource,
    Scalar,
    Value,
)
from robosmi.typed import attribute_of

F = TypeVar("F", bound=EObject)

if TYPE_CHECKING:

    class Features(dict[EStructuralFeature, None]):
        """Features in the order in which they were added."""

        def add(self, feature: EStructuralFeature) -> None:
            """Put a feature behind the others, unless it is there."""


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
"""Field of elements and resources: who is told of changes before the `listeners`."""
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
    """A function that reads a field, without a step in Python; what it gives is said where it is named."""
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
"""Who is told of changes of an element first."""
key_of: Callable[[EStructuralFeature], str] = _reader("_name")
"""The key of a feature's slot: the feature's name, or another one where that name is taken."""
declared_type_of: Callable[[EStructuralFeature], EClassifier | None] = _reader("_eType")
"""The `eType` of a feature as it was declared, a proxy unresolved; None if it has a generic type."""
value_in: Callable[[EValue], Scalar] = _reader("_value")
"""The value that an `EValue` holds."""
target_in: Callable[[EValue], EObject | None] = _reader("_value")
"""The element that an `EValue` of a reference holds."""
read: Callable[[Any], Any] = methodcaller("_get")
"""The value of a slot, or the collection in it."""
proxied: Callable[[EObject], Any] = _reader("_wrapped")
"""What a resolved proxy stands for."""
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
    return attribute_of(cls, IS_STATIC, bool) or False


def hold(holder: EValue, value: Value) -> None:
    """Put a value into an `EValue`, without a check and a notification."""
    held: Any = holder
    held._value = value


def contain(element: Any, container: EObject, feature: EStructuralFeature) -> None:
    """Let an element say where it is contained, without a word to its container."""
    element._container = container
    element._containment_feature = feature


def set_key(feature: Any, key: str) -> None:
    """Let a feature have another slot than that of its name."""
    feature._name = key


def set_own_resource(element: Any, resource: Any) -> None:
    """Let an element be a root of a resource, or of none."""
    element._eresource = resource


def set_xmi_id(element: Any, identity: str | None) -> None:
    """Give an element an xmi:id."""
    element._internal_id = identity


def set_first_listeners(element: Any, listeners: list[Any]) -> None:
    """Say who is told of changes of an element first."""
    element._eternal_listener = listeners


def empty_ordered_set(collection: Any) -> None:
    """Make an ordered set that was made without its constructor ready for use."""
    collection._orderedset_update = False
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


def fill_silently(collection: Any, values: Sequence[Scalar]) -> None:
    """Let a collection hold exactly these values, without check, opposite and notification."""
    if isinstance(collection, list):
        list.clear(collection)
        list.extend(collection, values)
        return
    collection.items[:] = values
    collection.map.clear()
    collection.map.update((value, place) for place, value in enumerate(values))


def quick_constructor(cls: type[F]) -> Callable[..., F]:
    """A function that makes what `cls(**arguments)` makes, in a fraction of the time; for EAttribute and EReference.

    pyecore's constructors assign some twelve features one by one, with a notification each, though nobody can listen yet. Here
    one object that was made without arguments is copied, and only what is given is assigned.
    """
    plain = cls()
    slots = {name: value for name, value in plain.__dict__.items() if isinstance(value, EValue)}
    others = {name: value for name, value in plain.__dict__.items() if name not in slots and not _is_own(name)}
    names = {"lower": "lowerBound", "upper": "upperBound"}

    def make(**arguments: Argument) -> F:
        made = cls.__new__(cls)
        own = made.__dict__
        own.update(others)
        inside = own[SET_FEATURES]
        inside.update(set_features_of(plain))
        for name, slot in slots.items():
            copy = own[name] = object.__new__(EValue)
            copy.__dict__.update(slot.__dict__)
            copy.owner = made
        own[FIRST_LISTENERS].append(made)
        kind = arguments.get("eType")
        if cls is EReference and kind is not None and not isinstance(kind, EClass) and hasattr(kind, "eClass"):
            arguments["eType"] = kind.eClass
        elif cls is EAttribute and isinstance(kind, EDataType) and arguments.get("default_value") is None:
            arguments["default_value"] = kind.default_value
        for name, value in arguments.items():
            setattr(made, names.get(name, name), value)
        return made

    return make


def _is_own(name: str) -> bool:
    """Whether a field of an element is its own, and not to be copied to another."""
    return name in FIELDS or name in ("listeners", "dyn_inst")


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
    """A holder of one value that says itself what assigning does."""

    def _set(self, value: Any, update_opposite: bool = True) -> None:
        self.assign(value)

    def assign(self, value: Any) -> None:
        """Called when the feature is assigned."""
        raise NotImplementedError


class ListenedTo:
    """What pyecore's notifications ask of a resource: who listens."""

    def __init__(self, listeners: list[Any]) -> None:
        self.listeners = listeners
        self._eternal_listener: list[Any] = []
