"""Setting a feature of an element from a rule: many values to a many-valued feature, one to a single-valued one, nothing else.

Works on every technology's elements; those of EMF by their feature.
"""

from __future__ import annotations

from typing import Any

from robosmi.errors import ModelError, did_you_mean
from robosmi.model.elements.by_name import feature_value
from robosmi.model.elements.driver import FeatureValue, Node, features_of
from robosmi.model.elements.ecore import EObject
from robosmi.query.values import collection_kind


def is_many(target: Node, name: str) -> bool:
    """Whether a feature of an element is many-valued.

    Raises:
        ModelError: there is no such feature.
    """
    if isinstance(target, EObject):
        feature = target.eClass.findEStructuralFeature(name)
        if feature is not None:
            return bool(feature.many)
    elif name in features_of(target):
        return collection_kind(feature_value(target, name)) is not None
    known = features_of(target)
    raise ModelError(f"{target!r} has no feature '{name}'{did_you_mean(name, known)}", fix=f"use one of: {', '.join(known)}")


def assign(target: Node, name: str, value: Any, given: FeatureValue = None) -> None:
    """Set a feature; None leaves a many-valued one as it is.

    Args:
        target: the element.
        name: the feature.
        value: what it gets.
        given: what the value was made from, for the message.

    Raises:
        ModelError: there is no such feature, or one value is given for many, or a collection for one.
    """
    collection = collection_kind(value) is not None
    if not is_many(target, name):
        if collection:
            raise ModelError(
                f"{name} of {target!r} has one value, not the equivalents of a collection",
                fix="give one element, or take one of the collection",
            )
        setattr(target, name, value)
        return
    if value is None:
        return
    if not collection:
        raise ModelError(
            f"{name} of {target!r} is many-valued, not the equivalent of {given!r}", fix=f"put it into a list: {name}=[x]"
        )
    values = getattr(target, name)
    values.clear()
    values.extend(list(value))
