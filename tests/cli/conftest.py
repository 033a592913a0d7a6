"""Fixtures of the command line's tests: copies of the case studies that a test may change, and one migration of each."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.copies import Copies
from tests.running import run

CASES = Path(__file__).parent / "cases"


@pytest.fixture
def cases() -> Path:
    """The damaged and unusable inputs."""
    return CASES


@pytest.fixture
def line_follower(tmp_path: Path, examples: Path) -> Path:
    """The source of the line follower, in a folder of its own with drawing and project file."""
    return copied(examples, "line_follower", tmp_path)


@pytest.fixture(params=["line_follower", "environmental_monitoring"])
def case_study(request: pytest.FixtureRequest, tmp_path: Path, examples: Path) -> Path:
    """The source of each case study."""
    return copied(examples, str(request.param), tmp_path)


@pytest.fixture
def migrated(line_follower: Path, tmp_path: Path, examples: Path, copies: Copies) -> Path:
    """The output folder of a migration of the line follower: a copy, so no run of this test's user has made it."""

    def fill(folder: Path) -> None:
        assert run("migrate", copied(examples, "line_follower", folder), "-o", folder / "out").code == 0

    copies.into(line_follower.parents[1], "line_follower by the command line", fill)
    return tmp_path / "out"


def copied(examples: Path, name: str, folder: Path) -> Path:
    """A copy of a case study; its source file."""
    shutil.copytree(examples / name, folder / "input")
    return folder / "input" / f"{name}.c"
