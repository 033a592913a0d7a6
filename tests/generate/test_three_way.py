"""The merge of three texts by lines, in the cases that decide where one change ends and the next begins."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import permutations, product

import pytest

from robosmi.generate.three_way import by_words, chunks
from tests.tiers import sample


def kinds(base: str, ours: str, theirs: str) -> list[str]:
    """The chunks of a merge of three texts, each character a line: the kind with the three stretches."""
    return [
        f"{c.kind} {base[slice(*c.base)]}|{ours[slice(*c.ours)]}|{theirs[slice(*c.theirs)]}" for c in chunks(base, ours, theirs)
    ]


@pytest.mark.parametrize(
    ("base", "ours", "theirs", "expected"),
    [
        ("ab", "Ab", "aB", ["conflict ab|Ab|aB"]),  # edits of lines that are next to each other meet: nobody kept a line between
        ("abc", "Abc", "abC", ["ours a|A|a", "same b|b|b", "theirs c|c|C"]),
        ("ab", "aXb", "aYb", ["same a|a|a", "conflict |X|Y", "same b|b|b"]),
        ("ab", "aXb", "aB", ["same a|a|a", "conflict b|Xb|B"]),
        ("ab", "b", "aB", ["conflict ab|b|aB"]),
        ("ab", "a", "b", ["conflict ab|a|b"]),
        ("abc", "aXc", "aXc", ["same a|a|a", "both b|X|X", "same c|c|c"]),
        ("", "X", "Y", ["conflict |X|Y"]),
        ("a", "", "a", ["ours a||a"]),
        ("a", "", "", ["both a||"]),
    ],
)
def test_stretches(base: str, ours: str, theirs: str, expected: list[str]) -> None:
    assert kinds(base, ours, theirs) == expected


def functions(heads: Iterable[str]) -> list[str]:
    """Functions that differ only in their heads."""
    return [line for head in heads for line in (f"void {head}()", "{", "  begin();", "  work();", "  end();", "}", "")]


@pytest.mark.parametrize("theirs", [*sample(map("".join, permutations("ABCD")), 6), "BCD", "DCB", "CAB", "XBACD", "BXADC"])
@pytest.mark.parametrize("inside", ["", "  if (ready) {", "#ifdef FAST"])
def test_a_body_stays_in_its_function_whatever_the_order(theirs: str, inside: str) -> None:
    """What a person writes into a function is in that function or in a conflict, on either side of the merge."""
    base, new = functions("ABCD"), functions(theirs)
    for edited, place, replaced, edit in product(range(4), range(2, 6), (0, 1), ("EDIT", "  work(EDIT);")):
        at = edited * 7 + place
        ours = [*base[:at], *([inside] if inside else []), edit, *base[at + replaced :]]
        for one, other in ((ours, new), (new, ours)):
            text: list[str] = []
            for chunk in chunks(base, one, other):
                mine, made = one[slice(*chunk.ours)], other[slice(*chunk.theirs)]
                merged = by_words(base[slice(*chunk.base)], mine, made) or ["?"]
                text += {"ours": mine, "conflict": merged}.get(chunk.kind, made)
            if edit in text:
                heads = [line for line in text[: text.index(edit)] if line.startswith("void") or line == "?"]
                assert heads[-1] in ("?", f"void {'ABCD'[edited]}()")
            else:
                assert "?" in text


def test_the_order_of_similar_functions_is_no_conflict_where_the_edited_one_stays() -> None:
    base, theirs = functions("ABCD"), functions("ACBD")
    ours = [line.replace("work", "EDIT") if number < 7 else line for number, line in enumerate(base)]
    assert [chunk.kind for chunk in chunks(base, ours, theirs) if chunk.kind in ("ours", "conflict")] == ["ours"]


@pytest.mark.parametrize(
    ("base", "ours", "theirs", "merged"),
    [
        ("const int left = 7;", "const int leftEye = 7;", "const int left = 10;", "const int leftEye = 10;"),
        ("const int left = 7;", "const int left = 7;  // the eye", "const int left = A0;", "const int left = A0;  // the eye"),
        ("  high(left);", "    high(left);", "  high(right);", "    high(right);"),
        ("a = b + c;", "a = d + c;", "a = e + c;", None),  # the same word
        ("a = b + c;", "a = b - c;", "a = b + d;", None),  # words that touch
        ("high(left);", "high(leftEye);", "high(port(left));", "high(port(leftEye));"),
        ("a = b + c;", "print(x);", "a = b + d;", None),  # hardly a word left
        ("int pin = 7", "long pin = 7", "int pin = 8", "long pin = 8"),
        ("int left = 7\nint right = 8", "int l = 7\nint right = 8", "int left = 9\nint right = 10", "int l = 9\nint right = 10"),
        ("void A()\n  work();", "void A()\n  work(1);", "void B()\n  work();", None),  # the body may be another's
        ("int a = 7;", "int a = 7;\nint c = 1;", "int a = 8;", None),  # a line came
    ],
)
def test_lines_that_both_sides_changed_are_merged_by_words(base: str, ours: str, theirs: str, merged: str | None) -> None:
    found = by_words(*(text.split("\n") for text in (base, ours, theirs)))
    assert found == (merged.split("\n") if merged is not None else None)
