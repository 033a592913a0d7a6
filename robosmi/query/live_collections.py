"""Collections of a many-valued feature whose changes affect the element, as EOL's `book.authors.add(a)` does.

A query collection is a copy; one of a many-valued feature is a copy that knows the feature, and whose changing operations
change both. Their results are those of the copy, as for every collection (`changes`).
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, ClassVar

from robosmi.model.elements.ecore import ECollection
from robosmi.model.elements.feature_values import queried_by
from robosmi.query.changes import Changeable
from robosmi.query.collections import Bag, OrderedSet, Q, Set
from robosmi.query.items import T
from robosmi.query.values import collection_kind

if TYPE_CHECKING:
    from robosmi.model.elements.dynamic import Dynamic
    from robosmi.query.maps import V
    from robosmi.query.values import Answer

CHANGING = frozenset({"add", "add_all", "clear", "remove", "remove_all", "remove_at"})
"""The operations that change a collection itself, by their names in Python's way."""


class FeatureView(Changeable[Any]):
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


class _OfFeature(FeatureView, Q[T]):
    """The values of a many-valued feature: changes affect the element; results of operations are independent collections."""

    __slots__ = ("_feature",)
    _eol_equals = "Sequence"  # EMF's lists are, whatever their kind

    @classmethod
    def _of(cls, items: list[Any]) -> Any:
        return cls._plain._of(items)


def _of_feature(plain: type[Q[Any]]) -> Any:
    return type(
        "OfFeature",
        (_OfFeature, plain),
        {"__slots__": (), "_plain": plain, "_indexed": plain in (Q, OrderedSet), "__doc__": plain.__doc__},
    )


_CLASSES: dict[str, type[Q[Any]]] = {"Sequence": Q, "Bag": Bag, "Set": Set, "OrderedSet": OrderedSet}
_OF_FEATURES = {kind: _of_feature(plain) for kind, plain in _CLASSES.items()}


def collection(given: V) -> Q[Dynamic]:
    """A value as a collection of its kind; a value that is none as a Sequence of one, as EOL's operations take it.

    >>> collection({1}), collection("ab")
    (Set([1]), Q(['ab']))
    """
    value: Any = given
    if isinstance(value, Q):
        return value
    kind = collection_kind(value)
    if kind is None:
        return Q([value])
    if not isinstance(value, ECollection):
        return _CLASSES[kind]._of(list(value))
    cls = _OF_FEATURES[kind]
    made: Q[Dynamic] = cls.__new__(cls)
    made._items, made._feature = list(value), value  # type: ignore[attr-defined]
    return made


queried_by(collection)
