"""The merge of three texts by lines, in the cases that decide where one change ends and the next begins."""

from __future__ import annotations

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
