"""Libraries for parts as Wokwi, EAGLE and KiCad name them (`drawn_parts`)."""

from __future__ import annotations

import pytest

from tests.recommend.drawn_parts import LEAST, Figures, figures, labelled


@pytest.fixture(scope="module")
def found() -> Figures:
    """The ranking's answers, judged."""
    return figures()


def test_the_table_has_sixty_distinct_parts_of_three_tools_and_thirty_that_need_a_library() -> None:
    rows = labelled()
    assert len({(row["tool"], row["title"]) for row in rows}) == len(rows) >= 60
    assert {row["tool"] for row in rows} == {"wokwi", "eagle", "kicad"}
    assert sum(row["decision"] == "library" for row in rows) >= 30
    assert all(bool(row["libraries"]) == (row["decision"] == "library") for row in rows)


def test_whether_a_library_is_needed_is_told(found: Figures) -> None:
    assert found.decision >= LEAST, found.wrong


def test_the_first_library_is_one_that_would_do(found: Figures) -> None:
    assert found.top_1 >= LEAST, found.missed
