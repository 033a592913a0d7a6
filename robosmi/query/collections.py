"""The four kinds of collection: `Q` (EOL's Sequence), `Bag`, `Set`, `OrderedSet`, with the operations that take no function.

`Q(items)` takes any iterable and reads it once. `q.name` collects a property of every item (a Sequence, of a Set or Bag a Bag;
not flattened). Operations that give a collection give a new one; those that change it itself are in `changes`. All is eager,
`lazy()` gives the view that is not. The operations that take a function are in `first_order`.
Source: Kolovos et al., The Epsilon Object Language, section 3.2; measured against Epsilon (docs/reference/eol.md).
"""

from __future__ import annotations

import builtins
import random as _random
from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations
from typing import TYPE_CHECKING, Any, Self, TypeVar, overload

from robosmi.query.changes import Changeable, several
from robosmi.query.first_order import FirstOrder
from robosmi.query.problems import OperandError
from robosmi.query.totals import Totals
from robosmi.query.types import matching
from robosmi.query.values import (
    as_string,
    collection_kind,
    equal,
    flattened,
    key,
    position,
    unique,
)

if TYPE_CHECKING:
    from robosmi.query.lazy import Lazy

T = TypeVar("T")
R = TypeVar("R")
_MISSING: Any = object()


class Q(FirstOrder[T], Changeable[T], Totals[T], Sequence[T]):
    """A Sequence to be queried; the other kinds of collection inherit from it.

    Args:
        items: any iterable; it is read once, at once.

    >>> Q([3, 1, 2]).select(lambda x: x > 1).sort_by(lambda x: x)
    Q([2, 3])
    """

    __slots__ = ("_items",)
    _eol_kind = "Sequence"
    _indexed = True

    def __init__(self, items: Iterable[T] = ()) -> None:
        self._items: builtins.list[T] = list(items)

    @classmethod
    def _of(cls, items: builtins.list[Any]) -> Self:
        """A collection around a list that nobody else holds, of unique items where the kind wants that."""
        made = cls.__new__(cls)
        made._items = items
        return made

    def _same(self, items: builtins.list[T]) -> Self:
        """A collection of the same kind, of items that are among this one's."""
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
        return self._same(self._items[index]) if isinstance(index, slice) else self._items[index]

    def __getattr__(self, name: str) -> Q[Any]:
        if name[0] == "_":  # protocols of Python, not properties
            raise AttributeError(name)
        return self.get(name)

    def get(self, name: str, default: Any = _MISSING) -> Q[Any]:
        """A property of every item, also one whose name is an operation here.

        Args:
            name: of the property.
            default: taken for an item that is None (EOL `?.` with `?:`); without it None is an error.

        Raises:
            UndefinedError: an item is None.
            ModelError: an item has no such property.
        """
        from robosmi.query.properties import get_all

        return self._mapped(get_all(self._items, name) if default is _MISSING else get_all(self._items, name, default))

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
        from robosmi.model.show import items_html

        return items_html(self._items)

    def __add__(self, other: Iterable[Any]) -> Self:
        return self.including_all(other)

    def __sub__(self, other: Iterable[Any]) -> Self:
        return self.excluding_all(other)

    def of_kind(self, kind: Any) -> Self:
        """The items that are instances of the type or of a subtype (EOL `selectByKind`)."""
        return self._same(matching(self._items, kind))

    def of_type(self, kind: Any) -> Self:
        """The items that are instances of exactly that type (EOL `selectByType`)."""
        return self._same(matching(self._items, kind, exact=True))

    select_by_kind = of_kind
    select_by_type = of_type

    def size(self) -> int:
        """How many items there are."""
        return len(self._items)

    def is_empty(self) -> bool:
        """Whether there is no item."""
        return not self._items

    def not_empty(self) -> bool:
        """Whether there is an item."""
        return bool(self._items)

    def includes(self, value: Any) -> bool:
        """Whether the value is an item; unlike `=` and Python's `in`, 2 is not 2.0 here."""
        return position(self._items, value) >= 0

    def excludes(self, value: Any) -> bool:
        """Whether the value is no item."""
        return position(self._items, value) < 0

    def includes_all(self, values: Iterable[Any]) -> bool:
        """Whether all the values are items."""
        return {key(v) for v in several(values)} <= set(map(key, self._items))

    def excludes_all(self, values: Iterable[Any]) -> bool:
        """Whether none of the values is an item."""
        return set(map(key, self._items)).isdisjoint(key(v) for v in several(values))

    def index_of(self, value: Any) -> int:
        """The index of the first item that is the value, or -1."""
        return position(self._items, value)

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

    def second(self) -> T | None:
        """The second item; None when empty. A Sequence of one is too short: an error."""
        return self.at(1) if self._items else None

    def third(self) -> T | None:
        """The third item; None when empty."""
        return self.at(2) if self._items else None

    def fourth(self) -> T | None:
        """The fourth item; None when empty."""
        return self.at(3) if self._items else None

    def last(self) -> T | None:
        """The last item, or None when empty."""
        return self._items[-1] if self._items else None

    def at(self, index: int) -> T | None:
        """The item at an index from 0. Beyond the end a Sequence raises; the other kinds, which have no index in EOL, give None.

        Raises:
            OperandError: there is no such index.
        """
        if 0 <= index < len(self._items):
            return self._items[index]
        if not self._indexed:
            return None
        raise OperandError(f"at({index}) is outside a {self._eol_kind} of {len(self._items)}")

    def random(self) -> T | None:
        """Any item, or None when empty."""
        return _random.choice(self._items) if self._items else None

    def flatten(self) -> Q[Any]:
        """The items of all nested collections, on all levels: a Sequence; without a nested collection the kind stays."""
        flat = flattened(self._items)
        return self._made(list(self._items)) if flat is None else Q._of(flat)

    def distinct(self) -> Q[T]:
        """A Sequence of each item once, in the order first seen (see `as_ordered_set`)."""
        return Q._of(unique(self._items))

    def including(self, value: Any) -> Self:
        """This and one more item."""
        return self._made([*self._items, value])

    def including_all(self, values: Iterable[Any]) -> Self:
        """This and more items (EOL also `+`)."""
        return self._made([*self._items, *several(values)])

    def excluding(self, value: Any) -> Self:
        """This without the value, wherever it occurs."""
        wanted = key(value)
        return self._same([x for x in self._items if key(x) != wanted])

    def excluding_all(self, values: Iterable[Any]) -> Self:
        """This without the values, wherever they occur (EOL also `-`)."""
        wanted = {key(v) for v in several(values)}
        return self._same([x for x in self._items if key(x) not in wanted])

    def invert(self) -> Q[T]:
        """A Sequence from the last item to the first."""
        return Q._of(self._items[::-1])

    def clone(self) -> Self:
        """A copy; the items are the same."""
        return self._of(list(self._items))

    def concat(self, separator: str = "") -> str:
        """The items as texts in one text."""
        return separator.join(map(as_string, self._items))

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
        """A view whose operations look at an item only when it is asked for; `Lazy` says what that changes."""
        from robosmi.query.lazy import Lazy

        return Lazy(self)

    def create_collection(self) -> Self:
        """An empty collection of the same kind."""
        return self._of([])


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


class _Feature(OrderedSet[T]):
    """What a many-valued feature holds: an OrderedSet with an index that is equal to a Sequence, as EMF's lists are in EOL."""

    __slots__ = ()
    _indexed = True
    _eol_equals = "Sequence"

    def _same(self, items: builtins.list[T]) -> Any:
        return OrderedSet._of(items)

    def _made(self, items: builtins.list[Any]) -> Any:
        return OrderedSet._of(unique(items))


_CLASSES: dict[str, type[Q[Any]]] = {"Sequence": Q, "Bag": Bag, "Set": Set, "OrderedSet": OrderedSet}


def collection(value: Any) -> Q[Any]:
    """A value as a collection of its kind; a value that is none as a Sequence of one, as EOL's operations take it.

    >>> collection({1}), collection("ab")
    (Set([1]), Q(['ab']))
    """
    if isinstance(value, Q):
        return value
    kind = collection_kind(value)
    if kind is None:
        return Q([value])
    cls = _Feature if kind == "OrderedSet" else _CLASSES[kind]  # no class of Python's is an ordered set
    return cls._of(list(value))
