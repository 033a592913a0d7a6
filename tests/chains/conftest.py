"""Fixtures of the chains' tests: each case study migrated, in a folder that a test may change."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

import robosmi
from tests.copies import Copies

PROGRAM = '#include "simpletools.h"\nint eye = 3;\nint main() { while (1) { high(eye); pause(5); } }\n'
SETTINGS = '# mine\n[migrate]\ntarget = "uno"\n'
"""A program with one port, and its project file, in which nothing is chosen."""


@pytest.fixture(params=["line_follower", "environmental_monitoring"])
def case_study(request: pytest.FixtureRequest, tmp_path: Path, examples: Path) -> Path:
    """The source of each case study, beside its drawing and project file."""
    return copied(examples, str(request.param), tmp_path)


@pytest.fixture
def line_follower(tmp_path: Path, examples: Path) -> Path:
    """The source of the line follower."""
    return copied(examples, "line_follower", tmp_path)


@pytest.fixture
def migrated(line_follower: Path, examples: Path, copies: Copies) -> Path:
    """The output folder of a migration of the line follower: a copy, so no run of this test's user has made it."""
    return migrated_copy(line_follower, examples, copies)


@pytest.fixture
def migrated_study(case_study: Path, examples: Path, copies: Copies) -> Path:
    """The same of each case study."""
    return migrated_copy(case_study, examples, copies)


@pytest.fixture
def own_output(line_follower: Path, tmp_path: Path) -> Path:
    """As `migrated`, by a run of this test's user."""
    robosmi.migrate([line_follower], tmp_path / "out")
    return tmp_path / "out"


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    """A folder with a program of one port, its project file, and its migration in `out`, whose sources `choose` finds again."""
    folder = tmp_path / "robot"
    folder.mkdir()
    (folder / "blink.c").write_text(PROGRAM)
    (folder / "robosmi.toml").write_text(SETTINGS)
    robosmi.migrate([folder / "blink.c"], folder / "out")
    return folder


def migrated_copy(source: Path, examples: Path, copies: Copies) -> Path:
    """The output folder of the migration of a case study, beside the folder of its source."""

    def fill(folder: Path) -> None:
        robosmi.migrate([copied(examples, source.stem, folder)], folder / "out")

    return copies.into(source.parents[1], source.stem, fill) / "out"


def copied(examples: Path, name: str, folder: Path) -> Path:
    """A copy of a case study; its source file."""
    shutil.copytree(examples / name, folder / "input")
    return folder / "input" / f"{name}.c"
