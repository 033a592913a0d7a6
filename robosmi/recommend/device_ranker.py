"""The default ranker: matches what a part is and says against what libraries are and contain, with reasons and a confidence.

The evidence of `evidence` is summed with fixed weights; popularity, the target's architecture and the interface are factors.
Earlier choices decide only among candidates that are nearly as good. `decision` says whether a library is needed. The paper's
ranker is `tfidf_ranker`; all data are passed in.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from msgspec import Struct

from robosmi.base.quantities import quantity
from robosmi.errors import UsageError
from robosmi.recommend.architectures import ArchitectureFacts, Support
from robosmi.recommend.component import ComponentQuery
from robosmi.recommend.decision import DecisionModel, features
from robosmi.recommend.evidence import Evidence, EvidenceFinder
from robosmi.recommend.index import INTERFACES, Library, LibraryIndex
from robosmi.recommend.lexicon import Lexicon
from robosmi.recommend.part_words import PartWords, part_words
from robosmi.recommend.ranking import Candidate, Choices, Recommendation
from robosmi.recommend.tokens import StopWords

LOOKED_AT = 40
"""Number of libraries that are examined closely."""

NEARLY = 0.5
"""Fraction of the best score that a library needs so that an earlier choice may put it first."""

UNKNOWN = 0.5
"""Upper limit of the confidence for a part that no table recognises, since all labelled parts were of known kinds."""

_TEXT, _MODEL, _NAME, _USUAL = 1.2, 1.5, 0.7, 1.5
_POPULARITY = 0.1
_OTHER_ARCHITECTURE = 0.25
_SAME_BUS, _OTHER_BUS = 1.06, 0.88
_INSTALLED = 1.03
_BUSES = frozenset({"i2c", "spi", "onewire"})
_REMEMBERED = 256  # parts; drawings have the same few again and again
_AT_LEAST = 5  # candidates are listed whatever the decision (contract)
_WHERE = {
    "name": "its name",
    "header": "its header's name",
    "keyword": "its keywords",
    "meta": "its description",
    "ident": "its identifiers",
}


class Knowledge(Struct, frozen=True, eq=False):
    """What the ranker knows besides the index.

    Attributes:
        stop: words that say nothing.
        lexicon: what devices there are; None for none.
        usual: name of a device (as `words.plain` writes it) -> names of the libraries that are usual for it.
        model: coefficients of the decision.
        exact: whether model numbers and trade names of the lexicon count (False only to measure what they add).
        architectures: on which architectures libraries work, beyond what they declare.
    """

    stop: StopWords
    lexicon: Lexicon | None
    usual: Mapping[str, Sequence[str]]
    model: DecisionModel
    exact: bool = True
    architectures: ArchitectureFacts = ArchitectureFacts()


class DeviceRanker:
    """Implements `ranking.Ranker`.

    Args:
        index: the libraries of the target.
        knowledge: what else is known.
        architecture: the target's processor architecture, as libraries name it; None if it does not matter.

    Attributes:
        libraries: name of each library -> its number in the index.
    """

    def __init__(self, index: LibraryIndex, knowledge: Knowledge, architecture: str | None = None) -> None:
        self.index, self.knowledge, self.architecture = index, knowledge, architecture
        self._finder = EvidenceFinder(index, knowledge.stop)
        self._weighed: dict[tuple[object, ...], tuple[PartWords, list[tuple[float, Evidence]]]] = {}
        self.libraries = numbers = {name: number for number, name in enumerate(index.names())}
        self._usual = {
            device: list(dict.fromkeys(numbers[name] for name in map(self._replaced, libraries) if name in numbers))
            for device, libraries in knowledge.usual.items()
        }

    def _replaced(self, library: str) -> str:
        """The library that takes the place of another one on the target's architecture; the other one itself if none does."""
        found = self.knowledge.architectures.replacement(library, self.architecture)
        return found.library if found is not None else library

    def rank(self, query: ComponentQuery, history: Choices | None = None, limit: int | None = None) -> Recommendation:
        """See `ranking.Ranker.rank`. Candidates are listed whatever the decision.

        Raises:
            UsageError: a limit below 1.
        """
        if limit is not None and limit < 1:
            raise UsageError(f"a limit of {limit} candidates leaves none", fix="give 1 or more")
        part, ranked = self.weigh(query)
        decision, confidence = self.knowledge.model.decide(self.features(query, part, ranked))
        if self.knowledge.lexicon is not None and not part.devices:
            confidence = min(confidence, UNKNOWN)
        if decision == "library" and ranked and not self._suits(self.index.library(ranked[0][1].library)):
            confidence = min(confidence, UNKNOWN)  # no rule chooses what cannot work
        first = self._why(part, decision)
        candidates = [self._candidate(part, score, entry, first) for score, entry in ranked[:limit]]
        if history is not None:
            candidates = self._with_history(query, part, candidates, history, [score for score, _ in ranked])
        return Recommendation(query.id, decision, round(confidence, 4), tuple(candidates[:limit]), (first,) if first else ())

    def features(self, query: ComponentQuery, part: PartWords, ranked: list[tuple[float, Evidence]]) -> list[float]:
        """The features of the decision for a part, see `decision.FEATURES`."""
        return features(part, self.knowledge.lexicon, ranked, len(query.connectors))

    def weigh(self, query: ComponentQuery) -> tuple[PartWords, list[tuple[float, Evidence]]]:
        """The words of a part, and the libraries with the most evidence and their scores, best first."""
        key = (
            query.title, query.family, query.tags, tuple(query.properties.items()), query.description, query.connectors,
        )  # fmt: skip
        if key not in self._weighed:
            if len(self._weighed) >= _REMEMBERED:
                self._weighed.clear()
            self._weighed[key] = self._weigh(query)
        return self._weighed[key]

    def _weigh(self, query: ComponentQuery) -> tuple[PartWords, list[tuple[float, Evidence]]]:
        known = self.knowledge
        part = part_words(query, known.stop, known.lexicon, self._usual, exact=known.exact)
        found = [(self._score(entry, part), entry) for entry in self._finder.gather(part, LOOKED_AT)]
        seen = {entry.library for _, entry in found}
        for library in range(len(self.index)):  # a part that says nothing still gets a list
            if len(found) >= _AT_LEAST:
                break
            if library not in seen:
                found.append((0.0, Evidence(library)))
        found.sort(key=lambda pair: (-pair[0], -self.index.copies[pair[1].library], pair[1].library))
        return part, found

    def _score(self, entry: Evidence, part: PartWords) -> float:
        score = _TEXT * entry.text + _MODEL * entry.model + _NAME * entry.name + _USUAL * entry.usual
        score *= 1 + _POPULARITY * math.log1p(self.index.copies[entry.library] - 1 + 2 * self.index.used_by[entry.library])
        library = self.index.library(entry.library)
        if not self._suits(library):
            score *= _OTHER_ARCHITECTURE
        if library.installed:
            score *= _INSTALLED
        return score * self._agreement(entry.library, part)

    def _agreement(self, library: int, part: PartWords) -> float:
        """A factor for whether a library uses the part's interface; a library that names no bus is neutral."""
        wanted = part.bus or part.interface
        speaks = self._speaks(library) & _BUSES
        if not speaks or not wanted or wanted == "serial":
            return 1.0
        return _SAME_BUS if wanted in speaks else _OTHER_BUS

    def _speaks(self, library: int) -> frozenset[str]:
        bits = self.index.interfaces[library]
        return frozenset(name for number, name in enumerate(INTERFACES) if bits >> number & 1)

    def _suits(self, library: Library) -> bool:
        """Whether a library works on the target's architecture, or probably does."""
        return self.knowledge.architectures.support(library, self.architecture) is not Support.absent

    def _why(self, part: PartWords, decision: str) -> str:
        """The reasons why a library is needed or not, from the device that the part is recognised as."""
        lexicon = self.knowledge.lexicon
        if lexicon is None or not part.devices:
            return (
                "probably no library needed: no table lists the part, and few of its words suggest one"
                if decision == "none"
                else ""
            )
        found = part.devices[0]
        device = lexicon.devices[found.device]
        named = f"{device.name}, by '{found.said}' in the {found.where}"
        how = part.bus or device.interface
        if decision == "none":
            return f"no library needed: {_HOW.get(how, 'plain calls are enough')} ({named})"
        spoken = f", used over {_SPOKEN.get(how, how)}" if how else ""
        helps = "a library helps, but plain calls are enough: " if decision == "optional" else ""
        return f"{helps}{named}{spoken}"

    def _candidate(self, part: PartWords, score: float, entry: Evidence, first: str) -> Candidate:
        library = self.index.library(entry.library)
        reasons = []
        if entry.model:
            number, word, field = entry.model_reason
            alike = f" (as {word})" if word != number else ""
            reasons.append(f"model number {number.upper()}{alike} in {_WHERE[field]}")
        if entry.usual:
            reasons.append(f"usual library for {part.usual[entry.library][1]}")
        if entry.name >= 0.2:
            reasons.append(f"name match {entry.name:.0%}")
        if entry.text >= 0.05:
            reasons.append(f"common words: {', '.join(self._common(entry.library, part)) or 'few'}")
        wanted = part.bus or part.interface
        agreement = self._agreement(entry.library, part)
        if agreement != 1.0:
            reasons.append(f"it uses {'/'.join(sorted(self._speaks(entry.library) & _BUSES))}, but the part uses {wanted}")
        if remark := self.knowledge.architectures.remark(library, self.architecture):
            reasons.append(remark)
        if library.installed:
            reasons.append("installed here")
        if first:
            reasons.append(first)
        return Candidate(library.name, library.header, library.version, score, tuple(reasons))

    def _common(self, library: int, part: PartWords) -> list[str]:
        shared = [word for word in part.words if library in self._finder.having(word)]
        return sorted(shared, key=lambda word: (-part.words[word] * self._finder.rarity(word), word))[:4]

    def _with_history(
        self, query: ComponentQuery, part: PartWords, candidates: list[Candidate], history: Choices, scores: list[float]
    ) -> list[Candidate]:
        """The candidates with those chosen earlier for this part (else for its model number) first, if they are nearly as good.

        Libraries that were chosen earlier and that the index does not have are appended.
        """
        chosen = history.choices(query.part_id, query.title)
        how = "this part"
        if not chosen and part.models:
            number = max(part.models, key=lambda n: (part.models[n], n))
            chosen, how = history.choices_for_model(number), f"parts with the model number {number.upper()}"
        if not chosen:
            return candidates
        best = max(scores, default=0.0)
        listed = []
        for candidate in candidates:
            count = chosen.get(candidate.library, 0)
            near = count > 0 and candidate.score >= NEARLY * best
            reason = f"chosen {quantity(count, 'time')} before for {how}"
            reasons = (reason, *candidate.reasons) if count else candidate.reasons
            listed.append(
                (
                    -count if near else 0,
                    Candidate(candidate.library, candidate.header, candidate.version, candidate.score, reasons),
                )
            )
        listed.sort(key=lambda pair: pair[0])  # stable: among equals the score decides
        known = {candidate.library for candidate in candidates}
        strangers = [
            Candidate(name, "", "", 0.0, (f"chosen before for {how}", "it is not in the index of libraries"))
            for name in sorted(chosen)
            if name not in known and self.index.library_named(name) is None
        ]
        return [candidate for _, candidate in listed] + strangers


_HOW = {
    "digital": "a digital pin is enough",
    "analog": "an analogue input is enough",
    "pwm": "a PWM output is enough",
    "pulse": "pulses are enough",
    "serial": "the serial port is enough",
}
_SPOKEN = {"i2c": "I2C", "spi": "SPI", "onewire": "one wire", "pwm": "PWM"}
