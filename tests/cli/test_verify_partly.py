"""`robosmi verify` says how much it compared: outputs that were driven, lines that main can reach."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.running import run
from tests.tools import require_verification

PROGRAM = Path(__file__).parent / "cases" / "partly" / "lamps.c"


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
