"""`ModelMerge`: the three-way merge of models: what both made of a base, in one model, or the conflicts between them.

As in EMF Compare and git, what only one of the two changed is taken, and what both changed in the same way, too. A conflict is
a value, a place or an order that both changed in different ways, and an element that one removed and the other changed.

`PlacesMerge` decides which elements the merged model has, where, and in which order; `FeaturesMerge` which values and
references they have. `_merge_into` makes the merged model of the first of the two.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

from robosmi.base.quantities import quantity
from robosmi.diagnostics import Finding, Location
from robosmi.errors import ModelError
from robosmi.model.comparison.comparison import opened_models, refuse_others
from robosmi.model.comparison.conflicts import ConflictList, Side, lines_of
from robosmi.model.comparison.facts import follows, is_compared
from robosmi.model.comparison.merged_lists import merged_members, merged_order, replaced_twice
from robosmi.model.comparison.versions import BASE, A, B, Place, ThreeModels, Versions, texts_of
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.elements.by_name import feature_value
from robosmi.model.elements.driver import Model
from robosmi.model.elements.ecore import EObject
from robosmi.model.elements.element_factory import new
from robosmi.model.elements.features import opposite
from robosmi.model.elements.home import home_of
from robosmi.model.elements.pyecore_internals import fill_silently, set_xmi_id, xmi_id_of
from robosmi.model.emf import EmfModel
from robosmi.model.session import Paths
from robosmi.model.xmi.xmi_layout import DETAILS, LINKS, Column
from robosmi.model.xmi.xmi_reader import FOREIGN

_SIDES: Mapping[str | None, int | None] = {"a": A, "b": B, None: None}

_Values: TypeAlias = "Mapping[Hashable, Any]"
"""What `ThreeModels.values` gives."""


class ModelMerge:
    """The merge of two edited copies of a model.

    Args:
        base: what both were made from.
        a: the first; it becomes the merged model, unless there are conflicts and no side is to win them.
        b: the second.
        take: the side that wins the conflicts, if any.
        is_as_read: whether `a` was just read from its file, so that conflicts have their lines in it.

    Attributes:
        conflicts: what both changed in different ways: removed elements, moved ones, contents, then values.
        findings: the same as findings, after what was odd in the files.

    Raises:
        ModelError: the models are of different metamodels, or of copies of one.
    """

    def __init__(self, base: EmfModel, a: EmfModel, b: EmfModel, take: Side | None = None, *, is_as_read: bool = False) -> None:
        refuse_others(base, a)
        refuse_others(base, b)
        self._take = _SIDES[take]
        self._model = a
        self._three = ThreeModels(base, a, b)
        self._refuse_copies(b)
        merged, conflicts = MergeDecisions(self._take or A), ConflictList(self._three)
        PlacesMerge(self._three, conflicts, merged, self._take).decide()
        FeaturesMerge(self._three, conflicts, merged).decide()
        self.conflicts = conflicts.all
        reported = [
            each.finding(place, take) for each, place in zip(self.conflicts, _places(a, conflicts, is_as_read), strict=True)
        ]
        self.findings: list[Finding] = [*base.findings, *a.findings, *b.findings, *reported]
        self._done = take is not None or not self.conflicts
        if self._done:
            _merge_into(a, self._three, merged)

    def __repr__(self) -> str:
        return f"<ModelMerge: {quantity(len(self.conflicts), 'conflict')}>"

    @property
    def model(self) -> EmfModel:
        """The merged model: the first one, with what the second changed.

        Raises:
            ModelError: there are conflicts, and no side was to win them.
        """
        if not self._done:
            raise ModelError(
                f"the models have {quantity(len(self.conflicts), 'conflict')}, so there is no merged model",
                location=Location(str(self._model.path)) if self._model.path is not None else None,
                fix="solve the conflicts in the models, or merge with take='a' or take='b'",
            )
        return self._model

    def _refuse_copies(self, b: EmfModel) -> None:
        pair = next((each for each in self._three.all if each.elements[A] is not None and each.elements[B] is not None), None)
        if pair is not None and type(pair.elements[A]) is not type(pair.elements[B]):
            raise ModelError(
                "the models have two copies of a metamodel, so elements of one cannot go into the other",
                location=Location(str(b.path)) if b.path is not None else None,
                fix="open the models in one Session, or give their files",
            )


def merge(
    base: str | Path | Model,
    a: str | Path | Model,
    b: str | Path | Model,
    take: Side | None = None,
    metamodel: Paths | Metamodel = (),
) -> ModelMerge:
    """Merge what two models made of one.

    Args:
        base: what both were made from, a model of EMF or its file: XMI, JSON or .ecore.
        a: the first; given as a model, it becomes the merged one.
        b: the second.
        take: the side that wins conflicts.
        metamodel: .ecore files of models that are given as files, or a `Metamodel`; the built-in metamodels if none.

    Raises:
        SourceError: a file cannot be read.
        ModelError: a model contradicts its metamodel, they are of different ones, or one is no model of EMF.
    """
    first, second, third = opened_models((base, a, b), metamodel)
    return ModelMerge(first, second, third, take, is_as_read=not isinstance(a, Model))


def _places(a: EmfModel, conflicts: ConflictList, is_as_read: bool) -> list[Location | None]:
    """Where the first model has what is in conflict: file and line, of a model without a file nothing."""
    if a.path is None:
        return [None] * len(conflicts.all)
    is_plain = is_as_read and not any(finding.rule == FOREIGN for finding in a.findings)  # else children would be miscounted
    lines = lines_of(conflicts.in_a, a.path) if is_plain and conflicts.all else [None] * len(conflicts.all)
    return [Location(str(a.path), line) for line in lines]


class FeaturesMerge:
    """The merge of values and references, when it is decided which elements exist.

    Args:
        three: the models.
        conflicts: receives the conflicts.
        merged: receives what was decided.
    """

    def __init__(self, three: ThreeModels, conflicts: ConflictList, merged: MergeDecisions) -> None:
        self._three, self._conflicts, self._merged = three, conflicts, merged

    def decide(self) -> None:
        """Decide the values of all features that are not as the first model has them."""
        self._decide_features()
        self._decide_claims()

    def _decide_features(self) -> None:
        for each in self._three.all:
            if not each.exists:
                continue
            for column in self._three.columns(each).values():
                if not is_compared(column):
                    continue
                if follows(column):
                    self._decide_order(each, column)
                elif each.elements[A] is None:
                    self._set(each, column, self._three.values(B, each, column))
                elif each.elements[B] is not None:
                    self._decide_feature(each, column)

    def _set(self, versions: Versions, column: Column, values: Mapping[Hashable, Any]) -> None:
        kept = {key: value for key, value in values.items() if not isinstance(key, Versions) or key.exists}
        self._merged.features.append((versions, column, kept))

    def _decide_order(self, versions: Versions, column: Column) -> None:
        """Order the ends of a reference that follows from its opposite."""
        base, a, b = (list(self._three.values(side, versions, column)) for side in (BASE, A, B))
        has_order = column.many and column.feature.ordered and None not in versions.elements[A:]
        if has_order and merged_order(base, a, b, set(a) & set(b)) is None:
            self._conflicts.differ(versions, column)
        self._merged.orders.append((versions, column, (base, a, b)))

    def _decide_feature(self, versions: Versions, column: Column) -> None:
        """Merge the values of a feature of an element that both models have."""
        one, other = (self._three.values(side, versions, column) for side in (A, B))
        ones, others = texts_of(one, column), texts_of(other, column)
        if ones == others:
            return
        same = self._same_as_base(A, versions, column, ones), self._same_as_base(B, versions, column, others)
        if same == (True, True):  # what one of them removed may stay
            self._set(versions, column, self._three.values(BASE, versions, column) or other or one)
        elif same[0]:
            self._set(versions, column, one if _is_lost(column, other) else other)
        elif same[1]:
            if _is_lost(column, one):
                self._set(versions, column, other)
        elif column.kind == DETAILS:
            self._merge_pairs(versions, column, one, other)
        elif column.many:
            self._merge_values(versions, column, one, other)
        else:
            self._conflicts.differ(versions, column)
            if self._merged.prefer == B:
                self._set(versions, column, other)

    def _same_as_base(self, side: int, versions: Versions, column: Column, texts: Hashable) -> bool:
        """Whether a model did not change a feature itself; the end of a reference may be gone because it was removed."""
        if versions.elements[BASE] is None:
            default = not column.many and column.kind not in (LINKS, DETAILS)
            values = self._three.values(side, versions, column)
            return not values or (default and list(values.values()) == [column.default])
        before = self._three.values(BASE, versions, column)
        return texts in (texts_of(before, column), texts_of(self._three.remaining(side, versions, column), column))

    def _merge_pairs(
        self, versions: Versions, column: Column, one: Mapping[Hashable, Any], other: Mapping[Hashable, Any]
    ) -> None:
        """Merge pairs of texts, key by key."""
        before = self._three.values(BASE, versions, column)
        found: dict[Hashable, Any] = {}
        for key in dict.fromkeys([*one, *other]):
            was, mine, theirs = before.get(key), one.get(key), other.get(key)
            if was not in (mine, theirs) and mine != theirs:
                self._conflicts.differ(versions, column)
            value = theirs if mine == was or (self._merged.prefer == B and theirs != was) else mine
            if value is not None:
                found[key] = value
        self._set(versions, column, dict(sorted(found.items(), key=str)))

    def _merge_values(
        self, versions: Versions, column: Column, one: Mapping[Hashable, Any], other: Mapping[Hashable, Any]
    ) -> None:
        """Merge a list that both models changed."""
        before = self._three.values(BASE, versions, column)
        here = {key: value for key, value in before.items() if not isinstance(key, Versions) or key.exists}
        members = merged_members(before, one, other) | {key for key in here if self._stays(key, one, other)}
        lists = list(before), list(one), list(other)
        order = merged_order(*lists, members)
        is_full = max(map(len, lists)) <= column.upper < len(members)
        if order is None or is_full or replaced_twice(here, one, other):
            self._conflicts.differ(versions, column)
            order = list(other if self._merged.prefer == B else one)
        both = {**other, **one}
        self._set(versions, column, {key: both[key] for key in order or ()})

    def _stays(self, key: Hashable, one: Mapping[Hashable, Any], other: Mapping[Hashable, Any]) -> bool:
        """Whether an end of a reference is missing only where the element itself is."""
        return isinstance(key, Versions) and all(
            key in values or key.elements[side] is None for side, values in ((A, one), (B, other))
        )

    def _decide_claims(self) -> None:
        """Find elements at the one end of a reference that two elements shall have at its other end."""
        claims: dict[tuple[Versions, Column], list[Versions]] = {}
        chosen = {(versions, column.name): values for versions, column, values in self._merged.features}
        for each in self._three.all:
            for column in self._three.columns(each).values() if each.exists else ():
                if column.kind == LINKS and not column.many and not follows(column) and _is_one(column):
                    values = chosen.get((each, column.name))
                    for end in self._three.values(A, each, column) if values is None else values:
                        if isinstance(end, Versions):
                            claims.setdefault((end, column), []).append(each)
        for (end, column), claimants in claims.items():
            if len(claimants) > 1:
                claiming = [self._claiming(side, end, column, claimants) for side in (BASE, A, B)]
                other = opposite(column.feature)
                assert other is not None
                self._conflicts.claim(end, str(other.name), claiming)
                for each in claimants:
                    if end not in self._three.values(self._merged.prefer, each, column):
                        self._set(each, column, {})

    def _claiming(self, side: int, end: Versions, column: Column, claimants: Sequence[Versions]) -> Versions | None:
        """The element whose reference leads to an end in a model."""
        return next((each for each in claimants if end in self._three.values(side, each, column)), None)


def _is_lost(column: Column, values: Mapping[Hashable, Any]) -> bool:
    """Whether the one end of a reference is no element of the merged model."""
    return not column.many and any(isinstance(end, Versions) and not end.exists for end in values)


def _is_one(column: Column) -> bool:
    other = opposite(column.feature)
    return other is not None and not other.many


class PlacesMerge:
    """The merge of what models contain: removed, moved and added elements.

    Args:
        three: the models.
        conflicts: receives the conflicts.
        merged: receives what was decided.
        take: the model that wins conflicts, 1 or 2; None for none.
    """

    def __init__(self, three: ThreeModels, conflicts: ConflictList, merged: MergeDecisions, take: int | None) -> None:
        self._three, self._conflicts, self._merged, self._take = three, conflicts, merged, take
        self._new_ends = {side: self._newly_referred(side) for side in (A, B)}

    def decide(self) -> None:
        """Decide `exists`, `container` and `feature` of all elements, and the order of contents."""
        for side, other in ((A, B), (B, A)):
            self._decide_removals(side, other)
        self._decide_places()
        self._decide_contents()

    # --- removed elements

    def _newly_referred(self, side: int) -> set[Versions]:
        """The elements that a model has references to which the base has not."""
        found: set[Versions] = set()
        for each in self._three.all:
            if each.elements[side] is not None:
                for column in self._three.columns(each).values():
                    if column.kind == LINKS and not follows(column):
                        before = self._three.values(BASE, each, column)
                        ends = self._three.values(side, each, column)
                        found |= {end for end in ends if isinstance(end, Versions) and end not in before}
        return found

    def _decide_removals(self, side: int, other: int) -> None:
        """Remove what the other model removed, unless this one changed it."""
        removed = {each for each in self._three.all if each.elements[BASE] and each.elements[side] and not each.elements[other]}
        for each in self._three.all:
            place = self._three.place(side, each) if each in removed else None
            if place is None or place[0] in removed:
                continue
            inside = list(self._inside(side, other, each))
            if any(self._changed(side, other, one) for one in inside):
                self._conflicts.place("removed", each)
                if self._take == side:
                    continue
            for one in inside:
                one.exists = one.exists and one.elements[other] is not None

    def _inside(self, side: int, other: int, versions: Versions) -> Iterator[Versions]:
        """An element and what it contains in a model, but not the contents of elements that the other model has."""
        pending = [versions]
        while pending:
            one = pending.pop()
            yield one
            if one.elements[other] is None:
                for children in self._three.contents(side, one).values():
                    pending += children

    def _changed(self, side: int, other: int, versions: Versions) -> bool:
        """Whether a model added, moved, changed or newly referred to an element."""
        place = self._three.place(BASE, versions)
        if place is None or place != self._three.place(side, versions):
            return True
        if versions.elements[other] is not None:
            return False
        if versions in self._new_ends[side]:
            return True
        for column in self._three.columns(versions).values():
            if is_compared(column) and not follows(column):
                before = self._three.remaining(side, versions, column)
                if texts_of(before, column) != texts_of(self._three.values(side, versions, column), column):
                    return True
        return False

    # --- places

    def _decide_places(self) -> None:
        for each in self._three.all:
            if each.exists:
                each.container, each.feature = self._place(each)
        while (circle := self._circle()) is not None:
            self._conflicts.place("moved", circle[0])
            for each in circle:
                place = self._three.place(self._merged.prefer, each)
                if place is not None:
                    each.container, each.feature = place

    def _place(self, versions: Versions) -> Place:
        """Where the merged model has an element."""
        before, one, other = (self._three.place(side, versions) for side in (BASE, A, B))
        if one is None or other is None:
            found = one or other
            assert found is not None
            return found
        found, alternative = (other, one) if one == before else (one, other)
        if before not in (one, other) and one != other:
            self._conflicts.place("moved", versions)
            if self._merged.prefer == B:
                found, alternative = alternative, found
        return found if found[0] is None or found[0].exists else alternative

    def _circle(self) -> list[Versions] | None:
        """Elements that contain each other, or None."""
        done: set[Versions] = set()
        for each in self._three.all:
            way: dict[Versions, None] = {}
            one: Versions | None = each if each.exists else None
            while one is not None and one not in done:
                if one in way:
                    begun = list(way)
                    return begun[begun.index(one) :]
                way[one] = None
                one = one.container
            done.update(way)
        return None

    # --- contents

    def _decide_contents(self) -> None:
        """Order the contents of all elements."""
        groups: dict[tuple[Versions | None, str], list[Versions]] = {}
        for each in self._three.all:
            if each.exists:
                groups.setdefault((each.container, each.feature), []).append(each)
        for (container, name), members in groups.items():
            known = self._known(container, name)
            upper = self._three.columns(container)[name].upper if container is not None else -1
            if 0 < upper < len(members) and max(map(len, known[1:])) <= upper and container is not None:
                self._conflicts.contain(container, name, known)
                members = [each for each in members if each in known[self._merged.prefer]]
            order = merged_order(*known, members)
            if order is None:
                self._conflicts.contain(container or members[0], name or None, known)
                order = merged_order(*known, members, self._merged.prefer) or []
            self._merged.contents[container, name] = order
        self._leave_out({each for order in self._merged.contents.values() for each in order})

    def _known(self, container: Versions | None, name: str) -> tuple[list[Versions], list[Versions], list[Versions]]:
        """What an element contains in the three models."""
        base, a, b = (self._three.contents(side, container).get(name, []) for side in (BASE, A, B))
        return base, a, b

    def _leave_out(self, placed: set[Versions]) -> None:
        """Leave elements without a place out, with all they contain."""
        for each in self._three.all:
            way: list[Versions] = []
            one: Versions | None = each
            while one is not None and one.exists and one in placed:
                way.append(one)
                one = one.container
            if one is not None:
                each.exists = False


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
        self.features: list[tuple[Versions, Column, _Values]] = []
        self.orders: list[tuple[Versions, Column, Sequence[Sequence[Hashable]]]] = []


def _merge_into(model: EmfModel, three: ThreeModels, merged: MergeDecisions) -> None:
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
