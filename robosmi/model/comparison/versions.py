"""The elements of three models: of a base, and of two models `a` and `b` that were made from it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterable, Iterator, Mapping
from typing import Any, TypeAlias

from robosmi.model.comparison.facts import Facts, compared
from robosmi.model.comparison.matching import Matching
from robosmi.model.elements.ecore import EObject
from robosmi.model.emf import EmfModel
from robosmi.model.xmi.xmi_layout import DETAILS, LINKS, Column

BASE, A, B = range(3)


class Versions:
    """One element as each of the three models has it.

    Args:
        base: the element in the base, or None.
        a: the element in the first model, or None.
        b: the element in the second, or None.

    Attributes:
        elements: these three.
        exists: whether the merged model has the element.
        container: what contains it there; None for a root.
        feature: the name of the containment reference; empty for a root.
    """

    __slots__ = ("container", "elements", "exists", "feature")

    def __init__(self, base: EObject | None, a: EObject | None, b: EObject | None) -> None:
        self.elements = (base, a, b)
        self.exists = a is not None or b is not None
        self.container: Versions | None = None
        self.feature = ""


Place: TypeAlias = "tuple[Versions | None, str]"
"""A container, None for the model, and the name of its containment reference."""


class ThreeModels:
    """The three models, with their elements matched. Both models are matched with the base; what both added is matched by id, and
    in matched containers by contents, then by key.

    Args:
        base: what both were made from.
        a: the first.
        b: the second.

    Attributes:
        facts: what is compared of each of them.
        all: the elements: those of the base in its order, then what `a` added, then what `b` added.
    """

    def __init__(self, base: EmfModel, a: EmfModel, b: EmfModel) -> None:
        self.facts = (Facts(base), Facts(a), Facts(b))
        for each in self.facts:
            each.know(self.facts)
        self.all: list[Versions] = []
        self._known: dict[int, Versions] = {}
        self._columns: dict[type, dict[str, Column]] = {}
        ones, others = (Matching(self.facts[BASE], self.facts[side]).to_after for side in (A, B))
        for element in self.facts[BASE].elements:
            self._add(Versions(element, ones.get(id(element)), others.get(id(element))))
        partners = self._added_by_both()
        for element in self.facts[A].elements:
            if id(element) not in self._known:
                self._add(Versions(None, element, partners.get(id(element))))
        for element in self.facts[B].elements:
            if id(element) not in self._known:
                self._add(Versions(None, None, element))

    def _add(self, versions: Versions) -> None:
        self.all.append(versions)
        self._known.update((id(element), versions) for element in versions.elements if element is not None)

    def _added_by_both(self) -> dict[int, EObject]:
        """What both models added: the element of `a` -> that of `b`."""
        found: dict[int, EObject] = {}
        ids: dict[tuple[str, str], EObject] = {}
        for other in self._added(B, self.facts[B].elements, ()):
            if (identity := self.facts[B].id_of(other)) is not None:
                ids.setdefault((self.facts[B].type_of(other), identity), other)
        fresh: list[tuple[EObject | None, EObject | None]] = [(None, None)]
        for one in self._added(A, self.facts[A].elements, ()):
            identity = self.facts[A].id_of(one)
            if identity is not None and (same := ids.pop((self.facts[A].type_of(one), identity), None)) is not None:
                found[id(one)] = same
                fresh.append((one, same))
        taken = {id(other) for other in found.values()}
        fresh += [(each.elements[A], each.elements[B]) for each in self.all if None not in each.elements]
        while fresh:
            container = fresh.pop()
            others = dict(self.facts[B].children(container[1]))
            for name, children in self.facts[A].children(container[0]):
                ones = [child for child in self._added(A, children, found) if self.facts[A].id_of(child) is None]
                there = [child for child in self._added(B, others.get(name, ()), taken) if self.facts[B].id_of(child) is None]
                for one, other in self._same(ones, there) if ones and there else ():
                    found[id(one)] = other
                    taken.add(id(other))
                    fresh.append((one, other))
        return found

    def _added(self, side: int, elements: Iterable[EObject], but: Iterable[int]) -> list[EObject]:
        return [each for each in elements if id(each) not in self._known and id(each) not in but]

    def _same(self, ones: list[EObject], others: list[EObject]) -> Iterator[tuple[EObject, EObject]]:
        """The pairs of elements in one place with the same contents in their order, then of those with a key of their own."""
        paired: set[int] = set()
        for named in (False, True):
            here, there = ([each for each in known if id(each) not in paired] for known in (ones, others))
            keys = [self._key_of(A, one, named) for one in here]
            numbers = Counter(keys)
            places: dict[Hashable | None, list[EObject]] = {}
            for other in there:
                places.setdefault(self._key_of(B, other, named), []).append(other)
            for key, one in zip(keys, here, strict=True):
                same = places.get(key, [])
                if key is not None and same and not (named and (len(same) > 1 or numbers[key] > 1)):
                    other = same.pop(0)
                    paired |= {id(one), id(other)}
                    yield one, other

    def _key_of(self, side: int, element: EObject, named: bool) -> Hashable | None:
        facts = self.facts[side]
        value: Hashable | None = facts.key_of(element) if named else facts.digest(element)
        return None if value is None else (facts.type_of(element), value)

    # --- one of the three

    def knows(self, element: EObject) -> bool:
        """Whether an element is one of a model's own, and not in another file."""
        return id(element) in self._known

    def place(self, side: int, versions: Versions) -> Place | None:
        """Where a model has an element; None if it lacks it."""
        element = versions.elements[side]
        if element is None:
            return None
        container, name = self.facts[side].container_of(element)
        return (None if container is None else self._known[id(container)]), name

    def contents(self, side: int, container: Versions | None) -> dict[str, list[Versions]]:
        """The contents of an element, or the roots, in a model, by the names of the containment references."""
        element = container.elements[side] if container is not None else None
        if container is not None and element is None:
            return {}
        return {name: [self._known[id(child)] for child in children] for name, children in self.facts[side].children(element)}

    def columns(self, versions: Versions) -> dict[str, Column]:
        """The features of an element's class that a file has."""
        side = next(side for side in (BASE, A, B) if versions.elements[side] is not None)
        element = versions.elements[side]
        assert element is not None
        cls = element.__class__
        if cls not in self._columns:
            self._columns[cls] = {column.name: column for column in self.facts[side].columns(element)}
        return self._columns[cls]

    def values(self, side: int, versions: Versions, column: Column) -> dict[Hashable, Any]:
        """What a feature of an element has in a model: what is equal for equal values in all three -> the value.

        A value that comes several times is numbered. The same end of a reference is the same `Versions`, or the same URI.
        """
        element = versions.elements[side]
        if element is None:
            return {}
        found: dict[Hashable, Any] = {}
        numbers: Counter[Hashable] = Counter()
        facts = self.facts[side]
        for value in facts.values(element, column):
            key: Hashable
            if column.kind == LINKS:
                key = self._known[id(value)] if id(value) in facts.inside else facts.outside_key(value)
                found[key] = value
                continue
            key = value[0] if column.kind == DETAILS else _hashable(compared(column, value))
            found[key, numbers[key]] = value
            numbers[key] += 1
        return found

    def remaining(self, side: int, versions: Versions, column: Column) -> dict[Hashable, Any]:
        """What a feature has in the base, without the elements that a model has removed."""
        known = self.values(BASE, versions, column)
        return {key: value for key, value in known.items() if not isinstance(key, Versions) or key.elements[side] is not None}


def texts_of(values: Mapping[Hashable, Any], column: Column) -> Hashable:
    """What is equal for the same values of a feature, as `ThreeModels.values` gives them."""
    if column.kind == DETAILS:
        return tuple(sorted(values.values(), key=str))
    return tuple(values) if column.feature.ordered else frozenset(values)


def _hashable(value: Any) -> Hashable:
    return type(value).__name__, str(value)
