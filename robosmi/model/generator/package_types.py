"""Maps Ecore's types to Python: annotations, the objects that pyecore needs as `eType`, and default values.

Tables and small functions over descriptions. What cannot be expressed leads to a note in the report, never to a guess.
"""

from __future__ import annotations

import re
from typing import Any

from msgspec import Struct

from robosmi.diagnostics import Finding, Severity
from robosmi.model.ecore.ecore_description import (
    ECORE,
    Class,
    Classifier,
    DataType,
    DescribedElement,
    Enumeration,
    Feature,
    Typed,
    is_known,
)
from robosmi.model.ecore.source_text import string
from robosmi.model.generator.package_names import PackageNames, Scope
from robosmi.model.strict_package import XML_JAVA, python_type

STRICT = "robosmi.model.strict"
PARTS = "robosmi.model.strict_package"
MAP_ENTRY = "EStringToStringMapEntry"
_BASES = {"EModelElement": "AnnotatedBase", "ENamedElement": "NamedBase"}
"""The classes of Ecore, beside EObject, that a generated class may inherit from -> what stands for them in Python."""

_ECORE_TYPES = {
    "EString": "str", "EChar": "str", "ECharacterObject": "str",
    "EInt": "int", "ELong": "int", "EShort": "int",
    "EIntegerObject": "int", "ELongObject": "int", "EShortObject": "int", "EBigInteger": "int",
    "EBoolean": "bool", "EBooleanObject": "bool",
    "EDouble": "float", "EFloat": "float", "EDoubleObject": "float", "EFloatObject": "float",
    "EBigDecimal": "Decimal", "EDate": "datetime", "EByte": "bytes", "EByteObject": "bytes", "EByteArray": "bytearray",
}  # fmt: skip
_NEVER_NONE = {"EInt", "ELong", "EShort", "EBoolean", "EDouble", "EFloat"}
_MODULE_OF = {"Decimal": "decimal", "datetime": "datetime"}
_ABSENT = {
    "EEList",
    "EEnumerator",
    "EFeatureMap",
    "EInvocationTargetException",
    "EMap",
    "EResource",
    "EResourceSet",
    "ETreeIterator",
}
_REAL = re.compile(r"[+-]?([0-9]+(?:\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?[fFdD]?|[+-]?Infinity|NaN")


_MOST_DIGITS = 4000
"""Of a whole number in source code; Python reads 4,300."""


class Notes(Struct):
    """What the user should know about what was generated."""

    findings: list[Finding] = []

    def add(self, rule: str, severity: Severity, element: DescribedElement, path: str, message: str, fix: str) -> None:
        """Note one thing about one element of the metamodel."""
        self.findings.append(Finding(rule, severity, message, element.location, path, fix))


def is_feature_map(feature: Feature) -> bool:
    """Whether it is a feature map, which has no counterpart in pyecore."""
    kind = feature.classifier
    return kind is not None and kind.package is ECORE and kind.name in ("EFeatureMapEntry", "EFeatureMap")


def _java(kind: DataType) -> str:
    if is_known(kind) and kind.package is not ECORE:
        return XML_JAVA.get(kind.name, "java.lang.String")
    return kind.instance_class


def is_base(kind: Class) -> bool:
    """Whether a class is a base of generated classes: any but EObject, which all have."""
    return not is_known(kind) or (kind.package is ECORE and kind.name in _BASES)


def base_name(kind: Class, scope: Scope, when: str = "run") -> str:
    """The local name of a base class."""
    return scope.symbol(PARTS, _BASES[kind.name], when) if is_known(kind) else scope.classifier(kind, when, inside=False)


def value_type(kind: Classifier) -> str:
    """The Python type of a data type's values, or an empty text where any value does."""
    if kind.package is ECORE:
        return _ECORE_TYPES.get(kind.name, "")
    found = python_type(_java(kind)) if isinstance(kind, DataType) else None
    return "" if found is None or found is object else found.__name__


def type_name(kind: Classifier | None, scope: Scope, when: str = "typing") -> str:
    """The annotation for one value of a type."""
    if kind is None:
        return scope.symbol("typing", "Any")
    if isinstance(kind, Class):
        if not is_known(kind):
            return scope.classifier(kind, when)
        if kind.name == MAP_ENTRY:
            return scope.symbol(PARTS, MAP_ENTRY)
        return scope.symbol(STRICT, "Element") if kind.name == "EObject" else scope.symbol("typing", "Any")
    if isinstance(kind, Enumeration):
        return scope.classifier(kind, when)
    name = value_type(kind)
    return scope.symbol(_MODULE_OF.get(name, "builtins"), name) if name else scope.symbol("typing", "Any")


def is_typed(kind: Classifier | None) -> bool:
    """Whether the annotation for one value of a type says more than `Any`."""
    if isinstance(kind, Class):
        return type_is_named(kind)
    return isinstance(kind, Enumeration) or (kind is not None and bool(value_type(kind)))


def may_be_none(typed: Typed, default: str | None) -> bool:
    """Whether a single value can be None."""
    kind = typed.classifier
    if kind is None or isinstance(kind, Class):
        return kind is not None and type_is_named(kind)
    if isinstance(kind, Enumeration):
        return not kind.literals
    if not value_type(kind) or typed.lower > 0 or default is not None:
        return False
    if kind.package is ECORE:
        return kind.name not in _NEVER_NONE
    assert isinstance(kind, DataType)
    return "." in _java(kind) or _java(kind) == "char"


def type_is_named(kind: Class) -> bool:
    """Whether the annotation of a class is a name and not `Any`."""
    return not is_known(kind) or kind.name in ("EObject", MAP_ENTRY)


def annotation(typed: Typed, scope: Scope, default: str | None = None) -> str:
    """The annotation of a feature, a parameter or a result."""
    name = type_name(typed.classifier, scope)
    if typed.many:
        return f"{scope.symbol('collections.abc', 'MutableSequence')}[{name}]"
    return f"{name} | None" if may_be_none(typed, default) else name


def pyecore_type(kind: Classifier | None, scope: Scope, when: str = "run") -> str:
    """What pyecore gets as `eType`."""
    if kind is None:
        return "None"
    if not is_known(kind):
        return scope.classifier(kind, when)
    if kind.package is not ECORE:
        return (
            f"{scope.symbol(PARTS, 'xml_type', when)}({string(kind.name)})"
            if isinstance(kind, DataType)
            else _eobject(scope, when)
        )
    if kind.name in _ABSENT:
        return scope.symbol(PARTS, "EJavaObject", when)
    return _eobject(scope, when) if kind.name == "EFactory" else scope.symbol(PARTS, kind.name, when)


def _eobject(scope: Scope, when: str) -> str:
    return scope.symbol(PARTS, "EObject", when)


def default_value(feature: Feature, scope: Scope, names: PackageNames, notes: Notes, when: str = "run") -> tuple[str, str] | None:
    """The keyword and the source text of an attribute's default value, or None where there is none."""
    text, kind = feature.default, feature.classifier
    if text is None or feature.is_reference or feature.many or kind is None:
        return None
    if isinstance(kind, Enumeration):
        found = next((x for x in kind.literals if x.text == text), None) or next(
            (x for x in kind.literals if x.name == text), None
        )
        if found is not None:
            return "default_value", f"{scope.classifier(kind, when)}.{names[found]}"
    elif (made := _plain_default(text, value_type(kind), scope)) is not None:
        return made
    notes.add(
        "RS603", Severity.warning, feature, feature.path,
        f"the default value '{text}' of '{feature.path}' is no value of {kind.name}; it has none in Python",
        "correct defaultValueLiteral in the .ecore file",
    )  # fmt: skip
    return None


def _plain_default(text: str, name: str, scope: Scope) -> tuple[str, str] | None:
    if name == "str":
        return "default_value", string(text)
    if name == "int":
        return ("default_value", str(int(text))) if re.fullmatch(f"[+-]?[0-9]{{1,{_MOST_DIGITS}}}", text.strip()) else None
    if name == "bool":
        return ("default_value", text.strip().capitalize()) if text.strip().lower() in ("true", "false") else None
    if name == "float":
        if not _REAL.fullmatch(text.strip()):
            return None
        value: Any = float(text.strip().rstrip("fFdD").replace("Infinity", "inf"))
        plain = value == value and abs(value) != float("inf")
        return "default_value", repr(value) if plain else f'{scope.symbol("builtins", "float")}("{value}")'
    if name in ("bytes", "bytearray"):
        return None
    return "defaultValueLiteral", string(text)
