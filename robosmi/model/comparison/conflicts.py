"""What a three-way merge reports: the conflicts, as records, lines of text and findings."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Literal, TypeAlias
from xml.parsers import expat

from msgspec import Struct

from robosmi import inputs
from robosmi.base.data_text import Json, json_written
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.model.comparison.facts import plain
from robosmi.model.comparison.versions import BASE, A, B, ThreeModels, Versions
from robosmi.model.elements.driver import label
from robosmi.model.elements.ecore import EObject
from robosmi.model.elements.pyecore_internals import key_of
from robosmi.model.elements.structure import place_in
from robosmi.model.xmi.xmi_layout import DETAILS, LINKS, Column

CONFLICT = "RS660"
Side: TypeAlias = Literal["a", "b"]
_FIX = "make one of the models agree with the other there, or let one win all conflicts: --take a or --take b"


class Conflict(Struct, frozen=True):
    """Something that both models changed, in different ways.

    Attributes:
        kind: `changed` (a value, a reference, or the order of a list), `moved`, or `removed` (by one, and changed by the other).
        element: the id or fragment of the element, in the base if that has it.
        type: the name of its class.
        feature: the feature; None for an element that was removed or moved.
        base: the value, or the element's place, in the base; None if there is none.
        a: the same in the first model.
        b: the same in the second.
        name: what the element is called.
    """

    kind: str
    element: str
    type: str
    feature: str | None
    base: Json
    a: Json
    b: Json
    name: str

    def to_json(self) -> dict[str, Json]:
        """The record as JSON."""
        return {
            "kind": self.kind, "element": self.element, "type": self.type, "feature": self.feature, "base": self.base,
            "a": self.a, "b": self.b, "name": self.name,
        }  # fmt: skip

    def line(self) -> str:
        """The record as a line of text."""
        known = (self.base, self.a, self.b)
        what = f" {self.feature}" if self.feature is not None else ""
        texts = [value if isinstance(value, str) and self.feature is None else _text(value) for value in known]
        if self.kind == "removed":
            texts[1:] = [
                "removed" if value is None else "changed" if value == self.base else f"moved to {text}"
                for value, text in zip(known[1:], texts[1:], strict=True)
            ]
        return f"conflict {self.name} {self.element}:{what} {texts[0]} -> A: {texts[1]}, B: {texts[2]}"

    def finding(self, place: Location | None, take: Side | None) -> Finding:
        """The record as a finding.

        Args:
            place: the file of the first model, and the element's line in it if it is known.
            take: the side that won; None for an error.
        """
        evidence = {"kind": self.kind, "feature": self.feature, "base": self.base, "a": self.a, "b": self.b}
        if take is None:
            return Finding(CONFLICT, Severity.error, self.line(), place, self.element, _FIX, evidence)
        message = f"{self.line()}; taken from {take.upper()}"
        return Finding(CONFLICT, Severity.info, message, place, self.element, None, evidence)


class ConflictList:
    """The conflicts of one merge, each once.

    Args:
        three: the models.
    """

    def __init__(self, three: ThreeModels) -> None:
        self.all: list[Conflict] = []
        self.in_a: list[EObject | None] = []
        """The element of each conflict as the first model has it; None if it was removed there."""
        self._three = three

    def differ(self, versions: Versions, column: Column) -> None:
        """Both models changed a feature."""
        shown: list[Json] = []
        for side in (BASE, A, B):
            facts, element = self._three.facts[side], versions.elements[side]
            values = list(self._three.values(side, versions, column).values())
            texts = [facts.target(each) if column.kind == LINKS else plain(column, each) for each in values]
            many = column.many or column.kind == DETAILS
            shown.append(None if element is None else texts if many else texts[0] if texts else None)
        self._add("changed", versions, column.name, shown)

    def contain(self, container: Versions, name: str | None, contents: Sequence[Sequence[Versions]]) -> None:
        """Both models changed what an element contains, or in which order."""
        shown: list[Json] = [
            [place for each in known if (place := self._place(side, each)) is not None] for side, known in enumerate(contents)
        ]
        self._add("changed", container, name, shown)

    def claim(self, end: Versions, name: str, claimants: Sequence[Versions | None]) -> None:
        """Both models set the one reference that leads back from an element."""
        self._add(
            "changed", end, name, [None if each is None else self._place(side, each) for side, each in enumerate(claimants)]
        )

    def place(self, kind: str, versions: Versions) -> None:
        """Both models moved an element, or one removed it."""
        elements = enumerate(versions.elements)
        shown: list[Json] = [None if each is None else self._three.facts[side].position(each) for side, each in elements]
        self._add(kind, versions, None, shown)

    def _place(self, side: int, versions: Versions) -> Json:
        element = versions.elements[side]
        return None if element is None else self._three.facts[side].place_of(element)

    def _add(self, kind: str, versions: Versions, feature: str | None, shown: Sequence[Json]) -> None:
        side, element = next((side, each) for side, each in enumerate(versions.elements) if each is not None)
        place, name = self._three.facts[side].place_of(element), str(element.eClass.name)
        base, a, b = shown
        found = Conflict(kind, place, name, feature, base, a, b, label(element))
        if found not in self.all:
            self.all.append(found)
            self.in_a.append(versions.elements[A])


def lines_of(elements: Sequence[EObject | None], path: Path) -> list[int | None]:
    """The line of each element in the XMI file with one root that its model was just read from; None where it is not found."""
    ways = [None if each is None else _way(each) for each in elements]
    wanted, found = set(ways), dict[tuple[str, ...], int]()
    parser = expat.ParserCreate()
    way: list[str] = []
    counts: list[Counter[str]] = []

    def start(tag: str, _attributes: dict[str, str]) -> None:
        if counts:
            way.append(f"{tag}.{counts[-1][tag]}")
            counts[-1][tag] += 1
        counts.append(Counter())
        if (place := tuple(way)) in wanted and not (tag.endswith(":XMI") and not way):  # XMI is around several roots
            found[place] = parser.CurrentLineNumber

    def end(_tag: str) -> None:
        counts.pop()
        if counts:
            way.pop()

    parser.StartElementHandler, parser.EndElementHandler = start, end
    with suppress(expat.ExpatError, LookupError, ValueError):
        parser.Parse(inputs.read_bytes(path, inputs.MODEL), True)
    return [None if way is None else found.get(way) for way in ways]


def _way(element: EObject) -> tuple[str, ...]:
    """The features from the root to an element with the places in them, as the tags of a file follow each other."""
    steps: list[str] = []
    while (container := element.eContainer()) is not None and (feature := element.eContainmentFeature()) is not None:
        place = place_in(getattr(container, key_of(feature)), element) if feature.many else 0
        steps.append(f"{feature.name}.{place}")
        element = container
    return tuple(reversed(steps))


def _text(value: Json) -> str:
    return json_written(value, ensure_ascii=False)
