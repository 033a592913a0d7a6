"""Fast construction and change of model elements, which stores values directly in pyecore's slots.

pyecore's own setters create a notification and walk to the root of the model for every value: 60 to 120 microseconds an object.
A new element has no listener and no container, so the notifications have no effect; here only the checks remain (measured: five
times faster). So it is with elements in no model (`is_quiet`). Most references with an opposite are supported; the others, and
elements that are already contained elsewhere, use pyecore's setters. Only `Element` uses this module.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from robosmi.errors import ModelError
from robosmi.model.elements import compact_slots, ecore
from robosmi.model.elements.compact_slots import (
    ContainedValue,
    ReferenceValue,
    collection,
    features_fixed,
    new_slot,
    note_link,
)
from robosmi.model.elements.ecore import EAttribute, EClassifier, EEnum, EEnumLiteral, EObject, EProxy, EStructuralFeature
from robosmi.model.elements.feature_errors import REFUSAL, unknown_feature
from robosmi.model.elements.feature_values import added_by
from robosmi.model.elements.pyecore_internals import (
    CONTAINER,
    CONTAINING_FEATURE,
    FIRST_LISTENERS,
    INVERSE_REFERENCES,
    SET_FEATURES,
    container_of,
    key_of,
    own_resource_of,
)
from robosmi.model.elements.structure import disconnect, resource_of, root_of

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
RECORDINGS: set[object] = set()
"""What has to see each change in pyecore's methods; as long as there is one, no change is quiet."""


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


def is_quiet(element: EObject) -> bool:
    """Whether an element may change and nobody is notified: it is not read-only, has no listeners, and is in no model."""
    slots = element.__dict__
    if RECORDINGS or REFUSAL in slots or slots.get("listeners") or slots.get(FIRST_LISTENERS):
        return False
    return resource_of(element) is None


def _is_quiet_element(value: Any) -> bool:
    return features_fixed(value.__class__) and is_quiet(value)


def assign(element: EObject, name: str, value: Any) -> bool:
    """Set a feature of a quiet element that is not set yet, or a plain value; False if that is left to pyecore's setter."""
    slots, cls = element.__dict__, element.__class__
    entry = (_PLANS.get(cls) or _plan(cls)).get(name)
    if entry is None or value is None or not is_quiet(element):
        return False
    bare, key, feature, put, known = entry
    present = slots.get(key)
    if getattr(cls, name) is not feature:  # a mixin has it
        return False
    if value.__class__ is bare and (present is None or present.__class__ is bare):
        slots[key] = value
    elif (
        present is not None
        or not (put is _put_literal or (put is _put_one_of_many and _is_quiet_element(value)))
        or not put(element, slots, key, feature, known, value)
    ):
        return False
    if SET_FEATURES in slots:
        slots[SET_FEATURES][feature] = None
    return True


def add(many: Any, value: Any) -> bool:
    """Add a part to a collection of a quiet element; False if that is left to pyecore's collection."""
    element, feature = many.owner, many.feature
    plan = _PLANS.get(element.__class__)
    entry = plan.get(key_of(feature)) if plan is not None else None
    if entry is None or entry[2] is not feature or not is_quiet(element) or not _is_quiet_element(value):
        return False
    known = entry[4]
    if root_of(element) is value:
        return False  # pyecore's collection refuses the circle
    if entry[3] is _put_parts:
        if not _add_part(element, many, feature, known, value):
            return False
    elif entry[3] is _put_many and known.contains and value not in many.map:
        if not _adopt(element, feature, known, value, many.birth or (element, feature)):
            return False
        many.map[value] = len(many.items)
        many.items.append(value)
    else:
        return False
    _set(element.__dict__, feature)
    return True


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
    compact_slots.share_keys(cls, [entry[1] for entry in plan.values()])
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
    for value in values:
        if value not in many.map and not _add_part(element, many, feature, known, value):
            many.append(value)
    return True


def _add_part(element: EObject, many: Any, feature: EStructuralFeature, known: _Known, value: Any) -> bool:
    """Store a part that is in no container yet, with its container reference; whether it is one."""
    own = value.__dict__
    fresh = value.__class__ in known.classes or known.takes(value)
    if not fresh or container_of(value) is not None or own_resource_of(value) is not None or known.back_key in own:
        return False
    own[CONTAINER] = element
    own[CONTAINING_FEATURE] = feature
    own[known.back_key] = new_slot(ReferenceValue, value, known.back, element)
    _set(own, known.back)
    many.map[value] = len(many.items)
    many.items.append(value)
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


added_by(add)
