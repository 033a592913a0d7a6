"""Classes, features and literals of generated packages, made in a fraction of the time that pyecore takes.

pyecore assigns one by one what an element of a metamodel is made of, with a check and a notification each. Nobody can listen to
what is being made, and a generator wrote the values, so here they are put in directly. The result is what pyecore's own
constructors and metaclass make; `tests/model/pyecore_contract.py` compares every field.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import NamedTuple, TypeVar

from pyecore.ecore import Core

from robosmi.model.elements.compact_slots import quick, store_unboxed
from robosmi.model.elements.ecore import (
    Argument,
    EAttribute,
    EClass,
    EClassifier,
    ECollection,
    EDataType,
    EEnum,
    EEnumLiteral,
    ENamedElement,
    EObject,
    EPackage,
    EReference,
    EStructuralFeature,
    ETypedElement,
    EValue,
    Value,
)
from robosmi.model.elements.pyecore_internals import (
    FIELDS,
    IS_STATIC,
    add_silently,
    contain,
    container_of,
    first_listeners_of,
    inverse_references_of,
    key_of,
    set_features_of,
    set_key,
    set_slot,
    update_field,
    value_in,
)

F = TypeVar("F", bound=EStructuralFeature)


class _Slot(NamedTuple):
    """A feature of one of Ecore's own classes, and what each of its slots keeps of it."""

    feature: EStructuralFeature
    is_ref: bool
    is_cont: bool
    is_bare: bool


def _slot_of(feature: EStructuralFeature) -> _Slot:
    quick(feature)
    is_ref = feature.is_reference
    return _Slot(feature, is_ref, is_ref and feature.containment, store_unboxed(feature))


def _of_ecore(cls: type[EObject], name: str) -> _Slot:
    return _slot_of(cls.eClass.findEStructuralFeature(name))


_NAME = _of_ecore(ENamedElement, "name")
_TYPE = _of_ecore(ETypedElement, "eType").feature
_ABSTRACT = _of_ecore(EClass, "abstract")
_SUPERTYPES = _of_ecore(EClass, "eSuperTypes").feature
_FEATURES = _of_ecore(EClass, "eStructuralFeatures").feature
_CLASS = _of_ecore(EStructuralFeature, "eContainingClass")
_CLASSIFIERS = _of_ecore(EPackage, "eClassifiers").feature
_PACKAGE = _of_ecore(EClassifier, "ePackage")
_NUMBER = _of_ecore(EEnumLiteral, "value")
_LITERALS = _of_ecore(EEnum, "eLiterals").feature
_ENUMERATION = _of_ecore(EEnumLiteral, "eEnum")


def quick_constructor(cls: type[F]) -> Callable[..., F]:
    """A function that makes what `cls(**arguments)` makes, in a fraction of the time; for EAttribute and EReference.

    pyecore's constructors assign some twelve features one by one, with a notification each, though nobody can listen yet. Here
    the fields of an object that was made without arguments are copied, and what is given is put in, without a check and a
    notification where it is of the plain kind that the feature wants. Values of attributes are stored without holders, as those
    of models are (`compact_slots`); slots without a value are left to be made when they are first read.
    """
    plain = cls()
    slots = {name: _slot_of(slot.feature) for name, slot in plain.__dict__.items() if isinstance(slot, EValue)}
    others = {name: value for name, value in plain.__dict__.items() if name not in slots and not _is_own(name)}
    others |= {
        name: value for name, slot in slots.items() if (value := value_in(plain.__dict__[name])) is not None and slot.is_bare
    }
    inside = set_features_of(plain)
    names = {"lower": "lowerBound", "upper": "upperBound"}

    def make(**arguments: Argument) -> F:
        made = cls.__new__(cls)
        own = made.__dict__
        own.update(others)
        set_features_of(made).update(inside)
        first_listeners_of(made).append(made)
        kind = arguments.get("eType")
        if cls is EReference and kind is not None and not isinstance(kind, EClass) and hasattr(kind, "eClass"):
            arguments["eType"] = kind.eClass
        elif cls is EAttribute and isinstance(kind, EDataType) and arguments.get("default_value") is None:
            arguments["default_value"] = kind.default_value
        for name, value in arguments.items():
            key = names.get(name, name)
            if value.__class__ is _PLAIN.get(key):
                own[key] = value
                update_field(made, key, value)
            elif key == "eType" and isinstance(value, (EDataType, EClass)):
                own[key] = _holder(made, slots[key], value)
                update_field(made, key, value)
                inverse_references_of(value).add((made, _TYPE))
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
    features = {key: feature for key in names if isinstance(feature := getattr(cls, key, None), EStructuralFeature)}
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
            if not key_of(feature):
                _put(feature, _NAME, key)
                set_key(feature, key)
            contain(feature, made, _FEATURES)
            _put(feature, _CLASS, made)
            add_silently(own, feature)
    _enter(cls, made)


def _enter(cls: type[EObject], made: EClass) -> None:
    """Put the EClass of a generated class into the package of its module."""
    module = sys.modules[cls.__module__]
    package = getattr(module, "eClass", None)
    if (
        not isinstance(package, EPackage)
        or not vars(module).keys() >= _WITH_PACKAGE
        or package.listeners
        or first_listeners_of(package)
    ):
        Core.register_classifier(cls)
        return
    module.eClassifiers[cls.__name__] = cls
    add_silently(package.eClassifiers, made)
    set_features_of(package).add(_CLASSIFIERS)
    contain(made, module, _CLASSIFIERS)
    _put(made, _PACKAGE, package)


_WITH_PACKAGE = {"eClassifiers", "eClass", "dyn_inst", "eURIFragment"}
"""What pyecore gives to the module of a package, unless it has it."""


def add_literal(enumeration: EEnum, name: str, value: int) -> EEnumLiteral:
    """A new literal at the end of an enumeration to which nobody listens."""
    made = EEnumLiteral.__new__(EEnumLiteral)
    _put(made, _NAME, name)
    _put(made, _NUMBER, value)
    add_silently(enumeration.eLiterals, made)
    set_features_of(enumeration).add(_LITERALS)
    contain(made, enumeration, _LITERALS)
    _put(made, _ENUMERATION, enumeration)
    return made


def _are_all(features: dict[str, EStructuralFeature], names: list[str]) -> bool:
    """Whether a class consists of exactly these features, none of which another class has, besides Python's own attributes."""
    new = all(feature.__class__ in (EAttribute, EReference) and container_of(feature) is None for feature in features.values())
    return new and all(key in features or key[:2] == "__" for key in names)


def _holder(owner: EObject, slot: _Slot, value: Argument) -> EValue:
    """A holder with a value, as its constructor makes it."""
    made = object.__new__(EValue)
    made.owner = owner
    made.feature, made.is_ref, made.is_cont, _ = slot
    made.generic_type = None
    set_slot(made, value)
    return made


def _put(element: EObject, slot: _Slot, value: Value) -> None:
    """Store a value in an element without listeners, without a check and without updating the target of a reference."""
    element.__dict__[key_of(slot.feature)] = value if slot.is_bare else _holder(element, slot, value)
    set_features_of(element).add(slot.feature)


def _collect(element: EObject, feature: EStructuralFeature) -> ECollection[EObject]:
    """Give an element an empty collection for a feature, marked as set."""
    made: ECollection[EObject] = ECollection.create(element, feature)
    element.__dict__[key_of(feature)] = made
    set_features_of(element).add(feature)
    return made
