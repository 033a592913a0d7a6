"""Classes that a program made in pyecore (`EClass("Book")`) become as strict as ours: they refuse misspelt names, wrong values.

pyecore's dynamic classes take any name. They may change as long as the program runs, so that nothing of them is remembered here;
ours are `strict`'s business, those of generated code of other tools are left as they are.
"""

from __future__ import annotations

from typing import Any

from robosmi.errors import did_you_mean
from robosmi.model import ecore
from robosmi.model.ecore import EObject, EPackage
from robosmi.model.feature_errors import UnknownFeatureError, literal_wanted, value_refused
from robosmi.model.feature_values import Contents
from robosmi.model.in_order import all_contents
from robosmi.model.pyecore_internals import is_static
from robosmi.model.strict import INTERNAL, Element
from robosmi.model.structure import contents
from robosmi.typed import dynamic_attribute


def make_strict(package: EPackage) -> None:
    """Make the dynamic classes of an EPackage and its sub-packages strict, from now on and for whoever uses them.

    Args:
        package: the EPackage; what is in it later stays as pyecore makes it.
    """
    pending = [package]
    while pending:
        one = pending.pop()
        pending.extend(one.eSubpackages)
        for classifier in one.eClassifiers:
            cls = dynamic_attribute(classifier, "python_class", None)
            if not isinstance(classifier, ecore.EClass) or cls is None or issubclass(cls, Element):
                continue
            if not is_static(cls) and "__setattr__" not in cls.__dict__:
                cls.__setattr__ = _set
                cls.eContents = property(_contents)
                cls.eAllContents = all_contents


def _contents(self: EObject) -> Contents:
    return Contents(contents(self))


def _set(self: Any, name: str, value: Any) -> None:
    feature = dynamic_attribute(self.__class__, name, None)
    if feature is None and name[:1] != "_" and name not in INTERNAL:
        known = [str(f.name) for f in self.eClass.eAllStructuralFeatures()]
        raise UnknownFeatureError(
            f"{self.eClass.name} has no feature '{name}'{did_you_mean(name, known)}",
            fix=f"use one of: {', '.join(sorted(known))}",
        )
    if isinstance(feature, ecore.EAttribute) and isinstance(feature.eType, ecore.EEnum) and isinstance(value, str):
        raise literal_wanted(self.eClass.name, name, feature.eType, value)
    try:
        object.__setattr__(self, name, value)
    except TypeError as error:
        raise value_refused(self.eClass.name, name, value, error) from error
