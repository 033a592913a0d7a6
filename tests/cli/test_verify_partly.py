"""`robosmi verify` says how much it compared: outputs that were driven, lines that main can reach, how long it searched."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from robosmi.errors import VerificationError
from tests.running import run
from tests.tools import require_verification

PROGRAM = Path(__file__).parent / "cases" / "partly" / "lamps.c"
COURSE = PROGRAM.with_name("course.c")


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A migrated program with an output that nothing switches on, and a function that nothing calls."""
    require_verification("simavr")
    out = tmp_path_factory.mktemp("partly") / "out"
    assert run("migrate", PROGRAM, "-o", out, "--bind", "lamp=D3", "--bind", "siren=D4", "--bind", "spare=D5").code in (0, 1)
    return out


@pytest.mark.processes
def test_what_was_not_exercised_and_not_reached_makes_the_comparison_partial(made: Path) -> None:
    result = run("verify", made, "--json").result
    assert result["verdict"] == "no-difference-found"
    assert result["partial"] is True
    assert (result["compared"]["outputs"], result["compared"]["of"]) == (1, 2)
    assert result["compared"]["lines_pct"] == result["source_coverage"]["lines_pct"] < 100
    assert result["source_coverage"]["missed_lines"] == ["lamps.c:21"]
    assert [text.split()[-1] for text in result["source_coverage"]["unreachable"]] == ["never"]


@pytest.mark.processes
def test_required_coverage_makes_a_partial_comparison_fail(made: Path) -> None:
    lines = run("verify", made)
    assert lines.code == 0
    assert lines.out.splitlines()[0].startswith("PARTLY COMPARED: 1 of 2 outputs")
    assert run("verify", made, "--require-coverage", "50").code == 1
    assert run("verify", made, "--require-coverage", "200").code == 2


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A course of 76 s that is a table, with a fault in its last step."""
    require_verification("simavr")
    out = tmp_path_factory.mktemp("course") / "out"
    assert run("migrate", COURSE, "-o", out, "--bind", "P5=D7", "--bind", "P9=none").code in (0, 1)
    sketch = out / "course" / "course.ino"
    text = sketch.read_text()
    assert text.count("3000}") == 1
    sketch.write_text(text.replace("3000}", "4000}"))
    return out


@pytest.mark.exhaustive
def test_a_long_course_is_compared_whole_where_it_is_asked_for(course: Path, tmp_path: Path) -> None:
    shutil.copytree(course, tmp_path / "out")
    usual = run("verify", tmp_path / "out", "--json").result
    assert usual["verdict"] == "no-difference-found"
    assert usual["partial"] is True
    whole = run("verify", tmp_path / "out", "--json", "--horizon", "80").result  # beside the shorter one that is stored
    assert whole["verdict"] == "different"
    assert whole["first_difference"]["at_ms"] > 70_000
    assert max(each["simulated_s"] for each in whole["scenarios"]) == 80


@pytest.mark.processes
def test_a_search_that_its_budget_ends_says_so(course: Path, tmp_path: Path) -> None:
    shutil.copytree(course, tmp_path / "out")
    cut = run("verify", tmp_path / "out", "--json", "--budget", "0")
    assert cut.result["search"]["ended_by_budget"] is True
    assert cut.result["search"]["budget_s"] == 0
    assert cut.result["scenarios"]
    again = run("verify", tmp_path / "out", "--budget", "0")  # the search is not repeated
    assert "(--budget SECONDS)" in again.out
    assert run("verify", tmp_path / "out", "--json").result["search"]["ended_by_budget"] is False


def test_times_that_mean_nothing_are_wrong_usage(course: Path) -> None:
    for option, value in (("--budget", "-1"), ("--budget", "nan"), ("--horizon", "0"), ("--horizon", "long")):
        assert run("verify", course, option, value).code == 2


@pytest.mark.processes
def test_what_main_cannot_reach_is_named_before_the_search(course: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def stopped(*settings: object, **more: object) -> object:
        raise VerificationError("no search in this test")

    monkeypatch.setattr("robosmi.transformations.chains.verify.search", stopped)
    outcome = run("verify", course)
    assert outcome.code == 6
    assert "course.c:3 never" in outcome.err
