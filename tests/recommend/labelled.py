"""The labelled development queries that lie beside the checkout, the judge that goes with them, and the rankers compared.

Shared by the evaluation command, the fitting of the decision model and the tests. Nothing here is known to the product.
"""

from __future__ import annotations

import importlib.util
import json
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

from msgspec.structs import replace

from robosmi.recommend.component import ComponentQuery
from robosmi.recommend.decision import DecisionModel
from robosmi.recommend.device_ranker import DeviceRanker
from robosmi.recommend.ranking import Recommendation
from robosmi.transformations.knowledge.libraries.library_ranking import device_ranker

FOLDER = Path(__file__).resolve().parents[2].parent / "shared" / "arduino-libraries"

VIEWS = ("as shipped", "model numbers and trade names left out of the lexicon", "no lexicon at all")
"""Views of a part that the ranker gets: everything; its kind only, as if no table named it; nothing but the index."""


@dataclass(frozen=True)
class Labelled:
    """The queries and their judge."""

    queries: list[dict[str, Any]]
    components: list[ComponentQuery]
    judge: ModuleType
    index: Any

    def grades(self, number: int) -> dict[str, int]:
        """Library -> grade of the query of that number."""
        query = self.queries[number]
        return self.index.grades(query) if query["class"] != "none" else {}

    def score(self, answers: list[Recommendation], numbers: list[int] | None = None) -> dict[str, Any]:
        """The judge's figures for the answers to all queries, or to those of these numbers."""
        queries = self.queries if numbers is None else [self.queries[n] for n in numbers]
        document = {"result": {"recommendations": [answer.to_json() for answer in answers]}}
        figures: dict[str, Any] = self.judge.score(document, queries, self.index)
        return figures


def labelled(folder: Path = FOLDER) -> Labelled:
    """Read queries and judge."""
    spec = importlib.util.spec_from_file_location("shared_score", folder / "score.py")
    assert spec is not None
    assert spec.loader is not None
    judge = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(judge)
    queries = json.loads((folder / "queries-dev.json").read_text(encoding="utf-8"))
    return Labelled(queries, [ComponentQuery.from_json(q) for q in judge.components(queries)], judge, judge.Index())


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
