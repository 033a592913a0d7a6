"""The answer to "which library?": candidates with scores and reasons, and the utility function that orders them.

The paper (section 3.3, second phase) wants "a utility function that combines the TDIDF scores and the information from
the historical configuration data" and gives none; ours is `utility`. Whoever implements `Ranker` is registered through
`robosmi.plugins` as kind "ranker". How relevance is measured is in `tfidf`, how choices are kept in `history`.
"""

from __future__ import annotations

from typing import Any, Literal, Protocol

from msgspec import Struct

from robosmi.recommend.component import ComponentQuery

Decision = Literal["library", "optional", "none"]
"""Take a library; a library would help, the core alone does as well; none is needed."""


class Candidate(Struct, frozen=True):
    """One library that may serve a component.

    Attributes:
        library: its name in the index.
        header: bare name of the header that a program includes; empty if the index does not know the library.
        version: the index's version, or empty.
        score: see `utility`; comparable within one recommendation only.
        reasons: why it stands where it stands, as sentences without full stop.
    """

    library: str
    header: str
    version: str
    score: float
    reasons: tuple[str, ...] = ()

    def to_json(self) -> dict[str, Any]:
        """The contract's form; the score is rounded to six digits."""
        return {
            "library": self.library,
            "header": self.header,
            "version": self.version,
            "score": round(self.score, 6),
            "reasons": list(self.reasons),
        }


class Recommendation(Struct, frozen=True):
    """The answer for one component.

    Attributes:
        id: the component's id.
        decision: whether a library is needed.
        confidence: probability that the answer serves, 0..1 (see `decision.DecisionModel.decide`); 0 where a ranker does not
            estimate it.
        candidates: best first.
        reasons: why this decision, as sentences without full stop.
    """

    id: str
    decision: Decision
    confidence: float
    candidates: tuple[Candidate, ...]
    reasons: tuple[str, ...] = ()

    def to_json(self) -> dict[str, Any]:
        """The contract's form (`recommendations[]`)."""
        return {
            "id": self.id,
            "decision": self.decision,
            "confidence": self.confidence,
            "reasons": list(self.reasons),
            "candidates": [candidate.to_json() for candidate in self.candidates],
        }


class Choices(Protocol):
    """Earlier choices, as a ranker sees them; `history.History` is one."""

    def choices(self, part_id: str, title: str) -> dict[str, int]:
        """How often each library was chosen for this very part."""

    def choices_for_model(self, model: str) -> dict[str, int]:
        """How often each library was chosen for parts whose title has this model number (lower case, letters and digits)."""


class Ranker(Protocol):
    """Ranks the libraries of a target for a component."""

    def rank(self, query: ComponentQuery, history: Choices | None = None, limit: int | None = None) -> Recommendation:
        """The candidates for a component, best first.

        Args:
            query: the component.
            history: earlier choices; None for none.
            limit: the most candidates wanted; None for all.
        """


def utility(relevance: float, best: float, chosen: int) -> float:
    """How much speaks for a library: its share of the best relevance (0..1) plus how often it was chosen before.

    The count is the whole part, the text only the fraction: a library that was once chosen for this very part goes
    before all that never were, one chosen more often before one chosen less ("the higher the number, the more
    likely"), and the text decides among equals. Without history the order is that of the relevance alone.

    Args:
        relevance: score of the library, >= 0.
        best: the best score of all libraries for this component, >= relevance.
        chosen: how often the library was chosen for this very part, >= 0.
    """
    return chosen + (relevance / best if best > 0 else 0.0)
