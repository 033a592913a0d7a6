"""Two things of the standard library under signatures that keep the types of what goes in.

`dataclasses.field` and `dict.fromkeys` are declared with `Any`, for keywords that nobody here uses. Anything that is more than
a name for one call of the standard library does not belong here.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable
from dataclasses import field
from typing import TypeVar

T = TypeVar("T")
H = TypeVar("H", bound=Hashable)


def fresh(factory: Callable[[], T]) -> T:
    """The default of a dataclass's field that is made anew for each object: `field(default_factory=factory)`.

    >>> from dataclasses import dataclass
    >>> @dataclass
    ... class Shelf:
    ...     books: list[str] = fresh(list)
    >>> Shelf().books
    []
    """
    return field(default_factory=factory)


def distinct(values: Iterable[H]) -> list[H]:
    """Each value once, in the order in which they come first.

    >>> distinct(["red", "green", "red"])
    ['red', 'green']
    """
    return list(dict.fromkeys(values))
