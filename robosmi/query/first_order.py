"""The first-order operations of collections: those that take a function of one item.

Written once for the four kinds of collection; what a result's kind is, the kinds say (`_same`, `_mapped`, `_sequence`). Eager as
EOL's are; `exists`, `for_all`, `one`, `none`, `select_one` and the `n_match` family stop as soon as the answer is known. Every
operation takes `kind=T`, EOL's typed iterator `x : T`: items of other kinds are left out first. Not here: operations without a
function.
Source: Kolovos et al., The Epsilon Object Language, section 3.2.2; measured against Epsilon (docs/reference/eol.md).
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from robosmi.query.problems import OperandError
from robosmi.query.types import fits_integer, matching
from robosmi.query.values import collection_kind, key, position

if TYPE_CHECKING:
    from typing import Self

    from robosmi.query.collections import Map, OrderedSet, Q
    from robosmi.query.types import AnyKind
    from robosmi.query.values import Answer

T = TypeVar("T")
R = TypeVar("R")
K = TypeVar("K")

FIRST_ORDER = frozenset(
    {
        "select",
        "reject",
        "select_one",
        "select_first",
        "reject_one",
        "find",
        "find_one",
        "collect",
        "exists",
        "for_all",
        "one",
        "none",
        "n_match",
        "at_least_n_match",
        "at_most_n_match",
        "count",
        "sort_by",
        "map_by",
        "aggregate",
        "closure",
    }
)
"""The names of the operations here."""


class FirstOrder(Generic[T]):
    """The operations that take a function; `Q` and its kinds inherit them."""

    __slots__ = ()
    _items: list[T]

    if TYPE_CHECKING:

        def _same(self, items: list[T]) -> Self: ...
        def _mapped(self, items: list[R]) -> Q[R]: ...
        def _sequence(self, items: list[R]) -> Q[R]: ...
        def _ordered(self, items: list[R]) -> OrderedSet[R]: ...
        def _map(self, entries: Iterable[tuple[K, R]]) -> Map[K, R]: ...

    def _source(self, kind: AnyKind | None) -> list[T]:
        return self._items if kind is None else matching(self._items, kind)

    def select(self, condition: Callable[[T], R], kind: AnyKind | None = None) -> Self:
        """The items for which the condition holds, in order; the same kind of collection."""
        return self._same([x for x in self._source(kind) if condition(x)])

    def reject(self, condition: Callable[[T], R], kind: AnyKind | None = None) -> Self:
        """The items for which the condition does not hold, in order; the same kind of collection."""
        return self._same([x for x in self._source(kind) if not condition(x)])

    def select_one(self, condition: Callable[[T], R], kind: AnyKind | None = None) -> T | None:
        """The first item for which the condition holds, or None."""
        return next((x for x in self._source(kind) if condition(x)), None)

    select_first = select_one

    def reject_one(self, condition: Callable[[T], R], kind: AnyKind | None = None) -> Self:
        """All items but the first for which the condition holds."""
        items = list(self._source(kind))
        for x in items:
            if condition(x):
                del items[position(items, x)]
                break
        return self._same(items)

    def find(self, condition: Callable[[T], R], kind: AnyKind | None = None) -> Self:
        """The same as `select`: on a collection EOL's `find` is no search in an index."""
        return self.select(condition, kind)

    def find_one(self, condition: Callable[[T], R], kind: AnyKind | None = None) -> Self:
        """A collection with the first item for which the condition holds, as EOL gives (not the item: that is `select_one`)."""
        for x in self._source(kind):
            if condition(x):
                return self._same([x])
        return self._same([])

    def collect(self, body: Callable[[T], R], kind: AnyKind | None = None) -> Q[R]:
        """The body's value for every item: a Sequence, of a Set or Bag a Bag. Not flattened, and None is kept, as in EOL."""
        return self._mapped([body(x) for x in self._source(kind)])

    def exists(self, condition: Callable[[T], R], kind: AnyKind | None = None) -> bool:
        """Whether the condition holds for at least one item; False when empty."""
        for x in self._source(kind):  # noqa: SIM110 - a generator would double the time
            if condition(x):
                return True
        return False

    def for_all(self, condition: Callable[[T], R], kind: AnyKind | None = None) -> bool:
        """Whether the condition holds for every item; True when empty."""
        for x in self._source(kind):  # noqa: SIM110 - a generator would double the time
            if not condition(x):
                return False
        return True

    def one(self, condition: Callable[[T], R], kind: AnyKind | None = None) -> bool:
        """Whether the condition holds for exactly one item."""
        return self.n_match(condition, 1, kind)

    def none(self, condition: Callable[[T], R], kind: AnyKind | None = None) -> bool:
        """Whether the condition holds for no item; True when empty."""
        return self.n_match(condition, 0, kind)

    def n_match(self, condition: Callable[[T], R], n: int, kind: AnyKind | None = None) -> bool:
        """Whether the condition holds for exactly n items; stops when that is decided.

        Raises:
            OperandError: n is no integer.
        """
        items = self._source(kind)
        return len(items) >= _integer(n) and _matches(items, condition, n, False) == n

    def at_least_n_match(self, condition: Callable[[T], R], n: int, kind: AnyKind | None = None) -> bool:
        """Whether the condition holds for n items or more.

        Raises:
            OperandError: n is no integer.
        """
        items = self._source(kind)
        return len(items) >= _integer(n) and _matches(items, condition, n, True) >= n

    def at_most_n_match(self, condition: Callable[[T], R], n: int, kind: AnyKind | None = None) -> bool:
        """Whether the condition holds for n items or fewer.

        Raises:
            OperandError: n is no integer.
        """
        return _matches(self._source(kind), condition, _integer(n), False) <= n

    def count(self, condition: Any, kind: AnyKind | None = None) -> int:
        """How many items fulfil a condition, or are the value that is given; a function is taken as a condition."""
        if callable(condition) and not hasattr(condition, "eClass"):
            return sum(1 for x in self._source(kind) if condition(x))
        wanted = key(condition)
        return sum(1 for x in self._items if key(x) == wanted)

    def sort_by(self, body: Callable[[T], R], kind: AnyKind | None = None) -> Q[T]:
        """A Sequence sorted by the body's value; stable. Numbers, texts and Booleans as they are, anything else by its text.

        Raises:
            OperandError: the values have no order between them, as a number and a text.
        """
        from robosmi.query.sorting import sorted_by

        return self._sequence(sorted_by(self._source(kind), body))

    def map_by(self, body: Callable[[T], K], kind: AnyKind | None = None) -> Map[K, Q[T]]:
        """A map from the body's values to the Sequences of items that have them, keys in the order they are first seen."""
        groups: dict[Hashable, tuple[K, Q[T]]] = {}
        for x in self._source(kind):
            value = body(x)
            groups.setdefault(key(value), (value, self._sequence([])))[1]._items.append(x)
        return self._map(groups.values())

    def aggregate(
        self, body: Callable[[T], K], value: Callable[[T, Any], Any], initial: Answer = None, kind: AnyKind | None = None
    ) -> Map[K, Any]:
        """A map from the first body's values to a running total.

        Args:
            body: gives the key of an item.
            value: gives the new total of its key from the item and the total so far.
            initial: the first total of each key; a function is applied to the item.

        >>> from robosmi.query import Q
        >>> Q([1, 2, 3]).aggregate(lambda x: x % 2, lambda x, total: total + x, 0)
        Map({1: 4, 0: 2})
        """
        totals: Map[K, Any] = self._map(())
        for x in self._source(kind):
            place = body(x)
            total = totals[place] if place in totals else initial(x) if callable(initial) else initial
            totals[place] = value(x, total)
        return totals

    def closure(self, body: Callable[[T], Any], kind: AnyKind | None = None) -> OrderedSet[Any]:
        """Everything reached by applying the body again and again, depth first, each item once.

        The body may give one item, a collection, or None. An item of the source is in the result only if it is reached. With a
        kind, items of other kinds are reached but not followed.
        """
        found: dict[Hashable, Any] = {}
        for start in self._source(kind):
            pending: list[Iterator[Any]] = [iter(_many(body(start)))]
            while pending:
                reached = next(pending[-1], None)
                if reached is None:
                    pending.pop()
                elif (place := key(reached)) not in found:
                    found[place] = reached
                    if kind is None or matching([reached], kind):
                        pending.append(iter(_many(body(reached))))
        return self._ordered(list(found.values()))


def _integer(n: int) -> int:
    if not fits_integer(n):
        raise OperandError(f"the number of matches is an Integer, not {n!r}")
    return int(n)


def _matches(items: list[T], condition: Callable[[T], R], n: int, minimum: bool) -> int:
    """The number of matching items, counted only until the comparison with n is decided."""
    found, left = 0, len(items)
    for x in items:
        left -= 1
        if condition(x):
            found += 1
        if found > n or (minimum and found == n) or left < n - found:
            break
    return found


def _many(value: Any) -> list[Any]:
    """The result of a closure's body as a list without None."""
    if value is None:
        return []
    if collection_kind(value) is not None or (isinstance(value, Iterable) and not isinstance(value, (str, bytes))):
        return [x for x in value if x is not None]
    return [value]
