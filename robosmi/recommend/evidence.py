"""The evidence for a library: its words (BM25F over the fields of `index.FIELDS`), model numbers, its name, usual choices.

Each piece is measured separately, so that a ranking can give reasons. The text score is saturated, so that a long description
does not outweigh a model number; a model number counts by the field that contains it and by how few libraries do; name coverage
is how much of the library's name the part's words explain. `device_ranker` combines the pieces.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache
from typing import TypeAlias

from msgspec import Struct

from robosmi.recommend.index import FIELDS, Library, LibraryIndex
from robosmi.recommend.part_words import PartWords
from robosmi.recommend.tokens import StopWords, chunks, is_model, parts

FIELD_WEIGHTS = (3.0, 2.0, 1.0, 1.6, 0.35)
"""Weight of a word (BM25F) by the library's field that contains it: name, header, keyword, meta, ident."""

_LENGTH = (0.5, 0.5, 0.6, 0.6, 0.7)  # b of BM25F for each field: how much a long one counts less
_K1 = 1.5
_SATURATION = 10.0
_EVERYWHERE = 0.4  # a word that this share of the libraries has tells nothing
_MODEL_FIELDS = (1.0, 1.0, 0.75, 0.8, 0.4)
_SHORTER, _LONGER, _WILDCARD = 0.95, 0.9, 0.85  # SHT15C by SHT15, LIS331 by LIS331HH, SHT15 by SHT1x
_PER_LETTER = 0.93
_MOST_LETTERS = 4
_REMEMBERED = 4096  # libraries whose names are kept
_Name: TypeAlias = list[tuple[tuple[str, ...], float]]  # the significant words of a name, each with its pieces and its rarity


class Evidence(Struct):
    """The evidence for one library.

    Attributes:
        library: its index number.
        text: saturated BM25F score, 0..1.
        model: the best match of a model number, 0..1.
        model_reason: the part's model number, the library's word, and the field of this match.
        name: the share of its name that the part's words explain, 0..1.
        usual: how usual it is for such a device, 0..1.
    """

    library: int
    text: float = 0.0
    model: float = 0.0
    model_reason: tuple[str, str, str] = ("", "", "")
    name: float = 0.0
    usual: float = 0.0


class EvidenceFinder:
    """Measures how well the libraries of an index match the words of a part.

    Args:
        index: the libraries.
        stop: insignificant words.
    """

    def __init__(self, index: LibraryIndex, stop: StopWords) -> None:
        self.index, self.stop = index, stop
        filled = [sum(1 for length in lengths if length) for lengths in index.lengths]
        self._average = [sum(lengths) / max(count, 1) or 1.0 for lengths, count in zip(index.lengths, filled, strict=True)]
        self._hits = lru_cache(maxsize=1024)(self._model_hits)
        self._words_of: dict[int, list[_Name]] = {}
        self._scored = lru_cache(maxsize=512)(self._word_scores)

    def rarity(self, word: str) -> float:
        """The inverse document frequency of BM25, ln(1 + (N - df + 0.5) / (df + 0.5)); 0 for a word that no library has."""
        return self._rarity(len(self.index.facts(word)[0]))

    def _rarity(self, found: int) -> float:
        """The rarity of a word that so many libraries have."""
        return math.log(1 + (len(self.index) - found + 0.5) / (found + 0.5)) if found else 0.0

    def having(self, word: str) -> Sequence[int]:
        """The numbers of the libraries that have a word, ascending."""
        return self.index.facts(word)[0]

    def gather(self, part: PartWords, most: int) -> list[Evidence]:
        """The libraries with the most evidence by text, model numbers and usual choices; name coverage is added for these.

        Args:
            part: the words of the part.
            most: the most libraries wanted.
        """
        found: dict[int, Evidence] = {}
        for library, score in self._texts(part).items():
            found[library] = Evidence(library, text=score / (score + _SATURATION))
        for number, weight in part.models.items():
            for library, value, word, field in self._hits(number):
                entry = found.setdefault(library, Evidence(library))
                if weight * value > entry.model:
                    entry.model, entry.model_reason = weight * value, (number, word, field)
        for library, (value, _) in part.usual.items():
            found.setdefault(library, Evidence(library)).usual = value
        first = sorted(found.values(), key=lambda e: (-(e.text + 1.5 * e.model + 1.5 * e.usual), e.library))[:most]
        names = self._names([entry.library for entry in first])
        for entry in first:
            entry.name = self._coverage(names[entry.library], part)
        return first

    def _texts(self, part: PartWords) -> dict[int, float]:
        scores: dict[int, float] = {}
        get = scores.get
        for word, weight in part.words.items():
            for library, score in self._scored(word):
                scores[library] = get(library, 0.0) + weight * score
        return scores

    def _word_scores(self, word: str) -> list[tuple[int, float]]:
        """The BM25F score of one word for each library that has it."""
        libraries, columns = self.index.facts(word)
        if not libraries or len(libraries) > _EVERYWHERE * len(self.index) > 20:
            return []
        rarity = self.rarity(word)
        used = [
            (FIELD_WEIGHTS[n], _LENGTH[n], self._average[n], self.index.lengths[n], column)
            for n, column in enumerate(columns)
            if column
        ]
        found = []
        for place, library in enumerate(libraries):
            tf = 0.0
            for weight, b, average, lengths, column in used:
                if column[place]:
                    tf += weight * column[place] / (1 - b + b * lengths[library] / average)
            found.append((library, rarity * tf / (_K1 + tf)))
        return found

    def _model_hits(self, number: str) -> list[tuple[int, float, str, str]]:
        """Libraries with a model number or a similar one, as (library, value, the library's word, field)."""
        found: dict[int, tuple[float, str, str]] = {}
        for word, likeness in self._like(number):
            libraries, columns = self.index.facts(word)
            rare = min(1.0, self.rarity(word) / math.log(1 + len(self.index) / 3)) if libraries else 0.0
            for place, library in enumerate(libraries):
                field = max((n for n, c in enumerate(columns) if c and c[place]), key=lambda n: _MODEL_FIELDS[n])
                value = _MODEL_FIELDS[field] * likeness * rare
                if value > found.get(library, (0.0,))[0]:
                    found[library] = (value, word, FIELDS[field])
        return [(library, *value) for library, value in found.items()]

    def _like(self, number: str) -> Iterable[tuple[str, float]]:
        """A model number and its likely variants (shorter, longer, with x as wildcard), each with a similarity from 0 to 1."""
        yield number, 1.0
        if len(number) < 4:
            return
        for cut in range(1, _MOST_LETTERS):
            shorter = number[:-cut]
            if len(shorter) >= 4 and is_model(shorter):
                yield shorter, _SHORTER * _PER_LETTER ** (cut - 1)
        for cut in (1, 2):
            if number[-cut:].isdigit() and len(number) > cut + 2:
                yield number[:-cut] + "x" * cut, _WILDCARD
        stem = number.rstrip("x")
        for longer in self.index.terms_from(stem) if len(stem) >= 3 else ():
            if stem != number and len(longer) == len(number):
                yield longer, _WILDCARD
            elif stem == number and len(number) >= 5 and 0 < len(longer) - len(number) <= _MOST_LETTERS:
                yield longer, _LONGER * _PER_LETTER ** (len(longer) - len(number) - 1)

    def _coverage(self, names: list[_Name], part: PartWords) -> float:
        """The share of the library's name, or of a main header's, that the part's words explain; words are weighted by rarity."""
        best = 0.0
        for name in names:
            total = got = 0.0
            for pieces, rarity in name:
                total += rarity
                got += rarity * min(self._explained(pieces, part), 1.0)
            if total:
                best = max(best, got / total * got / (got + 2.0))  # a name of common words alone says little
        return best

    def _explained(self, pieces: tuple[str, ...], part: PartWords) -> float:
        def weight(word: str) -> float:
            return max(part.words.get(word, 0.0), part.models.get(word, 0.0))

        if value := weight(pieces[0]):
            return value
        if len(pieces) > 1:
            halves = [weight(piece) for piece in pieces[1:] if piece not in self.stop]
            return sum(halves) / len(halves) if halves else 0.0
        if is_model(pieces[0]):
            like = (w for n, w in part.models.items() if n.startswith(pieces[0]) or pieces[0].startswith(n))
            return 0.85 * max(like, default=0.0)
        return 0.0

    def _names(self, libraries: Sequence[int]) -> Mapping[int, list[_Name]]:
        """The names of libraries and of the first main headers of each, asked for at once."""
        known = self._words_of
        if len(known) > _REMEMBERED:
            known = self._words_of = {}
        if wanted := [number for number in libraries if number not in known]:
            telling = {library.id: self._telling(library) for library in self.index.libraries(wanted)}
            pieces = (piece for names in telling.values() for name in names for word in name for piece in word)
            spread = self.index.spread(list(dict.fromkeys(pieces)))
            rarity = {piece: self._rarity(found) for piece, found in spread.items()}
            for number, names in telling.items():
                known[number] = [[(word, max(rarity.get(piece, 0.0) for piece in word)) for word in name] for name in names]
        return known

    def _telling(self, library: Library) -> list[list[tuple[str, ...]]]:
        """The significant words, each with its pieces, of the library's name and of its first main headers."""
        names = [library.name, *(file.rsplit(".", 1)[0] for file in library.main[:3])]
        return [[pieces for chunk in chunks(name) if (pieces := parts(chunk))[0] not in self.stop] for name in names]
