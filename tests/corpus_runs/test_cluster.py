"""A corpus on a cluster of Dask: scheduler and workers are processes of their own, and one is killed on the way."""

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

import pytest

from tests.corpus_runs.running_corpora import command, copied, environment, faulty, rows, run_faulty

pytest.importorskip("distributed", reason="distributed is not installed (extra cluster)")
pytestmark = pytest.mark.processes
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
        opened = [
            stack.enter_context(started(
                "distributed.cli.dask_worker", place, "--nthreads", "1", "--no-nanny", "--no-dashboard", "--local-directory",
                str(folder / f"worker{number}"), **variables,
            )) for number in range(workers)
        ]  # fmt: skip
        for each in opened:
            address(each, r"Registered to")
        yield place, opened, scheduler


def finished(begun: subprocess.Popen[str]) -> tuple[int, Any]:
    out, err = begun.communicate(timeout=_PATIENCE)
    assert "Traceback" not in err, err
    return begun.returncode, json.loads(out)


def test_a_worker_that_dies_loses_nothing(tmp_path: Path) -> None:
    names = [f"p{number:02}" for number in range(20)]
    spec = faulty(tmp_path / "all", limits="seconds = 30", **dict.fromkeys(names, "slow"), bad="crash")
    out = tmp_path / "out"
    log = spec.parent / "programs" / "log"
    with cluster(tmp_path) as (place, workers, _):
        words = command("run", spec, "-o", out, "--scheduler", place, "--json")
        begun = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment())
        deadline = time.monotonic() + _PATIENCE
        while time.monotonic() < deadline and (not log.is_file() or len(log.read_text(encoding="utf-8").splitlines()) < 4):
            time.sleep(0.1)
        os.kill(workers[0].pid, signal.SIGKILL)
        code, document = finished(begun)
    assert (code, document["result"]["done"], document["result"]["failed"]) == (1, 20, 1)
    assert {row[0] for row in rows(out, "SELECT id FROM programs WHERE state = 'done'")} == {f"programs/{n}.c" for n in names}
    assert len(rows(out, "SELECT id FROM programs")) == 21


def test_the_rows_are_those_of_the_pool(tmp_path: Path) -> None:
    spec = copied(tmp_path)
    with cluster(tmp_path, workers=1) as (place, _, _):
        done = subprocess.run(
            command("run", spec, "-o", tmp_path / "cluster", "--scheduler", place), capture_output=True, text=True, check=False
        )
        assert done.returncode == 3, "its workers have the plug-in, and the run has not"
        assert "no worker has" in done.stderr
    with cluster(tmp_path, workers=1, PYTHONPATH="") as (place, _, _):
        words = command("run", spec, "-o", tmp_path / "cluster", "--scheduler", place)
        subprocess.run(words, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(command("run", spec, "-o", tmp_path / "pool"), check=True, stdout=subprocess.DEVNULL)
    for table in ("calls", "pins", "findings"):
        sql = f"SELECT * FROM {table} ORDER BY 1, 2, 3, 4, 5"
        assert rows(tmp_path / "cluster", sql) == rows(tmp_path / "pool", sql)


def test_no_scheduler(tmp_path: Path) -> None:
    spec = faulty(tmp_path / "all", a="good")
    code, document = run_faulty("run", spec, "-o", tmp_path / "out", "--scheduler", "tcp://127.0.0.1:9")
    assert code == 3
    assert "no scheduler" in document["findings"][0]["message"]


def test_a_scheduler_that_dies_ends_the_run_which_goes_on_later(tmp_path: Path) -> None:
    spec = faulty(tmp_path / "all", **{f"p{number:02}": "slow" for number in range(16)})
    out, log = tmp_path / "out", tmp_path / "all" / "programs" / "log"
    with cluster(tmp_path, workers=1) as (place, _, scheduler):
        words = command("run", spec, "-o", out, "--scheduler", place, "--json")
        begun = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment())
        deadline = time.monotonic() + _PATIENCE
        while time.monotonic() < deadline and (not log.is_file() or len(log.read_text(encoding="utf-8").splitlines()) < 3):
            time.sleep(0.1)
        scheduler.kill()
        code, document = finished(begun)
        assert code == 3
        assert "does not answer" in document["findings"][0]["message"]
    stored = rows(out, "SELECT count(*) FROM programs")[0][0]
    assert 1 <= stored < 16
    code, document = run_faulty("run", spec, "-o", out)
    assert (code, document["result"]["done"], document["result"]["run"]) == (0, 16, 16 - stored)
