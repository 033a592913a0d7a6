"""Fetching what the ground-truth tests read: from repositories beside the test, with all that can be missing there."""

from __future__ import annotations

import hashlib
import subprocess
from pathlib import Path

import pytest

from tests.corpus.fetch import Wanted, fetch, main, wanted
from tests.tools import require_tools


@pytest.fixture
def source(tmp_path: Path) -> tuple[str, str]:
    """The address of a folder with one repository `a/b`, and its commit."""
    require_tools("git")
    folder = tmp_path / "hub" / "a" / "b"
    (folder / "sub").mkdir(parents=True)
    for name in ("one.c", "sub/two.c", "sub/two.h", "sub/notes.txt"):
        (folder / name).write_text(name, encoding="utf-8")
    who = ["-c", "user.name=x", "-c", "user.email=x@example.org"]
    for words in (
        ["init", "--quiet"],
        ["add", "."],
        [*who, "commit", "--quiet", "-m", "x"],
        ["config", "uploadpack.allowFilter", "true"],
        ["config", "uploadpack.allowAnySHA1InWant", "true"],
    ):
        subprocess.run(["git", "-C", str(folder), *words], check=True)
    commit = subprocess.run(["git", "-C", str(folder), "rev-parse", "HEAD"], capture_output=True, text=True, check=True).stdout
    return f"file://{tmp_path / 'hub'}/", commit.strip()


def test_files_and_folders_of_a_commit_are_laid_out(source: tuple[str, str], tmp_path: Path) -> None:
    address, commit = source
    sha1 = hashlib.sha1(b"one.c").hexdigest()
    files = [
        Wanted("a/b", commit, "one.c", "c/a/b", sha1),
        Wanted("a/b", commit, "sub", "c/a/b", endings=frozenset({".c", ".h"})),
    ]
    assert list(fetch(files, tmp_path / "out", address)) == []
    found = {str(path.relative_to(tmp_path / "out")) for path in (tmp_path / "out").rglob("*") if path.is_file()}
    assert found == {"c/a/b/one.c", "c/a/b/sub/two.c", "c/a/b/sub/two.h"}
    assert list(fetch(files[:1], tmp_path / "out", "file:///nowhere/")) == [], "what is there is not fetched again"


def test_what_cannot_be_had_is_said_with_the_reason(source: tuple[str, str], tmp_path: Path) -> None:
    address, commit = source
    files = [
        Wanted("a/b", commit, "one.c", "x", "0" * 40),
        Wanted("a/b", commit, "gone.c", "x"),
        Wanted("a/b", "1" * 40, "one.c", "x"),
        Wanted("no/thing", commit, "one.c", "x"),
    ]
    said = sorted(fetch(files, tmp_path / "out", address))
    assert [line.partition(":")[0] for line in said] == [
        "a/b at 1111111111",
        "a/b/gone.c",
        "a/b/one.c",
        f"no/thing at {commit[:10]}",
    ]
    assert "not the file that was labelled" in said[2]
    assert not (tmp_path / "out").exists()


def test_all_tables_are_read_and_every_commit_is_whole() -> None:
    files = list(wanted())
    assert sum(one.place.startswith("corpus/") and not one.endings for one in files) == 156
    assert sum(one.place.startswith("drawings/") for one in files) > 240
    assert {len(one.commit) for one in files} == {40}


def test_without_a_network_everything_is_listed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    require_tools("git")
    some = list(wanted())[:1]
    monkeypatch.setattr("tests.corpus.fetch.wanted", lambda: iter(some))
    assert main([str(tmp_path / "out"), "--from", "file:///nowhere/"]) == 1
    out = capsys.readouterr().out
    assert "0 of 1 programs and drawings" in out
    assert f"cannot be had: {some[0].repository} at" in out
