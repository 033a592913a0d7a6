"""Decides whether a library is needed at all, and how sure that is: logistic models whose coefficients are data.

The model for the decision is multinomial (library, optional, none); a binary one estimates whether the first candidate is right
if a library is used. Both were fitted on labelled parts, with and without the lexicon's knowledge of them, so that the
confidence also holds for parts that are in no lexicon. Fitting is not done here.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from msgspec import Struct

from robosmi.errors import PlatformDataError
from robosmi.recommend.evidence import Evidence
from robosmi.recommend.lexicon import Lexicon
from robosmi.recommend.part_words import PartWords
from robosmi.recommend.ranking import Decision

DECISIONS: tuple[Decision, ...] = ("library", "optional", "none")

FEATURES = (
    "one", "kind_library", "kind_optional", "kind_none", "named_library", "named_optional", "named_none", "disputed", "model",
    "text", "name", "usual", "bus", "few_pins", "lead",
)  # fmt: skip
"""The features of the models, in order: a constant; for each need, how surely the lexicon states it, and whether by a model
number or trade name; how surely another recognised device contradicts it; the best candidate's evidence; whether a data bus is
known; at most three connectors; the best candidate's lead over the second.
"""


class DecisionModel(Struct, frozen=True):
    """Coefficients, in the order of `FEATURES`.

    Attributes:
        needs: a row for each of `DECISIONS`.
        first: those for the first candidate's being right.
    """

    needs: tuple[tuple[float, ...], ...]
    first: tuple[float, ...]

    @classmethod
    def from_data(cls, data: Mapping[str, object]) -> DecisionModel:
        """The model of a data file: tables `library`, `optional`, `none`, `first`, feature -> coefficient.

        Raises:
            PlatformDataError: a table or coefficient is missing.
        """
        return cls(tuple(_row(data, name) for name in DECISIONS), _row(data, "first"))

    def decide(self, features: Sequence[float]) -> tuple[Decision, float]:
        """The most likely decision, and the probability that it is right.

        For `none` it is the probability that no library is needed; for `optional`, that plain calls suffice or the first
        candidate is right; for `library`, that one is useful and the first candidate is right.
        """
        library, optional, none = softmax([_dot(row, features) for row in self.needs])
        right = 1 / (1 + math.exp(-_dot(self.first, features)))
        best = max(library, optional, none)
        if best == none:
            return "none", none + optional
        if best == optional:
            return "optional", optional + library * right
        return "library", (library + optional) * right


def features(part: PartWords, lexicon: Lexicon | None, ranked: Sequence[tuple[float, Evidence]], connectors: int) -> list[float]:
    """The feature values of one part, in the order of `FEATURES`.

    Args:
        part: what it asks for.
        lexicon: the devices that `part` names by number.
        ranked: scored evidence, best first; may be empty.
        connectors: how many connectors it has.
    """
    found = dict.fromkeys(FEATURES, 0.0)
    found["one"] = 1.0
    if lexicon is not None and part.devices:
        surest = part.devices[0]
        need = lexicon.devices[surest.device].need
        if need:
            found[f"kind_{need}"] = surest.strength
            found[f"named_{need}"] = float(surest.exact)
        others = (d.strength / surest.strength for d in part.devices[1:] if lexicon.devices[d.device].need not in ("", need))
        found["disputed"] = min(max(others, default=0.0), 1.0)
    if ranked:
        score, best = ranked[0]
        found |= {"model": best.model, "text": best.text, "name": best.name, "usual": best.usual}
        found["lead"] = min((score - ranked[1][0]) / score, 1.0) if len(ranked) > 1 and score > 0 else 1.0
    found["bus"] = float(bool(part.bus))
    found["few_pins"] = float(0 < connectors <= 3)
    return [found[name] for name in FEATURES]


def softmax(values: Sequence[float]) -> list[float]:
    """exp(v) / sum of exp, without overflow."""
    highest = max(values)
    powers = [math.exp(value - highest) for value in values]
    return [power / sum(powers) for power in powers]


def _dot(row: Sequence[float], features: Sequence[float]) -> float:
    return sum(a * b for a, b in zip(row, features, strict=True))


def _row(data: Mapping[str, object], name: str) -> tuple[float, ...]:
    table = data.get(name)
    if not isinstance(table, Mapping) or not all(isinstance(table.get(each), int | float) for each in FEATURES):
        raise PlatformDataError(
            f"the decision model lacks coefficients in [{name}]", fix="fit it again, or install robosmi again"
        )
    return tuple(float(table[each]) for each in FEATURES)
