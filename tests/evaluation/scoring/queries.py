"""Labelled parts against `robosmi recommend --json`: whether the right library is first, and whether one is recommended at all.

A part is of class `library` (`relevant` grades them, 2 canonical and 1 acceptable), `optional` (a helper library exists)
or `none`. A reference `X.h` stands for each library that has X.h as a main header (where none has, that offers it), and for the
library X that offers X.h or X.hpp; `lib:NAME` stands for that library and overrides a header's grade.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from robosmi.recommend.component import ComponentQuery
from robosmi.recommend.index import LibraryIndex
from robosmi.recommend.ranking import Recommendation
from robosmi.transformations.knowledge.libraries.library_ranking import library_index
from tests.evaluation.sources import LABELS, read_lines

BUNDLES = frozenset(("FloatyBall", "Robot_Control", "minimLibs"))
"""A game and kits with copies of other libraries' headers: a reference never means them."""
CONSIDERED = 5


def labelled_queries(path: Path = LABELS / "queries.jsonl") -> list[dict[str, Any]]:
    """The labels."""
    return read_lines(path)


def component(label: Mapping[str, Any]) -> ComponentQuery:
    """The query for a labelled part."""
    fields = ("id", "title", "label", "family", "tags", "properties", "connectors")
    return ComponentQuery.from_json({**{k: label[k] for k in fields if k in label}, "description": label.get("words", "")})


class Grades:
    """What the references of labels stand for in an index."""

    def __init__(self, index: LibraryIndex | None = None) -> None:
        found = index or library_index()
        names = found.names()
        self.main, self.offered = defaultdict[str, list[str]](list), defaultdict[str, list[str]](list)
        for number in range(found.documents):
            header = found.header(number)
            name = names[header.library]
            if name not in BUNDLES:
                self.offered[header.file].append(name)
                if header.main:
                    self.main[header.file].append(name)

    def of(self, label: Mapping[str, Any]) -> dict[str, int]:
        """Library -> grade for a labelled part."""
        grades: dict[str, int] = {}
        for reference, grade in label["relevant"].items():
            if not reference.startswith("lib:"):
                for name in self._libraries(reference):
                    grades[name] = max(grade, grades.get(name, 0))
        return grades | {name.removeprefix("lib:"): g for name, g in label["relevant"].items() if name.startswith("lib:")}

    def _libraries(self, header: str) -> list[str]:
        stem = header.rpartition(".")[0]
        named = [n for file in (f"{stem}.hpp", header) for n in self.offered.get(file, ()) if n == stem]
        return [*(self.main.get(header) or self.offered.get(header) or ()), *named]


def score(answers: Iterable[Recommendation], labels: Iterable[Mapping[str, Any]], grades: Grades) -> dict[str, float]:
    """The mean of each figure over the labels that it is about.

    Over class `library`: `top1`, `canonical`, `top5`, `mrr`, `ndcg5`, `library_answered`; over class `none`: `none_abstained`;
    `abstention` is the mean of the last two. `five_candidates` and `end_to_end` are over all; for the latter
    the decision is right, and the first candidate where it counts.
    """
    found = defaultdict[str, list[float]](list)
    for answer, label in zip(answers, labels, strict=True):
        for name, value in _figures(answer, label["class"], grades.of(label)).items():
            found[name].append(value)
    means = {name: sum(values) / len(values) for name, values in found.items()}
    means["abstention"] = (means.get("none_abstained", 1.0) + means.get("library_answered", 1.0)) / 2
    return means


def _figures(answer: Recommendation, kind: str, graded: Mapping[str, int]) -> dict[str, float]:
    got = [graded.get(name, 0) for name in dict.fromkeys(c.library for c in answer.candidates)]
    return {"five_candidates": float(len(got) >= CONSIDERED), **_of_class(answer, kind, graded, got)}


def _of_class(answer: Recommendation, kind: str, graded: Mapping[str, int], got: list[int]) -> dict[str, float]:
    first = next((place for place, grade in enumerate(got) if grade), None)
    if kind == "none":
        abstained = float(answer.decision == "none")
        return {"none_abstained": abstained, "end_to_end": abstained}
    if kind == "optional":
        return {"end_to_end": float(answer.decision != "library" or first == 0)}
    answered, ideal = answer.decision in ("library", "optional"), _gain(sorted(graded.values(), reverse=True))
    return {
        "top1": float(first == 0),
        "canonical": float(got[:1] == [2]),
        "top5": float(first is not None and first < CONSIDERED),
        "mrr": 1 / (first + 1) if first is not None else 0.0,
        "ndcg5": min(1.0, _gain(got) / ideal) if ideal else 0.0,
        "library_answered": float(answered),
        "end_to_end": float(answered and first == 0),
    }


def _gain(grades: list[int]) -> float:
    return math.fsum((2**grade - 1) / math.log2(place + 2) for place, grade in enumerate(grades[:CONSIDERED]))
