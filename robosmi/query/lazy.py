"""`Lazy`, a view of a collection whose operations look at an item only when it is asked for.

EOL's operations are eager: `select(f).first()` tests every item. A lazy chain gives the same answer as long as its functions
change nothing and fail for no item that is not reached; only the author can know that, so it is asked for: `q.lazy()`, or
`Lazy(all_contents(root))` for elements that are never all made. Ends with an answer, with a loop, or with `eager()`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any, Generic, TypeVar

from robosmi.query.collections import Bag, Q
from robosmi.query.types import EolType, resolve

T = TypeVar("T")
R = TypeVar("R")


class Lazy(Generic[T]):
    """A view of an iterable; every loop over it asks the source again.

    Args:
        source: a collection, or any iterable.

    >>> tested = []
    >>> Q(range(1000)).lazy().select(lambda x: tested.append(x) or x > 1).first(), len(tested)
    (2, 3)
    """

    def __init__(self, source: Iterable[T], kind: type[Q[Any]] | None = None) -> None:
        self._source = source
        self._kind = kind or (type(source) if isinstance(source, Q) else Q)

    def __iter__(self) -> Iterator[T]:
        return iter(self._source)

    def _then(self, make: Callable[[], Iterator[R]], kind: type[Q[Any]]) -> Lazy[R]:
        return Lazy(_Steps(make), kind)

    def select(self, condition: Callable[[T], Any]) -> Lazy[T]:
        """The items for which the condition holds."""
        return self._then(lambda: (x for x in self._source if condition(x)), self._kind)

    def reject(self, condition: Callable[[T], Any]) -> Lazy[T]:
        """The items for which the condition does not hold."""
        return self._then(lambda: (x for x in self._source if not condition(x)), self._kind)

    def collect(self, body: Callable[[T], R]) -> Lazy[R]:
        """The body's value for every item."""
        return self._then(lambda: (body(x) for x in self._source), Bag if self._kind._eol_kind in ("Bag", "Set") else Q)

    def of_kind(self, kind: Any) -> Lazy[Any]:
        """The items of the type or a subtype."""
        wanted = resolve(kind)
        if isinstance(wanted, EolType):
            return self.select(wanted.is_kind)
        return self.select(lambda x: isinstance(x, wanted))

    def of_type(self, kind: Any) -> Lazy[Any]:
        """The items of exactly the type."""
        wanted = resolve(kind)
        if isinstance(wanted, EolType):
            return self.select(wanted.is_type)
        return self.select(lambda x: type(x) is wanted)

    def first(self) -> T | None:
        """The first item, or None."""
        return next(iter(self._source), None)

    def select_one(self, condition: Callable[[T], Any]) -> T | None:
        """The first item for which the condition holds, or None."""
        return self.select(condition).first()

    def exists(self, condition: Callable[[T], Any]) -> bool:
        """Whether the condition holds for at least one item."""
        return any(condition(x) for x in self._source)

    def for_all(self, condition: Callable[[T], Any]) -> bool:
        """Whether the condition holds for every item."""
        return all(condition(x) for x in self._source)

    def is_empty(self) -> bool:
        """Whether there is no item."""
        return not any(True for _ in self._source)

    def not_empty(self) -> bool:
        """Whether there is an item."""
        return not self.is_empty()

    def eager(self) -> Q[T]:
        """The collection, of the kind the eager operations would have given; every other operation is there."""
        return self._kind(self._source)

    def list(self) -> list[T]:
        """The items as a Python list."""
        return list(self._source)


class _Steps(Generic[R]):
    """An iterable that starts anew each time."""

    def __init__(self, make: Callable[[], Iterator[R]]) -> None:
        self._make = make

    def __iter__(self) -> Iterator[R]:
        return self._make()
