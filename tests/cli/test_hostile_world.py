"""Commands in a world that is not as it should be: closed and full streams, no home, a folder that is gone."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from robosmi.errors import MissingToolError
from tests.broken_packages import worlds_of_packages
from tests.hostile_world import EXAMPLE, Done, run, worlds, wrong
from tests.running import run as run_here
from tests.tiers import one_of_each

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


PACKAGES = {world.name: world for world in worlds_of_packages()}


@pytest.mark.parametrize(
    ("name", "words"),
    one_of_each(
        [
            ("lxml without its shared library", ["hardware", "line_following_robot.fzz"]),
            ("lxml of another version", ["hardware", "line_following_robot.fzz"]),
            ("pyecore missing", ["analyse", "line_follower.c"]),
            ("pyecore no Python", ["analyse", "line_follower.c"]),
            ("pyecore ending the program", ["analyse", "line_follower.c"]),
            ("clang missing", ["analyse", "line_follower.c"]),
            ("clang with a text for a library", ["analyse", "line_follower.c"]),
            ("clang with another library", ["analyse", "line_follower.c"]),
        ],
        lambda case: case[0].split()[0],
    ),
)
def test_a_broken_package_is_named_and_no_bug_of_ours(name: str, words: list[str], tmp_path: Path) -> None:
    done = run([words[0], str(EXAMPLE / words[1]), "--json"], PACKAGES[name], tmp_path)
    assert wrong(done, as_json=True) == ""
    assert done.code == 4
    assert "cannot be loaded" in done.err or "not installed" in done.err
    assert "\n  do: " in done.err
    found = json.loads(run(["doctor", "--json"], PACKAGES[name], tmp_path / "again").out)["result"]["tools"]
    (package,) = [tool for tool in found if tool["name"] == name.partition(" ")[0].replace("clang", "libclang")]
    assert package["found"] is None
    assert package["fix"].startswith("pip install --force-reinstall")


def test_a_libclang_of_another_version_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    from robosmi.transformations.t2m.c_source.parsing import clang

    clang.library()
    monkeypatch.setattr(clang, "VERSION", 99)
    with pytest.raises(MissingToolError, match=r"version 18\..*needs version 99"):
        clang.library.__wrapped__()
