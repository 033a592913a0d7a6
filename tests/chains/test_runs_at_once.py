"""Runs into one folder at once and killed, in few rounds; `python -m tests.fuzz.runs` does many."""

from __future__ import annotations

from pathlib import Path

import pytest

import robosmi
from robosmi.errors import StoppedError
from robosmi.model.recovery import STAGE
from robosmi.transformations.chains.generate import generate
from tests.fuzz import runs


@pytest.fixture(autouse=True)
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROBOSMI_HOME", str(tmp_path / "home"))


def test_runs_at_once_end_as_one_of_them_alone(tmp_path: Path) -> None:
    assert runs.rounds(5, tmp_path) == 0


def test_a_killed_run_is_recovered_by_whoever_comes_next(tmp_path: Path) -> None:
    assert runs.kills(32, tmp_path) == 0


def test_a_plan_beside_an_interrupted_run_is_not_read(tmp_path: Path) -> None:
    out = tmp_path / "out"
    robosmi.migrate([runs.programs(tmp_path)[0]], out)
    (out / STAGE).mkdir()
    for dry_run in (False, True):
        with pytest.raises(StoppedError, match="interrupted"):
            generate(out / "models" / "plan.xmi", tmp_path / "other", dry_run=dry_run)
