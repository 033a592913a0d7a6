"""Names with wildcards, as the files of knowledge have them: `*` for any text, `?` for any character, `[ab]` for one of several.

They mean what they mean to `fnmatch`. It makes a regular expression of each pattern, which takes longer than all comparisons of
a run; most patterns only begin or end with a `*`, and need none.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from fnmatch import translate
from functools import lru_cache

from msgspec import Struct

_SPECIAL = frozenset("*?[")


def fits(word: str, pattern: str) -> bool:
    """Whether a word is one that a pattern stands for; upper and lower case differ.

    >>> fits("sda_1", "sda*"), fits("my_sda", "*sda"), fits("sda", "sda*_h"), fits("q3", "q[0-7]")
    (True, True, False, True)
    """
    return word == pattern if _SPECIAL.isdisjoint(pattern) else word in _of_one(pattern)


class Wildcards(Struct, frozen=True):
    """A set of words that is given by patterns.

    >>> names = Wildcards.of(["mosi", "mosi/*", "q[0-7]"])
    >>> [word for word in ("mosi", "mosi/d1", "mosi2", "q3", "q8") if word in names]
    ['mosi', 'mosi/d1', 'q3']
    """

    plain: frozenset[str]
    beginnings: tuple[str, ...]
    ends: tuple[str, ...]
    others: re.Pattern[str] | None

    @classmethod
    def of(cls, patterns: Iterable[str]) -> Wildcards:
        """The set of all words that one of the patterns stands for."""
        plain: list[str] = []
        beginnings: list[str] = []
        ends: list[str] = []
        others: list[str] = []
        for pattern in patterns:
            if _SPECIAL.isdisjoint(pattern):
                plain.append(pattern)
            elif pattern[-1] == "*" and _SPECIAL.isdisjoint(pattern[:-1]):
                beginnings.append(pattern[:-1])
            elif pattern[0] == "*" and _SPECIAL.isdisjoint(pattern[1:]):
                ends.append(pattern[1:])
            else:
                others.append(translate(pattern))
        compiled = re.compile("|".join(others)) if others else None
        return cls(frozenset(plain), tuple(beginnings), tuple(ends), compiled)

    def __contains__(self, word: str) -> bool:
        if word in self.plain or word.startswith(self.beginnings) or word.endswith(self.ends):
            return True
        return self.others is not None and self.others.match(word) is not None


@lru_cache(maxsize=1000)
def _of_one(pattern: str) -> Wildcards:
    return Wildcards.of([pattern])
