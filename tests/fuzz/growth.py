"""Measure how the cost of each command grows with its input: seconds at a size, its half and its quarter, and the memory.

Usage: python -m tests.fuzz.growth [--only WORD] [--seconds N]. Run by hand (`make fuzz`), not by CI. Each run is a process of its
own. A family is reported that takes more than 10 s or 500 MB for an input under 100 kB, or that grows much faster than its input.
"""

from __future__ import annotations

import argparse
import os
import resource
import subprocess
import sys
import tempfile
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from tests.growing import FAMILIES, Growing

SECONDS, MEGABYTES, SMALL = 10.0, 500, 100_000
PER_BYTE = 1e-4
"""Seconds per byte of input that are suspicious for inputs beyond `SMALL`: 10 s for 100 kB."""
STEEP = 3.2
"""Factor by which the cost may grow for twice the input if it takes over a second; linear cost gives 2, quadratic 4."""


@dataclass(frozen=True)
class Measured:
    """One run: bytes of input, seconds of processor time, megabytes, exit code and output."""

    size: int
    seconds: float
    megabytes: int
    code: int
    said: str


def measured(family: Growing, n: int, limit: float) -> Measured:
    """Run a family's command once, in a process of its own.

    Args:
        family: what grows.
        n: the size.
        limit: seconds after which it is ended; the code is -9 then.
    """
    with tempfile.TemporaryDirectory(prefix="robosmi-growth-") as place:
        folder = Path(place)
        words = [str(word) for word in family.make(folder, n)]
        size = sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())
        environment = {**os.environ, "ROBOSMI_HOME": str(folder / "home")}
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        code = (
            "import resource, sys\nfrom robosmi.cli.main import main\ncode = main(sys.argv[1:])\n"
            "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024, file=sys.stderr)\nsys.exit(code)"
        )
        try:
            done = subprocess.run(
                [sys.executable, "-c", code, *words], capture_output=True, text=True, errors="replace", timeout=limit,
                env=environment, cwd=folder,
            )  # fmt: skip
        except subprocess.TimeoutExpired:
            return Measured(size, limit, 0, -9, "it was ended")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
        *said, memory = done.stderr.strip().splitlines() or [""]
        return Measured(size, seconds, int(memory) if memory.isdecimal() else 0, done.returncode, " ".join(said)[:160])


def judged(family: Growing, limit: float) -> tuple[str, list[Measured]]:
    """What is wrong with a family, "ok" for nothing; and its runs, the smallest first."""
    runs: list[Measured] = []
    for n in (family.size // 4, family.size // 2, family.size):
        runs.append(measured(family, n, limit))
        if runs[-1].code in (-9, 70) or runs[-1].code < 0:
            break
    last = runs[-1]
    if last.code == -9:
        return "HANGS", runs
    if last.code not in (0, 1, 2, 3, 4, 5, 6):
        return "CRASHES", runs
    if last.seconds > max(SECONDS, PER_BYTE * last.size) or (last.megabytes > MEGABYTES and last.size < SMALL):
        return "COSTS TOO MUCH", runs
    if len(runs) == 3 and last.seconds > 1 and last.seconds - runs[0].seconds > 0.4:
        start = max(0.0, 2 * runs[0].seconds - runs[1].seconds)  # what a run without an input takes
        if (last.seconds - start) > STEEP * max(runs[1].seconds - start, 0.1):
            return "STEEP", runs
    return "ok", runs


def main() -> int:
    """Measure all families, or those whose name holds a word."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--only", default="", help="a word in the names of the families to measure")
    arguments.add_argument("--seconds", type=float, default=240, help="on the clock, after which a run is ended")
    given = arguments.parse_args()
    found: Counter[str] = Counter()
    for family in FAMILIES:
        if given.only not in family.name:
            continue
        verdict, runs = judged(family, given.seconds)
        found[verdict] += 1
        times = " ".join(f"{run.seconds:6.2f}" for run in runs)
        print(f"{verdict:8} {family.name:50} {runs[-1].size / 1000:7.0f} kB {times} s {runs[-1].megabytes:5} MB {runs[-1].said}")
        sys.stdout.flush()
    print(f"growth: {sum(found.values())} families: {dict(found)}")
    return 0 if set(found) <= {"ok"} else 1


if __name__ == "__main__":
    sys.exit(main())
