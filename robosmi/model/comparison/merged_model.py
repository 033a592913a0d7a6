"""Makes the merged model of the first of two models, as `merging` decided."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from typing import Any, TypeAlias

from robosmi.model.comparison.merged_lists import merged_order
from robosmi.model.comparison.versions import A, B, ThreeModels, Versions
from robosmi.model.elements.by_name import feature_value
from robosmi.model.elements.ecore import EObject
from robosmi.model.elements.element_factory import new
from robosmi.model.elements.home import home_of
from robosmi.model.elements.pyecore_internals import fill_silently, set_xmi_id, xmi_id_of
from robosmi.model.emf import EmfModel
from robosmi.model.xmi.xmi_layout import DETAILS, LINKS, Column

Values: TypeAlias = "Mapping[Hashable, Any]"
"""What `ThreeModels.values` gives."""


class MergeDecisions:
    """What was decided.

    Args:
        prefer: the model whose order counts where both changed one, 1 or 2.

    Attributes:
        contents: container and name of the containment reference -> what it contains, in order; container None for the roots.
        features: elements with a feature and its values, where these are not those of the first model.
        orders: elements with a reference that follows from its opposite, and its ends in the base and both models.
    """

    def __init__(self, prefer: int) -> None:
        self.prefer = prefer
        self.contents: dict[tuple[Versions | None, str], list[Versions]] = {}
        self.features: list[tuple[Versions, Column, Values]] = []
        self.orders: list[tuple[Versions, Column, Sequence[Sequence[Hashable]]]] = []


def merge_into(model: EmfModel, three: ThreeModels, merged: MergeDecisions) -> None:
    """Change the first model into the merged one.

    Args:
        model: the first of the two models.
        three: the models and their elements.
        merged: what was decided.
    """
    _Application(model, three, merged).run()
    for root in model.roots:
        if (home := home_of(root)) is not None:
            home.shared_ids = three.facts[A].shared_ids


class _Application:
    def __init__(self, model: EmfModel, three: ThreeModels, merged: MergeDecisions) -> None:
        self.model, self.three, self.merged = model, three, merged
        self.elements: dict[Versions, Any] = {}

    def run(self) -> None:
        """Create what the second model added, put all elements where they belong, remove the others, and set features."""
        for each in self.three.all:
            if each.exists:
                self.elements[each] = each.elements[A] or _copy_of(each.elements[B])
        self.take_out()
        for each in self.three.all:
            if (element := each.elements[A]) is not None and not each.exists and self.model.owns(element):
                self.model.delete(element)
        for (container, name), members in self.merged.contents.items():
            if container is None or container.exists:
                self.contain(container, name, [self.elements[each] for each in members if each.exists])
        for versions, column, values in self.merged.features:
            if versions.exists:
                self.set(self.elements[versions], column, [self.value(key, value) for key, value in values.items()])
        for versions, column, known in self.merged.orders:
            if versions.exists and column.many:
                self.order(self.elements[versions], column, known)
        self.model.refresh()

    def take_out(self) -> None:
        """Take elements that have another container now out of the one that they had."""
        for each in self.three.all:
            place = self.three.place(A, each)
            if not each.exists or place is None or place[0] is None or place == (each.container, each.feature):
                continue
            element, container = self.elements[each], place[0].elements[A]
            assert container is not None
            column = self.three.columns(place[0])[place[1]]
            if column.many:
                getattr(container, column.key).remove(element)
            else:
                setattr(container, column.key, None)

    def contain(self, container: Versions | None, name: str, members: list[EObject]) -> None:
        """Let an element, or the model, contain these elements in this order."""
        if container is None:
            known = {id(root) for root in self.model.roots}
            for each in members:
                if id(each) not in known:
                    self.model.add(each)
            self.model.order_roots(members)
            return
        owner, column = self.elements[container], self.three.columns(container)[name]
        if not column.many:
            if feature_value(owner, column.key) is not members[0]:
                setattr(owner, column.key, members[0])
            return
        held = getattr(owner, column.key)
        self.fill(held, [*members, *(each for each in held if not self.three.knows(each))])

    def fill(self, collection: Any, wanted: list[Any]) -> None:
        """Let a collection have these elements in this order, such that opposites follow."""
        known, taken = {id(each) for each in collection}, {id(each) for each in wanted}
        for each in [each for each in collection if id(each) not in taken]:
            collection.remove(each)
        for each in wanted:
            if id(each) not in known:
                collection.append(each)
        if [id(each) for each in collection] != [id(each) for each in wanted]:
            fill_silently(collection, wanted)

    def value(self, key: Hashable, value: Any) -> Any:
        """A value, or the element of the merged model that is the end of a reference."""
        return self.elements[key] if isinstance(key, Versions) else value

    def set(self, element: Any, column: Column, values: list[Any]) -> None:
        """Set a feature."""
        if column.kind == DETAILS:
            held = getattr(element, column.key)
            held.clear()
            held.update(dict(values))
        elif not column.many:
            setattr(element, column.key, values[0] if values else None)
        elif column.kind == LINKS:
            self.fill(getattr(element, column.key), values)
        else:
            held = getattr(element, column.key)
            held.clear()
            held.extend(values)

    def order(self, element: Any, column: Column, known: Sequence[Sequence[Hashable]]) -> None:
        """Order the ends of a reference that follows from its opposite."""
        collection = getattr(element, column.key)
        ends = {id(each): each for each in collection}
        keys: dict[Hashable, Any] = {
            key: self.elements[key] for items in known for key in items if isinstance(key, Versions) and key.exists
        }
        members = {key for key, end in keys.items() if id(end) in ends}
        base, one, other = known
        order = [keys[key] for key in merged_order(base, one, other, members, self.merged.prefer) or ()]
        placed = {id(each) for each in order}
        wanted = [*order, *(end for place, end in ends.items() if place not in placed)]
        if [id(each) for each in collection] != [id(each) for each in wanted]:
            fill_silently(collection, wanted)


def _copy_of(element: EObject | None) -> Any:
    """A new element of the same class with the same xmi:id."""
    assert element is not None
    made = new(element.__class__)
    if (identity := xmi_id_of(element)) is not None:
        set_xmi_id(made, identity)
    return made
