"""What a three-way merge reports: the conflicts, as records, lines of text and findings."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, TypeAlias

from msgspec import Struct

from robosmi.base.data_text import Json, json_written
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.model.comparison.facts import plain
from robosmi.model.comparison.versions import BASE, A, B, ThreeModels, Versions
from robosmi.model.elements.driver import label
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
            place: the file of the first model.
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


def _text(value: Json) -> str:
    return json_written(value, ensure_ascii=False)
