"""The collections of many-valued features: pyecore's, extended by the operations of queries.

`book.authors.select(...)` is delegated to a collection that the query package makes from the values
(`robosmi.query.live_collections.collection`). This package does not depend on queries, so they register themselves when imported
(`queried_by`). Methods of pyecore's collections keep their meaning (`append`, `remove`, `index`), except for `select`, `reject`
and `count`, which return plain lists or take no function there.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any

from robosmi.model.elements.ecore import EBag, ECollection, EList, EObject, EOrderedSet, EProxy, ESet, EStructuralFeature
from robosmi.model.elements.feature_errors import REFUSAL, FeatureValueError, not_computed, value_error
from robosmi.model.elements.pyecore_internals import key_of
from robosmi.model.elements.structure import refuse_circle

_query: Callable[[Any], Any] | None = None


def queried_by(view: Callable[[Any], Any]) -> None:
    """Register the function that makes a query collection from the values of a feature."""
    global _query
    _query = view


class Queryable:
    """Adds the operations of queries to a collection of elements or values."""

    def __getattr__(self, name: str) -> Any:
        if name[0] == "_" or _query is None:
            raise AttributeError(f"'{type(self).__name__}' has no attribute '{name}'")
        return getattr(_query(self), name)

    def _repr_html_(self) -> str:
        from robosmi.model.elements.show import items_html  # for notebooks only

        return items_html(list(self))

    def _ask(self, name: str, *arguments: Any, **options: Any) -> Any:
        if _query is None:
            raise AttributeError(f"'{name}' is an operation of queries: import robosmi.query")
        return getattr(_query(self), name)(*arguments, **options)

    def select(self, condition: Callable[[Any], Any], kind: Any = None) -> Any:
        """The values for which the condition holds, as queries give them."""
        return self._ask("select", condition, kind)

    def reject(self, condition: Callable[[Any], Any], kind: Any = None) -> Any:
        """The values for which the condition does not hold, as queries give them."""
        return self._ask("reject", condition, kind)

    def count(self, condition: Any, kind: Any = None) -> int:
        """How many values there are for which the condition holds, or that are the value."""
        return int(self._ask("count", condition, kind))


class Contents(Queryable, list[Any]):
    """What an element contains, as a list of its own that takes the operations of queries; changing it changes no element."""


class Queried(Queryable):
    """Adds the operations of queries to a collection of pyecore's that holds the values of a feature."""

    owner: EObject
    feature: EStructuralFeature
    is_cont: bool

    def check(self, value: object) -> None:
        """Refuse a value that the feature does not take, as assigning does.

        Raises:
            FeatureValueError: it is of another kind, or None in the place of an element.
            ModelError: it would contain itself, or its new owner is read-only.
        """
        if REFUSAL in self.owner.__dict__ and (self.is_cont or self.feature.eOpposite is None):
            raise self.owner.__dict__[REFUSAL](self.owner, str(self.feature.name))
        if value is None and self._place()[1]:
            raise FeatureValueError(f"{self._place()[0]} takes elements, not None", fix="leave out what is not there")
        try:
            super().check(value)  # type: ignore[misc]
        except TypeError as error:
            owner, _, name = self._place()[0].rpartition(".")
            raise value_error(owner, name, value, error) from error
        if self.is_cont:
            refuse_circle(self.owner, value)

    def _update_opposite(self, owner: Any, new_value: Any, remove: bool = False) -> None:
        """Set the opposite of a value (`owner`) that is added; what it referred to before lets go of it, as in EMF.

        pyecore leaves the value in the former collection.
        """
        opposite = self.feature.eOpposite
        if opposite is not None and not remove and not opposite.many and owner.__class__ is not EProxy:
            former = getattr(owner, key_of(opposite))
            if former is not None and former is not new_value:
                former.__dict__[key_of(self.feature)].remove(owner, update_opposite=False)
        super()._update_opposite(owner, new_value, remove)  # type: ignore[misc]

    def __iter__(self) -> Iterator[Any]:
        """The values as they are now: changing the collection in a loop over it skips none of them."""
        return iter([*super().__iter__()])  # type: ignore[misc]

    def _place(self) -> tuple[str, bool]:
        """Class and name of the feature, as `Book.authors`, and whether it holds elements."""
        feature = getattr(self, "feature", None)
        owner = type(getattr(self, "owner", None)).__name__
        return f"{owner}.{feature.name if feature is not None else ''}", feature is not None and bool(feature.is_reference)


def _class(name: str, base: type, said: str) -> Any:
    common = {"is_ref": True, "is_cont": False, "generic_type": None, "birth": None}  # of most, not in each
    return type(name, (Queried, base), {"__doc__": said, "__module__": __name__, **common})


FeatureOrderedSet: Any = _class("FeatureOrderedSet", EOrderedSet, "Unique values in order.")


def added_by(add: Callable[[Any, Any], bool]) -> None:
    """Register the function that adds a value without pyecore where it can (`construct.add`)."""
    pyecores: Any = EOrderedSet  # whose methods a recording replaces

    def added(self: Any, value: Any, update_opposite: bool = True) -> None:
        """Add a value at the end."""
        if not update_opposite or not add(self, value):
            pyecores.add(self, value, update_opposite)

    def extended(self: Any, values: Iterable[Any]) -> None:
        """Add values at the end."""
        pending = iter(values)
        rest = next(([value, *pending] for value in pending if not add(self, value)), None)
        if rest is not None or not len(self):
            pyecores.extend(self, rest or ())

    FeatureOrderedSet.add = FeatureOrderedSet.append = added
    FeatureOrderedSet.extend = FeatureOrderedSet.update = extended


FeatureSet: Any = _class("FeatureSet", ESet, "Unique values in no order.")
FeatureList: Any = _class("FeatureList", EList, "Values in order.")
FeatureBag: Any = _class("FeatureBag", EBag, "Values in no order.")


if TYPE_CHECKING:
    _Collection = ECollection[Any]
else:
    _Collection = ECollection


class FeatureCollection(_Collection):
    """Makes the collection of a feature when it is first read; a feature's `derived_class`, in pyecore's words."""

    @staticmethod
    def create(owner: EObject, feature: EStructuralFeature) -> Any:
        """An empty collection for a feature of an element.

        Raises:
            NotComputedError: the feature is derived and volatile, and no code computes it.
        """
        if feature.derived and feature.volatile:
            raise not_computed(owner, str(feature.name))
        return kind_of(feature)(owner, feature)


def kind_of(feature: EStructuralFeature) -> Any:
    """The class of the values of a feature that is not derived. A reference with an opposite has each element once, as in EMF."""
    if feature.unique or (feature.is_reference and feature.eOpposite is not None):
        return FeatureOrderedSet if feature.ordered else FeatureSet
    return FeatureList if feature.ordered else FeatureBag


def is_stored(feature: EStructuralFeature) -> bool:
    """Whether the values of a feature are kept in the element, not computed by a class of the user's own."""
    return feature.derived_class in (ECollection, FeatureCollection)
