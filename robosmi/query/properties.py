"""Properties: `get(x, "name")` as EOL's `x.name`, on anything.

Of an element its feature; of a collection the property of every item; of a Tuple a field; of an enumeration literal `name`,
`value`, `literal`; of anything an operation without arguments (`"robot".length`), as in the engine. None has no property:
`get` raises, `get_safe` gives None (EOL `?.`). Functions, modules, generators and the like have no properties.
"""

from __future__ import annotations

from collections.abc import Iterable
from operator import attrgetter
from types import BuiltinFunctionType, CodeType, FrameType, FunctionType, GeneratorType, MethodType, ModuleType, TracebackType
from typing import TYPE_CHECKING, Any, TypeVar, cast

from robosmi.model.elements.driver import ModelElement
from robosmi.model.elements.ecore import EClass, EEnumLiteral, EObject
from robosmi.model.elements.reachable import of_models
from robosmi.query.collections import Map, Tuple
from robosmi.query.live_collections import collection
from robosmi.query.naming import snake
from robosmi.query.operations import TABLES, has_plain_operation, plain_operation
from robosmi.query.problems import UndefinedError, UnknownPropertyError, describe, unknown_property
from robosmi.query.run import noted
from robosmi.query.values import EolType, collection_kind, compares_itself

if TYPE_CHECKING:
    from robosmi.model.elements.dynamic import Dynamic
    from robosmi.query.values import Answer

V = TypeVar("V")
_MISSING: Any = object()


def get(target: V, name: str) -> Dynamic:
    """A property (EOL `target.name`); `~name` is an extended one.

    Raises:
        UndefinedError: the target is None.
        ModelError: it has no such property.

    >>> get([[1, 2], [3]], "size"), get("robot", "length")
    (2, 5)
    """
    return cast("Dynamic", _property(target, name))


def _property(target: V, name: str) -> Answer:
    if target is None:
        raise UndefinedError(f"the property '{name}' cannot be read from nothing", fix="use get_safe, or a default")
    if name[:1] == "~":
        extended: Answer = noted(target, name[1:])
        return extended
    if isinstance(target, Tuple):
        field: Answer = target.field(name)
        return field
    if isinstance(target, EObject) and not isinstance(target, EEnumLiteral):
        feature = target.eClass.findEStructuralFeature(name)
        if feature is not None:
            value = getattr(target, name)
            return collection(value) if compares_itself(value.__class__) else value
        if isinstance(target, EClass) and name == "name":
            return target.name
    elif (collection_kind(target) is None or isinstance(target, (EEnumLiteral, EolType))) and not isinstance(target, Map | dict):
        value = _own(target, name)
        if value is not _MISSING:
            return collection(value) if isinstance(target, ModelElement) and compares_itself(value.__class__) else value
    if has_plain_operation(target, name):
        return cast("Answer", plain_operation(target, name))
    if collection_kind(target) is not None:
        return collection(target).get(name)
    raise unknown_property(describe(target), name, property_names(target))


def get_safe(target: V, name: str) -> Dynamic:
    """A property, or None if the target is None (EOL `target?.name`).

    >>> get_safe(None, "name") is None
    True
    """
    return cast("Dynamic", None if target is None else _property(target, name))


def has_property(target: V, name: str) -> bool:
    """Whether the target has the property (EOL `hasProperty`): a feature, a field, or an operation without arguments."""
    if isinstance(target, Tuple):
        return name in target
    if target is None:
        return False
    known = isinstance(target, EObject) and target.eClass.findEStructuralFeature(name) is not None
    return known or name in property_names(target) or has_plain_operation(target, name)


def get_all(items: Iterable[Any], name: str, default: Answer = _MISSING) -> list[Any]:
    """A property of every item, for `q.name`; items that are None give the default, without one they raise.

    Raises:
        UndefinedError: an item is None.
        ModelError: an item has no such property.
    """
    found = items if isinstance(items, list) else list(items)
    classes = {x.__class__ for x in found}
    if default is not _MISSING and type(None) in classes:
        return [default if x is None else _of(x, name) for x in found]
    if type(None) not in classes and all(_has_feature(cls, name) for cls in classes):
        try:
            values = list(map(attrgetter(name), found))
        except AttributeError:
            values = [_of(x, name) for x in found]  # an operation without arguments; one that has some raises
        if not any(compares_itself(cls) or issubclass(cls, _METHODS) for cls in {x.__class__ for x in values}):
            return values
    return [_of(x, name) for x in found]


def of_items(items: Iterable[V], name: str, default: Answer = _MISSING) -> list[Any]:
    """As `get_all`; where no item has the property, the error names the operation of collections that is meant, if one is near.

    Raises:
        UndefinedError, ModelError: as `get_all`.
    """
    try:
        return get_all(items, name, default)
    except UnknownPropertyError as error:
        from difflib import get_close_matches  # 4 ms, needed only for an error

        operations = TABLES["Collection"]
        near = snake(name) if snake(name) in operations else next(iter(get_close_matches(snake(name), operations, 1)), None)
        if near is None or "did you mean" in error.message:
            raise
        raise UnknownPropertyError(
            f"{error.message}, and a collection no operation of that name (did you mean '{near}'?)",
            location=error.location, fix="; ".join(filter(None, (f"write {near}(...) for the operation", error.fix))),
        ) from error  # fmt: skip


def _has_feature(cls: type, name: str) -> bool:
    """Whether a name is a feature of a class and nothing else of Python, so that it can be read directly."""
    if not name.isidentifier() or name[0] == "_" or compares_itself(cls):
        return False
    if issubclass(cls, EObject):
        kind = getattr(cls, "eClass", None)
        return isinstance(kind, EClass) and kind.findEStructuralFeature(name) is not None
    return issubclass(cls, ModelElement)


_METHODS = (FunctionType, MethodType)
_CLOSED = (
    str, int, float, FunctionType, MethodType, BuiltinFunctionType, GeneratorType, FrameType, CodeType, TracebackType, ModuleType,
    type,
)  # fmt: skip


def _of(target: V, name: str) -> Dynamic:
    return get(target, name)


def _own(target: Any, name: str) -> Any:
    """An attribute of a plain Python object; texts and numbers have methods only, and no method is a property."""
    if name[:1] in ("_", "") or isinstance(target, _CLOSED) or of_models(target, name) is False:
        return _MISSING
    value = getattr(target, name, _MISSING)
    if value is None and name == "literal" and isinstance(target, EEnumLiteral):
        return target.name  # EMF: a literal without a text of its own is written by its name
    return _MISSING if isinstance(value, _METHODS) or (callable(value) and not isinstance(value, EObject)) else value


def property_names(target: Any) -> list[str]:
    """The names of the properties a target has of its own."""
    if isinstance(target, Tuple):
        return list(target)
    if isinstance(target, EEnumLiteral):
        return ["name", "value", "literal"]
    if isinstance(target, ModelElement):
        return target._features()
    if isinstance(target, EObject):
        return [feature.name for feature in target.eClass.eAllStructuralFeatures()]
    if isinstance(target, EolType):
        return ["name"]
    attributes = getattr(target, "__dict__", None)  # no dict if the target is a class
    return [name for name in attributes if name[0] != "_"] if isinstance(attributes, dict) else []
