"""Which element of one model is which of the other, in EMF Compare's three ways: by id, by key, by similarity.

An element that has an id is only matched by it. The others are matched from the roots down. In matched containers the same
contents in the same order come first, then the same key, then the same contents. After that, elements match anywhere if their key
or contents exist only once (they moved), and last, in matched containers, those that are similar.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Hashable, Iterable
from difflib import SequenceMatcher
from typing import TypeAlias

from robosmi.model.comparison.facts import Facts
from robosmi.model.elements.ecore import EObject

SIMILAR = 0.5
"""The share of what is known of two elements that must be the same."""
MOST_ALIKE = 1_000_000
"""How many pairs of elements with the same contents are looked at to keep the order of such elements."""
WINDOW = 100
"""How many of the next elements are looked at for a similar one, on either side."""
Key: TypeAlias = "Callable[[Facts, EObject], Hashable | None]"


class Matching:
    """The pairs of two models.

    Args:
        before: one model.
        after: the other.
    """

    def __init__(self, before: Facts, after: Facts) -> None:
        self.before, self.after = before, after
        self.to_after: dict[int, EObject] = {}
        self.to_before: dict[int, EObject] = {}
        self._fresh: list[tuple[EObject | None, EObject | None]] = [(None, None)]
        self._grown: list[tuple[EObject | None, EObject | None]] = []
        self._by_id()
        while self._fresh:
            self._grow()
            if not self._moved() and not self._alike():
                break

    def _pair(self, one: EObject, other: EObject) -> None:
        self.to_after[id(one)] = other
        self.to_before[id(other)] = one
        self._fresh.append((one, other))

    def _by_id(self) -> None:
        """Match elements with the same id and type."""
        known = {self.after.id_of(element): element for element in reversed(self.after.elements)}
        known.pop(None, None)
        for element in self.before.elements:
            other = known.get(self.before.id_of(element))
            if other is None or id(other) in self.to_before:
                continue
            if self.before.type_of(element) == self.after.type_of(other):
                self._pair(element, other)

    def _left(self, facts: Facts, elements: Iterable[EObject]) -> list[EObject]:
        """Those elements that have no partner and no id."""
        taken = self.to_after if facts is self.before else self.to_before
        return [element for element in elements if id(element) not in taken and facts.id_of(element) is None]

    def _grow(self) -> None:
        """Match what matched containers contain, by key, then by contents."""
        while self._fresh:
            pair = self._fresh.pop()
            self._grown.append(pair)
            for ones, others in self._contents(pair):
                self._aligned(self._left(self.before, ones), self._left(self.after, others))
                for key in (_key, _digest):
                    self._equal(self._left(self.before, ones), self._left(self.after, others), key, alone=False)

    def _contents(self, pair: tuple[EObject | None, EObject | None]) -> Iterable[tuple[list[EObject], list[EObject]]]:
        """What two matched elements contain, feature by feature."""
        others = dict(self.after.children(pair[1]))
        return [(ones, others[name]) for name, ones in self.before.children(pair[0]) if name in others]

    def _aligned(self, ones: list[EObject], others: list[EObject]) -> None:
        """Match elements with the same contents that stand in the same order among the others."""
        here = [self.before.digest(one) for one in ones]
        there = [self.after.digest(other) for other in others]
        start, end = 0, 0
        shorter = min(len(here), len(there))
        while start < shorter and here[start] == there[start]:
            start += 1
        while end < shorter - start and here[-1 - end] == there[-1 - end]:
            end += 1
        pairs = [(i, i) for i in range(start)]
        pairs += [(len(here) - i, len(there) - i) for i in range(1, end + 1)]
        here, there = here[start : len(here) - end], there[start : len(there) - end]
        numbers = Counter(there)
        if sum(numbers[each] for each in here) <= MOST_ALIKE:
            for block in SequenceMatcher(None, here, there, autojunk=False).get_matching_blocks():
                pairs += [(start + block.a + i, start + block.b + i) for i in range(block.size)]
        for i, j in pairs:
            if self.before.type_of(ones[i]) == self.after.type_of(others[j]):
                self._pair(ones[i], others[j])

    def _equal(self, ones: list[EObject], others: list[EObject], key: Key, alone: bool) -> bool:
        """Match elements with the same type and key in their order; if `alone`, only such that are the only ones."""
        groups: dict[Hashable, list[EObject]] = {}
        for other in others:
            if (value := key(self.after, other)) is not None:
                groups.setdefault((self.after.type_of(other), value), []).append(other)
        if not groups:
            return False
        known = [(one, value) for one in ones if (value := key(self.before, one)) is not None]
        keyed = [(one, (self.before.type_of(one), value)) for one, value in known]
        numbers = Counter(value for _, value in keyed)
        for group in groups.values():
            group.reverse()
        found = False
        for one, value in keyed:
            group = groups.get(value, [])
            if group and not (alone and (numbers[value] > 1 or len(group) > 1)):
                self._pair(one, group.pop())
                found = True
        return found

    def _moved(self) -> bool:
        """Match elements wherever they are that alone have their key, or their contents."""
        found = False
        for key in (_key, _digest):
            ones, others = self._left(self.before, self.before.elements), self._left(self.after, self.after.elements)
            found = self._equal(ones, others, key, alone=True) or found
        return found

    def _alike(self) -> bool:
        """Match what matched containers contain by similarity, the most similar first."""
        found = False
        for pair in self._grown:
            for all_ones, all_others in self._contents(pair):
                ones, others = self._left(self.before, all_ones), self._left(self.after, all_others)
                if ones and others:
                    found = self._most_similar(ones, others, _Neighbours(all_ones), _Neighbours(all_others)) or found
        return found

    def _most_similar(self, ones: list[EObject], others: list[EObject], here: _Neighbours, there: _Neighbours) -> bool:
        known = [(self.after.type_of(other), Counter(self.after.facts(other))) for other in others]
        scores: list[tuple[float, int, int]] = []
        for place, one in enumerate(ones):
            facts, kind = Counter(self.before.facts(one)), self.before.type_of(one)
            beside = [self.to_after.get(each) for each in here.of(one)]
            for index in range(max(0, place - WINDOW), min(len(others), place + WINDOW)):
                if known[index][0] == kind:
                    near = there.of(others[index])
                    same_place = any(each is not None and id(each) in near for each in beside)
                    same_place = same_place or here.places[id(one)] == there.places[id(others[index])]
                    score = _similarity(facts, known[index][1], same_place)
                    if score >= SIMILAR:
                        scores.append((-score, place, index))
        found = False
        for _, place, index in sorted(scores):
            if id(ones[place]) not in self.to_after and id(others[index]) not in self.to_before:
                self._pair(ones[place], others[index])
                found = True
        return found


class _Neighbours:
    """The places of elements among their siblings."""

    def __init__(self, siblings: list[EObject]) -> None:
        self.places = {id(one): index for index, one in enumerate(siblings)}
        self._siblings = siblings

    def of(self, one: EObject) -> list[int]:
        """The identities of the elements before and behind one."""
        place = self.places[id(one)]
        return [id(each) for each in self._siblings[max(0, place - 1) : place + 2] if each is not one]


def _similarity(facts: Counter[tuple[object, ...]], others: Counter[tuple[object, ...]], same_place: bool) -> float:
    """The share of what two elements in one container have in common; the container counts, and so does the place."""
    common = (facts & others).total() + 1 + same_place
    return 2 * common / (facts.total() + others.total() + 4)


def _key(facts: Facts, element: EObject) -> Hashable | None:
    return facts.key_of(element)


def _digest(facts: Facts, element: EObject) -> Hashable | None:
    return facts.digest(element)
