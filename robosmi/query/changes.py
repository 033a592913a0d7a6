"""The operations that change a collection itself: EOL's `add` ... `clear`. All others give a new collection."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar

from robosmi.query.problems import OperandError
from robosmi.query.values import as_string, key, position

if TYPE_CHECKING:
    from robosmi.query.values import Answer

T = TypeVar("T")


def several(values: Any) -> Iterable[Any]:
    """The argument of an operation that needs a collection; a text is refused.

    Raises:
        OperandError: it is no collection.
    """
    if isinstance(values, (str, bytes)) or not isinstance(values, Iterable):
        raise OperandError(f"a collection is needed, not {as_string(values)}")
    return values


class Changeable(Generic[T]):
    """The operations that change; `Q` and its kinds inherit them."""

    __slots__ = ()
    _items: list[T]
    _indexed: ClassVar[bool]

    if TYPE_CHECKING:

        def at(self, index: int) -> T | None:
            """See `Q.at`."""

    def add(self, value: T) -> bool:
        """Add an item to this collection itself; whether that changed it."""
        self._items.append(value)
        return True

    def add_all(self, values: Iterable[T]) -> bool:
        """Add items to this collection itself; whether that changed it."""
        added = [self.add(v) for v in list(several(values))]  # all of them, not only those up to the first success
        return any(added)

    def remove(self, value: Answer) -> bool:
        """Remove the first item that is the value from this collection itself; whether there was one."""
        place = position(self._items, value)
        if place >= 0:
            del self._items[place]
        return place >= 0

    def remove_at(self, index: int) -> T | None:
        """Remove the item at an index from this collection itself, and give it.

        Beyond the end a Sequence raises; the other kinds, which have no index in EOL, give their last item and keep it.

        Raises:
            OperandError: a Sequence has no such index.
        """
        if not self._indexed and index >= len(self._items):
            return self._items[-1] if self._items else None
        item = self.at(index)
        if 0 <= index < len(self._items):
            del self._items[index]
        return item

    def remove_all(self, values: Iterable[Any]) -> bool:
        """Remove the values, wherever they occur, from this collection itself; whether that changed it."""
        unwanted = {key(v) for v in several(values)}
        remaining = [x for x in self._items if key(x) not in unwanted]
        changed = len(remaining) < len(self._items)
        self._items[:] = remaining
        return changed

    def clear(self) -> None:
        """Remove all items from this collection itself."""
        self._items.clear()
