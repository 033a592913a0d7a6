"""Commands that a person interrupts, at few points; `python -m tests.fuzz.interrupts` tries many."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import pytest

from robosmi.__main__ import start
from robosmi.base.ending_signals import ending_signals
from robosmi.files import commit as commit_module
from robosmi.files.commit import commit
from robosmi.files.directory_fd import DirectoryFd
from robosmi.files.recovery import STAGE, finish
from tests.fuzz import interrupts
from tests.running import tree
from tests.tools import require_tools


@pytest.fixture(autouse=True)
def handler() -> Iterator[None]:
    """Restore the handler of Ctrl-C after the test."""
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
        patched.setattr(DirectoryFd, "write", _interrupted)
        with pytest.raises(KeyboardInterrupt):
            commit(tmp_path / "out", {"a": b"new", "b": b"new"})
    assert tree(tmp_path) == before


def _interrupted(*_: object) -> None:
    raise KeyboardInterrupt


@pytest.mark.parametrize("number", ending_signals(), ids=lambda number: number.name)
def test_what_has_its_journal_is_finished_before_an_interruption_counts(
    number: signal.Signals, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> None:
    commit(tmp_path / "out", {"a": b"old", "b": b"old"})

    def interrupted(held: DirectoryFd) -> None:
        signal.raise_signal(number)  # in this thread: a process may have others
        finish(held)

    monkeypatch.setattr(commit_module, "finish", interrupted)
    before = signal.signal(number, signal.default_int_handler)  # a process in the background ignores some
    request.addfinalizer(lambda: signal.signal(number, before))
    with pytest.raises(KeyboardInterrupt):
        commit(tmp_path / "out", {"a": b"new", "b": b"new"})
    assert {path.name: path.read_bytes() for path in (tmp_path / "out").iterdir()} == {"a": b"new", "b": b"new"}


@pytest.mark.parametrize("ending", [signal.SIGTERM, signal.SIGHUP], ids=["SIGTERM", "SIGHUP"])
def test_who_is_asked_to_end_leaves_no_process_and_no_temporary_file(ending: signal.Signals, tmp_path: Path) -> None:
    """A closed terminal, or an editor that ends what it has started, is as good as Ctrl-C."""
    require_tools("avr-g++", "arduino-core-avr")
    sketch, temporary = tmp_path / "blink" / "blink.ino", tmp_path / "temporary"
    temporary.mkdir()
    sketch.parent.mkdir()
    sketch.write_text("void setup() { pinMode(13, OUTPUT); }\nvoid loop() { digitalWrite(13, HIGH); delay(1); }\n")
    command = [sys.executable, "-m", "robosmi", "compile", str(sketch.parent), "--board", "uno"]
    environment = {**os.environ, "TMPDIR": str(temporary), "ROBOSMI_HOME": str(tmp_path / "home")}
    with subprocess.Popen(
        command, env=environment, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True,
        preexec_fn=lambda: signal.signal(ending, signal.SIG_DFL),  # nohup has it ignored
    ) as running:  # fmt: skip
        begun = time.monotonic()
        # a folder: the standard library tries the place with a file first, which an interruption may leave there
        while not any(path.is_dir() for path in temporary.iterdir()) and time.monotonic() - begun < 20:
            time.sleep(0.01)
        running.send_signal(ending)
        _, said = running.communicate(timeout=20)
    assert (running.returncode, said) == (128 + ending, "robosmi: interrupted\n")
    assert list(temporary.iterdir()) == []
