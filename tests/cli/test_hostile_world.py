"""Commands in a world that is not as it should be: closed and full streams, no home, a folder that is gone."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.hostile_world import Done, run, worlds, wrong
from tests.running import run as run_here

TRIED = {
    "no standard output": 3,
    "no standard error": 0,
    "no streams at all": 3,
    "full output": 3,
    "no home": 0,
    "current folder removed": 0,
}
"""Names of worlds, each with the exit code of a query there: 3 where its answer cannot be written."""
WORLDS = {world.name: world for world in worlds()}


@pytest.mark.parametrize("name", TRIED)
def test_a_command_ends_as_the_contract_says(name: str, tmp_path: Path) -> None:
    (tmp_path / "books.csv").write_text("title\nx\n")
    done = run(["query", str(tmp_path / "books.csv"), "books.all.size()"], WORLDS[name], tmp_path)
    assert wrong(done, told="error" not in name and "streams" not in name) == ""
    assert done.code == TRIED[name], done.err


def test_the_judge_sees_what_is_wrong() -> None:
    assert wrong(Done(70, "", "robosmi: error: x"))
    assert wrong(Done(0, "", "Traceback (most recent call last):"))
    assert wrong(Done(3, "", ""))
    assert wrong(Done(0, "[", ""), as_json=True)
    assert wrong(Done(0, "{}", ""), as_json=True) == ""


@pytest.mark.parametrize(
    "expression", ["Lazy(1)", "Lazy(lambda: 1)", "Lazy([1]).select(lambda x: 1 / 0)", 'call(books, "eClass")']
)
def test_a_query_that_fails_while_it_is_shown_fails_as_a_query(expression: str, tmp_path: Path) -> None:
    (tmp_path / "books.csv").write_text("title\nx\n")
    outcome = run_here("query", tmp_path / "books.csv", expression)
    assert outcome.code in (2, 3)
    assert "\n  do: " in outcome.err


def test_an_answer_that_is_too_long_to_be_shown_is_refused(tmp_path: Path) -> None:
    (tmp_path / "books.csv").write_text("title\nx\n")
    outcome = run_here("query", tmp_path / "books.csv", "'x' * 6_000_000 + 'x' * 6_000_000")
    assert outcome.code == 2
    assert "more than 10,000,000 characters" in outcome.err
