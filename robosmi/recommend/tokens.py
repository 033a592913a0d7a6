"""Splits the texts of parts and of libraries into comparable words: plain words, halves of compounds, and model numbers.

A name such as `MAX7219 LED-Matrix` or `QuadStepper` is split where letter case or punctuation changes. The pieces of a model
number ("HC-05", "DRV 8825", "24LC256") are also joined, since it is written both with and without a hyphen. Words without
significance (makers, "module") are data, `StopWords`. Nothing is scored here.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import lru_cache

from msgspec import Struct

_CHUNK = re.compile(r"[^\W_]+")
_CAMEL = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+|[^\W\d_A-Za-z]+")
_LETTER = re.compile(r"[a-z]")
_DIGIT = re.compile(r"\d")
_UNITS = (
    "v|a|mm|cm|m|hz|khz|mhz|ghz|k|mb|gb|kb|bit|pin|way|pos|dof|axis|ohm|w|g|kg|nm|s|ms|st|nd|rd|th|d|ch|wire|mil|pf|uf|nf|ma|in|"
    "p|c|f|led|digit|x"
)
_HOUSINGS = (
    r"(dil|dip|so|soic|sop|ssop|tssop|tsop|qfn|lga|lpcc|plcc|dfn|mlf|lcc|msop|sil|cerdip|smd|v|x)\d{1,2}|"
    r"(qfp|lqfp|tqfp|bga|sot|to|sc|sod|do|rev|ver)\d{1,3}"
)
_SIZE = re.compile(rf"\d+(x\d+)+|\d+({_UNITS})")
_HOUSING = re.compile(rf"({_HOUSINGS})[a-z]?")
_TERMS = frozenset(("i2c", "i2s", "mp3", "mp4", "rs232", "rs422", "rs485", "ps2", "1wire", "co2", "h2o", "x10", "t2c", "m2m"))
_LONGEST = 3  # chunks that one model number is put together of at most ("24 LC 256")


class StopWords(Struct, frozen=True):
    """Insignificant words, as stems in lower case: names of makers, and common words of the language."""

    makers: frozenset[str] = frozenset()
    common: frozenset[str] = frozenset()

    def __contains__(self, word: str) -> bool:
        """Whether a stem is insignificant; bare numbers and single letters always are."""
        return len(word) < 2 or word.isdigit() or word in self.makers or word in self.common


def chunks(text: str) -> list[str]:
    """The runs of letters and digits of a text, as written."""
    return _CHUNK.findall(text)


@lru_cache(maxsize=65536)
def stem(word: str) -> str:
    """A word without the plural's s ("sensors", "switches" stay comparable with "sensor", "switch"). Lower case in and out."""
    if len(word) <= 3 or word[-1] != "s" or word.endswith(("ss", "us", "is")) or _DIGIT.search(word):
        return word
    if word.endswith(("sses", "shes", "ches", "xes")):
        return word[:-2]
    return word[:-3] + "y" if word.endswith("ies") and len(word) > 4 else word[:-1]


@lru_cache(maxsize=65536)
def parts(chunk: str) -> tuple[str, ...]:
    """A chunk in lower case, and the words it is made of if these are several ("QuadStepper": quadstepper, quad, stepper).

    Of what may be a model number only longer words are taken: "mpu" says less than "mpu6050", and wrong things.
    """
    whole = stem(chunk.lower())
    shortest = 4 if is_model(whole) else 2
    inner = (stem(piece.lower()) for piece in _CAMEL.findall(chunk) if not piece.isdigit())
    return tuple(dict.fromkeys([whole, *(piece for piece in inner if len(piece) >= shortest)]))


def words(text: str) -> Iterator[str]:
    """All words of a text in their order, compounds also taken apart."""
    for chunk in chunks(text):
        yield from parts(chunk)


@lru_cache(maxsize=65536)
def is_model(word: str) -> bool:
    """Whether a word in lower case may be a model number: letters and digits, at least three, and no size, housing or term."""
    return (
        len(word) >= 3
        and _DIGIT.search(word) is not None
        and _LETTER.search(word) is not None
        and _SIZE.fullmatch(word) is None
        and _HOUSING.fullmatch(word) is None
        and word not in _TERMS
    )


def models(text: str) -> Iterator[str]:
    """The model numbers in a text, in lower case: chunks, and neighbours put together ("HC-05" as "hc05")."""
    found = chunks(text.lower())
    yield from (chunk for chunk in found if is_model(chunk))
    for start in range(len(found) - 1):
        for end in range(start + 2, min(start + _LONGEST, len(found)) + 1):
            run = found[start:end]
            if not _may_be_one(run):
                break
            joined = "".join(run)
            if is_model(joined):
                yield joined


def _may_be_one(run: Sequence[str]) -> bool:
    """Whether neighbouring pieces are short letters and digits that may be one model number written with punctuation."""
    short = all(len(piece) <= 4 or (piece.isdigit() and len(piece) == 5) for piece in run)
    return short and any(_DIGIT.search(piece) for piece in run) and not any(_SIZE.fullmatch(piece) for piece in run)


def runs(text: str, longest: int = 5) -> Iterator[tuple[int, int, str]]:
    """All runs of up to `longest` neighbouring chunks: first, end (exclusive), and the chunks' stems, joined."""
    found = [stem(chunk) for chunk in chunks(text.lower())]
    for start in range(len(found)):
        joined = ""
        for end in range(start, min(start + longest, len(found))):
            joined += found[end]
            yield start, end + 1, joined


def plain(name: str) -> str:
    """The normal form in which names are compared: lower-case stems of letters and digits, joined."""
    name = name.lower()
    if name.isalnum():  # most names of tables: no work
        return name if name[-1] != "s" else stem(name)
    found = chunks(name)
    for chunk in found:
        if chunk[-1] == "s":
            return "".join([stem(chunk) for chunk in found])
    return "".join(found)
