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

from pyecore.ecore import Core
from pyecore.innerutils import InternalSet

from robosmi.model.ecore import (
    Argument,
    DynamicEObject,
    EAttribute,
    EClass,
    EClassifier,
    ECollection,
    EDataType,
    ENamedElement,
    EObject,
    EReference,
    EStructuralFeature,
    ETypedElement,
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
    return attribute_of(cls, IS_STATIC, bool) or False


def hold(holder: EValue, value: Argument) -> None:
    """Store a value in an `EValue` without check and notification."""
    held: Any = holder
    held._value = value


def contain(element: Any, container: EObject, feature: EStructuralFeature) -> None:
    """Set the container of an element without changing the container."""
    element._container = container
    element._containment_feature = feature


def set_key(feature: Any, key: str) -> None:
    """Give a feature's slot another key than its name."""
    feature._name = key


def set_own_resource(element: Any, resource: Any) -> None:
    """Make an element a root of a resource, or of none."""
    element._eresource = resource


def set_xmi_id(element: Any, identity: str | None) -> None:
    """Give an element an xmi:id."""
    element._internal_id = identity


def set_first_listeners(element: Any, listeners: list[Any]) -> None:
    """Set the listeners of an element that are notified first."""
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
    """Set the content of a collection without check, opposite and notification."""
    if isinstance(collection, list):
        list.clear(collection)
        list.extend(collection, values)
        return
    collection.items[:] = values
    collection.map.clear()
    collection.map.update((value, place) for place, value in enumerate(values))


def _of_ecore(cls: type[EObject], name: str) -> EStructuralFeature:
    """A feature of one of Ecore's own classes."""
    found: EStructuralFeature = cls.eClass.findEStructuralFeature(name)
    return found


_NAME = _of_ecore(ENamedElement, "name")
_TYPE = _of_ecore(ETypedElement, "eType")
_ABSTRACT = _of_ecore(EClass, "abstract")
_SUPERTYPES = _of_ecore(EClass, "eSuperTypes")
_FEATURES = _of_ecore(EClass, "eStructuralFeatures")
_CLASS = _of_ecore(EStructuralFeature, "eContainingClass")


def quick_constructor(cls: type[F]) -> Callable[..., F]:
    """A function that makes what `cls(**arguments)` makes, in a fraction of the time; for EAttribute and EReference.

    pyecore's constructors assign some twelve features one by one, with a notification each, though nobody can listen yet. Here
    one object that was made without arguments is copied, and what is given is put in, without a word where it is of the plain
    kind that the feature wants.
    """
    plain = cls()
    slots = [
        (name, slot.feature, slot.is_ref, slot.is_cont, value_in(slot))
        for name, slot in plain.__dict__.items()
        if isinstance(slot, EValue)
    ]
    others = {name: value for name, value in plain.__dict__.items() if not isinstance(value, EValue) and not _is_own(name)}
    inside = set_features_of(plain)
    names = {"lower": "lowerBound", "upper": "upperBound"}

    def make(**arguments: Argument) -> F:
        made = cls.__new__(cls)
        own = made.__dict__
        own.update(others)
        set_features_of(made).update(inside)
        for name, feature, is_ref, is_cont, default in slots:
            own[name] = _slot(made, feature, is_ref, is_cont, default)
        first_listeners_of(made).append(made)
        kind = arguments.get("eType")
        if cls is EReference and kind is not None and not isinstance(kind, EClass) and hasattr(kind, "eClass"):
            arguments["eType"] = kind.eClass
        elif cls is EAttribute and isinstance(kind, EDataType) and arguments.get("default_value") is None:
            arguments["default_value"] = kind.default_value
        for name, value in arguments.items():
            key = names.get(name, name)
            if value.__class__ is _PLAIN.get(key) or (key == "eType" and isinstance(value, (EDataType, EClass))):
                hold(own[key], value)
                _follow(made, key, value)
            else:
                setattr(made, key, value)
        return made

    return make


_PLAIN: dict[str, type] = {
    "name": str, "lowerBound": int, "upperBound": int, "defaultValueLiteral": str,
    "ordered": bool, "unique": bool, "changeable": bool, "derived": bool, "transient": bool, "volatile": bool, "unsettable": bool,
    "iD": bool, "containment": bool,
}  # fmt: skip
"""Attributes of a feature that are put into a new one without a check, where the value is of exactly this class."""

_FIELDS = {"name": "_name", "eType": "_eType", "upperBound": "_many_cache"}
"""Attribute of a feature -> the field that follows it, which pyecore sets when it is notified."""


def _follow(feature: EObject, key: str, value: Argument) -> None:
    """Update what depends on an attribute of a feature: its field, and the back reference of its type."""
    if key in _FIELDS:
        setattr(feature, _FIELDS[key], not 0 <= value <= 1 if isinstance(value, int) else value)
    if isinstance(value, EClassifier):
        inverse_references_of(value).add((feature, _TYPE))


def _is_own(name: str) -> bool:
    """Whether a field belongs to one element only and must not be copied to another."""
    return name in FIELDS or name in ("listeners", "dyn_inst")


def promote(cls: type[EObject], root: type) -> None:
    """Give a generated class its EClass and put that into its package, as pyecore's metaclass does, in a fraction of the time.

    Nobody can listen to an EClass that is being made, so what it holds is put in without notifications. A class with more than
    features of its own, as with methods, is left to pyecore.

    Args:
        cls: the class.
        root: base class of all generated classes; as a base it makes no supertype.
    """
    names = [*vars(cls)]
    features = {key: feature for key in names if (feature := attribute_of(cls, key, EStructuralFeature)) is not None}
    if not _are_all(features, names):
        Core.register_classifier(cls, promote=True)
        if root in cls.__bases__:
            cls.eClass.eSuperTypes.remove(EObject.eClass)  # no class of Ecore has it unless the metamodel says so
        return
    made = EClass.__new__(EClass, cls.__name__, metainstance=cls)
    first_listeners_of(made).append(made)
    _put(made, _NAME, cls.__name__)
    _put(made, _ABSTRACT, False)
    cls.eClass = made
    setattr(cls, IS_STATIC, True)
    supertypes = _collect(made, _SUPERTYPES)
    for base in cls.__bases__:
        if base not in (root, EObject) and issubclass(base, EObject) and add_silently(supertypes, base.eClass):
            inverse_references_of(base.eClass).add((made, _SUPERTYPES))
    if features:
        own = _collect(made, _FEATURES)
        for key, feature in features.items():
            if not feature.name:
                _put(feature, _NAME, key)
                set_key(feature, key)
            contain(feature, made, _FEATURES)
            _put(feature, _CLASS, made)
            add_silently(own, feature)
    Core.register_classifier(cls)


def _are_all(features: dict[str, EStructuralFeature], names: list[str]) -> bool:
    """Whether a class consists of exactly these features, none of which another class has, besides Python's own attributes."""
    new = all(feature.__class__ in (EAttribute, EReference) and container_of(feature) is None for feature in features.values())
    return new and all(key in features or key[:2] == "__" for key in names)


def _slot(owner: EObject, feature: EStructuralFeature, is_ref: bool, is_cont: bool, value: Argument) -> EValue:
    """A holder with a value, as its constructor makes it."""
    slot = object.__new__(EValue)
    slot.owner, slot.feature, slot.is_ref, slot.is_cont, slot.generic_type = owner, feature, is_ref, is_cont, None
    hold(slot, value)
    return slot


def _put(element: EObject, feature: EStructuralFeature, value: Value) -> None:
    """Store a value in an element without listeners, without a check and without updating the target of a reference."""
    is_ref = feature.is_reference
    element.__dict__[key_of(feature)] = _slot(element, feature, is_ref, is_ref and feature.containment, value)
    set_features_of(element).add(feature)


def _collect(element: EObject, feature: EStructuralFeature) -> ECollection[EObject]:
    """Give an element an empty collection for a feature, marked as set."""
    made: ECollection[EObject] = ECollection.create(element, feature)
    element.__dict__[key_of(feature)] = made
    set_features_of(element).add(feature)
    return made


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
