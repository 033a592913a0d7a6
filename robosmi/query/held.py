"""Collections of a many-valued feature whose changes affect the element, as EOL's `book.authors.add(a)` does.

A query collection is a copy; one of a many-valued feature is a copy that knows the feature, and whose changing operations
change both. Their results are those of the copy, as for every collection (`changes`).
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, ClassVar

from robosmi.query.changes import Changeable

if TYPE_CHECKING:
    from robosmi.query.values import Answer

CHANGING = frozenset({"add", "add_all", "clear", "remove", "remove_all", "remove_at"})
"""The operations that change a collection itself, by their names in Python's way."""


class HeldByFeature(Changeable[Any]):
    """Changes the values of a feature with the copy; collections of an element's features inherit it before all else."""

    __slots__ = ()
    _feature: Any
    """pyecore's collection."""
    _plain: ClassVar[Any]
    """The plain kind of collection that operations such as `select` return."""

    def add(self, value: Any) -> bool:
        """Add a value; whether that changed the feature."""
        if added := super().add(value):
            self._feature.append(value)
        return added

    def remove(self, value: Answer) -> bool:
        """Remove the first value that is equal; whether there was one."""
        if removed := super().remove(value):
            self._kept()
        return removed

    def remove_at(self, index: int) -> Any:
        """Remove the value at an index, and give it; beyond the end as `Changeable.remove_at`."""
        item = super().remove_at(index)
        self._kept()
        return item

    def remove_all(self, values: Iterable[Any]) -> bool:
        """Remove the values, wherever they occur; whether that changed the feature."""
        if changed := super().remove_all(values):
            self._kept()
        return changed

    def clear(self) -> None:
        """Remove all values."""
        super().clear()
        self._feature.clear()

    def _kept(self) -> None:
        """Remove from the feature what is no longer in the copy; both have the same order."""
        place = 0
        for value in list(self._feature):
            if place < len(self._items) and self._items[place] is value:
                place += 1
            else:
                self._feature.pop(place)
