"""The figures of the README, measured: cold and warm migration of the line follower, its two analyses, import, memory.

`make bench`. Each figure is the best and the median of several runs, since other work on the machine only adds; beside
it stands its ratio to a reference measured in the same run (an interpreter that does nothing; a bare parse by libclang),
which tells more than seconds on a noisy machine. Exit 1 when a best figure is over its bound.
"""

from __future__ import annotations

import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

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


def warm(folder: Path) -> Callable[[], float]:
    """A function that migrates in this process and returns the seconds."""
    import robosmi

    def run() -> float:
        start = time.perf_counter()
        robosmi.migrate([SOURCE], folder / "warm")
        return time.perf_counter() - start

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


def main() -> int:
    """Measure, print, compare."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        os.environ["ROBOSMI_HISTORY"] = str(folder / "history.sqlite")
        os.environ.pop("PYTHONDONTWRITEBYTECODE", None)  # an installed program has its bytecode
        robosmi = [sys.executable, "-m", "robosmi"]
        command = [*robosmi, "migrate", str(SOURCE), "-o", str(folder / "cold")]
        start = measure(process([sys.executable, "-c", "pass"]), 20)
        imported = measure(process([sys.executable, "-c", "import robosmi"]), 20)
        cold = measure(process(command, folder / "cold"), 20)
        analyse = measure(process([*robosmi, "analyse", str(SOURCE)]), 20)
        hardware = measure(process([*robosmi, "hardware", str(DRAWING)]), 20)
        memory = peak_megabytes(command)
        parse = measure(bare_parse(), 20)
        in_process = measure(warm(folder), 50)  # the first ten or so still warm the interpreter up
    rows = [
        ("cold migrate, whole process", cold, 1.0, start, "interpreter start"),
        ("cold analyse, whole process", analyse, 0.5, start, "interpreter start"),
        ("cold hardware, whole process", hardware, 0.5, start, "interpreter start"),
        (
            "import robosmi, over the interpreter",
            tuple(max(a - b, 0.0) for a, b in zip(imported, start, strict=True)),
            0.150,
            start,
            "interpreter start",
        ),
        ("warm migrate() in process", in_process, 0.060, parse, "bare parse"),
    ]
    print(f"{'':38}{'best':>10}{'median':>10}{'bound':>10}   ratio")
    good = True
    for title, (best, median), bound, reference, what in rows:
        good &= best <= bound
        print(f"{title:38}{best * 1000:8.1f}ms{median * 1000:8.1f}ms{bound * 1000:8.0f}ms   {best / reference[0]:.1f} x {what}")
    good &= memory <= 150
    print(f"{'cold migrate, most memory':38}{memory:8.1f}MB{'':10}{150:8.0f}MB")
    print(f"this process: {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MB after all runs")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
