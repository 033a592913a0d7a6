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
def migrated(line_follower: Path, tmp_path: Path, examples: Path, copies: Copies) -> Path:
    """The output folder of a migration of the line follower: a copy, so no run of this test's user has made it."""

    def fill(folder: Path) -> None:
        robosmi.migrate([copied(examples, "line_follower", folder)], folder / "out")

    copies.into(line_follower.parents[1], "line_follower", fill)
    return tmp_path / "out"


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


def copied(examples: Path, name: str, folder: Path) -> Path:
    """A copy of a case study; its source file."""
    shutil.copytree(examples / name, folder / "input")
    return folder / "input" / f"{name}.c"
