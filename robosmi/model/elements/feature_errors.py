"""The errors of a feature's name or value that a model element does not take, and the features that its class declares.

What raises them is `strict` and `construct`, and the drivers of other technologies.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

from robosmi.errors import ModelError, did_you_mean
from robosmi.model.elements import ecore
from robosmi.model.elements.ecore import EEnum, EObject

LABELS = ("name", "title", "label", "id", "a_id", "a_name", "a_title", "elementId", "path")
"""The features that tell one element from another, the best first."""


REFUSAL = "_refusal"
"""Key in the `__dict__` of a read-only element: a function of the element and a feature's name that makes the error."""


class UnknownFeatureError(ModelError, AttributeError):
    """A feature that the element's class does not have."""


class FeatureValueError(ModelError, TypeError):
    """A value that the feature does not take."""


def value_error(owner: str, name: str, value: object, error: TypeError) -> FeatureValueError:
    """The error for a value that a feature does not take.

    Args:
        owner: name of the element's class.
        name: of the feature.
        value: what was given.
        error: what pyecore said of it.
    """
    said, expected = f"{owner}.{name} does not take {value!r}", getattr(error, "expected", None)
    if not isinstance(expected, ecore.EClassifier):
        if isinstance(expected, type) and issubclass(expected, ecore.ECollection):
            return FeatureValueError(
                f"{said}: it takes many values", fix=f"use {name}.append(value), {name}.extend(values) or clear()"
            )
        return FeatureValueError(f"{said}: {error}")
    kinds: list[ecore.EClassifier] = []
    if isinstance(value, ecore.EEnumLiteral) and isinstance(enumeration := value.eContainer(), EEnum):
        kinds = [enumeration]
    elif isinstance(value, EObject):
        kinds = [value.eClass, *value.eClass.eAllSuperTypes()]
    if any(is_another_load(kind, expected) for kind in kinds):
        where = f"metamodel '{expected.ePackage.nsURI}'" if expected.ePackage is not None else "metamodel"
        return FeatureValueError(f"{said}: its {expected.name} is that of another load of the {where}", fix=ONE_LOAD)
    fix = f"write {value}.0" if value.__class__ is int and expected.name in ("EDouble", "EFloat") else None
    return FeatureValueError(f"{said}: it takes {expected.name}, not {kinds[0].name if kinds else type(value).__name__}", fix=fix)


def is_another_load(kind: ecore.EClassifier | None, expected: ecore.EClassifier | None) -> bool:
    """Whether two different types have the same name in packages with the same namespace."""
    if kind is None or expected is None or kind is expected or kind.name != expected.name:
        return False
    return (kind.ePackage.nsURI if kind.ePackage else None) == (expected.ePackage.nsURI if expected.ePackage else None)


ONE_LOAD = "load the metamodel once and use that for both models, or open both in one Session (robosmi.model.Session)"
"""What to do where two loads of one metamodel meet, whose types are strangers to each other."""


_CACHE: dict[type, dict[str, Any]] = {}


def declared_features(cls: type) -> dict[str, Any]:
    """Feature name -> its enumeration, or None if it is of another type."""
    known = _CACHE.get(cls)
    if known is None:
        known = {}
        for base in reversed(cls.__mro__):
            for name, feature in base.__dict__.items():
                if isinstance(feature, ecore.EStructuralFeature):
                    known[name] = feature.eType if isinstance(feature.eType, ecore.EEnum) else None
        if getattr(cls, "eClass", None) is not None:
            _CACHE[cls] = known
    return known


_BODY = (
    "generate the metamodel's package (robosmi metamodels generate), write it in the package's mixins.py, and load models with "
    "the package: EmfModel.load(path, Metamodel([package]))"
)


class NotComputedError(ModelError):
    """A derived feature, or an operation, for which nothing but the metamodel is there."""


def not_computed(element: EObject, name: str) -> NotComputedError:
    """The error for a derived feature that no code computes."""
    cls = element.__class__
    is_generated = hasattr(sys.modules.get(cls.__module__), "eClassifiers")
    again = f"define it in class {cls.__name__}Mixin of mixins.py, and generate the package again"
    message = f"{type(element).__name__}.{name} is derived, and no code is there that computes it"
    return NotComputedError(message, fix=again if is_generated else _BODY)


def unknown_feature(element: EObject, name: str) -> UnknownFeatureError:
    """The error for a name that is no feature of the element, with the nearest that is; for an operation that it has no body."""
    if any(operation.name == name for operation in element.eClass.eAllOperations()):
        return UnknownFeatureError(
            f"the operation {type(element).__name__}.{name} has no body: a metamodel says only that there is one",
            fix=f"{_BODY}; in queries, write a function with @operation({type(element).__name__})",
        )
    known = declared_features(element.__class__)
    return UnknownFeatureError(
        f"{type(element).__name__} has no feature '{name}'{did_you_mean(name, known)}",
        fix=f"use one of: {', '.join(sorted(known))}",
    )


def not_named(kind: ecore.EClassifier | type, values: Sequence[object]) -> ModelError:
    """The error for values that a new element is given without the names of their features.

    Args:
        kind: the type that was called; an enumeration has no elements, whatever it is given.
        values: the values, if any.
    """
    if isinstance(kind, EEnum):
        literals = ", ".join(f"{kind.name}.{literal.name}" for literal in kind.eLiterals)
        return ModelError(f"{kind.name} is an enumeration, which has no elements", fix=f"use one of its literals: {literals}")
    eclass = kind if isinstance(kind, ecore.EClass) else getattr(kind, "eClass", None)
    name = kind.__name__ if isinstance(kind, type) else str(kind.name)
    known = sorted(str(feature.name) for feature in eclass.eAllStructuralFeatures()) if eclass is not None else []
    likely = next((each for each in LABELS if each in known), "FEATURE")
    features = f"; its features: {', '.join(known)}" if known else ""
    return FeatureValueError(
        f"{name} takes values by the names of its features, not {values[0]!r} alone",
        fix=f"write {name}({likely}={values[0]!r}){features}",
    )


def literal_error(owner: str, name: str, enumeration: EEnum, text: str) -> FeatureValueError:
    """The error for a text in the place of a literal.

    Args:
        owner: name of the element's class.
        name: of the feature.
        enumeration: the feature's type.
        text: what was given.
    """
    literals = ", ".join(f"{enumeration.name}.{literal.name}" for literal in enumeration.eLiterals)
    message = f"{owner}.{name} takes a literal of {enumeration.name}, not the text '{text}'"
    return FeatureValueError(message, fix=f"use one of: {literals}")
