"""A result is written over a file of its own kind, and over no other: not over the program, the drawing, or somebody's notes."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

from tests.running import run, tree

FOLLOWER = Path(__file__).resolve().parents[2] / "docs" / "examples" / "line_follower"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with a program and its drawing."""
    for name in ("line_follower.c", "line_following_robot.fzz"):
        shutil.copy(FOLLOWER / name, tmp_path)
    (tmp_path / "notes.txt").write_text("mine\n")
    return tmp_path


@pytest.mark.parametrize(
    "words",
    [
        ("analyse", "line_follower.c", "-o", "line_follower.c"),
        ("analyse", "line_follower.c", "-o", "notes.txt"),
        ("hardware", "line_following_robot.fzz", "-o", "line_following_robot.fzz"),
        ("hardware", "line_following_robot.fzz", "--svg", "line_follower.c"),
        ("simulate", ".", "-o", "notes.txt"),
        ("verify", ".", "-o", "line_follower.c"),
    ],
)
def test_a_file_of_another_kind_stays(words: tuple[str, ...], folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    before = tree(folder)
    outcome = run(*words)
    assert outcome.code == 5
    assert "a file exists there" in outcome.err
    assert tree(folder) == before


def test_a_file_of_its_kind_is_made_anew(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    for words in (("analyse", "line_follower.c", "-o", "p.xmi"), ("hardware", "line_following_robot.fzz", "--svg", "p.svg")):
        assert run(*words).code == 0
        assert run(*words).code == 0


@pytest.mark.parametrize("form", ["csv", "svg"])
def test_a_wiring_stops_at_a_file_that_is_another(form: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    drawing = ("--hardware", "line_following_robot.fzz")
    assert run("migrate", "line_follower.c", *drawing, "-o", "out").code == 0
    outcome = run("wiring", "out", "--as", form, "-o", "notes.txt")
    assert outcome.code == 5
    assert (folder / "notes.txt").read_text() == "mine\n"
    assert run("wiring", "out", "--as", form, "-o", f"w.{form}").code == 0
    assert run("wiring", "out", "--as", form, "-o", f"w.{form}").code == 0


def test_a_project_for_wokwi_lies_beside_the_migration(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Within the output folder its sketch would be taken for that of the migration."""
    monkeypatch.chdir(folder)
    assert run("migrate", "line_follower.c", "--hardware", "line_following_robot.fzz", "-o", "out").code == 0
    before = tree(folder / "out")
    for place in ("out", "out/line_follower", "out/w"):
        outcome = run("wiring", "out", "--as", "wokwi", "-o", place)
        assert outcome.code == 3
        assert "the project would be inside" in outcome.err
    assert tree(folder / "out") == before


@pytest.mark.skipif(os.name == "nt", reason="links need rights there")
@pytest.mark.parametrize(
    ("form", "place", "linked"), [("svg", "w.svg", "w.svg"), ("csv", "w.csv", "w.csv"), ("wokwi", "w", "w/diagram.json")]
)
@pytest.mark.parametrize("dangling", [True, False])
def test_a_wiring_replaces_no_link(
    form: str, place: str, linked: str, dangling: bool, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder)
    assert run("migrate", "line_follower.c", "--hardware", "line_following_robot.fzz", "-o", "out").code == 0
    assert run("wiring", "out", "--as", form, "-o", place).code == 0
    (folder / linked).rename(folder / "elsewhere")
    (folder / linked).symlink_to(folder / ("nowhere" if dangling else "elsewhere"))
    before = tree(folder)
    outcome = run("wiring", "out", "--as", form, "-o", place)
    assert outcome.code == 5
    assert "the result's path is a link" in outcome.err
    assert tree(folder) == before
    assert (folder / linked).is_symlink()


@pytest.mark.skipif(os.name == "nt", reason="links need rights there")
@pytest.mark.parametrize(
    "linked", ["line_follower/line_follower.ino", "line_follower/adapters.h", "line_follower/notes.h", "line_follower"]
)
def test_a_project_for_wokwi_gets_nothing_from_outside_of_the_migration(
    linked: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder)
    assert run("migrate", "line_follower.c", "--hardware", "line_following_robot.fzz", "-o", "out").code == 0
    secret = folder / "secret"
    if (folder / "out" / linked).exists():
        (folder / "out" / linked).rename(secret)
    else:
        secret.write_text("a key")
    (folder / "out" / linked).symlink_to(secret)
    outcome = run("wiring", "out", "--as", "wokwi", "-o", "wok")
    assert outcome.code == 3
    assert "the output folder" in outcome.err
    assert "a link" in outcome.err
    assert not (folder / "wok").exists()
