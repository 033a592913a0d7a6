"""What holds values: the four kinds of collection, `Q` (EOL's Sequence), `Bag`, `Set`, `OrderedSet`, then `Map`, `Tuple`, `Lazy`.

`Q(items)` takes any iterable and reads it once. `q.name` collects a property of every item (a Sequence, of a Set or Bag a Bag;
not flattened). Operations that give a collection give a new one; those that change it itself are in `changes`. All but `Lazy` is
eager. Here are the classes, which make one another, and the operations whose result is of another kind; the others are inherited:
those that take a function are in `first_order`, the rest in `items`, those of maps in `maps`, those on numbers in `Totals`.

Sum, product, least and greatest pass over items that are no numbers. Integers have 32 bits, and 64 as soon as a Long is among
them, so a sum wraps around as the engine's does.
Sources: Kolovos et al., The Epsilon Object Language, section 3.2; IterableOperationContributor and NumberUtil of Epsilon;
measured against Epsilon (docs/reference/eol.md).
"""

from __future__ import annotations

import builtins
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import combinations
from math import prod
from typing import TYPE_CHECKING, Any, ClassVar, Generic, Never, Protocol, Self, TypeVar, overload

from robosmi.query.changes import Changeable
from robosmi.query.first_order import FirstOrder, at_rest, grouped, reached, sorted_by
from robosmi.query.items import Items, R, T
from robosmi.query.maps import Entries, Fields, K, V
from robosmi.query.naming import snake
from robosmi.query.problems import OperandError, UnknownOperationError
from robosmi.query.types import AnyKind, matching, resolve
from robosmi.query.values import INT_MAX, INT_MIN, EolType, Long, as_string, equal, flattened, is_number, position, unique

if TYPE_CHECKING:
    from robosmi.model.elements.dynamic import Dynamic
    from robosmi.query.values import Answer


Numeric = TypeVar("Numeric")
_NUMBERS = frozenset({int, float, Long})


class Totals(Generic[Numeric]):
    """The operations on numbers; `Q` and its kinds inherit them."""

    __slots__ = ()
    _items: list[Numeric]

    def _numbers(self) -> Iterator[Any]:
        return (x for x in self._items if is_number(x))

    def sum(self) -> Any:
        """The sum of the numbers, 0 when there is none; other items are skipped.

        A sum of Integers wraps around at 32 bits, as in the engine; Python's `sum(q)` is exact.
        """
        items: Any = self._items if {x.__class__ for x in self._items} <= _NUMBERS else list(self._numbers())
        return _fitting(builtins.sum(items), items)

    def product(self) -> Any:
        """The product of the numbers; other items are skipped. 0.0 when empty, as EOL has it; wraps around as `sum` does."""
        items = list(self._numbers())
        return _fitting(prod(items), items) if self._items else 0.0

    def min(self, default: Any = 0) -> Any:
        """The smallest number; the default, a number or None, when there is none."""
        return builtins.min(self._numbers(), default=_number(default))

    def max(self, default: Any = 0) -> Any:
        """The greatest number; the default, a number or None, when there is none."""
        return builtins.max(self._numbers(), default=_number(default))


def _number(value: Answer) -> Any:
    if value is not None and not is_number(value):
        raise OperandError(f"the default is a number, not {as_string(value)}")
    return value


def _fitting(value: Any, items: Iterable[Any]) -> Any:
    """An exact result in the engine's range: Integers have 32 bits, and 64 as soon as a Long is among them."""
    if isinstance(value, float) or (
        INT_MIN <= value <= INT_MAX and value.__class__ is int and Long not in {x.__class__ for x in items}
    ):
        return value
    long = any(x.__class__ is Long or not INT_MIN <= x <= INT_MAX for x in items)
    return Long((value + 2**63) % 2**64 - 2**63) if long else (value + 2**31) % 2**32 - 2**31


_MISSING: Any = object()


class PropertiesReader(Protocol):
    """What reads a property of every item, as `properties.get_all`."""

    def __call__(self, items: Iterable[Any], name: str, default: Any = ..., /) -> builtins.list[Any]:
        """The values, one for each item."""


class Q(FirstOrder[T], Items[T], Changeable[T], Totals[T], Sequence[T]):
    """A Sequence to be queried; the other kinds of collection inherit from it.

    Args:
        items: any iterable; it is read once, at once.

    >>> Q([3, 1, 2]).select(lambda x: x > 1).sort_by(lambda x: x)
    Q([2, 3])
    """

    __slots__ = ("_items",)
    _eol_kind: ClassVar[str] = "Sequence"
    _indexed: ClassVar[bool] = True
    _read: ClassVar[PropertiesReader]
    """Reads `q.name`. A property may be any operation without arguments, those of collections too, so that this comes with the
    operations (`built_in`)."""

    def __init__(self, items: Iterable[T] = ()) -> None:
        self._items: builtins.list[T] = list(items)

    @classmethod
    def _of(cls, items: builtins.list[Any]) -> Self:
        """Make a collection from a list that it may keep; the items are unique if the kind requires it."""
        made = cls.__new__(cls)
        made._items = items
        return made

    def _same(self, items: builtins.list[T]) -> Self:
        """A collection of the same kind with a subset of this one's items."""
        return self._of(items)

    def _mapped(self, items: builtins.list[R]) -> Q[R]:
        return Q._of(items)

    def _made(self, items: builtins.list[Any]) -> Self:
        """A collection of the same kind, of any items."""
        return self._of(items)

    def __len__(self) -> int:
        return len(self._items)

    def __iter__(self) -> Iterator[T]:
        return iter(self._items)

    @overload
    def __getitem__(self, index: int) -> T: ...
    @overload
    def __getitem__(self, index: slice) -> Self: ...
    def __getitem__(self, index: int | slice) -> T | Self:
        return self._items[index] if isinstance(index, int) else self._same(self._items[index])

    def __getattr__(self, name: str) -> Q[Any]:
        if name[0] == "_":  # protocols of Python, not properties
            raise AttributeError(name)
        found, operation = self.get(name), snake(name)
        return found if self._items or operation == name or not hasattr(Q, operation) else _NoValues(name, operation)

    def get(self, name: str, default: V = _MISSING) -> Q[Dynamic]:
        """A property of every item, also one whose name is an operation here.

        Args:
            name: of the property.
            default: the result for an item that is None (EOL `?.` with `?:`); without it None is an error.

        Raises:
            UndefinedError: an item is None.
            ModelError: an item has no such property.
        """
        return self._mapped(self._read(self._items, name) if default is _MISSING else self._read(self._items, name, default))

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Q):
            return equal(self, other)
        if isinstance(other, (list, tuple)) and self._eol_kind in ("Sequence", "OrderedSet"):
            return self._items == list(other)  # Python's own equality, in order
        if isinstance(other, (set, frozenset)) and self._eol_kind == "Set":
            return equal(self, other)
        return NotImplemented

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self._items!r})"

    def _repr_html_(self) -> str:
        from robosmi.model.elements.show import items_html

        return items_html(self._items)

    def _in_order(self, other: object) -> Never:
        raise OperandError(
            f"a collection is not greater or less than {as_string(other)}",
            fix="compare its size (q.size() > 1), or ask for items: q.exists(lambda x: x > 1)",
        )

    __lt__ = __le__ = __gt__ = __ge__ = _in_order

    def __add__(self, other: Iterable[R]) -> Self:
        return self.including_all(other)

    def __sub__(self, other: Iterable[R]) -> Self:
        return self.excluding_all(other)

    @overload
    def first(self) -> T | None: ...
    @overload
    def first(self, n: int) -> Q[T]: ...
    def first(self, n: int | None = None) -> T | Q[T] | None:
        """The first item, or None when empty; with a number, a Sequence of so many first items, or fewer.

        Raises:
            OperandError: the number is negative.
        """
        if n is not None:
            if n < 0:
                raise OperandError(f"first({n}): there is no negative number of items")
            return Q._of(self._items[:n])
        return self._items[0] if self._items else None

    def flatten(self) -> Q[Dynamic]:
        """The items of all nested collections, on all levels: a Sequence; without a nested collection the kind stays."""
        flat = flattened(self._items)
        made: Q[Any] = self._made(list(self._items)) if flat is None else Q._of(flat)
        return made

    def distinct(self) -> Q[T]:
        """A Sequence of each item once, in the order first seen (see `as_ordered_set`)."""
        return Q._of(unique(self._items))

    def invert(self) -> Q[T]:
        """A Sequence from the last item to the first."""
        return Q._of(self._items[::-1])

    def collect(self, body: Callable[[T], R], kind: AnyKind | None = None) -> Q[R]:
        """The body's value for every item: a Sequence, of a Set or Bag a Bag. Not flattened, and it keeps None, as in EOL."""
        with at_rest(items := self._source(kind)):
            return self._mapped([body(x) for x in items])

    def sort_by(self, body: Callable[[T], R], kind: AnyKind | None = None) -> Q[T]:
        """A Sequence sorted by the body's value; stable. Numbers, texts and Booleans as they are, anything else by its text.

        Raises:
            OperandError: the values have no order between them, as a number and a text.
        """
        return Q._of(sorted_by(self._source(kind), body))

    def map_by(self, body: Callable[[T], K], kind: AnyKind | None = None) -> Map[K, Q[T]]:
        """A map from the body's values to the Sequences of items that have them, keys in the order they are first seen."""
        return Map((value, Q._of(items)) for value, items in grouped(self._source(kind), body))

    def aggregate(
        self,
        body: Callable[[T], K],
        value: Callable[[T, V], V],
        initial: V | Callable[[T], V] | None = None,
        kind: AnyKind | None = None,
    ) -> Map[K, V]:
        """A map from the first body's values to a running total.

        Args:
            body: gives the key of an item.
            value: gives the new total of its key from the item and the total so far.
            initial: the first total of each key; a function is applied to the item.

        >>> Q([1, 2, 3]).aggregate(lambda x: x % 2, lambda x, total: total + x, 0)
        Map({1: 4, 0: 2})
        """
        totals: Map[K, Any] = Map(())
        for x in self._source(kind):
            place = body(x)
            total: Any = totals[place] if place in totals else initial(x) if callable(initial) else initial
            totals[place] = value(x, total)
        return totals

    def closure(self, body: Callable[[T], R], kind: AnyKind | None = None) -> OrderedSet[Dynamic]:
        """Everything reached by applying the body again and again, depth first, each item once.

        The body may give one item, a collection, or None. An item of the source is in the result only if it is reached. With a
        kind, items of other kinds are reached but not followed.
        """
        return OrderedSet._of(reached(self._source(kind), body, lambda x: kind is None or bool(matching([x], kind))))

    def powerset(self) -> Set[Set[T]]:
        """A Set of all Sets of these items."""
        items = unique(self._items)
        return Set._of([Set._of(list(part)) for n in range(len(items) + 1) for part in combinations(items, n)])

    def as_sequence(self) -> Q[T]:
        """A Sequence of the items."""
        return Q._of(list(self._items))

    def as_bag(self) -> Bag[T]:
        """A Bag of the items."""
        return Bag._of(list(self._items))

    def as_set(self) -> Set[T]:
        """A Set of the items."""
        return Set._of(unique(self._items))

    def as_ordered_set(self) -> OrderedSet[T]:
        """An OrderedSet of the items."""
        return OrderedSet._of(unique(self._items))

    def list(self) -> builtins.list[T]:
        """The items as a Python list of their own."""
        return list(self._items)

    def lazy(self) -> Lazy[T]:
        """A view whose operations evaluate an item only on demand; `Lazy` describes the differences."""
        return Lazy(self)


class _NoValues(Q[Any]):
    """What `q.notEmpty` gives where q is empty: no values, since a feature may have this name; a call says what to write."""

    __slots__ = ("_asked",)

    def __init__(self, name: str, operation: str) -> None:
        super().__init__()
        self._asked = (name, operation)

    def __repr__(self) -> str:
        return "Q([])"

    def __call__(self, *_arguments: Any, **_options: Any) -> Never:
        name, operation = self._asked
        raise UnknownOperationError(
            f"a collection has no operation '{name}' (did you mean '{operation}'?)", fix=f"write {operation}(...)"
        )


class Bag(Q[T]):
    """Items in no order, with repetition; equal to a Bag of the same items in any order."""

    __slots__ = ()
    _eol_kind = "Bag"
    _indexed = False

    def _mapped(self, items: builtins.list[R]) -> Q[R]:
        return Bag._of(items)


class _Unique(Q[T]):
    """What Set and OrderedSet share: an item occurs once; they keep the order of insertion, and compare without it."""

    __slots__ = ()
    _indexed = False

    def __init__(self, items: Iterable[T] = ()) -> None:
        self._items = unique(items)

    def _made(self, items: builtins.list[Any]) -> Self:
        return self._of(unique(items))

    def add(self, value: T) -> bool:
        """Add an item to this collection itself, if it is not there; whether that changed it."""
        if position(self._items, value) >= 0:
            return False
        self._items.append(value)
        return True


class Set(_Unique[T]):
    """Each item once; `collect` and `q.name` give a Bag."""

    __slots__ = ()
    _eol_kind = "Set"

    def _mapped(self, items: builtins.list[R]) -> Q[R]:
        return Bag._of(items)


class OrderedSet(_Unique[T]):
    """Each item once, in order; `collect` and `q.name` give a Sequence. Compares without order, as in EOL."""

    __slots__ = ()
    _eol_kind = "OrderedSet"


class Map(Entries[K, V]):
    """A map in the order of insertion.

    Args:
        entries: a mapping or pairs; of a key given twice the last value counts, at the place of the first.

    >>> m = Map([("k", 1), ("k", 2)])
    >>> m, m.get("k"), m.get("x")
    (Map({'k': 2}), 2, None)
    """

    __slots__ = ()
    _eol_map = "Map"

    def key_set(self) -> Set[K]:
        """The keys, a Set in the order of insertion."""
        return Set._of(list(self))

    def value_bag(self) -> Bag[V]:
        """The values, a Bag (EOL `values`; Python's `values()` stays what it is)."""
        return Bag._of(list(self.values()))


class Tuple(Fields, Map[str, Any]):
    """Named values (EOL `Tuple{p = 1}`).

    >>> t = Tuple(p=[1, 2], q="x")
    >>> t.q
    'x'
    """

    __slots__ = ()
    _eol_map = "Tuple"


def map_of(value: Any) -> Map[Any, Any]:
    """A Python dict or a Map as a Map."""
    return value if isinstance(value, Map) else Map(value)


class Lazy(Generic[T]):
    """A view of an iterable whose operations evaluate an item only on demand; every loop reads the source again.

    EOL's operations are eager: `select(f).first()` tests every item. A lazy chain gives the same answer as long as its functions
    change nothing and fail for no item that is not reached; only the author can know that, so it is explicit: `q.lazy()`, or
    `Lazy(all_contents(root))` for elements that are never all made. Ends with an answer, with a loop, or with `eager()`.

    Args:
        source: a collection, or any iterable.

    >>> tested = []
    >>> Q(range(1000)).lazy().select(lambda x: tested.append(x) or x > 1).first(), len(tested)
    (2, 3)
    """

    def __init__(self, source: Iterable[T], kind: type[Q[T]] | None = None) -> None:
        self._source = source
        self._kind = kind or (type(source._made([])) if isinstance(source, Q) else Q)

    def __iter__(self) -> Iterator[T]:
        return iter(self._source)

    def _then(self, make: Callable[[], Iterator[R]], kind: type[Q[Any]]) -> Lazy[R]:
        return Lazy(_Steps(make), kind)

    def select(self, condition: Callable[[T], R]) -> Lazy[T]:
        """The items for which the condition holds."""
        return self._then(lambda: (x for x in self._source if condition(x)), self._kind)

    def reject(self, condition: Callable[[T], R]) -> Lazy[T]:
        """The items for which the condition does not hold."""
        return self._then(lambda: (x for x in self._source if not condition(x)), self._kind)

    def collect(self, body: Callable[[T], R]) -> Lazy[R]:
        """The body's value for every item."""
        return self._then(lambda: (body(x) for x in self._source), Bag if self._kind._eol_kind in ("Bag", "Set") else Q)

    def of_kind(self, kind: AnyKind) -> Lazy[T]:
        """The items of the type or a subtype."""
        resolved = resolve(kind)
        if isinstance(resolved, EolType):
            return self.select(resolved.is_kind)
        return self.select(lambda x: isinstance(x, resolved))

    def of_type(self, kind: AnyKind) -> Lazy[T]:
        """The items of exactly the type."""
        resolved = resolve(kind)
        if isinstance(resolved, EolType):
            return self.select(resolved.is_type)
        return self.select(lambda x: x.__class__ is resolved)

    def first(self) -> T | None:
        """The first item, or None."""
        return next(iter(self._source), None)

    def select_one(self, condition: Callable[[T], R]) -> T | None:
        """The first item for which the condition holds, or None."""
        return self.select(condition).first()

    def exists(self, condition: Callable[[T], R]) -> bool:
        """Whether the condition holds for at least one item."""
        return any(condition(x) for x in self._source)

    def for_all(self, condition: Callable[[T], R]) -> bool:
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
