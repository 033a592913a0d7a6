"""Flock's conservative copy: copies the features of an element that the newer metamodel still accepts.

A feature is copied if the new class has one of that name and the value conforms to it; all others are dropped, and only lost
enumeration literals are reported. For EMF models only. Source: Rose et al., Model Migration with Epsilon Flock (ICMT 2010), and
measurements (docs/reference/flock.md).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from robosmi.model.by_name import feature_value
from robosmi.model.driver import Item, class_of
from robosmi.model.ecore import EClassifier, EEnum, EEnumLiteral, EObject, EStructuralFeature
from robosmi.model.features import all_features
from robosmi.query.values import collection_kind

_BOXED = {
    "boolean": "java.lang.Boolean", "byte": "java.lang.Byte", "char": "java.lang.Character", "double": "java.lang.Double",
    "float": "java.lang.Float", "int": "java.lang.Integer", "long": "java.lang.Long", "short": "java.lang.Short",
}  # fmt: skip
_OF_ECORE = {
    "EBoolean": "boolean", "EBooleanObject": "boolean", "EByte": "byte", "EByteObject": "byte", "EChar": "char",
    "ECharacterObject": "char", "EDouble": "double", "EDoubleObject": "double", "EFloat": "float", "EFloatObject": "float",
    "EInt": "int", "EIntegerObject": "int", "ELong": "long", "ELongObject": "long", "EShort": "short", "EShortObject": "short",
    "EString": "java.lang.String", "EDate": "java.util.Date", "EBigInteger": "java.math.BigInteger",
    "EBigDecimal": "java.math.BigDecimal",
}  # fmt: skip
NONE: Any = object()
"""Stands for a value that cannot be copied."""


class ConservativeCopy:
    """Copies features between elements of two metamodels.

    Args:
        equivalent: element of the original model -> its equivalent, None if it has none, itself if it is of another model.
        literal: enumeration and literal by name -> the literal of the new metamodel, or None.
        warn: takes warnings.
    """

    def __init__(
        self,
        equivalent: Callable[[EObject], EObject | None],
        literal: Callable[[str, str], EEnumLiteral | None],
        warn: Callable[[str], None],
    ) -> None:
        self._equivalent = equivalent
        self._literal = literal
        self._warn = warn

    def copy(self, original: EObject, migrated: EObject, ignored: Iterable[str]) -> None:
        """Copy all features that both elements' classes have, but the ignored ones, in the order of the original class."""
        new = {f.name: f for f in all_features(migrated.eClass)}
        skipped = set(ignored)
        for feature in all_features(original.eClass):
            wanted = new.get(feature.name)
            if wanted is None or feature.name in skipped or feature.derived or wanted.derived or not wanted.changeable:
                continue
            value = self._fitting(self._copied(feature, feature_value(original, feature.name)), feature, wanted)
            if value is NONE:
                continue
            if wanted.many:
                values = getattr(migrated, wanted.name)
                values.clear()
                values.extend(value)
            else:
                setattr(migrated, wanted.name, value)

    def _copied(self, feature: EStructuralFeature, value: Any) -> Any:
        if feature.many:
            return [c for c in (self.value(v) for v in value) if c is not None]
        return self.value(value)

    def value(self, value: Any) -> Any:
        """One value as the new model has it: equivalents of elements, literals of the same name, others as they are."""
        if isinstance(value, EEnumLiteral):
            enumeration = value.eContainer()
            literal = self._literal(enumeration.name, value.name) if isinstance(enumeration, EEnum) else None
            if literal is None:
                self._warn(f"Could not find in migrated metamodel an enumeration value equivalent to: {value.name}")
            return literal
        return self._equivalent(value) if isinstance(value, EObject) else value

    def _fitting(self, value: Any, feature: EStructuralFeature, wanted: EStructuralFeature) -> Any:
        """The value as the new feature takes it, or NONE."""
        if feature.many:
            upper = wanted.upperBound if wanted.upperBound >= 0 else len(value)
            if not wanted.many or not wanted.lowerBound <= len(value) <= upper:
                return NONE
            return value if all(_is_instance(v, feature, wanted) for v in value) else NONE
        if value is None or not _is_instance(value, feature, wanted):
            return NONE
        return [value] if wanted.many else value


def _is_instance(value: Item, feature: EStructuralFeature, wanted: EStructuralFeature) -> bool:
    """Whether a value of one feature is an instance of another one's type, as Java's classes have it."""
    kind = wanted.eType
    if isinstance(kind, EEnum):
        return isinstance(value, EEnumLiteral) and value.eContainer() is kind
    if wanted.is_reference:
        return isinstance(value, class_of(kind))
    if isinstance(value, (EEnumLiteral, EObject)) or isinstance(feature.eType, EEnum):
        return False
    return _java_class(kind) in (_java_class(feature.eType), "java.lang.Object")


def _java_class(datatype: EClassifier) -> str:
    name = datatype.instanceClassName or _OF_ECORE.get(datatype.name, "java.lang.Object")
    return _BOXED.get(name, name)


def restore_order(original: EObject, migrated: EObject, equivalent: Callable[[EObject], EObject | None]) -> None:
    """Give the many-valued references of an element the order of the original, where copying their opposites changed it."""
    for feature in all_features(migrated.eClass):
        if not (feature.is_reference and feature.many and feature.eOpposite and not feature.derived):
            continue
        old: Any = getattr(original, feature.name, None)
        if collection_kind(old) is None:
            continue
        values = getattr(migrated, feature.name)
        wanted = [e for e in (equivalent(x) for x in old) if e is not None]
        if list(values) != wanted and len(values) == len(wanted) and {id(x) for x in values} == {id(x) for x in wanted}:
            values.items[:] = wanted
            values.map.update({element: index for index, element in enumerate(wanted)})
