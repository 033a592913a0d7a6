"""Typed stand-ins for functions of the standard library that forget types."""

from __future__ import annotations

import re

import pytest
from msgspec import Struct

from robosmi.typed import (
    attribute_of,
    class_name,
    distinct,
    dynamic_attribute,
    matches,
    paired,
    remembered,
    replaced,
    sum_of,
)


class Point(Struct, frozen=True):
    x: int
    y: int


def test_values_keep_their_order_and_come_once() -> None:
    assert distinct(n % 3 for n in (5, 4, 3, 2)) == [2, 1, 0]


def test_matches_are_those_of_the_one_group_or_of_the_whole_pattern() -> None:
    assert matches(r"#(\w+)", "#one two #three") == ["one", "three"]
    assert matches(re.compile(rb"\w+"), b"one two") == [b"one", b"two"]
    assert matches("o.", "one\nO.", re.IGNORECASE) == ["on", "O."]


def test_a_pattern_of_several_groups_is_refused() -> None:
    with pytest.raises(TypeError, match=r"several groups: ask finditer"):
        matches(r"(\w)=(\w)", "a=b")


def test_an_attribute_is_told_where_it_is_of_the_kind() -> None:
    assert attribute_of(Point(1, 2), "x", int) == 1
    assert attribute_of(Point(1, 2), "x", str) is None
    assert attribute_of(Point(1, 2), "z", int) is None


def test_a_dynamic_attribute_that_is_missing_is_an_error_unless_there_is_a_default() -> None:
    assert dynamic_attribute(Point(1, 2), "y") == 2
    assert dynamic_attribute(Point(1, 2), "z", None) is None
    with pytest.raises(AttributeError, match="z"):
        dynamic_attribute(Point(1, 2), "z")


def test_pairs_end_with_the_shorter_one_only_where_that_is_said() -> None:
    assert list(paired("ab", [1, 2])) == [("a", 1), ("b", 2)]
    assert list(paired("abc", [1, 2], strict=False)) == [("a", 1), ("b", 2)]
    with pytest.raises(ValueError, match="longer"):
        list(paired("ab", [1, 2, 3]))


def test_the_sum_of_no_numbers_is_zero() -> None:
    assert (sum_of([]), sum_of([True, True]), sum_of([0.5, 1])) == (0, 2, 1.5)


def test_only_the_latest_results_are_remembered() -> None:
    asked: list[int] = []

    @remembered(2)
    def double(number: int) -> int:
        asked.append(number)
        return 2 * number

    assert [double(n) for n in (1, 2, 1, 3, 2)] == [2, 4, 2, 6, 4]
    assert asked == [1, 2, 3, 2]


def test_a_record_is_copied_with_other_values() -> None:
    point = Point(1, 2)
    assert replaced(point, y=3) == Point(1, 3)
    assert point == Point(1, 2)
    with pytest.raises(TypeError, match="z"):
        replaced(point, z=3)


def test_the_class_of_a_thing_has_a_name() -> None:
    assert class_name(Point(1, 2)) == "Point"
