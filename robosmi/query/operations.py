"""Operations by name: `call(x, "isDefined")` on anything, and operations of one's own, registered with `@operation(Type)`.

A name is taken as EOL writes it or in Python's way (`sortBy`, `sort_by`). An operation of one's own comes before a built-in one;
among several the one with the most specific context type counts. `@cached` ones keep their result per object for the run.
Here a name finds its operation; which built-in operations there are is `built_in`'s business, what they do theirs.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable
from functools import cache, wraps
from typing import Any, TypeVar

from pyecore.ecore import EClass, EEnumLiteral
from pyecore.valuecontainer import ECollection

from robosmi.errors import RobosmiError, UsageError
from robosmi.model.driver import Model, TypeHandle, is_element
from robosmi.query import types
from robosmi.query.collections import Map, Q, collection
from robosmi.query.first_order import FIRST_ORDER
from robosmi.query.held import CHANGING, HeldByFeature
from robosmi.query.problems import OperandError, describe, unknown_operation
from robosmi.query.run import current_run
from robosmi.query.values import collection_kind, equal, key

F = TypeVar("F", bound=Callable[..., Any])


Table = dict[str, Callable[..., Any]]

TABLES: dict[str, Table] = {
    kind: {}
    for kind in (
        "Any", "Boolean", "Collection", "Element", "Integer", "Literal", "Map", "Model", "Number", "String", "Type",
    )
}  # fmt: skip
"""Kind of target -> the built-in operations by name in Python's way, which take the target first; `built_in` puts them in."""


@cache
def snake(name: str) -> str:
    """An EOL name in Python's way.

    >>> snake("atLeastNMatch"), snake("ftuc")
    ('at_least_n_match', 'ftuc')
    """
    return re.sub(r"(?<!^)(?=[A-Z])", "_", name).lower().rstrip("_")


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


def _built_in(target: Any, name: str) -> Callable[..., Any] | None:
    closed = current_run().closed
    if name in closed or (closed and name in CHANGING and isinstance(target, (ECollection, HeldByFeature))):
        raise UsageError(f"an expression may not use the operation '{name}'", fix="see docs/reference/eol.md for what reads")
    for table in _tables(target):
        if (found := table.get(name)) is not None:
            return found
    return getattr(Q, name) if name in FIRST_ORDER else None


def call(target: Any, name: str, *arguments: Any, **options: Any) -> Any:
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
    own = _own(target, plain, len(arguments))
    if own is not None:
        return own(target, *arguments)
    return call_built_in(target, name, *arguments, **options)


def call_built_in(target: Any, name: str, *arguments: Any, **options: Any) -> Any:
    """Call a built-in operation, passing over those of one's own (EOL `target->name(...)`).

    Raises:
        UnknownOperationError: the target has none of that name.
        OperandError: it does not take these arguments.
    """
    plain = snake(name)
    function = _built_in(target, plain)
    if function is None:
        known = [n for table in [*_tables(target), *_registered_names(target)] for n in table]
        raise unknown_operation("nothing" if target is None else describe(target), plain, known)
    of_collections = plain in TABLES["Collection"]
    receiver = collection(target) if plain in FIRST_ORDER or (of_collections and collection_kind(target) is not None) else target
    if isinstance(receiver, Q) and of_collections:
        function = (lambda other: equal(receiver, other)) if plain == "equals" else getattr(receiver, plain, None)
        assert function is not None
        return _guarded(function, plain, arguments, options)
    return _guarded(function, plain, (receiver, *arguments), options)


def _guarded(function: Callable[..., Any], name: str, arguments: tuple[Any, ...], options: dict[str, Any]) -> Any:
    try:
        inspect.signature(function).bind(*arguments, **options)
    except TypeError as error:
        raise OperandError(f"{name}: {error}", fix="see docs/reference/eol.md for what it takes") from error
    try:
        return function(*arguments, **options)
    except RobosmiError:
        raise
    except (TypeError, ValueError, AttributeError, ArithmeticError, LookupError) as error:
        raise OperandError(f"{name}: {error}") from error


def has_plain_operation(target: Any, name: str) -> bool:
    """Whether the target has an operation of that name that needs no argument, so that it can be read as a property."""
    function = _own(target, snake(name), 0) or _built_in(target, snake(name)) or _built_in(target, f"is_{snake(name)}")
    if function is None or (snake(name) in FIRST_ORDER and snake(name) != "first"):
        return False
    try:
        inspect.signature(function).bind(target)
    except TypeError:
        return False
    return True


def plain_operation(target: Any, name: str) -> Any:
    """The value of an operation without arguments, read as a property (`"robot".length`, `{1}.empty`)."""
    plain = snake(name)
    known = _own(target, plain, 0) or _built_in(target, plain)
    return call(target, plain if known else f"is_{plain}")


class _Operation:
    """An operation of one's own: its context type, its function, whether it is cached."""

    def __init__(self, context: Any, function: Callable[..., Any], cached: bool) -> None:
        self.context = context
        self.function = function
        self.cached = cached
        parameters = inspect.signature(function).parameters.values()
        self.most = len(parameters) - 1
        self.least = sum(1 for p in parameters if p.default is p.empty) - 1

    def run(self, target: Any, *arguments: Any) -> Any:
        if not self.cached:
            return self.function(target, *arguments)
        notes = current_run().notes_of(target)
        place = (self, tuple(map(key, arguments)))
        if place not in notes:
            notes[place] = self.function(target, *arguments)
        return notes[place]


_REGISTERED: dict[str, list[_Operation]] = {}


def operation(context: Any, *, name: str | None = None) -> Callable[[F], F]:
    """Register a function as an operation of all objects of a type (EOL `operation Book isOld() : Boolean`).

    Args:
        context: the type: a class, an EClass, an EOL type or its name.
        name: the operation's name; the function's if None.

    The decorated function, called itself, is dispatched too: by the most specific context type among the operations of its name.
    A second registration for the same type replaces the first.

    >>> @operation(int)
    ... def doubled(self): return 2 * self
    >>> call(21, "doubled"), doubled(4)
    (42, 8)
    """

    def register(function: F) -> F:
        plain = snake(name or function.__name__)
        made = _Operation(context, function, getattr(function, "_eol_cached", False))
        others = [o for o in _REGISTERED.get(plain, []) if o.context is not context and o.context != context]
        _REGISTERED[plain] = [*others, made]

        @wraps(function)
        def dispatched(target: Any, *arguments: Any) -> Any:
            own = _own(target, plain, len(arguments))
            if own is None:
                raise unknown_operation("nothing" if target is None else describe(target), plain, _REGISTERED)
            return own(target, *arguments)

        return dispatched  # type: ignore[return-value]

    return register


def cached(function: F) -> F:
    """Keep an operation's result per object and arguments for the run (EOL `@cached`); written under `@operation`."""
    function._eol_cached = True  # type: ignore[attr-defined]
    return function


def _own(target: Any, name: str, arguments: int) -> Callable[..., Any] | None:
    best: _Operation | None = None
    for candidate in _REGISTERED.get(name, ()):
        fits = candidate.least <= arguments <= candidate.most and types.is_kind_of(target, candidate.context)
        if fits and (best is None or _more_specific(candidate.context, best.context, target)):
            best = candidate
    return None if best is None else best.run


def _more_specific(one: Any, other: Any, target: Any) -> bool:
    if types.is_type_of(target, one) != types.is_type_of(target, other):
        return types.is_type_of(target, one)
    first, second = types.resolve(one), types.resolve(other)
    if isinstance(first, type) and isinstance(second, type):
        return first is not second and issubclass(first, second)
    return isinstance(second, types.EolType) and second.name == "Any"


def _registered_names(target: Any) -> list[dict[str, Any]]:
    return [{n: None for n, found in _REGISTERED.items() if any(types.is_kind_of(target, o.context) for o in found)}]
