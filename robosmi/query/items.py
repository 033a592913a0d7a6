"""The operations of collections that take no function of an item: sizes, membership, single items, with and without some.

Written once for the four kinds of collection; each kind defines the kind of its results (`_same`, `_made`). Operations that
change a collection itself are in `changes`; those whose result is of another kind are in `collections`.
Source: Kolovos et al., The Epsilon Object Language, section 3.2; measured against Epsilon (docs/reference/eol.md).
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar

from robosmi.query.changes import several
from robosmi.query.problems import OperandError
from robosmi.query.types import matching
from robosmi.query.values import as_string, key, position

if TYPE_CHECKING:
    from typing import Self

    from robosmi.query.types import AnyKind

T = TypeVar("T")
R = TypeVar("R")


class Items(Generic[T]):
    """The operations that take no function; `Q` and its kinds inherit them."""

    __slots__ = ()
    _items: list[T]
    _indexed: ClassVar[bool]
    _eol_kind: ClassVar[str]

    if TYPE_CHECKING:

        @classmethod
        def _of(cls, items: list[Any]) -> Self: ...
        def _same(self, items: list[T]) -> Self: ...
        def _made(self, items: list[Any]) -> Self: ...

    def of_kind(self, kind: AnyKind) -> Self:
        """The items that are instances of the type or of a subtype (EOL `selectByKind`)."""
        return self._same(matching(self._items, kind))

    def of_type(self, kind: AnyKind) -> Self:
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

    def includes(self, value: R) -> bool:
        """Whether the value is an item; unlike `=` and Python's `in`, 2 is not 2.0 here."""
        return position(self._items, value) >= 0

    def excludes(self, value: R) -> bool:
        """Whether the value is no item."""
        return position(self._items, value) < 0

    def includes_all(self, values: Iterable[R]) -> bool:
        """Whether all the values are items."""
        return {key(v) for v in several(values)} <= {key(x) for x in self._items}

    def excludes_all(self, values: Iterable[R]) -> bool:
        """Whether none of the values is an item."""
        return {key(x) for x in self._items}.isdisjoint(key(v) for v in several(values))

    def index_of(self, value: R) -> int:
        """The index of the first item that is the value, or -1."""
        return position(self._items, value)

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
        import random  # slow to load, and needed only here

        return random.choice(self._items) if self._items else None

    def including(self, value: R) -> Self:
        """This and one more item."""
        return self._made([*self._items, value])

    def including_all(self, values: Iterable[R]) -> Self:
        """This and more items (EOL also `+`)."""
        return self._made([*self._items, *several(values)])

    def excluding(self, value: R) -> Self:
        """This without the value, wherever it occurs."""
        excluded = key(value)
        return self._same([x for x in self._items if key(x) != excluded])

    def excluding_all(self, values: Iterable[R]) -> Self:
        """This without the values, wherever they occur (EOL also `-`)."""
        excluded = {key(v) for v in several(values)}
        return self._same([x for x in self._items if key(x) not in excluded])

    def clone(self) -> Self:
        """A copy; the items are the same."""
        return self._of(list(self._items))

    def concat(self, separator: str = "") -> str:
        """The items as texts in one text."""
        return separator.join(as_string(x) for x in self._items)

    def create_collection(self) -> Self:
        """An empty collection of the same kind."""
        return self._of([])
