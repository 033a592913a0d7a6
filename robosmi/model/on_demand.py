"""Read-only EMF elements whose parts are built on demand.

A driver builds an element with stand-ins for parts that are not needed yet (`stand_in`); `settle` turns these into promises,
which are fulfilled when pyecore's attribute access first reads them. After that every slot is read-only, with a clear error.
The driver decides which parts can wait and how they are built.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cache
from typing import TYPE_CHECKING, Any

from robosmi.errors import InternalError
from robosmi.model.elements.compact_slots import UNBOXED_TYPES, prepare, store_unboxed
from robosmi.model.elements.driver import ReadOnlyError
from robosmi.model.elements.ecore import EList, EObject, EReference, EStructuralFeature, EValue
from robosmi.model.elements.feature_errors import REFUSAL
from robosmi.model.elements.feature_values import FeatureList, FeatureOrderedSet
from robosmi.model.elements.features import all_features
from robosmi.model.elements.pyecore_internals import (
    SET_FEATURES,
    GuardedValue,
    Slot,
    contain,
    fill_silently,
    key_of,
    read,
    set_slot,
    target_in,
)

if TYPE_CHECKING:
    from robosmi.base.functions import Function
    from robosmi.model.elements.driver import ItemOrItems


def read_only_error(element: EObject, name: str) -> ReadOnlyError:
    """The error for a change of an element that is built on demand."""
    return ReadOnlyError(
        f"{type(element).__name__}.{name} cannot be changed: the model is a view of its source and read-only",
        fix="read the source into a model of its own and change that",
    )


class Promise(Slot):
    """A slot whose value is made when it is first read.

    Args:
        element: the element that has the slot.
        feature: its feature.
        make: makes the value; for a many-valued feature an iterable.
        hint: data by which the driver decides whether to fulfil it.
    """

    __slots__ = ("element", "feature", "hint", "make")

    def __init__(self, element: EObject, feature: EStructuralFeature, make: Function, hint: Any = None) -> None:
        self.element = element
        self.feature = feature
        self.make = make
        self.hint = hint
        element.__dict__[key_of(feature)] = self

    def value(self) -> Any:
        """Make the value."""
        return self.make()

    def read(self) -> Any:
        """The value, which is stored in the slot from now on."""
        try:
            value = self.value()
        except AttributeError as error:  # pyecore would take the promise itself for the value
            raise InternalError(f"{key_of(self.feature)} cannot be built: {error}") from error
        slots, name = self.element.__dict__, key_of(self.feature)
        if slots[name] is self:
            fill(self.element, self.feature, value)
        held = slots[name]
        return held if held.__class__ in UNBOXED_TYPES else read(held)

    def assign(self, value: Any) -> None:
        """Raise the error for a change."""
        raise read_only_error(self.element, key_of(self.feature))


class OnDemandLink(Promise):
    """A promise whose value is determined by the element and the feature, so that many can share one function (`make`)."""

    __slots__ = ()

    def value(self) -> Any:
        """Find the value."""
        return self.make(self.element, self.feature)


class ReadOnlyValue(GuardedValue):
    """An immutable holder of one value."""

    def assign(self, value: ItemOrItems) -> None:
        """Raise the error for a change."""
        raise read_only_error(self.owner, key_of(self.feature))


def _refuse(self: Any, *_: Any, **__: Any) -> Any:
    raise read_only_error(self.owner, key_of(self.feature))


_CHANGES = (
    "append", "extend", "insert", "pop", "remove", "clear", "update", "__setitem__", "__delitem__", "__iadd__", "__imul__",
    "sort", "reverse", "add", "discard", "difference_update", "intersection_update", "symmetric_difference_update", "__ior__",
    "__iand__", "__isub__", "__ixor__", "remove_or_unset",
)  # fmt: skip
ReadOnlySet: Any = type("ReadOnlySet", (FeatureOrderedSet,), {"__doc__": "Unique values.", **dict.fromkeys(_CHANGES, _refuse)})
ReadOnlyList: Any = type("ReadOnlyList", (FeatureList,), {"__doc__": "Values.", **dict.fromkeys(_CHANGES, _refuse)})


def _collection(owner: EObject, feature: EStructuralFeature, values: Iterable[Any]) -> Any:
    if not feature.unique:
        made = ReadOnlyList(owner, feature)
        list.extend(made, values)
        return made
    made = ReadOnlySet(owner, feature)
    fill_silently(made, list(values))
    return made


def fill(element: EObject, feature: EStructuralFeature, value: Any) -> None:
    """Store a value permanently in a slot, and set the container of contained elements."""
    values = list(value) if feature.many else [] if value is None else [value]
    if feature.is_reference and feature.containment:
        for child in values:
            contain(child, element, feature)
    slots = element.__dict__
    if feature.many:
        slots[key_of(feature)] = _collection(element, feature, values)
    elif value.__class__ in UNBOXED_TYPES and store_unboxed(feature):
        slots[key_of(feature)] = value
    else:
        holder = slots[key_of(feature)] = object.__new__(ReadOnlyValue)
        holder.owner, holder.feature = element, feature
        set_slot(holder, value)
        holder.is_ref = feature.is_reference
    if values and SET_FEATURES in slots:
        slots[SET_FEATURES][feature] = None


@cache
def _stand_ins(cls: Any) -> Any:
    """The class of stand-ins for elements of a class; being a subclass, they are accepted wherever it is."""
    quiet: Any = type("Quiet", (cls.__class__,), {"__init__": type.__init__})  # it becomes part of no metamodel
    made = quiet(f"Later{cls.__name__}", (cls,), {})
    prepare(made)
    return made


def stand_in(cls: type, make: Callable[[], Any], hint: Any) -> Any:
    """Make a stand-in for an element that is built later.

    Args:
        cls: the class of the element.
        make: builds it.
        hint: data for the driver, see `Promise`.
    """
    made = object.__new__(_stand_ins(cls))
    slots = made.__dict__
    slots["_make"], slots["_hint"] = make, hint
    return made


def settle(element: EObject, links: Callable[[Any, Any], Any] | None = None) -> Any:
    """Make a newly built element and its contents read-only, and turn its stand-ins into promises.

    Args:
        element: the element.
        links: finds the value of a cross reference, given the element and the feature; None if they are set already.

    Returns:
        The element.
    """
    pending = [element]
    while pending:
        one = pending.pop()
        slots = one.__dict__
        cls: type = one.__class__
        slots[REFUSAL] = read_only_error
        for feature, name, is_link, holds in _held(cls):
            slot = slots.get(name)
            if isinstance(slot, _READ_ONLY):
                if holds:
                    pending.extend(_parts(slot, feature))
            elif is_link and links is not None:
                OnDemandLink(one, feature, links)
            elif slot is None:
                slots[name] = _empty(cls, name, feature)
            elif holds and (built := _promised(one, feature, slot)) is not None:
                pending.extend(built)
            else:
                slot.__class__ = (
                    ReadOnlyValue if isinstance(slot, EValue) else ReadOnlyList if isinstance(slot, EList) else ReadOnlySet
                )
                if holds:
                    pending.extend(_parts(slot, feature))
    return element


_READ_ONLY = (Promise, ReadOnlyValue, ReadOnlySet, ReadOnlyList)


@cache
def _held(cls: Any) -> list[tuple[Any, str, bool, bool]]:
    """The features of a class whose slots must be made read-only individually; cached, so its metamodel must not change.

    Each with the key of its slot, whether it is a cross reference, and whether it is a containment.
    """
    features = [f for f in all_features(cls.eClass) if f.is_reference or not store_unboxed(f)]
    return [(f, key_of(f), _is_link(f), bool(f.is_reference and f.containment)) for f in features]


def _is_link(feature: EStructuralFeature) -> bool:
    return (
        isinstance(feature, EReference) and not feature.containment and not (feature.eOpposite and feature.eOpposite.containment)
    )


def _parts(slot: Any, feature: EStructuralFeature) -> list[Any]:
    """The already built elements in a containment slot."""
    if isinstance(slot, Promise):
        return []
    return list(slot) if feature.many else [] if target_in(slot) is None else [target_in(slot)]


def _promised(element: EObject, feature: EStructuralFeature, slot: Any) -> list[Any] | None:
    """Turn a slot with stand-ins into a promise; returns its already built elements, or None if it has no stand-in."""
    parts: list[Any] = list(slot) if feature.many else [target_in(slot)]
    if not any(part is not None and "_make" in part.__dict__ for part in parts):
        return None
    if not feature.many:
        Promise(element, feature, parts[0]._make, [parts[0]._hint])
        return []
    built = [part for part in parts if "_make" not in part.__dict__]
    makes = [part._make if "_make" in part.__dict__ else lambda part=part: part for part in parts]
    hints = [part.__dict__.get("_hint") for part in parts]
    Promise(element, feature, lambda: [make() for make in makes], hints)
    return built


@cache
def _empty(cls: Any, name: str, feature: EStructuralFeature) -> Any:
    """The slot of a feature without a value, shared by all elements of a class."""
    if feature.many:
        return _collection(_Anyone(cls), feature, ())
    return ReadOnlyValue(_Anyone(cls), feature)


def _Anyone(cls: type) -> Any:
    """A dummy owner of shared slots, whose class name appears in messages."""
    return object.__new__(type(cls.__name__, (), {}))
