"""Runs into one folder at once and killed, in few rounds; `python -m tests.fuzz.runs` does many."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from filelock import FileLock

import robosmi
from robosmi.errors import StoppedError
from robosmi.files import run_lock as at_work
from robosmi.files.recovery import STAGE
from robosmi.transformations.chains.generate import generate
from tests.fuzz import runs
from tests.running import tree


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


def test_a_lock_is_the_same_whether_it_is_taken_at_once_or_waited_for(tmp_path: Path) -> None:
    out = tmp_path / "out"
    with at_work.alone(out):
        lock = next((tmp_path / "home" / "runs").glob("*.lock"))
        assert lock.with_suffix(".who").read_text() == str(os.getpid())
    for _ in range(2):  # what failed leaves nothing behind
        with FileLock(lock), pytest.raises(StoppedError, match=rf"process {os.getpid()}\) is active"), at_work.alone(out, 0.1):
            pass
        with at_work.alone(out, 0.1):
            pass


HOLDER = """
import sys, time
from pathlib import Path
from robosmi.files.recovery import at_work
out, mark = map(Path, sys.argv[1:])
with at_work(out):
    print("in", flush=True)
    sys.stdin.readline()
    time.sleep(0.5)
    mark.write_text("the writer has ended")
"""


@contextmanager
def living_writer(out: Path, mark: Path) -> Iterator[subprocess.Popen[str]]:
    """Another process's run that works in a folder until it receives a line, and half a second longer."""
    words = [sys.executable, "-c", HOLDER, str(out), str(mark)]
    with subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as writer:
        assert writer.stdout is not None
        assert writer.stdout.readline() == "in\n"
        yield writer
        writer.kill()


@pytest.mark.parametrize("output", ["out", "other"], ids=["into its own folder", "into another one"])
def test_generate_waits_for_a_living_writer_in_the_folder_of_its_plan(
    output: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out, mark = tmp_path / "out", tmp_path / "mark"
    robosmi.migrate([runs.programs(tmp_path)[0]], out)
    before = tree(out)
    with living_writer(out, mark) as writer:
        with monkeypatch.context() as patched:
            patched.setattr("robosmi.files.run_lock.PATIENCE", 0.2)
            with pytest.raises(StoppedError, match=rf"process {writer.pid}\) is active"):
                generate(out / "models" / "plan.xmi", tmp_path / output)
        assert tree(out) == before
        assert not (tmp_path / "other").exists()
        assert writer.stdin is not None
        writer.stdin.write("\n")
        writer.stdin.flush()
        assert not mark.exists()
        generate(out / "models" / "plan.xmi", tmp_path / output)
        assert mark.read_text() == "the writer has ended", "generate went on before"
    assert (tmp_path / output / "models" / "plan.xmi").is_file()
