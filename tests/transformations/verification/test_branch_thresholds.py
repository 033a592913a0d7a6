"""Borders of a program are found from how far apart the two sides of its comparisons are."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from robosmi.transformations.verification.search.branch_thresholds import Fineness, Look, branch_thresholds, look_of

WHOLE = Fineness(1.0, 1.0)
WIDE = (0.0, 1_000.0, 100_000.0)


def program(*distances: Callable[[float], float]) -> Callable[[float], Look]:
    """A program that makes a comparison for each function, which gives the difference of its sides."""
    return lambda value: look_of(
        frozenset(), frozenset(), {place: (each(value), each(value)) for place, each in enumerate(distances, 1)}
    )


def found(look: Callable[[float], Look | None], values: tuple[float, ...] = WIDE, looks: int = 30) -> list[tuple[float, float]]:
    return [(turn.low, turn.high) for turn in branch_thresholds(values, look, WHOLE, looks, 20)]


def test_a_border_behind_a_calculation_takes_a_few_runs() -> None:
    seen = []

    def look(value: float) -> Look:
        seen.append(value)
        return program(lambda each: 3 * each + 7 - 100.5)(value)

    assert found(look) == [(31.0, 32.0)]
    assert len(seen) <= len(WIDE) + 3


def test_where_both_sides_are_equal_the_side_counts_at_which_the_program_does_something_else() -> None:
    def look(value: float) -> Look:
        edge = 7 if value < 42 else 8
        return look_of(frozenset(), frozenset([edge]), {1: (value - 41, value - 41)})

    assert found(look) == [(41.0, 42.0)]


def test_a_value_for_itself_has_two_borders() -> None:
    def look(value: float) -> Look:
        edge = 7 if value == 4_711 else 8
        return look_of(frozenset(), frozenset([edge]), {1: (value - 4_711, value - 4_711)})

    assert found(look) == [(4_710.0, 4_711.0), (4_711.0, 4_712.0)]


def test_a_comparison_that_shows_nowhere_has_one() -> None:
    assert found(program(lambda each: each - 4_711)) == [(4_710.0, 4_711.0)]


def test_all_borders_between_two_values_are_found() -> None:
    assert found(program(lambda each: each - 20.5, lambda each: each - 900.5, lambda each: 650.5 - each)) == [
        (20.0, 21.0), (650.0, 651.0), (900.0, 901.0),
    ]  # fmt: skip


def test_curves_and_steps_are_halved() -> None:
    assert found(program(lambda each: each * each - 10_000.5)) == [(100.0, 101.0)]
    assert found(program(lambda each: float(each >= 333))) == [(332.0, 333.0)]


def test_what_a_program_shows_is_a_way_without_any_comparison() -> None:
    def look(value: float) -> Look:
        return look_of(frozenset([("value", "P4", "high" if value > 77 else "low")]), frozenset(), {})

    assert found(look) == [(77.0, 78.0)]


@pytest.mark.parametrize("look", [program(lambda each: each + 1), lambda value: None])
def test_nothing_is_found_where_the_program_goes_one_way_or_nothing_is_told(look: Callable[[float], Look | None]) -> None:
    assert found(look) == []


def test_no_more_runs_are_made_than_asked_for() -> None:
    seen = []

    def look(value: float) -> Look:
        seen.append(value)
        return program(lambda each: float(int(each) % 7))(value)

    found(look, looks=12)
    assert len(seen) <= len(WIDE) + 12
