"""Helpers of the tests of corpus runs: runs in processes of their own, and questions to their stores."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Generator, Iterator, Sequence
from pathlib import Path
from typing import Any

from robosmi.corpus.jobs import ProgramJob, ProgramResult
from robosmi.corpus.running import CorpusRun, RunOptions, Summary
from robosmi.corpus.spec import read_spec
from robosmi.corpus.store import Store

HERE = Path(__file__).parent
PLUGIN = HERE / "faulty_plugin"


def copied(folder: Path) -> Path:
    """The corpus of the fixtures in a folder of its own; its specification."""
    shutil.copytree(HERE / "programs", folder / "programs")
    return Path(shutil.copy(HERE / "corpus.toml", folder))


def faulty(folder: Path, *, limits: str = "seconds = 60", **programs: str) -> Path:
    """A corpus for the plug-in: programs with the texts given; its specification."""
    (folder / "programs").mkdir(parents=True)
    for name, text in programs.items():
        (folder / "programs" / f"{name}.c").write_text(text, encoding="utf-8")
    spec = folder / "corpus.toml"
    spec.write_text(f'[[programs]]\nglob = "programs/*.c"\n[limits]\n{limits}\n', encoding="utf-8")
    return spec


def command(*words: str | Path) -> list[str]:
    """The command line of `robosmi corpus`."""
    return [sys.executable, "-m", "robosmi", "corpus", *map(str, words)]


def environment() -> dict[str, str]:
    """The environment in which the plug-in is installed."""
    return {**os.environ, "PYTHONPATH": os.pathsep.join([str(PLUGIN), os.environ.get("PYTHONPATH", "")])}


def run_faulty(*words: str | Path) -> tuple[int, Any]:
    """Run the command with the plug-in installed: exit code and document."""
    done = subprocess.run(command(*words, "--json"), capture_output=True, text=True, env=environment(), check=False)
    assert "Traceback" not in done.stderr, done.stderr
    return done.returncode, json.loads(done.stdout)


STOPPED = """
import sys, time, robosmi
run = robosmi.corpus.run(*sys.argv[1:3], jobs=1, scheduler=sys.argv[3] if sys.argv[3:] else None)
next(iter(run))
time.sleep(0.5)
run.stop()
print(run.summary.programs, run.summary.done, len(run), run.running)
"""
"""Stops a run of two programs after the first."""


def stopped(folder: Path, *scheduler: str) -> str:
    """What is said about a run from Python that is stopped while its second program hangs, for whose end nobody could wait."""
    spec = faulty(folder / "all", limits="seconds = 3600", a="good", b="hang")
    words = [sys.executable, "-c", STOPPED, str(spec), str(folder / "out"), *scheduler]
    done = subprocess.run(words, capture_output=True, text=True, env=environment(), check=False, timeout=90)
    assert not done.stderr
    return done.stdout.strip()


def rows(out: Path, sql: str) -> list[tuple[Any, ...]]:
    """The rows that answer a question."""
    store = Store(out / "corpus.sqlite")
    try:
        return store.query(sql).rows
    finally:
        store.close()


def run_here(
    spec: Path, out: Path, run_one: Callable[[ProgramJob], ProgramResult], steps: Sequence[str] = ("analyse",)
) -> Summary:
    """Run a corpus in this process: what each program results in is what a function says."""

    def backend(jobs: Iterator[ProgramJob], steps: Sequence[str]) -> Generator[ProgramResult, None, None]:
        yield from map(run_one, jobs)

    made = CorpusRun(read_spec(spec), out, RunOptions(tuple(steps)))
    list(made.results(backend))
    return made.summary
