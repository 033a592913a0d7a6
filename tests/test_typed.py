"""Typed stand-ins for functions of the standard library that forget types."""

from __future__ import annotations

import re

import pytest

from robosmi.typed import distinct, matches


def test_values_keep_their_order_and_come_once() -> None:
    assert distinct(n % 3 for n in (5, 4, 3, 2)) == [2, 1, 0]


def test_matches_are_those_of_the_one_group_or_of_the_whole_pattern() -> None:
    assert matches(r"#(\w+)", "#one two #three") == ["one", "three"]
    assert matches(re.compile(rb"\w+"), b"one two") == [b"one", b"two"]
    assert matches("o.", "one\nO.", re.IGNORECASE) == ["on", "O."]


def test_a_pattern_of_several_groups_is_refused() -> None:
    with pytest.raises(TypeError, match=r"several groups: ask finditer"):
        matches(r"(\w)=(\w)", "a=b")
