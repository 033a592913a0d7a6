"""Creates and removes EMF elements outside of any model: `new` and `unlink`. Extents are handled by `emf`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from robosmi.errors import ModelError, did_you_mean
from robosmi.model.elements import ecore
from robosmi.model.elements.construct import disconnect
from robosmi.model.elements.driver import Kind, TypeHandle, class_of
from robosmi.model.elements.ecore import DynamicEObject, EEnum, EObject, EStructuralFeature
from robosmi.model.elements.feature_errors import not_named
from robosmi.model.elements.features import all_features, is_computed
from robosmi.model.elements.pyecore_internals import (
    first_listeners_of,
    inverse_references_of,
    key_of,
    own_resource_of,
    read,
    set_features_of,
)
from robosmi.model.elements.structure import walk

if TYPE_CHECKING:
    from robosmi.model.elements.driver import ItemOrItems


def new(kind: Kind, /, **features: Any) -> Any:
    """A new element of a class or EClass, in no model.

    Raises:
        ModelError: the class is abstract, or has no such feature.
    """
    from robosmi.model.elements.strict import Element, UnknownFeatureError

    cls = class_of(kind)
    eclass = cls.eClass  # type: ignore[attr-defined]
    if eclass.abstract or eclass.interface:
        raise ModelError(f"{eclass.name} is abstract: it has no instances of its own", fix="create one of a subclass")
    if issubclass(cls, Element):
        return cls(**features)
    known = {feature.name: feature for feature in eclass.eAllStructuralFeatures()}
    for name in features:
        if name not in known:
            raise UnknownFeatureError(
                f"{eclass.name} has no feature '{name}'{did_you_mean(name, known)}", fix=f"use one of: {', '.join(sorted(known))}"
            )
    made = of_ecore(cls) if cls.__module__ == "pyecore.ecore" else cls()
    try:
        for name, value in features.items():
            if known[name].many:
                getattr(made, name).extend(value)
            elif value is not None:
                setattr(made, name, value)
    except ModelError:
        disconnect(made)
        raise
    return made


def refuse_unnamed(kind: Kind, values: Sequence[object]) -> None:
    """Refuse to make an element with values without the names of their features, or one of an enumeration.

    Raises:
        ModelError: there are such values (FeatureValueError), or the type is an enumeration.
    """
    wanted = kind.kind if isinstance(kind, TypeHandle) else kind
    if (values or isinstance(wanted, EEnum)) and not isinstance(wanted, str):
        raise not_named(wanted, values)


def of_ecore(cls: type) -> Any:
    """A new element of one of Ecore's own classes, which is data of a model and no type of a program.

    pyecore makes a Python class of every EClass and attributes of the literals of an EEnum, and changes them with it: it needs
    names before there are any, and two classes with crossed supertypes change the method resolution of the whole process.
    """
    made: Any = cls("") if issubclass(cls, ecore.EClass) else cls()
    as_data(made)
    if issubclass(cls, ecore.EClass):  # no name was given yet
        made.name = None
        set_features_of(made).pop(vars(ecore.ENamedElement)["name"], None)
    return made


def as_data(classifier: EObject) -> None:
    """Keep changes of a class or enumeration of a metamodel that is edited as a model from affecting Python's classes."""
    if isinstance(classifier, (ecore.EClass, ecore.EEnum)) and classifier in first_listeners_of(classifier):
        first_listeners_of(classifier).remove(classifier)


def unlink(element: Any) -> list[DynamicEObject]:
    """Take an element with all it contains out of its container, its resource and all references; all that was taken out."""
    doomed = list(walk(element))
    for one in reversed(doomed):
        for owner, feature in list(inverse_references_of(one)):
            _forget(owner, feature, one)
        for feature in all_features(one.eClass):
            slot = one.__dict__.get(key_of(feature)) if feature.is_reference and not is_computed(feature) else None
            if slot is not None and feature.many:
                read(slot).clear()
            elif slot is not None and read(slot) is not None:
                setattr(one, key_of(feature), None)
        if (container := one.eContainer()) is not None and (holding := one.eContainmentFeature()) is not None:
            _forget(container, holding, one)
    if (resource := own_resource_of(element)) is not None:
        resource.remove(element)
    return doomed


def _forget(owner: EObject, feature: EStructuralFeature, value: ItemOrItems) -> None:
    held = getattr(owner, key_of(feature))
    if not feature.many:
        if held is value:
            setattr(owner, key_of(feature), None)
        return
    while value in held:
        held.remove(value)
