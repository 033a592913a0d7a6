"""`Q`, a sequence with EOL's first-order operations.

Every operation that gives a collection gives a new `Q`; nothing changes the source. Operations are eager, as EOL's are;
`exists`, `for_all`, `one`, `none` and `select_one` stop as soon as the answer is known. Semantics and names follow
Kolovos et al., "The Epsilon Object Language" (2006).
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from typing import Any, Generic, TypeVar, overload

T = TypeVar("T")
R = TypeVar("R")
K = TypeVar("K", bound=Hashable)


class Q(Sequence[T], Generic[T]):
    """A collection to be queried.

    Args:
        items: any iterable; it is read once, at once.
    """

    __slots__ = ("_items",)

    def __init__(self, items: Iterable[T] = ()) -> None:
        self._items: list[T] = list(items)

    def __len__(self) -> int:
        return len(self._items)

    @overload
    def __getitem__(self, index: int) -> T: ...
    @overload
    def __getitem__(self, index: slice) -> Q[T]: ...
    def __getitem__(self, index: int | slice) -> T | Q[T]:
        return Q(self._items[index]) if isinstance(index, slice) else self._items[index]

    def __eq__(self, other: object) -> bool:
        return self._items == list(other) if isinstance(other, (Q, list, tuple)) else NotImplemented

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"Q({self._items!r})"

    def select(self, condition: Callable[[T], Any]) -> Q[T]:
        """The items for which the condition holds, in order."""
        return Q(x for x in self._items if condition(x))

    def reject(self, condition: Callable[[T], Any]) -> Q[T]:
        """The items for which the condition does not hold, in order."""
        return Q(x for x in self._items if not condition(x))

    def select_one(self, condition: Callable[[T], Any]) -> T | None:
        """The first item for which the condition holds, or None."""
        return next((x for x in self._items if condition(x)), None)

    def collect(self, body: Callable[[T], R]) -> Q[R]:
        """The body's value for every item. Not flattened, and None is kept, as in EOL."""
        return Q(body(x) for x in self._items)

    def exists(self, condition: Callable[[T], Any]) -> bool:
        """Whether the condition holds for at least one item; False when empty."""
        return any(condition(x) for x in self._items)

    def for_all(self, condition: Callable[[T], Any]) -> bool:
        """Whether the condition holds for every item; True when empty."""
        return all(condition(x) for x in self._items)

    def one(self, condition: Callable[[T], Any]) -> bool:
        """Whether the condition holds for exactly one item."""
        found = 0
        for x in self._items:
            found += bool(condition(x))
            if found > 1:
                return False
        return found == 1

    def none(self, condition: Callable[[T], Any]) -> bool:
        """Whether the condition holds for no item; True when empty."""
        return not self.exists(condition)

    def count(self, condition: Any) -> int:
        """How many items fulfil a condition, or equal a value that is not callable."""
        return sum(1 for x in self._items if (condition(x) if callable(condition) else x == condition))

    def of_kind(self, kind: type[R]) -> Q[R]:
        """The items that are instances of the class or of a subclass."""
        return Q(x for x in self._items if isinstance(x, kind))

    def of_type(self, kind: type[R]) -> Q[R]:
        """The items that are instances of exactly that class."""
        same: list[Any] = [x for x in self._items if type(x) is kind]
        return Q(same)

    def sort_by(self, key: Callable[[T], Any]) -> Q[T]:
        """The items sorted by a key; stable."""
        return Q(sorted(self._items, key=key))

    def map_by(self, key: Callable[[T], K]) -> dict[K, Q[T]]:
        """The items by key, keys in the order they are first seen."""
        groups: dict[K, list[T]] = {}
        for x in self._items:
            groups.setdefault(key(x), []).append(x)
        return {k: Q(v) for k, v in groups.items()}

    def closure(self, body: Callable[[T], Any]) -> Q[T]:
        """Everything reached by applying the body again and again, depth first, each item once.

        The body may give one item, an iterable, or None. An item of the source is in the result only if it is reached.
        """
        found: dict[int, T] = {}
        for start in self._items:
            pending: list[Iterator[T]] = [iter(_many(body(start)))]
            while pending:
                reached = next(pending[-1], None)
                if reached is None:
                    pending.pop()
                elif id(reached) not in found:
                    found[id(reached)] = reached
                    pending.append(iter(_many(body(reached))))
        return Q(found.values())

    def flatten(self) -> Q[Any]:
        """The items of all nested collections, on all levels."""
        flat: list[Any] = []
        for x in self._items:
            flat.extend(Q(x).flatten() if isinstance(x, Iterable) and not isinstance(x, (str, bytes)) else [x])
        return Q(flat)

    def distinct(self) -> Q[T]:
        """Each item once, in the order first seen (EOL: asOrderedSet)."""
        return Q(dict.fromkeys(self._items))

    def first(self) -> T | None:
        """The first item, or None when empty."""
        return self._items[0] if self._items else None

    def last(self) -> T | None:
        """The last item, or None when empty."""
        return self._items[-1] if self._items else None


def _many(value: Any) -> list[Any]:
    """What a closure's body gives, as a list without None."""
    if value is None:
        return []
    if isinstance(value, Iterable) and not isinstance(value, str):
        return [x for x in value if x is not None]
    return [value]
