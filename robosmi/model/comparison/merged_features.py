"""Which values and references the elements of a merged model have."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from typing import Any

from robosmi.model.comparison.conflicts import ConflictList
from robosmi.model.comparison.facts import follows, is_compared
from robosmi.model.comparison.merged_lists import merged_members, merged_order, replaced_twice
from robosmi.model.comparison.merged_model import MergeDecisions
from robosmi.model.comparison.versions import BASE, A, B, ThreeModels, Versions, texts_of
from robosmi.model.elements.features import opposite
from robosmi.model.xmi.xmi_layout import DETAILS, LINKS, Column


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
