"""Wildcards in names: without regular expressions for most, but always with fnmatch's meaning."""

from __future__ import annotations

from fnmatch import fnmatchcase

from hypothesis import example, given, strategies as st

from robosmi.transformations.knowledge.wildcards import Wildcards, fits

PATTERN = st.text(alphabet="ab/*?[]!-.\n(|", max_size=6)
WORD = st.text(alphabet="ab/*.]\n(|", max_size=6)


@given(PATTERN, WORD)
@example("*", "")
@example("**", "a")
@example("a*", "a\n")
@example("[a]*", "[a]b")
@example("a.*", "ab")
def test_one_pattern_stands_for_the_words_that_fnmatch_finds(pattern: str, word: str) -> None:
    assert fits(word, pattern) == fnmatchcase(word, pattern)


@given(st.lists(PATTERN, max_size=4), WORD)
@example([], "")
@example(["[", "*]"], "a]")
def test_a_set_has_the_words_of_all_its_patterns(patterns: list[str], word: str) -> None:
    assert (word in Wildcards.of(patterns)) == any(fnmatchcase(word, pattern) for pattern in patterns)
