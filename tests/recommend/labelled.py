"""The labelled parts of tests/evaluation as queries, judged, and the rankers compared.

Shared by the evaluation command, the fitting of the decision model and the tests. Nothing here is known to the product.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from msgspec.structs import replace

from robosmi.recommend.component import ComponentQuery
from robosmi.recommend.decision import DecisionModel
from robosmi.recommend.device_ranker import DeviceRanker
from robosmi.recommend.ranking import Recommendation
from robosmi.transformations.knowledge.libraries.library_ranking import device_ranker
from tests.evaluation.scoring.queries import Grades, component, labelled_queries, score

VIEWS = ("as shipped", "model numbers and trade names left out of the lexicon", "no lexicon at all")
"""Views of a part that the ranker gets: everything; its kind only, as if no table named it; nothing but the index."""


@dataclass(frozen=True)
class Labelled:
    """The queries and what their labels stand for."""

    queries: list[dict[str, Any]]
    components: list[ComponentQuery]
    judge: Grades

    def grades(self, number: int) -> dict[str, int]:
        """Library -> grade of the query of that number."""
        query = self.queries[number]
        return self.judge.of(query) if query["class"] != "none" else {}

    def score(self, answers: Sequence[Recommendation], numbers: list[int] | None = None) -> dict[str, float]:
        """The figures for the answers to all queries, or to those of these numbers."""
        return score(answers, self.queries if numbers is None else [self.queries[n] for n in numbers], self.judge)


def labelled() -> Labelled:
    """Read the queries."""
    queries = labelled_queries()
    return Labelled(queries, [component(q) for q in queries], Grades())


def ranker(view: str = VIEWS[0], model: DecisionModel | None = None, architecture: str = "avr") -> DeviceRanker:
    """The default ranker in one of `VIEWS`, perhaps with another decision model."""
    made = device_ranker(architecture=architecture)
    knowledge = made.knowledge
    if view == VIEWS[1]:
        knowledge = replace(knowledge, exact=False)
    if view == VIEWS[2]:
        knowledge = replace(knowledge, lexicon=None, usual={})
    if model is not None:
        knowledge = replace(knowledge, model=model)
    return DeviceRanker(made.index, knowledge, architecture)
