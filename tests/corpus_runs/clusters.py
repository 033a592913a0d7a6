"""A cluster of Dask for tests: its scheduler and its workers are processes of their own, which are killed at the end."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

from tests.corpus_runs.running_corpora import command, environment, faulty

_PATIENCE = 90
Process = subprocess.Popen[str]


@contextmanager
def started(*words: str, **variables: str) -> Iterator[subprocess.Popen[str]]:
    """A process of Dask, which is killed at the end."""
    process = subprocess.Popen(
        [sys.executable, "-m", *words], stderr=subprocess.PIPE, text=True, env={**environment(), **variables},
        start_new_session=True,
    )  # fmt: skip
    try:
        yield process
    finally:
        process.kill()
        assert process.stderr is not None
        process.stderr.close()
        process.wait()


def address(process: subprocess.Popen[str], pattern: str) -> str:
    """What a process of Dask says once it is ready."""
    assert process.stderr is not None
    for line in process.stderr:
        if found := re.search(pattern, line):
            return found[1] if found.groups() else ""
    raise AssertionError("it has ended")


@contextmanager
def cluster(folder: Path, workers: int = 2, **variables: str) -> Iterator[tuple[str, list[Process], Process]]:
    """The address of a scheduler, its workers, and its process."""
    flags = ["--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--no-jupyter"]
    with ExitStack() as stack:
        scheduler = stack.enter_context(started("distributed.cli.dask_scheduler", *flags))
        place = address(scheduler, r"Scheduler at:\s+(tcp://\S+)")
        opened = [stack.enter_context(started(*_worker(place, folder / f"worker{n}"), **variables)) for n in range(workers)]
        for each in opened:
            address(each, r"Registered to")
        yield place, opened, scheduler


def _worker(place: str, folder: Path) -> list[str]:
    """The words that start a worker."""
    flags = ["--nthreads", "1", "--no-nanny", "--no-dashboard", "--local-directory", str(folder)]
    return ["distributed.cli.dask_worker", place, *flags]


@contextmanager
def other_worker(folder: Path, place: str) -> Iterator[None]:
    """A further worker of a cluster, without the plug-in."""
    with started(*_worker(place, folder / "other"), PYTHONPATH="") as process:
        address(process, r"Registered to")
        yield


def finished(begun: subprocess.Popen[str]) -> tuple[int, Any]:
    """Exit code and document of a run, once it has ended."""
    out, err = begun.communicate(timeout=_PATIENCE)
    assert "Traceback" not in err, err
    return begun.returncode, json.loads(out)


def run_with_a_lost_worker(folder: Path, *words: str) -> tuple[Path, int, Any]:
    """Run 21 programs, of which one crashes, on two workers, and kill one of these midway: output folder, exit code, document."""
    names = [f"p{number:02}" for number in range(20)]
    spec = faulty(folder / "all", limits="seconds = 30", **dict.fromkeys(names, "slow"), bad="crash")
    out, log = folder / "out", spec.parent / "programs" / "log"
    with cluster(folder) as (place, workers, _):
        line = command("run", spec, "-o", out, "--scheduler", place, "--json", *words)
        begun = subprocess.Popen(line, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment())
        until_lines(log, 4)
        os.kill(workers[0].pid, signal.SIGKILL)
        code, document = finished(begun)
    return out, code, document


def until_lines(log: Path, count: int) -> None:
    """Wait until so many programs have written their line into the log of the plug-in."""
    deadline = time.monotonic() + _PATIENCE
    while time.monotonic() < deadline and (not log.is_file() or len(log.read_text(encoding="utf-8").splitlines()) < count):
        time.sleep(0.1)
