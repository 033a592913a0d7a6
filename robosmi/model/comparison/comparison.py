"""`ModelComparison`: what is different about two models of one metamodel, as records.

As in EMF Compare, every element that is in one of them only is a change (`added`, `removed`), and so is one that has another
container or place (`moved`), and each feature of a matched element that has another value (`changed`). Of two opposite references
the one with fewer values is reported, since the other follows from it. What is not saved in a file is not compared.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

from msgspec import Struct

from robosmi.base.data_text import Json, json_written
from robosmi.base.quantities import quantity
from robosmi.diagnostics import Location
from robosmi.errors import ModelError
from robosmi.model.comparison.facts import Facts, compared, follows, is_compared, plain
from robosmi.model.comparison.matching import Matching
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.elements.driver import Model, label
from robosmi.model.elements.ecore import EObject
from robosmi.model.emf import EmfModel
from robosmi.model.session import Paths, Session
from robosmi.model.xmi.xmi_layout import LINKS


class Difference(Struct, frozen=True):
    """One difference.

    Attributes:
        kind: `added`, `removed`, `changed` or `moved`.
        element: the id or fragment of the element, in the second model if it was added, else in the first.
        type: the name of its class.
        feature: what has another value, or contains the element; None for a root.
        before: the value in the first model; of an element its place: the container's id or fragment, feature and index.
        after: the same in the second.
        name: what the element is called.
    """

    kind: str
    element: str
    type: str
    feature: str | None
    before: Json
    after: Json
    name: str

    def to_json(self) -> dict[str, Json]:
        """The record as JSON."""
        return {
            "kind": self.kind, "element": self.element, "type": self.type, "feature": self.feature, "before": self.before,
            "after": self.after, "name": self.name,
        }  # fmt: skip

    def line(self) -> str:
        """The record as a line of text."""
        if self.kind == "changed":
            before, after = (json_written(value, ensure_ascii=False) for value in (self.before, self.after))
            return f"changed {self.name} {self.element}: {self.feature} {before} -> {after}"
        where = " -> ".join(str(place) for place in (self.before, self.after) if place is not None)
        return f"{self.kind} {self.name} {self.element}: {where}"


class ModelComparison:
    """Two models and what is different about them.

    Args:
        before: one model.
        after: the other, of the same metamodel or a copy of it.

    Attributes:
        changes: the differences: what was removed, moved and changed in the order of the first model, then what was added.
        findings: what was odd in the files of the models.

    Raises:
        ModelError: they are of different metamodels.
    """

    def __init__(self, before: EmfModel, after: EmfModel) -> None:
        refuse_others(before, after)
        self.findings = [*before.findings, *after.findings]
        self._before, self._after = both = (Facts(before), Facts(after))
        for each in both:
            each.know(both)
        self._matching = Matching(self._before, self._after)
        self.changes: list[Difference] = [*self._of_first(), *self._added()]

    def __bool__(self) -> bool:
        return bool(self.changes)

    def __repr__(self) -> str:
        return f"<ModelComparison: {quantity(len(self.changes), 'change')}>"

    @property
    def equal(self) -> bool:
        """Whether there is no difference."""
        return not self.changes

    def match(self, element: EObject) -> EObject | None:
        """The element of the other model that is this one, or None."""
        return self._matching.to_after.get(id(element)) or self._matching.to_before.get(id(element))

    def lines(self) -> list[str]:
        """The changes as text; what is inside of an added or removed element is only counted."""
        found: list[str] = []
        hidden: dict[str, int] = {}
        tops: dict[tuple[str, str], int] = {}
        for change in self.changes:
            place = change.before if change.kind == "removed" else change.after if change.kind == "added" else None
            container = str(place).partition(" ")[0] if place is not None else ""
            top = tops.get((change.kind, container)) if place is not None else None
            if top is not None:
                tops[change.kind, change.element] = top
                hidden[str(top)] = hidden.get(str(top), 0) + 1
                continue
            if change.kind in ("added", "removed"):
                tops[change.kind, change.element] = len(found)
            found.append(change.line())
        return [
            f"{line} (with {quantity(hidden[str(i)], 'element')})" if str(i) in hidden else line for i, line in enumerate(found)
        ]

    # --- the records

    def _of_first(self) -> Iterator[Difference]:
        """What was removed, moved and changed, in the order of the first model."""
        misplaced = self._misplaced()
        for element in self._before.elements:
            other = self._matching.to_after.get(id(element))
            if other is None:
                yield self._record("removed", self._before, element, self._before.position(element), None)
                continue
            before, after = self._before.container_of(element), self._after.container_of(other)
            stays = before[1] == after[1] and (before[0] is None) == (after[0] is None)
            stays = stays and (before[0] is None or self._matching.to_after.get(id(before[0])) is after[0])
            if not stays or id(element) in misplaced:
                places = self._before.position(element), self._after.position(other)
                yield self._record("moved", self._before, element, *places)
            yield from self._changed(element, other)

    def _added(self) -> Iterator[Difference]:
        for element in self._after.elements:
            if id(element) not in self._matching.to_before:
                yield self._record("added", self._after, element, None, self._after.position(element))

    def _record(self, kind: str, facts: Facts, element: EObject, before: str | None, after: str | None) -> Difference:
        name = str(element.eClass.name)
        return Difference(
            kind, facts.place_of(element), name, facts.container_of(element)[1] or None, before, after, label(element)
        )

    def _misplaced(self) -> set[int]:
        """Those elements of the first model that have the container they had, and stand before or behind others there."""
        found: set[int] = set()
        pairs = [(None, None), *((one, self._matching.to_after.get(id(one))) for one in self._before.elements)]
        for one, other in pairs:
            if one is not None and other is None:
                continue
            others = dict(self._after.children(other))
            for name, children in self._before.children(one):
                places = {id(child): index for index, child in enumerate(others.get(name, []))}
                kept = [(child, places.get(id(self._matching.to_after.get(id(child))))) for child in children]
                order = [(child, place) for child, place in kept if place is not None]
                stay = _longest_rise([place for _, place in order])
                found.update(id(child) for index, (child, _) in enumerate(order) if index not in stay)
        return found

    def _changed(self, element: EObject, other: EObject) -> Iterator[Difference]:
        """The features of a matched element that have other values."""
        theirs = {column.name: column for column in self._after.columns(other)}
        for column in self._before.columns(element):
            counterpart = theirs.get(column.name)
            if counterpart is None or not is_compared(column):
                continue
            ones, others = self._before.values(element, column), self._after.values(other, counterpart)
            if column.kind == LINKS:
                before, after = self._targets(ones, others)
                if follows(column):
                    common = set(before) & set(after)
                    before, after = ([each for each in known if each in common] for known in (before, after))
                shown: tuple[list[Json], list[Json]] = (
                    [self._before.target(each) for each in ones],
                    [self._after.target(each) for each in others],
                )
            else:
                before, after = [compared(column, each) for each in ones], [compared(counterpart, each) for each in others]
                shown = [plain(column, each) for each in ones], [plain(counterpart, each) for each in others]
            if not column.feature.ordered:
                before, after = (sorted(known, key=repr) for known in (before, after))
            if before == after:
                continue
            was, now = (known if column.many else known[0] if known else None for known in shown)
            place = self._before.place_of(element)
            yield Difference("changed", place, str(element.eClass.name), column.name, was, now, label(element))

    def _targets(self, ones: Sequence[Any], others: Sequence[Any]) -> tuple[list[Any], list[Any]]:
        """The ends of references, such that the same end is equal."""
        before = [self._matching.to_after.get(id(one), one) for one in ones]
        return [self._after.end(each, self._before) for each in before], [self._after.end(each, self._after) for each in others]


def compare(before: str | Path | Model, after: str | Path | Model, metamodel: Paths | Metamodel = ()) -> ModelComparison:
    """What is different about two models.

    Args:
        before: a model of EMF, or its file: XMI, JSON or .ecore.
        after: the other.
        metamodel: .ecore files of models that are given as files, or a `Metamodel`; the built-in metamodels if none.

    Raises:
        SourceError: a file cannot be read.
        ModelError: a model contradicts its metamodel, they are of different ones, or one is no model of EMF.
    """
    return ModelComparison(*opened_models((before, after), metamodel))


def opened_models(given: Iterable[str | Path | Model], metamodel: Paths | Metamodel = ()) -> list[EmfModel]:
    """Models of EMF: those that are given, and those of given files, which are opened in one session.

    Args:
        given: models and files.
        metamodel: .ecore files of models that are given as files, or a `Metamodel`; the built-in metamodels if none.

    Raises:
        SourceError: a file cannot be read.
        ModelError: a model contradicts its metamodel, or is no model of EMF.
    """
    session = Session()
    found: list[EmfModel] = []
    for each in given:
        model = each if isinstance(each, Model) else session.open_model(each, metamodel=metamodel)
        if not isinstance(model, EmfModel):
            raise ModelError(
                f"the model {model.name} has no metamodel, so its elements cannot be told apart",
                location=Location(str(model.path)) if model.path is not None else None,
                fix="compare models in XMI, JSON or .ecore files",
            )
        found.append(model)
    return found


def refuse_others(before: EmfModel, after: EmfModel) -> None:
    """Refuse models whose roots are of different metamodels; one without roots may be compared with any."""
    spaces = [sorted({str(root.eClass.ePackage.nsURI) for root in model.roots}) for model in (before, after)]
    if all(spaces) and set(spaces[0]).isdisjoint(spaces[1]):
        raise ModelError(
            f"the models are of different metamodels: {', '.join(spaces[0])}, and {', '.join(spaces[1])}",
            location=Location(str(after.path)) if after.path is not None else None,
            fix="compare two models of one metamodel; migrate the older one first if they are of two versions",
        )


def _longest_rise(places: Sequence[int]) -> set[int]:
    """The indices of a longest part of a sequence that rises."""
    ends: list[int] = []
    last: list[int] = []
    before: list[int] = []
    for index, place in enumerate(places):
        at = bisect_left(ends, place)
        before.append(last[at - 1] if at else -1)
        if at == len(ends):
            ends.append(place)
            last.append(index)
        else:
            ends[at], last[at] = place, index
    found: set[int] = set()
    index = last[-1] if last else -1
    while index >= 0:
        found.add(index)
        index = before[index]
    return found
