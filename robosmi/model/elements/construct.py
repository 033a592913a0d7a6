"""Fast construction of model elements, which stores values directly in pyecore's slots.

pyecore's own setters create a notification and walk to the root of the model for every value: 60 to 120 microseconds an object.
A new element has no listener and no container, so the notifications have no effect; here only the checks remain (measured: five
times faster). Most references with an opposite are supported; the others, and elements that are already contained elsewhere,
use pyecore's setters. Only `Element` uses this module.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from robosmi.errors import ModelError
from robosmi.model.elements import compact_slots, ecore
from robosmi.model.elements.compact_slots import ContainedValue, ReferenceValue, collection, features_fixed, new_slot, note_link
from robosmi.model.elements.ecore import EAttribute, EClassifier, EEnum, EEnumLiteral, EObject, EProxy, EStructuralFeature
from robosmi.model.elements.feature_errors import unknown_feature
from robosmi.model.elements.features import all_features, is_computed
from robosmi.model.elements.pyecore_internals import (
    CONTAINER,
    CONTAINING_FEATURE,
    INVERSE_REFERENCES,
    SET_FEATURES,
    container_of,
    key_of,
    own_resource_of,
    read,
)

if TYPE_CHECKING:
    from robosmi.model.elements.ecore import Slots


Entry = tuple[Any, str, Any, Any, Any]
"""How one feature is set.

(class of the values stored without a holder, or None; key of the feature's slot; the feature; function that stores any other
value, or None for pyecore's setter; that function's facts about the feature)
"""


class Plan(dict[str, Entry]):
    """How the features of a class are set, by name.

    Attributes:
        bare: feature whose slot has its name -> class of the values that are stored there without a holder.
    """

    def __init__(self) -> None:
        super().__init__()
        self.bare: dict[str, type] = {}


_PYTHON: dict[EClassifier, type] = {
    ecore.EString: str,
    ecore.EInt: int,
    ecore.ELong: int,
    ecore.EBoolean: bool,
    ecore.EDouble: float,
}
_PLANS: dict[type, Plan] = {}


def initialise(element: EObject, features: dict[str, Any]) -> None:
    """Set the features of an element that was just made.

    Raises:
        UnknownFeatureError: a name is no feature of the class.
        FeatureValueError: a value is of the wrong kind.
    """
    cls = element.__class__
    plan = _PLANS.get(cls) or _plan(cls)
    if not features.keys() <= plan.keys():
        raise unknown_feature(element, next(name for name in features if name not in plan))
    slots = element.__dict__
    bare_class = plan.bare.get
    try:
        for name, value in features.items():
            if value.__class__ is bare_class(name):  # two of three values in models of code: numbers of lines, and names
                slots[name] = value
                continue
            if value is None:
                continue
            bare, key, feature, put, known = plan[name]
            if value.__class__ is bare:
                slots[key] = value
            elif put is None or not put(element, slots, key, feature, known, value):
                setattr(element, name, value)
    except ModelError:
        disconnect(element)
        raise
    if SET_FEATURES in slots:  # else it is read off the slots when somebody asks
        slots[SET_FEATURES].update(dict.fromkeys(plan[name][2] for name, value in features.items() if value is not None))


def disconnect(made: Any) -> None:
    """Take an element that could not be made out of its container and out of all references."""
    for feature in all_features(made.eClass):
        slot = made.__dict__.get(key_of(feature)) if feature.is_reference and not is_computed(feature) else None
        if slot is not None and feature.many:
            read(slot).clear()
        elif slot is not None and read(slot) is not None:
            setattr(made, key_of(feature), None)


def connect(element: EObject, name: str, value: Any) -> None:
    """Set a cross reference of an element as its constructor would; one that was set before is changed as by assignment.

    Raises:
        UnknownFeatureError: the name is no feature of the class.
        FeatureValueError: the value is of the wrong kind.
    """
    slots = element.__dict__
    cls = element.__class__
    entry = (_PLANS.get(cls) or _plan(cls)).get(name)
    if name in slots or entry is None or entry[3] is None or not entry[3](element, slots, entry[1], entry[2], entry[4], value):
        setattr(element, name, value)
    elif SET_FEATURES in slots:
        slots[SET_FEATURES][entry[2]] = None


class _Known:
    """Cached facts about a reference, since asking pyecore each time would take longer than everything else.

    Attributes:
        kind: the type of its values.
        classes: classes known to conform to this type.
        holder: the class of the holder of a single value.
        contains: whether it is a containment.
        back: its opposite, if it has one.
        back_key: the key of the opposite's slot.
    """

    __slots__ = ("back", "back_key", "classes", "contains", "holder", "kind")

    def __init__(self, feature: EStructuralFeature) -> None:
        self.kind: Any = feature.eType
        self.classes: set[type] = set()
        self.contains = bool(feature.containment)
        self.holder = ContainedValue if self.contains else ReferenceValue
        self.back_key = ""
        if feature.eOpposite is not None:
            self.back = feature.eOpposite
            self.back_key = key_of(self.back)

    def takes(self, value: Any) -> bool:
        """Whether the feature accepts a value whose class is not in `classes` yet; proxies are left to pyecore's setter."""
        cls = value.__class__
        if cls is EProxy or not isinstance(value, self.kind):
            return False
        if features_fixed(cls):
            self.classes.add(cls)
        return True


def _plan(cls: type) -> Plan:
    plan = Plan()
    for base in reversed(cls.__mro__):
        for name, feature in base.__dict__.items():
            if not isinstance(feature, EStructuralFeature):
                continue
            put: Any
            kind: Any
            bare = None
            if isinstance(feature, EAttribute):
                enumeration = isinstance(feature.eType, EEnum)
                kind = feature.eType if enumeration else _PYTHON.get(feature.eType)
                many = None if feature.unique or enumeration else _put_attributes
                put = None if kind is None else many if feature.many else _put_literal if enumeration else None
                if kind is not None and not feature.many and compact_slots.store_unboxed(feature):
                    bare = None if enumeration else kind
                elif not feature.many:
                    put = None
            else:
                kind = _Known(feature)
                compact_slots.quick(feature)
                opposite = feature.eOpposite
                if opposite is None:
                    put = _put_many if feature.many else _put_reference
                elif feature.containment and feature.many and not opposite.many:
                    put = _put_parts
                elif opposite.many and not feature.many and not opposite.containment:
                    put = _put_one_of_many
                else:
                    put = None
            plan[name] = (bare, key_of(feature), feature, put, kind)
            if bare is not None and key_of(feature) == name:
                plan.bare[name] = bare
    _PLANS[cls] = plan
    return plan


def _put_attributes(
    element: EObject, slots: Slots, name: str, feature: EStructuralFeature, kind: Any, values: Iterable[Any]
) -> bool:
    found = list(values) if values.__class__ is not str else None
    if found == []:
        return True
    if found is None or any(value.__class__ is not kind for value in found):
        return False
    slots[name] = many = collection(element, feature)
    list.extend(many, found)
    return True


def _put_literal(element: EObject, slots: Slots, name: str, feature: EStructuralFeature, kind: Any, value: Any) -> bool:
    if value.__class__ is not EEnumLiteral or container_of(value) is not kind:
        return False
    slots[name] = value
    return True


def _adopt(element: EObject, feature: EStructuralFeature, known: _Known, value: Any, birth: Any) -> bool:
    """Whether a value can be stored without moving it out of another container; if so, its back links are set."""
    if value.__class__ not in known.classes and not known.takes(value):
        return False
    if not known.contains:
        note_link(value, birth)
        return True
    if container_of(value) is not None or own_resource_of(value) is not None:
        return False
    slots = value.__dict__
    slots[CONTAINER] = element
    slots[CONTAINING_FEATURE] = feature
    if INVERSE_REFERENCES in slots:
        slots[INVERSE_REFERENCES].add(birth)
    else:
        slots["_birth"] = birth
    return True


def _put_reference(element: EObject, slots: Slots, name: str, feature: EStructuralFeature, known: _Known, value: Any) -> bool:
    if not _adopt(element, feature, known, value, (element, feature)):
        return False
    slots[name] = new_slot(known.holder, element, feature, value)
    return True


def _put_many(
    element: EObject, slots: Slots, name: str, feature: EStructuralFeature, known: _Known, values: Iterable[Any]
) -> bool:
    if values.__class__ is list and not values:
        return True
    many = slots[name] = collection(element, feature)
    items, positions = many.items, many.map
    birth = (element, feature)
    for value in values:
        if value in positions:
            continue
        if _adopt(element, feature, known, value, birth):
            positions[value] = len(items)
            items.append(value)
        else:
            many.append(value)
    return True


def _put_parts(
    element: EObject, slots: Slots, name: str, feature: EStructuralFeature, known: _Known, values: Iterable[Any]
) -> bool:
    """Store a many-valued containment whose opposite is single-valued: sets the container reference of the parts."""
    many = slots[name] = collection(element, feature)
    items, positions = many.items, many.map
    back, key = known.back, known.back_key
    for value in values:
        if value in positions:
            continue
        fresh = value.__class__ in known.classes or known.takes(value)
        if not fresh or container_of(value) is not None or own_resource_of(value) is not None or key in value.__dict__:
            many.append(value)
            continue
        own = value.__dict__
        own[CONTAINER] = element
        own[CONTAINING_FEATURE] = feature
        own[key] = new_slot(ReferenceValue, value, back, element)
        _set(own, back)
        positions[value] = len(items)
        items.append(value)
    return True


def _put_one_of_many(element: EObject, slots: Slots, name: str, feature: EStructuralFeature, known: _Known, value: Any) -> bool:
    """Store a single-valued reference whose opposite is many-valued: adds the element to the target's collection."""
    if value.__class__ not in known.classes and not known.takes(value):
        return False
    own = value.__dict__
    many = own.get(known.back_key)
    if many is None:
        many = own[known.back_key] = collection(value, known.back)
    slots[name] = new_slot(ReferenceValue, element, feature, value)
    many.map[element] = len(many.items)
    many.items.append(element)
    _set(own, known.back)
    return True


def _set(slots: Slots, feature: EStructuralFeature) -> None:
    """Record that a feature was set, unless the set features are computed on demand."""
    if SET_FEATURES in slots:
        slots[SET_FEATURES][feature] = None
