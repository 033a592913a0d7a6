"""Fast construction of model elements: values go straight into pyecore's slots.

pyecore's own setters build a notification and walk to the root of the model for every value, 60 to 120 microseconds an
object. A new element has no listener and no container, so nobody can notice: here the checks are kept and the rest is
left out (research: five times faster). Most references with an opposite are among the fast ones; the rest and
elements that already live elsewhere take pyecore's way. Nothing here is called by anything but `Element`.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from pyecore import ecore
from pyecore.ecore import EAttribute, EEnum, EEnumLiteral, EProxy, EStructuralFeature
from pyecore.valuecontainer import EList, EOrderedSet, EValue

from robosmi.model import strict

_PYTHON = {ecore.EString: str, ecore.EInt: int, ecore.ELong: int, ecore.EBoolean: bool, ecore.EDouble: float}
_PLANS: dict[type, dict[str, tuple[Any, Any, Any]]] = {}


def initialise(element: Any, features: dict[str, Any]) -> None:
    """Set the features of an element that was just made.

    Raises:
        UnknownFeatureError: a name is no feature of the class.
        FeatureValueError: a value is of the wrong kind.
    """
    cls = type(element)
    plan = _PLANS.get(cls) or _plan(cls)
    slots = element.__dict__
    isset = element._isset
    for name, value in features.items():
        if value is None:
            continue
        entry = plan.get(name)
        if entry is None:
            raise strict.unknown_feature(element, name)
        feature, put, kind = entry
        if put is None or not put(element, slots, feature._name, feature, kind, value):
            setattr(element, name, value)
        else:
            isset[feature] = None


def _plan(cls: type) -> dict[str, tuple[Any, Any, Any]]:
    plan: dict[str, tuple[Any, Any, Any]] = {}
    for base in reversed(cls.__mro__):
        for name, feature in base.__dict__.items():
            if not isinstance(feature, EStructuralFeature):
                continue
            put: Any
            if isinstance(feature, EAttribute):
                enumeration = isinstance(feature.eType, EEnum)
                kind = (feature.eType,) if enumeration else _PYTHON.get(feature.eType)
                many = None if feature.unique or enumeration else _put_attributes
                put = None if kind is None else many if feature.many else _put_literal if enumeration else _put_attribute
            else:
                kind = feature.eType
                opposite = feature.eOpposite
                if opposite is None:
                    put = _put_many if feature.many else _put_reference
                elif feature.containment and feature.many and not opposite.many:
                    put = _put_parts
                elif opposite.many and not feature.many and not opposite.containment:
                    put = _put_one_of_many
                else:
                    put = None
            plan[name] = (feature, put, kind)
    _PLANS[cls] = plan
    return plan


def _holder(element: Any, feature: Any, value: Any, is_ref: bool) -> Any:
    holder = EValue.__new__(EValue)
    holder.owner = element
    holder.feature = feature
    holder.is_ref = is_ref
    holder.is_cont = is_ref and feature.containment
    holder.generic_type = None
    holder._value = value
    return holder


def _put_attribute(element: Any, slots: dict[str, Any], name: str, feature: Any, kind: Any, value: Any) -> bool:
    if value.__class__ is not kind:
        return False
    slots[name] = _holder(element, feature, value, False)
    return True


def _put_attributes(element: Any, slots: dict[str, Any], name: str, feature: Any, kind: Any, values: Iterable[Any]) -> bool:
    found = list(values) if values.__class__ is not str else None
    if found is None or any(value.__class__ is not kind for value in found):
        return False
    collection = slots[name] = EList(element, feature)
    list.extend(collection, found)
    return True


def _put_literal(element: Any, slots: dict[str, Any], name: str, feature: Any, kind: Any, value: Any) -> bool:
    if value.__class__ is not EEnumLiteral or value.eContainer() is not kind[0]:
        return False
    slots[name] = _holder(element, feature, value, False)
    return True


def _adopt(element: Any, feature: Any, kind: Any, value: Any) -> bool:
    """Whether the value may be referred to without pyecore's bookkeeping of moves; if so the back links are made."""
    if value.__class__ is EProxy or not isinstance(value, kind):
        return False
    if feature.containment:
        if value._container is not None or value._eresource is not None:
            return False
        value._container = element
        value._containment_feature = feature
    value._inverse_rels.add((element, feature))
    return True


def _put_reference(element: Any, slots: dict[str, Any], name: str, feature: Any, kind: Any, value: Any) -> bool:
    if not _adopt(element, feature, kind, value):
        return False
    slots[name] = _holder(element, feature, value, True)
    return True


def _put_many(element: Any, slots: dict[str, Any], name: str, feature: Any, kind: Any, values: Iterable[Any]) -> bool:
    collection = slots[name] = EOrderedSet(element, feature)
    items, positions = collection.items, collection.map
    for value in values:
        if value in positions:
            continue
        if _adopt(element, feature, kind, value):
            positions[value] = len(items)
            items.append(value)
        else:
            collection.append(value)
    return True


def _put_parts(element: Any, slots: dict[str, Any], name: str, feature: Any, kind: Any, values: Iterable[Any]) -> bool:
    """Containment of many with a single-valued opposite: the parts know their container under its name."""
    collection = slots[name] = EOrderedSet(element, feature)
    items, positions = collection.items, collection.map
    back = feature.eOpposite
    for value in values:
        if value in positions:
            continue
        fresh = (
            value.__class__ is not EProxy and isinstance(value, kind) and value._container is None and value._eresource is None
        )
        if not fresh or back._name in value.__dict__:
            collection.append(value)
            continue
        value._container = element
        value._containment_feature = feature
        value.__dict__[back._name] = _holder(value, back, element, True)
        value._isset[back] = None
        positions[value] = len(items)
        items.append(value)
    return True


def _put_one_of_many(element: Any, slots: dict[str, Any], name: str, feature: Any, kind: Any, value: Any) -> bool:
    """A single reference whose opposite collects many: the element joins the collection of what it refers to."""
    if value.__class__ is EProxy or not isinstance(value, kind):
        return False
    back = feature.eOpposite
    collection = value.__dict__.get(back._name)
    if collection is None:
        collection = value.__dict__[back._name] = EOrderedSet(value, back)
    slots[name] = _holder(element, feature, value, True)
    collection.map[element] = len(collection.items)
    collection.items.append(element)
    value._isset[back] = None
    return True
