"""The paper's ranker: TF-IDF of the title over headers, a library by its best header, earlier choices on top.

It filters nothing, as the paper: every library that scores above 0 or was chosen before is listed, a library for other
processors with a reason that says so. It estimates no confidence (always 0) and abstains only when nothing scores. The
equation is in `tfidf`, the utility function in `ranking`, the file of libraries in `index`.
"""

from __future__ import annotations

import heapq

from robosmi.base.quantities import quantity
from robosmi.errors import UsageError
from robosmi.recommend.component import ComponentQuery
from robosmi.recommend.index import Library, LibraryIndex
from robosmi.recommend.ranking import Candidate, Choices, Recommendation, utility
from robosmi.recommend.tfidf import TermScore, explain, score_headers, words

_Order = tuple[float, int, int, int, int]


class TfidfRanker:
    """Implements `ranking.Ranker`.

    Args:
        index: the libraries of the target.
        architecture: the target's processor architecture, as libraries name it; None to say nothing about it.
    """

    def __init__(self, index: LibraryIndex, architecture: str | None = None) -> None:
        self.index = index
        self.architecture = architecture

    def rank(self, query: ComponentQuery, history: Choices | None = None, limit: int | None = None) -> Recommendation:
        """See `ranking.Ranker.rank`. Asked is with `query.title`, the part's title.

        Equal utility is ordered by: chosen more often, best header named like its library, more copies of the library
        seen (popularity), name.

        Raises:
            UsageError: a limit below 1.
        """
        if limit is not None and limit < 1:
            raise UsageError(f"a limit of {limit} candidates leaves none", fix="give 1 or more")
        terms = words(query.title)
        best = self._best_headers(score_headers(self.index, terms))
        top = max((score for score, _ in best.values()), default=0.0)
        chosen = history.choices(query.part_id, query.title) if history is not None else {}
        known, strangers = self._known(chosen)
        for number in known.keys() - best.keys():
            best[number] = (0.0, -1)
        if limit is not None and len(best) > limit:  # the utility grows with the score: most need no closer look
            least = heapq.nlargest(limit, (score for score, _ in best.values()))[-1]
            best = {number: found for number, found in best.items() if found[0] >= least or number in known}
        order = [self._order(number, score, header, top, known.get(number, 0)) for number, (score, header) in best.items()]
        first = sorted(order)[:limit]
        candidates = [self._candidate(key[-1], best[key[-1]], -key[0], known.get(key[-1], 0), top, terms) for key in first]
        if strangers:
            candidates += [_stranger(name, count) for name, count in sorted(strangers.items())]
            candidates.sort(key=lambda candidate: -candidate.score)  # stable: keeps the order made above
        found = tuple(candidates[:limit])
        return Recommendation(query.id, "library" if found else "none", 0.0, found)

    def _best_headers(self, scores: dict[int, float]) -> dict[int, tuple[float, int]]:
        """Score and number of the best header of each library that scores above 0."""
        library_of, named, main = self.index.library_of, self.index.named, self.index.is_main
        best: dict[int, tuple[float, int]] = {}
        for header, score in scores.items():
            if score <= 0:
                continue
            library = library_of[header]
            old = best.get(library)
            if old is not None and score <= old[0]:
                rank, old_rank = (named[header], main[header], -header), (named[old[1]], main[old[1]], -old[1])
                if score < old[0] or rank < old_rank:
                    continue
            best[library] = (score, header)
        return best

    def _known(self, chosen: dict[str, int]) -> tuple[dict[int, int], dict[str, int]]:
        """Counts by library number for what the index has, by name for what it has not."""
        known: dict[int, int] = {}
        strangers: dict[str, int] = {}
        for name, count in chosen.items():
            library = self.index.library_named(name)
            if library is None:
                strangers[name] = count
            else:
                known[library.id] = known.get(library.id, 0) + count
        return known, strangers

    def _order(self, number: int, score: float, header: int, top: float, chosen: int) -> _Order:
        named = self.index.named[header] if header >= 0 else 0
        return (-utility(score, top, chosen), -chosen, -named, -self.index.copies[number], number)

    def _candidate(
        self, number: int, best: tuple[float, int], value: float, chosen: int, top: float, terms: tuple[str, ...]
    ) -> Candidate:
        library = self.index.library(number)
        score, header = best
        include, reasons = library.header, []
        if chosen:
            reasons.append(_times(chosen))
        if header >= 0:
            file = self.index.header(header)
            include = file.file if file.main else include
            reasons += [_words(part, file.file) for part in explain(self.index, terms, header)]
            reasons.append(f"TF-IDF {score:.2f} in {file.file}, {score / top:.0%} of the best")
        else:
            reasons.append("no word of the title occurs in its headers")
        if self.architecture and not self._suits(library, self.architecture):
            reasons.append(f"does not list the architecture {self.architecture} (it lists {', '.join(library.architectures)})")
        return Candidate(library.name, include, library.version, value, tuple(reasons))

    @staticmethod
    def _suits(library: Library, architecture: str) -> bool:
        """Whether a library supports an architecture; one that names none has no metadata and counts as suitable."""
        return not library.architectures or "*" in library.architectures or architecture in library.architectures


def _times(count: int) -> str:
    return f"chosen {quantity(count, 'time')} before for this part"


def _stranger(name: str, count: int) -> Candidate:
    return Candidate(name, "", "", utility(0.0, 0.0, count), (_times(count), "it is not in the index of libraries"))


def _words(part: TermScore, file: str) -> str:
    return (
        f"'{part.term}' of the title occurs {quantity(part.tf, 'time')} in {file}, in {part.df} of "
        f"{part.documents} headers: (1 + ln {part.tf}) x ln({part.documents}/{part.df}) = {part.value:.2f}"
    )
