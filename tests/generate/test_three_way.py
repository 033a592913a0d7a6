"""The merge of three texts by lines, in the cases that decide where one change ends and the next begins."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import permutations, product

import pytest

from robosmi.generate.three_way import chunks


def kinds(base: str, ours: str, theirs: str) -> list[str]:
    """The stretches of three texts of one letter a line, each as its kind with the three stretches."""
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
    """Functions that differ in nothing but their heads."""
    return [line for head in heads for line in (f"void {head}()", "{", "  begin();", "  work();", "  end();", "}", "")]


@pytest.mark.parametrize("theirs", [*map("".join, permutations("ABCD")), "BCD", "DCB", "CAB", "XBACD", "BXADC"])
@pytest.mark.parametrize("inside", ["", "  if (ready) {", "#ifdef FAST"])
def test_a_body_stays_in_its_function_whatever_the_order(theirs: str, inside: str) -> None:
    """What a person writes into a function is in that function or in a conflict, on either side of the merge."""
    base, new = functions("ABCD"), functions(theirs)
    for edited, place, replaced in product(range(4), range(2, 6), (0, 1)):
        at = edited * 7 + place
        ours = [*base[:at], *([inside] if inside else []), "EDIT", *base[at + replaced :]]
        for one, other in ((ours, new), (new, ours)):
            text: list[str] = []
            for chunk in chunks(base, one, other):
                text += {"ours": one[slice(*chunk.ours)], "conflict": ["?"]}.get(chunk.kind, other[slice(*chunk.theirs)])
            if "EDIT" in text:
                heads = [line for line in text[: text.index("EDIT")] if line.startswith("void") or line == "?"]
                assert heads[-1] in ("?", f"void {'ABCD'[edited]}()")
            else:
                assert "?" in text


def test_the_order_of_similar_functions_is_no_conflict_where_the_edited_one_stays() -> None:
    base, theirs = functions("ABCD"), functions("ACBD")
    ours = [line.replace("work", "EDIT") if number < 7 else line for number, line in enumerate(base)]
    assert [chunk.kind for chunk in chunks(base, ours, theirs) if chunk.kind in ("ours", "conflict")] == ["ours"]
