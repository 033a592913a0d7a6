"""The first-order operations of collections, those that take a function of one item, and the order that `sort_by` goes by.

Written once for the four kinds of collection. Eager as EOL's are; `exists`, `for_all`, `one`, `none`, `select_one` and the
`n_match` family stop as soon as the answer is known. Every operation takes `kind=T`, EOL's typed iterator `x : T`: items of other
kinds are left out first. Operations whose result is of another kind (`collect`, `map_by`) are in `collections`, their loops here.

`sort_by` compares numbers by value, texts with texts, Booleans with Booleans; with a None, an element or a collection in a
comparison, both sides are compared as texts.
Sources: Kolovos et al., The Epsilon Object Language, section 3.2.2; SortByOperation of Epsilon; measured against Epsilon
(docs/reference/eol.md).
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator
from contextlib import AbstractContextManager, nullcontext
from functools import cmp_to_key
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from robosmi.model.elements.compact_slots import collector_at_rest
from robosmi.query.problems import OperandError
from robosmi.query.types import fits_integer, matching
from robosmi.query.values import Long, as_string, collection_kind, is_number, key, position

if TYPE_CHECKING:
    from typing import Self

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


_LARGE = 50_000


def at_rest(items: list[T]) -> AbstractContextManager[None]:
    """Suspends garbage collection for many items: the first reading of features makes so much that all would be examined."""
    return collector_at_rest() if len(items) > _LARGE else nullcontext()


class FirstOrder(Generic[T]):
    """The operations that take a function; `Q` and its kinds inherit them."""

    __slots__ = ()
    _items: list[T]

    if TYPE_CHECKING:

        def _same(self, items: list[T]) -> Self: ...

    def _source(self, kind: AnyKind | None) -> list[T]:
        return self._items if kind is None else matching(self._items, kind)

    def select(self, condition: Callable[[T], R], kind: AnyKind | None = None) -> Self:
        """The items for which the condition holds, in order; the same kind of collection."""
        with at_rest(items := self._source(kind)):
            return self._same([x for x in items if condition(x)])

    def reject(self, condition: Callable[[T], R], kind: AnyKind | None = None) -> Self:
        """The items for which the condition does not hold, in order; the same kind of collection."""
        with at_rest(items := self._source(kind)):
            return self._same([x for x in items if not condition(x)])

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
        """How many items fulfil a condition, or equal the given value; a function is a condition."""
        if callable(condition) and not hasattr(condition, "eClass"):
            return sum(1 for x in self._source(kind) if condition(x))
        searched = key(condition)
        return sum(1 for x in self._items if key(x) == searched)


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


def grouped(items: Iterable[T], body: Callable[[T], K]) -> list[tuple[K, list[T]]]:
    """The items by the body's values, in the order in which the values are first seen."""
    groups: dict[Hashable, tuple[K, list[T]]] = {}
    for x in items:
        value = body(x)
        groups.setdefault(key(value), (value, []))[1].append(x)
    return list(groups.values())


def reached(starts: Iterable[T], body: Callable[[T], Any], follow: Callable[[Any], bool]) -> list[Any]:
    """Everything reached from the starts by applying the body again and again, depth first, each item once.

    Args:
        starts: where to begin; one of them is in the result only if it is reached.
        body: gives one item, a collection, or None.
        follow: whether the body is applied to an item that was reached.
    """
    found: dict[Hashable, Any] = {}
    for start in starts:
        pending: list[Iterator[Any]] = [iter(_many(body(start)))]
        while pending:
            item = next(pending[-1], None)
            if item is None:
                pending.pop()
            elif (place := key(item)) not in found:
                found[place] = item
                if follow(item):
                    pending.append(iter(_many(body(item))))
    return list(found.values())


def _many(value: Any) -> list[Any]:
    """The result of a closure's body as a list without None."""
    if value is None:
        return []
    if collection_kind(value) is not None or (isinstance(value, Iterable) and not isinstance(value, (str, bytes))):
        return [x for x in value if x is not None]
    return [value]


# ---- sorting

_NUMBERS = frozenset({int, float, Long})
_UNORDERED: Any = vars(object)["__lt__"]


def sorted_by(items: list[T], body: Callable[[T], Any]) -> list[T]:
    """The items in the order of the body's values; the body is called once for each, in order.

    Raises:
        OperandError: two values have no order between them.
    """
    values: list[Any] = []
    note = values.append

    def keyed(x: T) -> Any:
        note(value := body(x))
        return value

    try:
        made: list[T] | None = sorted(items, key=keyed)  # moves the items without touching them, twice as fast as by their places
    except TypeError:
        if len(values) < len(items):
            raise  # of the body, not of a comparison
        made = None
    classes = {x.__class__ for x in values}
    if made is not None and (classes <= _NUMBERS or classes in ({str}, {bool})):
        return made
    by_value = cmp_to_key(_compare)
    order = sorted(range(len(items)), key=[by_value(v) for v in values].__getitem__)
    return [items[i] for i in order]


def _compare(left: Any, right: Any) -> int:
    if is_number(left) and is_number(right):
        return int(left > right) - int(left < right)
    if _comparable(left) and _comparable(right):
        if isinstance(left, bool) != isinstance(right, bool):  # Python has an order between them, EOL has none
            raise OperandError(f"sort_by: {left!r} and {right!r} have no order between them")
        try:
            return int(left > right) - int(left < right)
        except TypeError as error:
            raise OperandError(f"sort_by: {left!r} and {right!r} have no order between them") from error
    first, second = as_string(left), as_string(right)
    return (first > second) - (first < second)


def _comparable(value: Answer) -> bool:
    if isinstance(value, (str, bool)) or is_number(value):
        return True
    if value is None:  # whose class has an own __lt__ from Python 3.13 on
        return False
    own: Any = getattr(value.__class__, "__lt__", None)  # dates and the like, and Python's tuples of keys
    return isinstance(value, tuple) or (collection_kind(value) is None and own is not _UNORDERED)
