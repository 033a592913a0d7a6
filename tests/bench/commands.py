"""The figures of the README: cold and warm migration of the line follower, its two analyses, import, memory.

Each figure is the best of several runs, since other work on the machine only adds; the note has the median, and the ratio to a
reference that was measured in the same run: an interpreter that does nothing, or a bare parse by libclang.
"""

from __future__ import annotations

import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

from tests.bench.figures import Figure

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "docs" / "examples" / "line_follower" / "line_follower.c"
DRAWING = SOURCE.with_name("line_following_robot.fzz")


def process(arguments: list[str], output: Path | None = None) -> Callable[[], float]:
    """A function that deletes the previous output, runs a process, and returns its seconds; bytecode is written beforehand."""

    def run() -> float:
        if output is not None:
            shutil.rmtree(output, ignore_errors=True)
        start = time.perf_counter()
        subprocess.run(arguments, check=True, stdout=subprocess.DEVNULL, cwd=ROOT)
        return time.perf_counter() - start

    run()
    return run


def warm(folder: Path, again: bool) -> Callable[[], float]:
    """A function that migrates in this process, into the same folder or a new one each time, and returns the seconds."""
    import robosmi

    number = iter(range(10_000))

    def run() -> float:
        output = folder / ("again" if again else f"new{next(number)}")
        start = time.perf_counter()
        robosmi.migrate([SOURCE], output)
        return time.perf_counter() - start

    for _ in range(10):  # they still warm the interpreter up
        run()
    return run


def bare_parse() -> Callable[[], float]:
    """A function that lets libclang parse the source and nothing else, and returns the seconds."""
    from clang.cindex import Index

    index = Index.create()
    options = ["-x", "c", "-nostdinc", "-Wno-everything"]

    def run() -> float:
        start = time.perf_counter()
        index.parse(str(SOURCE), args=options)
        return time.perf_counter() - start

    run()
    return run


def measure(run: Callable[[], float], times: int) -> tuple[float, float]:
    """Best and median of some runs, seconds."""
    found = [run() for _ in range(times)]
    return min(found), statistics.median(found)


def peak_megabytes(arguments: list[str]) -> float:
    """Peak memory of a process in MB."""
    script = "import resource, subprocess, sys; subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL); "
    script += "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)"
    out = subprocess.run([sys.executable, "-c", script, *arguments], check=True, capture_output=True, text=True, cwd=ROOT).stdout
    return int(out) / 1024


def figures() -> Iterator[Figure]:
    """Times of the best run, and the peak memory."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        os.environ["ROBOSMI_HISTORY"] = str(folder / "history.sqlite")
        os.environ.pop("PYTHONDONTWRITEBYTECODE", None)  # an installed program has its bytecode
        robosmi = [sys.executable, "-m", "robosmi"]
        command = [*robosmi, "migrate", str(SOURCE), "-o", str(folder / "cold")]
        start = measure(process([sys.executable, "-c", "pass"]), 20)

        def cold(what: str, times: tuple[float, float], bound: float) -> Figure:
            return _figure(what, times, bound, f"{times[0] / start[0]:.1f} x interpreter start")

        yield cold("cold migrate, whole process", measure(process(command, folder / "cold"), 20), 1000)
        yield cold("cold analyse, whole process", measure(process([*robosmi, "analyse", str(SOURCE)]), 20), 500)
        yield cold("cold hardware, whole process", measure(process([*robosmi, "hardware", str(DRAWING)]), 20), 500)
        best, median = measure(process([sys.executable, "-c", "import robosmi"]), 20)
        over = max(best - start[0], 0.0), max(median - start[1], 0.0)
        yield cold("import robosmi, over the interpreter", over, 150)
        yield Figure("cold migrate, peak memory", peak_megabytes(command), "MB", 150)
        parse = measure(bare_parse(), 20)[0]
        for what, again in (("a new folder", False), ("the same folder", True)):
            times = measure(warm(folder, again), 50)
            yield _figure(f"warm migrate() into {what}", times, 60, f"{times[0] / parse:.0f} x bare parse")


def _figure(name: str, times: tuple[float, float], bound: float, ratio: str) -> Figure:
    best, median = times
    return Figure(name, best * 1000, "ms", bound, note=f"median {median * 1000:.0f} ms, {ratio}")
