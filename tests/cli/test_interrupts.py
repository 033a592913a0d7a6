"""Commands that a person interrupts, at few points; `python -m tests.fuzz.interrupts` tries many."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import pytest

from robosmi.__main__ import start
from robosmi.model import commit as commit_module
from robosmi.model.commit import commit
from robosmi.model.open_folder import OpenFolder
from robosmi.model.recovery import STAGE, finish
from tests.fuzz import interrupts
from tests.running import tree


@pytest.fixture(autouse=True)
def handler() -> Iterator[None]:
    """Ctrl-C means what it meant, after the test."""
    before = signal.getsignal(signal.SIGINT)
    yield
    signal.signal(signal.SIGINT, before)


def test_a_migration_that_is_interrupted_leaves_nothing_half(tmp_path: Path) -> None:
    found = interrupts.points(8, tmp_path)
    assert found["wrong"] == 0
    assert found["interrupted"] >= 6, "few points lay in the run: the test shows nothing"


def test_the_judge_sees_what_is_wrong(tmp_path: Path) -> None:
    folder = tmp_path / "out"
    assert interrupts.wrong(folder, 130, "robosmi: interrupted\n", [{}]) == ""
    assert interrupts.wrong(folder, 70, "", [{}])
    assert interrupts.wrong(folder, 130, "", [{}])
    assert interrupts.wrong(folder, 130, "Traceback\nrobosmi: interrupted\n", [{}])
    (tmp_path / f"{STAGE}-out").mkdir()
    assert interrupts.wrong(folder, 0, "", [{}])
    folder.mkdir()
    (folder / "a").touch()
    assert interrupts.wrong(folder, 0, "", [{}])


def test_an_interruption_while_the_program_is_loaded_is_said(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    class Loading(ModuleType):
        def __getattr__(self, name: str) -> object:
            raise KeyboardInterrupt

    monkeypatch.setitem(sys.modules, "robosmi.cli.main", Loading("robosmi.cli.main"))
    assert start() == 130
    assert capsys.readouterr().err == "robosmi: interrupted\n"
    assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN


@pytest.mark.parametrize("new", [True, False], ids=["a new folder", "a folder that is there"])
def test_nothing_waits_beside_the_files_after_an_interruption(new: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    if not new:
        commit(tmp_path / "out", {"a": b"old"})
    before = tree(tmp_path)
    with monkeypatch.context() as patched:
        patched.setattr(OpenFolder, "write", _interrupted)
        with pytest.raises(KeyboardInterrupt):
            commit(tmp_path / "out", {"a": b"new", "b": b"new"})
    assert tree(tmp_path) == before


def _interrupted(*_: object) -> None:
    raise KeyboardInterrupt


def test_what_has_its_journal_is_finished_before_an_interruption_counts(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> None:
    commit(tmp_path / "out", {"a": b"old", "b": b"old"})

    def interrupted(held: OpenFolder) -> None:
        os.kill(os.getpid(), signal.SIGINT)
        finish(held)

    monkeypatch.setattr(commit_module, "finish", interrupted)
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # which a process in the background ignores
    request.addfinalizer(lambda: signal.signal(signal.SIGINT, before))
    with pytest.raises(KeyboardInterrupt):
        commit(tmp_path / "out", {"a": b"new", "b": b"new"})
    assert {path.name: path.read_bytes() for path in (tmp_path / "out").iterdir()} == {"a": b"new", "b": b"new"}
