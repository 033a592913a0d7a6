"""Operations by name: `call(x, "isDefined")` on anything.

A name may be written as in EOL or in Python's style (`sortBy`, `sort_by`). User-defined operations (`own_operations`) take
precedence. This module finds the operation of a name; `built_in` lists the built-in ones.
"""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

from robosmi.errors import RobosmiError, UsageError
from robosmi.model.elements.driver import Model, TypeHandle, is_element
from robosmi.model.elements.ecore import EClass, ECollection, EEnumLiteral
from robosmi.query import types
from robosmi.query.collections import Map, Q
from robosmi.query.first_order import FIRST_ORDER
from robosmi.query.live_collections import CHANGING, FeatureView, collection
from robosmi.query.naming import snake
from robosmi.query.own_operations import own_names, own_operation
from robosmi.query.problems import OperandError, describe, unknown_operation
from robosmi.query.run import current_run
from robosmi.query.values import collection_kind, equal

if TYPE_CHECKING:
    from robosmi.base.functions import Function
    from robosmi.model.elements.dynamic import Dynamic
    from robosmi.query.types import AnyKind


V = TypeVar("V")
W = TypeVar("W")
Table: TypeAlias = "dict[str, Function]"

TABLES: dict[str, Table] = {
    kind: {}
    for kind in (
        "Any", "Boolean", "Collection", "Element", "Integer", "Literal", "Map", "Model", "Number", "String", "Type",
    )
}  # fmt: skip
"""Kind of target -> the built-in operations by name in Python's way, which take the target first; `built_in` puts them in."""


def _tables(target: Any) -> list[Table]:
    """The tables of built-in operations that a target has, the first that knows the name counts."""
    return [TABLES[kind] for kind in _kinds(target)]


def _kinds(target: Any) -> tuple[str, ...]:
    if collection_kind(target) is not None:
        return "Collection", "Any"
    if isinstance(target, str):
        return "String", "Any"
    if isinstance(target, bool):
        return "Boolean", "Any"
    if isinstance(target, (int, float)):
        return ("Integer", "Number", "Any") if types.fits_integer(target) else ("Number", "Any")
    if isinstance(target, (Map, dict)):
        return "Map", "Any"
    if isinstance(target, Model):
        return "Model", "Any"
    if isinstance(target, (EClass, TypeHandle)):
        return "Type", "Element", "Any"
    if isinstance(target, EEnumLiteral):
        return "Literal", "Any"
    return ("Element", "Any") if is_element(target) else ("Any",)


def _built_in(target: Any, name: str) -> Function | None:
    closed = current_run().closed
    if name in closed or (closed and name in CHANGING and isinstance(target, (ECollection, FeatureView))):
        raise UsageError(f"an expression may not use the operation '{name}'", fix="see docs/reference/eol.md for what reads")
    for table in _tables(target):
        if (found := table.get(name)) is not None:
            return found
    return getattr(Q, name) if name in FIRST_ORDER else None


def call(target: V, name: str, *arguments: W, **options: AnyKind) -> Dynamic:
    """Call an operation of anything by name (EOL `target.name(...)`); operations of one's own come first.

    Args:
        target: anything, None too.
        name: as EOL or as Python writes it.
        arguments: values, or functions of an item for first-order operations.
        options: `kind=T` for first-order operations, EOL's typed iterator.

    Raises:
        UnknownOperationError: the target has none of that name.
        OperandError: it does not take these arguments.

    >>> call(7, "mod", 3), call([1, 2, 3], "select", lambda x: x > 1), call(None, "isUndefined")
    (1, Q([2, 3]), True)
    """
    plain = snake(name)
    own = own_operation(target, plain, len(arguments))
    if own is not None:
        made: Dynamic = own(target, *arguments)
        return made
    return call_built_in(target, name, *arguments, **options)


def call_built_in(target: V, name: str, *arguments: W, **options: AnyKind) -> Dynamic:
    """Call a built-in operation, passing over those of one's own (EOL `target->name(...)`).

    Raises:
        UnknownOperationError: the target has none of that name.
        OperandError: it does not take these arguments.
    """
    plain = snake(name)
    function = _built_in(target, plain)
    if function is None:
        known = [*(n for table in _tables(target) for n in table), *own_names(target)]
        raise unknown_operation("nothing" if target is None else describe(target), plain, known)
    of_collections = plain in TABLES["Collection"]
    receiver = collection(target) if plain in FIRST_ORDER or (of_collections and collection_kind(target) is not None) else target
    if isinstance(receiver, Q) and of_collections:
        function = (lambda other: equal(receiver, other)) if plain == "equals" else getattr(receiver, plain, None)
        assert function is not None
        return _guarded(function, plain, arguments, options)
    return _guarded(function, plain, (receiver, *arguments), options)


def _guarded(function: Function, name: str, arguments: tuple[V, ...], options: dict[str, AnyKind]) -> Dynamic:
    try:
        inspect.signature(function).bind(*arguments, **options)
    except TypeError as error:
        raise OperandError(f"{name}: {error}", fix="see docs/reference/eol.md for its arguments") from error
    try:
        made: Dynamic = function(*arguments, **options)
        return made
    except RobosmiError:
        raise
    except (TypeError, ValueError, AttributeError, ArithmeticError, LookupError) as error:
        raise OperandError(f"{name}: {error}") from error


def has_plain_operation(target: Any, name: str) -> bool:
    """Whether the target has an operation of that name that needs no argument, so that it can be read as a property."""
    function = own_operation(target, snake(name), 0) or _built_in(target, snake(name)) or _built_in(target, f"is_{snake(name)}")
    if function is None or (snake(name) in FIRST_ORDER and snake(name) != "first"):
        return False
    try:
        inspect.signature(function).bind(target)
    except TypeError:
        return False
    return True


def plain_operation(target: V, name: str) -> Dynamic:
    """The value of an operation without arguments, read as a property (`"robot".length`, `{1}.empty`)."""
    plain = snake(name)
    known = own_operation(target, plain, 0) or _built_in(target, plain)
    return call(target, plain if known else f"is_{plain}")
