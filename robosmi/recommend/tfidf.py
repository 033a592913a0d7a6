"""The paper's equation: TF-IDF of a component's title over the headers of libraries (section 3.3, equation 1).

    score(d) = sum over t in T of (1 + ln tf(t,d)) * ln(N / df(t))

A document d is a header. T are the distinct words of the title ("a term corresponds to a part in the name of a
component": read as a word). What the paper leaves open is closed here: printed tf_{f,d} is read tf_{t,d}; at tf = 0,
where the equation is undefined, a word contributes 0; the base of the logarithm, which changes no order, is e. Words
are counted, not substrings. Libraries, history and the order of ties are in `ranking` and `tfidf_ranker`.
"""

from __future__ import annotations

import math
import re
from bisect import bisect_left
from collections.abc import Sequence
from typing import Protocol

from msgspec import Struct

_WORD = re.compile(r"[^\W_]+")

Postings = tuple[Sequence[int], Sequence[int]]
"""Where a word occurs: numbers of the headers, ascending, and beside each the count there (>= 1). Equal lengths."""


class Documents(Protocol):
    """A collection of headers as the equation sees it."""

    @property
    def documents(self) -> int:
        """N: how many headers there are."""

    def postings(self, term: str) -> Postings:
        """The headers in which the word occurs; two empty sequences if in none."""


class TermScore(Struct, frozen=True):
    """What one word of the title adds to the score of one header.

    Attributes:
        term: the word.
        tf: how often it occurs in the header (>= 1).
        df: in how many headers it occurs.
        documents: N.
    """

    term: str
    tf: int
    df: int
    documents: int

    @property
    def value(self) -> float:
        """The summand of the equation."""
        return tf_weight(self.tf) * idf(self.documents, self.df)


def words(title: str) -> tuple[str, ...]:
    """T: the distinct words of a title in their order; lower case, split at everything but letters and digits."""
    return tuple(dict.fromkeys(_WORD.findall(title.lower())))


def tf_weight(tf: int) -> float:
    """1 + ln tf, and 0 where the word does not occur (the equation says nothing about tf = 0)."""
    return 1.0 + math.log(tf) if tf > 0 else 0.0


def idf(documents: int, df: int) -> float:
    """ln(N / df): 0 for a word that is in every header, and for one that is in none (it can add nothing)."""
    return math.log(documents / df) if df > 0 else 0.0


def score_headers(collection: Documents, terms: Sequence[str]) -> dict[int, float]:
    """The score of every header in which a word occurs, by header number; all others score 0.

    Args:
        collection: the headers.
        terms: distinct words, see `words`.
    """
    scores: dict[int, float] = {}
    get = scores.get
    weights: dict[int, float] = {}
    for term in terms:
        headers, counts = collection.postings(term)
        rarity = idf(collection.documents, len(headers))
        for header, tf in zip(headers, counts, strict=True):
            weight = weights.get(tf)
            if weight is None:
                weight = weights[tf] = tf_weight(tf)
            scores[header] = get(header, 0.0) + weight * rarity
    return scores


def explain(collection: Documents, terms: Sequence[str], header: int) -> tuple[TermScore, ...]:
    """What each word adds to the score of one header, largest first; words that are not in it are left out."""
    found = []
    for term in terms:
        headers, counts = collection.postings(term)
        place = bisect_left(headers, header)
        if place < len(headers) and headers[place] == header:
            found.append(TermScore(term, counts[place], len(headers), collection.documents))
    return tuple(sorted(found, key=lambda part: -part.value))
