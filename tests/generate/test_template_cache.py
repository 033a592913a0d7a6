"""The compiled templates that are kept between runs: used when nothing changed, passed over when anything did or is odd."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

CODE = """
import sys
from unittest.mock import patch
import jinja2
from robosmi.generate.templates import Templates
made = []
compile_ = jinja2.Environment.compile
def counted(self, *args, **options):
    made.append(args)
    return compile_(self, *args, **options)
with patch.object(jinja2.Environment, "compile", counted):
    text = Templates(None).text("line.j2", {"name": sys.argv[1]})
print(str(text), len(made), sep="|", end="")
"""


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A folder with a template in ROBOSMI_PATH."""
    (tmp_path / "own" / "templates").mkdir(parents=True)
    (tmp_path / "own" / "templates" / "line.j2").write_text("Hello {{ name }}", encoding="utf-8")
    return tmp_path


def said(project: Path, name: str) -> str:
    environment = {**os.environ, "ROBOSMI_PATH": str(project / "own"), "XDG_CACHE_HOME": str(project / "cache")}
    command = [sys.executable, "-c", CODE, name]
    return subprocess.run(command, env=environment, cwd=project, capture_output=True, text=True, check=True).stdout


def kept(project: Path) -> list[Path]:
    return sorted((project / "cache" / "robosmi" / "templates").iterdir())


def test_a_template_is_compiled_once(project: Path) -> None:
    assert [said(project, name) for name in ("you", "all")] == ["Hello you|1", "Hello all|0"]


def test_a_changed_template_is_compiled_again(project: Path) -> None:
    said(project, "you")
    (project / "own" / "templates" / "line.j2").write_text("Bye {{ name }}", encoding="utf-8")
    assert said(project, "you") == "Bye you|1"


def test_what_is_damaged_or_others_can_write_is_passed_over(project: Path) -> None:
    said(project, "you")
    (place,) = kept(project)
    place.write_bytes(place.read_bytes()[:-20])
    assert said(project, "you") == "Hello you|1"
    place.chmod(0o666)
    assert said(project, "you") == "Hello you|1"
    (place,) = kept(project)
    other = project / "other"
    place.rename(other)
    place.symlink_to(other)
    assert said(project, "you") == "Hello you|1"


def test_a_folder_that_cannot_be_written_keeps_nothing(project: Path) -> None:
    (project / "cache").write_text("no folder", encoding="utf-8")
    assert [said(project, "you") for _ in range(2)] == ["Hello you|1"] * 2
