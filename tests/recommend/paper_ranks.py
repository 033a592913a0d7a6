"""The paper's setting, N = 247: `python -m tests.recommend.paper_ranks [DRAWS]` prints ranks of Servo.h and DHT.h.

The paper found Servo.h 2nd and DHT.h 4th among 247 headers, which are not published; so a range is reproduced, not the
ranks. Draw rule: fixed are all headers of the libraries that the IDE bundled and of the DHT library (85); the others are drawn
from the main headers of all other libraries whose file name is not among the fixed ones. Three ways of splitting words.
"""

from __future__ import annotations

import random
import statistics
import sys
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from robosmi.recommend.index import LibraryIndex
from robosmi.recommend.tfidf import Postings, score_headers, words
from robosmi.transformations.knowledge.libraries.library_ranking import library_index

SERVO, DHT = "Basic Servo", "DHT22 Temperature and Humidity Sensor"
"""Titles as the paper's prose has them; the servo's is also that of its part in Fritzing."""
DRAWN_DHT = "Humidity and Temperature Sensor RHT03"
"""The title of the part that the drawing has for the DHT22."""
OWN = {SERVO: ("Servo", "Servo.h"), DHT: ("DHT sensor library", "DHT.h"), DRAWN_DHT: ("DHT sensor library", "DHT.h")}
PAPER_RANKS = {SERVO: 2, DHT: 4, DRAWN_DHT: 4}
TOP = 5
HEADERS = 247
FIXED_LIBRARIES = frozenset(
    (
        "EEPROM", "Esplora", "Ethernet", "Firmata", "GSM", "LiquidCrystal", "Robot_Control", "Robot_Motor", "SD", "SPI", "Servo",
        "SoftwareSerial", "Stepper", "TFT", "WiFi", "Wire", "DHT sensor library",
    )
)  # fmt: skip


@dataclass(frozen=True)
class Collection:
    """The headers of a draw, as the equation sees them, with the words split in one way."""

    documents: int
    found: dict[str, Postings]

    def postings(self, term: str) -> Postings:
        """See `tfidf.Documents`."""
        return self.found.get(term, ((), ()))


def by_words(index: LibraryIndex, term: str) -> dict[int, int]:
    """Counts of a word of the whole text, comments and all, split at everything but letters and digits."""
    return dict(zip(*index.postings(term), strict=True))


def by_substrings(index: LibraryIndex, term: str) -> dict[int, int]:
    """Sum of the counts of all words that contain the term."""
    counts: dict[int, int] = {}
    for word in index.terms_containing(term):
        for header, count in by_words(index, word).items():
            counts[header] = counts.get(header, 0) + count
    return counts


def by_identifiers(index: LibraryIndex, term: str) -> dict[int, int]:
    """Counts of a word of the identifiers, split at changes of case and underscores; comments and strings left out."""
    return dict(zip(*index.identifiers(term), strict=True))


WAYS: dict[str, Callable[[LibraryIndex, str], dict[int, int]]] = {
    "words": by_words, "substrings": by_substrings, "identifier words": by_identifiers,
}  # fmt: skip


class Experiment:
    """The index with the two groups of headers that the draw rule names."""

    def __init__(self, titles: Iterable[str] = tuple(OWN)) -> None:
        self.titles = tuple(titles)
        self.index = library_index()
        headers = [self.index.header(number) for number in range(self.index.documents)]
        names = self.index.names()
        self.fixed = [header.id for header in headers if names[header.library] in FIXED_LIBRARIES]
        files = {headers[number].file.lower() for number in self.fixed}
        rest = (h for h in headers if h.main and names[h.library] not in FIXED_LIBRARIES and h.file.lower() not in files)
        self.rest = [header.id for header in rest]
        self._counts = {
            (way, term): count(self.index, term) for way, count in WAYS.items() for t in self.titles for term in words(t)
        }
        self._own = {
            title: next(h.id for h in headers if h.file == file and names[h.library] == library)
            for title, (library, file) in ((title, OWN[title]) for title in self.titles)
        }

    def draw(self, seed: int) -> list[int]:
        """The headers of one draw."""
        return [*self.fixed, *random.Random(seed).sample(self.rest, HEADERS - len(self.fixed))]

    def rank(self, title: str, way: str, headers: Iterable[int]) -> int:
        """1 + number of headers that score higher than the title's own."""
        scores = self.scores(title, way, headers)
        own = scores.get(self._own[title], 0.0)
        return 1 + sum(score > own for score in scores.values())

    def first(self, title: str, way: str, headers: Iterable[int]) -> str:
        """The file name of the header with the highest score."""
        scores = self.scores(title, way, headers)
        return self.index.header(max(scores, key=lambda header: scores[header])).file

    def scores(self, title: str, way: str, headers: Iterable[int]) -> dict[int, float]:
        """The score of each header that has one of the title's words."""
        drawn = set(headers)
        found: dict[str, Postings] = {}
        for term in words(title):
            pairs = sorted((header, count) for header, count in self._counts[way, term].items() if header in drawn)
            found[term] = [header for header, _ in pairs], [count for _, count in pairs]
        return score_headers(Collection(len(drawn), found), words(title))


def main(arguments: list[str]) -> int:
    """Print the table."""
    draws = int(arguments[0]) if arguments else 60
    experiment = Experiment()
    print(
        f"{draws} draws of {HEADERS} headers: {len(experiment.fixed)} fixed, the others of {len(experiment.rest)}; median (range)"
    )
    print(f"{'':42}" + "".join(f"{way:>20}" for way in WAYS) + f"{'paper':>8}")
    collections = [experiment.draw(seed) for seed in range(draws)]
    found: dict[tuple[str, str], list[int]] = {}
    for title, (_, file) in OWN.items():
        cells = []
        for way in WAYS:
            ranks = found[title, way] = [experiment.rank(title, way, headers) for headers in collections]
            cells.append(f"{statistics.median(ranks):g} ({min(ranks)}-{max(ranks)})")
        print(f"{file + ' for ' + repr(title):42.42}" + "".join(f"{cell:>20}" for cell in cells) + f"{PAPER_RANKS[title]:>8}")
    for title in (DHT, DRAWN_DHT):
        pairs = {way: list(zip(found[SERVO, way], found[title, way], strict=True)) for way in WAYS}
        ranked = (f"{sum(pair == (2, 4) for pair in p) / draws:.1%}" for p in pairs.values())
        top = (f"{sum(max(pair) <= TOP for pair in p) / draws:.0%}" for p in pairs.values())
        print(f"{'2 and 4 at once, ' + repr(title):42.42}" + "".join(f"{cell:>20}" for cell in ranked))
        print(f"{'both in the top five':42}" + "".join(f"{cell:>20}" for cell in top))
    boards = sum(experiment.first(SERVO, "words", headers) == "Boards.h" for headers in collections)
    print(f"Boards.h, full of MAX_SERVOS, is first for {SERVO!r} by words in {boards} of {draws} draws, as in the paper")
    print("the paper's collection is not published: a range is reproduced, not its two ranks")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
