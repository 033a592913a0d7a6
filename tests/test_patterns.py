"""No regular expression of the product takes more than linear time for a text that it matches in many ways.

That is judged by `overlapping_repetitions`, not by time; the texts of strangers reach most of the patterns.
"""

from __future__ import annotations

import re

import pytest

from tests.overlapping_repetitions import overlaps
from tests.own_patterns import own_patterns, unreadable_patterns

ALLOWED = {
    "robosmi/generate/languages.py": "reads lines of templates, which their user trusts",
    "transformations/knowledge/lexer.py": "always matches something, so that no repetition gives back more than a character",
}
"""Modules whose overlapping repetitions do no harm, with the reason."""
NOT_IN_THE_TEXT = {
    "robosmi/base/data_tables.py": "from data files, which are looked at here themselves",
    "robosmi/generate/formatters.py": "from the language of a template's user",
    "robosmi/generate/languages.py": "an escaped word",
    "robosmi/query/strings.py": "given by the user in a query, whose time is not limited",
    "robosmi/verify/uploads/upload.py": "from data files, which are looked at here themselves",
    "transformations/knowledge/board_models.py": "from data files, which are looked at here themselves",
    "transformations/knowledge/cores/core_recipes.py": "from an installed core, whose commands are run anyway",
    "transformations/knowledge/part.py": "from data files, which are looked at here themselves",
    "transformations/knowledge/parts_catalogue.py": "from data files, which are looked at here themselves",
    "transformations/knowledge/wildcards.py": "made of words and stars of data files",
    "transformations/m2m/sketches/absent_names.py": "made of words and stars of data files",
    "transformations/verification/jobs.py": "from data files, which are looked at here themselves",
    "transformations/verification/originals.py": "from data files, which are looked at here themselves; or an escaped name",
}
"""Modules with a pattern that is only known when the program runs, with what it is made of."""


def test_no_two_repetitions_of_a_pattern_can_match_the_same_text() -> None:
    assert len(own_patterns()) > 500
    found = {
        f"{each.path}:{each.line} {each.pattern.pattern!r}: {told}"
        for each in own_patterns()
        for told in overlaps(each.pattern, anywhere=False, whole=each.whole)
        if each.path not in ALLOWED
    }
    assert not found, "\n".join(sorted(found))


def test_a_comment_that_is_never_closed_is_looked_through_once() -> None:
    """A pattern that needs the comment's end looks for it from each `/*` again, to the end of the text."""
    texts = {f"{each.path}:{each.line}": each.pattern.pattern for each in own_patterns()}
    plain = {place: text.decode("latin-1") if isinstance(text, bytes) else text for place, text in texts.items()}
    comments = {place: text for place, text in plain.items() if r"/\*.*?" in text}
    assert len(comments) > 5
    assert [place for place, text in comments.items() if r"/\*.*?(?:\*/|\Z)" not in text] == []


def test_every_pattern_is_looked_at() -> None:
    assert {each.partition(":")[0] for each in unreadable_patterns()} == {*NOT_IN_THE_TEXT}
    assert {each.path for each in own_patterns()} >= {*ALLOWED}


@pytest.mark.parametrize(
    "pattern",
    [
        r"\bdefined\s*\(?\s*\w", r"(a*)*b", r"(aa|a)*b", r"(?:\d{1,18})*x", r"[ab]*[bc]*d", r".*x.*y", r"(?:a|b*)*c",
        r"\s*\n\s*x", r"(?s:.*)x(?s:.*)y", r"(?:x*y?)+z", r"(?>(a*)*b)c", r"(?:ab*)*b*c", r"\w+(?:\w+ )*x",
    ],
)  # fmt: skip
def test_what_overlaps_is_found(pattern: str) -> None:
    assert overlaps(re.compile(pattern), anywhere=False)


@pytest.mark.parametrize(
    "pattern",
    [
        r"\bdefined\s*+\(?\s*+\w", r"a*b", r"(?:ab)*c", r"\d+(?:\.\d*)?x", r"[ab]*c[ab]*d", r"[^x]*x.*", r"(?:a+,)*b",
        r'"(?:[^"\\]|\\.)*"', r"(?:\s++|(?><.*?>))*+x", r"a{1,5}a{1,5}b",
    ],
)  # fmt: skip
def test_what_does_not_overlap_is_passed(pattern: str) -> None:
    assert not overlaps(re.compile(pattern), anywhere=False)


def test_a_search_may_begin_within_a_repetition() -> None:
    assert overlaps(re.compile(r"\w+\("))
    assert not overlaps(re.compile(r"\w+\("), anywhere=False)
    assert not overlaps(re.compile(r"\w+"))
