"""Processes that end with the run that started them."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import pytest

from robosmi.verify.toolchains.processes import ending_with_us, in_parallel
from tests.running import alive

_SLEEPS = [sys.executable, "-c", "import time; time.sleep(60)"]
_start = partial(subprocess.Popen[str], _SLEEPS, start_new_session=True, text=True)


def is_gone(number: int) -> bool:
    """Whether a process ends within five seconds."""
    for _ in range(100):
        if not alive(number):
            return True
        time.sleep(0.05)
    return False


@pytest.mark.skipif(not hasattr(signal, "SIGQUIT"), reason="this system does not have the signals")
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGQUIT"])
def test_an_interruption_while_a_process_is_started_ends_it(name: str) -> None:
    number = signal.Signals[name]
    started: list[int] = []

    def asked(number: int, _: object) -> None:
        raise KeyboardInterrupt

    def start() -> subprocess.Popen[str]:
        process = _start()
        started.append(process.pid)
        signal.raise_signal(number)  # it runs, and nobody has its handle yet
        return process

    before = signal.signal(number, asked)
    try:
        with pytest.raises(KeyboardInterrupt), ending_with_us(start):
            pytest.fail("the interruption is lost")
        assert signal.getsignal(number) is asked
    finally:
        signal.signal(number, before)
    assert is_gone(started[0])


def test_the_block_ends_the_process_and_what_it_has_started() -> None:
    sleeps = f"import subprocess, sys, time; print(subprocess.Popen({_SLEEPS}).pid, flush=True); time.sleep(60)"
    command = [sys.executable, "-c", sleeps]
    start = partial(subprocess.Popen[str], command, start_new_session=True, text=True, stdout=subprocess.PIPE)
    with ending_with_us(start) as process:
        assert process.stdout is not None
        grandchild = int(process.stdout.readline())
    assert process.returncode == -signal.SIGKILL
    assert is_gone(grandchild)


def test_what_cannot_be_started_is_told() -> None:
    with pytest.raises(FileNotFoundError), ending_with_us(partial(subprocess.Popen[str], ["no such program"])):
        pytest.fail("it runs")


def test_results_come_in_order_and_jobs_are_taken_as_needed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("os.cpu_count", lambda: 2)
    taken: list[int] = []

    def jobs() -> Iterator[int]:
        for number in range(9):
            taken.append(number)
            yield number

    results = in_parallel(lambda number: number * number, jobs())
    assert next(results) == 0
    assert taken == [0, 1, 2]
    assert list(results) == [1, 4, 9, 16, 25, 36, 49, 64]


@pytest.mark.parametrize("how", ["closed", "a job fails"])
def test_who_wants_no_more_results_ends_the_processes_of_all_jobs(how: str, tmp_path: Path) -> None:
    started: list[int] = []

    def job(number: int) -> int:
        if number == 0:
            while not started:
                time.sleep(0.01)
            if how == "a job fails":
                raise ValueError("this one")
            return 0
        with ending_with_us(_start) as process:
            started.append(process.pid)
            process.wait()
        return number

    results = in_parallel(job, range(20))
    begun = time.monotonic()
    if how == "closed":
        assert next(results) == 0
        results.close()
    else:
        with pytest.raises(ValueError, match="this one"):
            next(results)
    assert time.monotonic() - begun < 20
    assert all(is_gone(number) for number in started)
