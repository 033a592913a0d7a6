"""Types in queries: EOL's own (Integer, Collection, Any ...), and the types of models of any technology, with one interface.

A type may be given as a Python class (generated ones too), an EClass, a model's `m.Book`, an `EolType`, or a name ("Integer",
"Book", "library::Book", "M!Book"); names of model types are looked up in the models of the current run. Not here: extents.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, TypeAlias, TypeVar

from robosmi.model.elements import driver
from robosmi.model.elements.driver import TypeHandle, is_element, unknown_type
from robosmi.model.elements.ecore import EClass
from robosmi.query.run import current_run
from robosmi.query.values import INT_MAX, INT_MIN, EolType, Long, collection_kind

if TYPE_CHECKING:
    from robosmi.base.functions import Function


V = TypeVar("V")
AnyKind: TypeAlias = "driver.Kind | EolType"
"""How a type may be given: as a type of a model, its name, a class, or one of EOL's own."""


def _collection(*kinds: str) -> Function:
    return lambda x: collection_kind(x) in kinds


def _map(name: str) -> Function:
    return lambda x: getattr(x.__class__, "_eol_map", "Map" if isinstance(x, dict) else "") == name


_BUILT_IN = {
    t.name: t
    for t in (
        EolType("Integer", lambda x: isinstance(x, int) and x.__class__ is not bool),
        EolType("Real", lambda x: isinstance(x, float), lambda x: isinstance(x, (int, float)) and x.__class__ is not bool),
        EolType("String", lambda x: isinstance(x, str)),
        EolType("Boolean", lambda x: isinstance(x, bool)),
        EolType("Any", lambda x: False, lambda x: True),
        EolType("Collection", lambda x: False, lambda x: collection_kind(x) is not None),
        EolType("Sequence", _collection("Sequence")),
        EolType("Bag", _collection("Bag"), _collection("Bag", "Sequence")),
        EolType("Set", _collection("Set"), _collection("Set", "OrderedSet")),
        EolType("OrderedSet", _collection("OrderedSet")),
        EolType("Map", _map("Map"), lambda x: _map("Map")(x) or _map("Tuple")(x)),
        EolType("Tuple", _map("Tuple")),
    )
}
_OF_PYTHON = {
    int: "Integer",
    float: "Real",
    str: "String",
    bool: "Boolean",
    object: "Any",
    list: "Sequence",
    set: "Set",
    dict: "Map",
    Long: "Integer",
}


def type_named(name: str) -> driver.Type | EolType:
    """A type by name: one of EOL's own, else a class of the current run's models (`Book`, `library::Book`, `M!Book`).

    Raises:
        UnknownTypeError: there is none.

    >>> type_named("Integer")
    Integer
    """
    if (found := _BUILT_IN.get(name)) is not None:
        return found
    models = current_run().models
    model_name, _, type_name = name.rpartition("!")
    for model in models:
        if (not model_name or model.name == model_name) and (kind := model.find_type(type_name)) is not None:
            return kind
    raise unknown_type(name, [*_BUILT_IN, *(n for model in models for n in model.type_names())])


def resolve(kind: AnyKind) -> type | EolType:
    """A type in any of its forms as an `EolType` or a Python class.

    Raises:
        UnknownTypeError: a name that does not exist.
        TypeError: no type at all.
    """
    if isinstance(kind, str):
        kind = type_named(kind)
    if isinstance(kind, EolType):
        return kind
    if isinstance(kind, (EClass, TypeHandle)):
        return driver.class_of(kind)
    if isinstance(kind, type):
        name = _OF_PYTHON.get(kind) or (kind.__dict__.get("_eol_kind") or kind.__dict__.get("_eol_map"))
        return _BUILT_IN[name] if name else kind
    raise TypeError(f"{kind!r} is no type")


def is_kind_of(value: V, kind: AnyKind) -> bool:
    """Whether the value is of the type or a subtype (EOL `isKindOf`, `instanceOf`); Integer conforms to Real.

    >>> is_kind_of(1, float), is_kind_of([1], "Bag"), is_kind_of("s", "Any")
    (True, True, True)
    """
    resolved = resolve(kind)
    return bool(resolved.is_kind(value)) if isinstance(resolved, EolType) else isinstance(value, resolved)


def is_type_of(value: V, kind: AnyKind) -> bool:
    """Whether the value is of exactly the type (EOL `isTypeOf`).

    >>> is_type_of(1, float), is_type_of([1], "Sequence")
    (False, True)
    """
    resolved = resolve(kind)
    return bool(resolved.is_type(value)) if isinstance(resolved, EolType) else value.__class__ is resolved


def matching(items: Iterable[V], kind: AnyKind, exact: bool = False) -> list[V]:
    """The items of the kind, or of exactly the type."""
    resolved = resolve(kind)
    if isinstance(resolved, EolType):
        test = resolved.is_type if exact else resolved.is_kind
        return [x for x in items if test(x)]
    if exact:
        return [x for x in items if x.__class__ is resolved]
    return [x for x in items if isinstance(x, resolved)]


def type_of(value: V) -> driver.Type | EolType | None:
    """The type of a value (EOL `type`): an `EolType`, an EClass or a class for model elements, None for anything else.

    >>> type_of(1), type_of({1}), type_of(None)
    (Integer, Set, None)
    """
    if is_element(value):
        return driver.type_of(value)
    for name in ("String", "Boolean", "Real", "Integer", "Bag", "Sequence", "Set", "OrderedSet", "Tuple", "Map"):
        if _BUILT_IN[name].is_type(value):
            return _BUILT_IN[name]
    return None


def fits_integer(value: V) -> bool:
    """Whether the value is an Integer of 32 bits (a Long is none)."""
    return value.__class__ is int and isinstance(value, int) and INT_MIN <= value <= INT_MAX
