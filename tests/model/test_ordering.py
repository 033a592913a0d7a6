"""What comes before what, in graphs that may be deep or lead in circles."""

from __future__ import annotations

import pytest

from robosmi.model.elements.ordering import post_order

DIAMOND = {"top": ["left", "right"], "left": ["bottom"], "right": ["bottom"], "bottom": []}
RING = {"in": ["a"], "a": ["b"], "b": ["c", "end"], "c": ["a"], "end": []}


def test_each_comes_once_behind_what_it_leads_to() -> None:
    assert list(post_order(["top"], DIAMOND.__getitem__)) == ["bottom", "left", "right", "top"]


def test_the_starts_are_taken_in_their_order_and_what_was_met_is_not_repeated() -> None:
    assert list(post_order(["right", "top", "right"], DIAMOND.__getitem__)) == ["bottom", "right", "left", "top"]


def test_a_circle_is_told_from_its_first_to_its_first_and_left() -> None:
    circles: list[list[str]] = []
    assert list(post_order(["in"], RING.__getitem__, circles.append)) == ["c", "end", "b", "a", "in"]
    assert circles == [["a", "b", "c", "a"]]


def test_one_that_leads_to_itself_is_a_circle() -> None:
    circles: list[list[str]] = []
    assert list(post_order(["x"], lambda one: [one], circles.append)) == ["x"]
    assert circles == [["x", "x"]]


def test_who_is_told_of_a_circle_may_refuse_it() -> None:
    def refuse(circle: list[str]) -> None:
        raise ValueError(" to ".join(circle))

    with pytest.raises(ValueError, match="a to b to c to a"):
        list(post_order(["in"], RING.__getitem__, refuse))


def test_a_way_may_be_long() -> None:
    length = 100_000
    walked = list(post_order([0], lambda one: [one + 1] if one < length else []))
    assert walked == list(range(length, -1, -1))


def test_a_long_way_with_many_that_lead_back_is_walked_in_its_own_time() -> None:
    length = 5_000
    told: list[int] = []
    list(post_order([0], lambda one: [0, one + 1] if one < length else [0], lambda circle: told.append(circle[0])))
    assert told == [0] * (length + 1)
