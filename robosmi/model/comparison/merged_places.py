"""Which elements a merged model has, where, and in which order."""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.model.comparison.conflicts import ConflictList
from robosmi.model.comparison.facts import follows, is_compared
from robosmi.model.comparison.merged_lists import merged_order
from robosmi.model.comparison.merged_model import MergeDecisions
from robosmi.model.comparison.versions import BASE, A, B, Place, ThreeModels, Versions, texts_of
from robosmi.model.xmi.xmi_layout import LINKS


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
