"""Libraries for parts as Wokwi, EAGLE and KiCad name them.

`data/drawn_parts.csv` lists distinct parts with what the tool says of them, whether a program needs a library for each, and the
libraries that would do: labelled by a person before the ranking was looked at.
"""

from __future__ import annotations

import csv
from pathlib import Path

import pytest

from robosmi.recommend.component import ComponentQuery
from robosmi.transformations.knowledge.library_ranking import device_ranker

TABLE = Path(__file__).with_name("data") / "drawn_parts.csv"
LEAST = 0.85


def labelled() -> list[dict[str, str]]:
    """The rows."""
    with TABLE.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file, delimiter=";"))


def query(number: int, row: dict[str, str]) -> ComponentQuery:
    """The part of a row as a component."""
    return ComponentQuery(
        id=str(number),
        title=row["title"],
        label=row["label"],
        family=row["family"],
        tags=tuple(row["tags"].split()),
        description=row["description"],
        connectors=tuple(row["connectors"].split(",")),
    )


@pytest.fixture(scope="module")
def figures() -> tuple[list[str], list[str], list[str]]:
    """Parts whose decision is wrong, parts that need a library and whose first is none of those that would do, all parts."""
    rows = labelled()
    ranker = device_ranker("arduino", architecture="avr")
    answers = [ranker.rank(query(number, row)) for number, row in enumerate(rows)]
    wrong, missed = [], []
    for row, answer in zip(rows, answers, strict=True):
        name = f"{row['tool']}: {row['title']}"
        if answer.decision != row["decision"]:
            wrong.append(f"{name}: {answer.decision}, not {row['decision']}")
        if row["decision"] == "library" and answer.candidates[0].library not in row["libraries"].split("|"):
            missed.append(f"{name}: {answer.candidates[0].library}")
    return wrong, missed, [row["title"] for row in rows]


def test_the_table_has_sixty_distinct_parts_of_three_tools_and_thirty_that_need_a_library() -> None:
    rows = labelled()
    assert len({(row["tool"], row["title"]) for row in rows}) == len(rows) >= 60
    assert {row["tool"] for row in rows} == {"wokwi", "eagle", "kicad"}
    assert sum(row["decision"] == "library" for row in rows) >= 30
    assert all(bool(row["libraries"]) == (row["decision"] == "library") for row in rows)


def test_whether_a_library_is_needed_is_told(figures: tuple[list[str], list[str], list[str]]) -> None:
    wrong, _, rows = figures
    assert 1 - len(wrong) / len(rows) >= LEAST, wrong


def test_the_first_library_is_one_that_would_do(figures: tuple[list[str], list[str], list[str]]) -> None:
    _, missed, _ = figures
    needed = sum(row["decision"] == "library" for row in labelled())
    assert 1 - len(missed) / needed >= LEAST, missed
