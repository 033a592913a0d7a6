"""Cheap figures for CI that hold on any machine: ratios to work that is measured in turn with them, and counts.

The reference of a warm `migrate()` is `ast.unparse` of a module of the standard library: Python code with many small objects. The
reference of a cold command is an interpreter that imports the packages that RoboSMi is built on. Times are processor times; a
ratio is the median of several rounds. The counts do not depend on the machine at all: a warm `migrate()` does more work if it
calls more functions, and a cold command costs more if it loads more modules.

The bounds of ratios are a fifth above what this head needs, those of counts a twentieth. On 21 November 2026 (37e65686), when a
warm `migrate()` took less than 60 ms, it called 91,000 functions and took 1.7 times the reference; features that came since
call the others. A loop over a feature's values goes over a snapshot since 27 November 2026, which is a call for each loop: 9,000.
That day this head needed 4.0, 4.3 and 5.3 times where the one before needed 3.6, 4.1 and 5.5, on a machine that varied by
a fifth.
"""

from __future__ import annotations

import argparse as reference_module
import ast
import inspect
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import robosmi
from tests.bench.figures import Figure

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "docs" / "examples" / "line_follower" / "line_follower.c"
COLD_ROUNDS, WARM_ROUNDS = 7, 15
PACKAGES = "import clang.cindex, jinja2, lxml.etree, msgspec, pyecore.ecore"
MODULES = """
import sys
from robosmi.__main__ import start
code = start()
print(sum(name.partition(".")[0] == "robosmi" for name in sys.modules), file=sys.stderr)
"""


def in_children(command: list[str]) -> float:
    """Processor seconds of a process."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=ROOT)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def here(run: Callable[[], object]) -> float:
    """Processor seconds of a call in this process."""
    start = time.process_time()
    run()
    return time.process_time() - start


def python_calls(run: Callable[[], object]) -> int:
    """The number of Python functions that are called."""
    count = 0

    def profile(frame: object, event: str, argument: object) -> None:
        nonlocal count
        count += event == "call"

    sys.setprofile(profile)
    try:
        run()
    finally:
        sys.setprofile(None)
    return count


def figures() -> Iterator[Figure]:
    """Ratios and counts."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        os.environ["ROBOSMI_HISTORY"] = str(folder / "history.sqlite")
        os.environ["ROBOSMI_HOME"] = str(folder / "home")
        os.environ["XDG_CACHE_HOME"] = str(folder / "cache")
        os.environ.pop("PYTHONDONTWRITEBYTECODE", None)  # an installed program has its bytecode
        yield from cold(folder)
        yield from warm(folder)


def cold(folder: Path) -> Iterator[Figure]:
    """A migration in a process of its own."""
    migrate = ["migrate", str(SOURCE), "-o"]
    counted = [sys.executable, "-c", MODULES, *migrate, str(folder / "counted")]
    said = subprocess.run(counted, check=True, capture_output=True, text=True, cwd=ROOT).stderr  # fills the cache, too
    commands = [sys.executable, "-m", "robosmi", *migrate], [sys.executable, "-c", PACKAGES]
    in_children(commands[1])
    rounds = [
        in_children([*commands[0], str(folder / f"cold{number}")]) / in_children(commands[1]) for number in range(COLD_ROUNDS)
    ]
    yield Figure("cold migrate, to importing its packages", statistics.median(rounds), "x", 4.8)
    yield Figure("cold migrate, modules of ours", int(said.split()[-1]), "", 477)


def warm(folder: Path) -> Iterator[Figure]:
    """A migration in this process, into a new folder and again into the same one."""
    text = inspect.getsource(reference_module)
    number = iter(range(1000))

    def reference() -> None:
        ast.unparse(ast.parse(text))

    def again() -> None:
        robosmi.migrate([SOURCE], folder / "again")

    def fresh() -> None:
        robosmi.migrate([SOURCE], folder / f"fresh{next(number)}")

    for _ in range(5):
        again()
        fresh()
        reference()
    rounds = [(here(reference), here(fresh), here(again)) for _ in range(WARM_ROUNDS)]
    yield Figure("warm migrate(), new folder, to ast.unparse", statistics.median(b / a for a, b, _ in rounds), "x", 5.0)
    yield Figure("warm migrate(), same folder, to ast.unparse", statistics.median(c / a for a, _, c in rounds), "x", 6.0)
    yield Figure("warm migrate(), new folder, Python calls", python_calls(fresh), "", 236_000)
    yield Figure("warm migrate(), same folder, Python calls", python_calls(again), "", 268_000)
