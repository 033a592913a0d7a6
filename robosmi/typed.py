"""Wrappers of standard library functions whose signatures preserve the types of their arguments.

Only wrappers of a single standard library call belong here.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Hashable, Iterable, Iterator
from typing import Any, AnyStr, ParamSpec, TypeVar, cast

from msgspec import Struct, structs

A = TypeVar("A")
B = TypeVar("B")
C = TypeVar("C")
H = TypeVar("H", bound=Hashable)
N = TypeVar("N", int, float)
P = ParamSpec("P")
S = TypeVar("S", bound=Struct)
T = TypeVar("T")


def attribute_of(thing: object, name: str, kind: type[T]) -> T | None:
    """The attribute of that name, where there is one and it is of that kind; None otherwise.

    >>> attribute_of(print, "__name__", str), attribute_of(print, "name", str)
    ('print', None)
    """
    found: object = getattr(thing, name, None)
    return found if isinstance(found, kind) else None


def class_name(thing: object) -> str:
    """The name of a thing's class.

    >>> class_name(1)
    'int'
    """
    return type(thing).__name__


def distinct(values: Iterable[H]) -> list[H]:
    """Each value once, in the order in which they come first.

    >>> distinct(["red", "green", "red"])
    ['red', 'green']
    """
    return list(dict.fromkeys(values))


def dynamic_attribute(thing: object, name: str, *default: object) -> Any:
    """The attribute of a name known only at run time, such as a feature of a model's element.

    If a type is expected, use `attribute_of`.

    Args:
        thing: the object.
        name: the attribute's name.
        default: the result if there is no such attribute; without it, that is an AttributeError.

    >>> dynamic_attribute("red", "upper")()
    'RED'
    """
    return getattr(thing, name, *default)


def first_of(values: Iterable[T]) -> T:
    """The first of some values, of which there is at least one.

    >>> first_of({"red": 1, "green": 2})
    'red'
    """
    return next(iter(values))


def in_threes(first: Iterable[A], second: Iterable[B], third: Iterable[C], *, strict: bool = True) -> Iterator[tuple[A, B, C]]:
    """The values of three collections side by side; `strict` as for `paired`.

    >>> list(in_threes("ab", [1, 2], "xy"))
    [('a', 1, 'x'), ('b', 2, 'y')]
    """
    return zip(first, second, third, strict=strict)


def kept(function: Callable[P, T]) -> Callable[P, T]:
    """Decorator: keep all results of a function by its arguments, as `functools.cache` does."""
    return cast("Callable[P, T]", functools.cache(function))


def matches(pattern: re.Pattern[AnyStr] | AnyStr, text: AnyStr, flags: int = 0) -> list[AnyStr]:
    """What a pattern finds in a text, in order: what its group matched if it has one, the whole match if it has none.

    >>> matches(r"(\\w+)=", "red=1 green=2")
    ['red', 'green']
    """
    compiled = pattern if isinstance(pattern, re.Pattern) else re.compile(pattern, flags)
    if compiled.groups > 1:
        raise TypeError(f"the pattern {compiled.pattern!r} has several groups: ask finditer for what each of them matched")
    return compiled.findall(text)


def paired(first: Iterable[A], second: Iterable[B], *, strict: bool = True) -> Iterator[tuple[A, B]]:
    """The values of two collections side by side.

    Args:
        first, second: the collections.
        strict: whether one that is longer than the other is an error (ValueError); otherwise what is left of it is not asked for.

    >>> list(paired(["red", "green"], [1, 2]))
    [('red', 1), ('green', 2)]
    """
    return zip(first, second, strict=strict)


def side_by_side(columns: Iterable[Iterable[A]], *, strict: bool = True) -> Iterator[tuple[A, ...]]:
    """The values of any number of collections side by side; `strict` as for `paired`.

    >>> list(side_by_side(["ab", "xy"]))
    [('a', 'x'), ('b', 'y')]
    """
    return zip(*columns, strict=strict)


def sum_of(numbers: Iterable[N]) -> N:
    """The sum of numbers; 0 if there are none.

    >>> sum_of([1, 2])
    3
    """
    return sum(numbers)


def remembered(most: int) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """Decorator: keep the latest results of a function by its arguments, as `functools.lru_cache` does.

    Args:
        most: how many results are kept.
    """

    def decorate(function: Callable[P, T]) -> Callable[P, T]:
        return cast("Callable[P, T]", functools.lru_cache(maxsize=most)(function))

    return decorate


def replaced(record: S, **changes: object) -> S:
    """A copy of a record in which some fields have other values.

    >>> class Point(Struct):
    ...     x: int
    ...     y: int
    >>> replaced(Point(1, 2), y=3)
    Point(x=1, y=3)
    """
    return structs.replace(record, **changes)
