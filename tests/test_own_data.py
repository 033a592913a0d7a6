"""Neither tests nor what the Makefile runs read or write the data of the person at the machine."""

from __future__ import annotations

import os
import subprocess
import tempfile
from pathlib import Path

import pytest

import robosmi
from robosmi import resources
from robosmi.recommend.history import default_place
from tests.tools import require_tools

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="module")
def migrated(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """A migration with choices of a person, made before any fixture of a single test; where it keeps its data."""
    robosmi.migrate([ROOT / "docs" / "examples" / "line_follower" / "line_follower.c"], tmp_path_factory.mktemp("made") / "out")
    return resources.user_data(), Path(default_place())


def test_fixtures_of_modules_keep_out_of_the_data_of_the_person(migrated: tuple[Path, Path]) -> None:
    home, history = migrated
    assert history.is_file(), "the choices of the example were remembered"
    for place in (home, history):
        assert place.is_relative_to(tempfile.gettempdir())


def test_the_makefile_keeps_out_of_the_data_of_the_person(tmp_path: Path) -> None:
    require_tools("make")
    theirs = {"ROBOSMI_HOME": str(tmp_path), "ROBOSMI_HISTORY": str(tmp_path / "history.sqlite")}
    show = 'show:\n\t@echo "$$ROBOSMI_HOME|$$ROBOSMI_HISTORY"'
    words = ["make", "--silent", f"--eval={show}", "show"]
    done = subprocess.run(words, cwd=ROOT, env={**os.environ, **theirs}, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == f"{ROOT / 'out' / 'data'}|"
