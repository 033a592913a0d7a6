"""The smallest span around a place, against a look at all of them."""

from __future__ import annotations

from hypothesis import given, strategies as st

from robosmi.transformations.queries.innermost import Innermost

PLACES = st.integers(0, 12)


@given(st.lists(st.tuples(PLACES, PLACES, st.integers(0, 3))), PLACES)
def test_it_is_the_smallest_one_that_contains_the_place(spans: list[tuple[int, int, int]], place: int) -> None:
    numbered = [(start, end, size, number) for number, (start, end, size) in enumerate(spans)]
    inside = [(size, number) for start, end, size, number in numbered if start <= place < end]
    assert Innermost(numbered).at(place) == (min(inside)[1] if inside else None)


def test_lines_with_columns_are_places() -> None:
    spans = Innermost([((1, 1), (9, 1), 90, "outer"), ((2, 5), (2, 8), 3, "inner")])
    assert [spans.at(place) for place in ((1, 0), (1, 1), (2, 4), (2, 5), (2, 7), (2, 8), (9, 1))] == [
        None, "outer", "outer", "inner", "inner", "outer", None,
    ]  # fmt: skip
