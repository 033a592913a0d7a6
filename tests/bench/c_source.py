"""The speed of the C reader against libclang's bare parse of the same files in the same run, and what large programs cost.

Programs and headers are those below ROBOSMI_CORPUS, else the programs are the ones of the tests. A file's figure is the least
processor time of several runs in which the stages take turns, so that a busy machine slows all of them; files are added up.
Partition is what the dispositions need (constructs of the platform and of the standard library), everything is the whole report
with all findings and pin uses.
"""

from __future__ import annotations

import multiprocessing
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import suppress
from pathlib import Path
from typing import Any

from tests.bench.figures import Figure, not_measured

ROOT = Path(__file__).resolve().parents[2]
TIMES = 5
FILES = 160
"""How many programs are timed one by one."""
FUNCTION = """\
int function_{0}(int x)
{{
  int a = x + {0};
  int b[4] = {{1, 2, {0}, 4}};
  for (int i = 0; i < 4; i++) {{
    a += b[i] * 3;
    if (a > 100) high(a % 32);
    else low(b[i]);
  }}
  while (input(x) == 0) {{
    pause({0} % 50);
    a--;
  }}
  print("%d %d\\n", a, total);
  total = total + a;
  OUTA |= 1 << (a & 15);
  return a;
}}

// the next function
""".splitlines()
"""Of the synthetic program: declarations, loops, branches and five calls of the platform."""
CALLS = 5
PLATFORM = "propeller"
BOUNDS = {("partition", False): 4.0, ("partition", True): 1.6, ("everything", False): 7.0, ("everything", True): 2.2}
"""Bounds of each stage as multiples of the bare parse, without and with the headers."""
MEGABYTES, POOL = 600, 3.0


def corpus() -> list[Path]:
    """The programs."""
    folder = os.environ.get("ROBOSMI_CORPUS")
    found = sorted(Path(folder).rglob("*.c")) if folder else []
    own = [*(ROOT / "docs" / "examples").rglob("*.c"), *(ROOT / "tests" / "transformations").rglob("*.c")]
    paths = found or [p for p in sorted(own) if p.parent.name not in ("bad", "damaged")]
    return [p for p in paths if 0 < p.stat().st_size < 200_000]


def headers() -> list[str]:
    """The include folders with the platform's headers; none without a corpus."""
    folder = os.environ.get("ROBOSMI_CORPUS")
    if not folder:
        return []
    folders = {str(p.parent) for p in (Path(folder) / "parallaxinc").rglob("*.h") if "include/sys" not in p.as_posix()}
    return sorted(folders, key=lambda f: (not f.endswith("lib/include"), f))


def bare(path: Path, folders: Sequence[str]) -> None:
    """Let libclang parse a file, and nothing else."""
    from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
    from robosmi.transformations.t2m.c_source.parsing import clang

    settings = ApiIndex.load(PLATFORM).settings["parser"]
    arguments = ["-x", "c", f"-std={settings['standard']}", "-nostdinc", "-target", settings["target"], "-Wno-everything"]
    arguments += [f"-D{name}" for name in settings["defines"]] + [f"-I{folder}" for folder in folders]
    unit = clang.parse(str(path), arguments, [], 0)
    if unit:
        clang.library().disposeTranslationUnit(unit)


def partition(path: Path, folders: Sequence[str]) -> None:
    """Analyse a file up to its partition: what belongs to the platform, what is standard, what is unknown."""
    from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
    from robosmi.transformations.queries import code
    from robosmi.transformations.t2m.c_source import read_program

    program, _ = read_program(path, platform=PLATFORM, include_dirs=folders)
    for view in code.views(program, ApiIndex.load(PLATFORM)):
        view.functions_of("platform", "standard", "posix")
        view.unknown()
        view.symbols()
        view.types()


def everything(path: Path, folders: Sequence[str]) -> None:
    """Analyse a file up to the whole report, with all findings and pin uses."""
    from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
    from robosmi.transformations.queries.reports.analysis import analysis
    from robosmi.transformations.t2m.c_source import read_program

    program, findings = read_program(path, platform=PLATFORM, include_dirs=folders)
    analysis(program, findings, ApiIndex.load(PLATFORM))


STAGES: dict[str, Callable[[Path, Sequence[str]], None]] = {"bare parse": bare, "partition": partition, "everything": everything}


def seconds(paths: Sequence[Path], folders: Sequence[str]) -> dict[str, float]:
    """The time of each stage, over all files; files that the reader refuses count with what that takes."""
    from robosmi.errors import RobosmiError

    total = dict.fromkeys(STAGES, 0.0)
    for path in paths:
        best = dict.fromkeys(STAGES, float("inf"))
        for _ in range(TIMES):
            for stage, run in STAGES.items():
                start = time.process_time()
                with suppress(RobosmiError):
                    run(path, folders)
                best[stage] = min(best[stage], time.process_time() - start)
        for stage, took in best.items():
            total[stage] += took
    return total


def synthetic(lines: int) -> str:
    """A program of so many lines, most of them in functions as `FUNCTION`."""
    made = ['#include "simpletools.h"', "", "int total;", ""]
    for number in range(max(1, lines // len(FUNCTION))):
        made += [line.format(number) for line in FUNCTION]
    return "\n".join([*made, "int main() { while (1) function_0(1); }", ""])


def most_lines() -> int:
    """Those of the largest synthetic program that the reader takes, which counts calls."""
    from robosmi.transformations.t2m.c_source.expressions import MOST_CALLS

    return (MOST_CALLS - 1) // CALLS * len(FUNCTION)


def on_demand(path: str) -> tuple[float, float]:
    """Seconds and megabytes of a migration's queries to a program read on demand, in this process."""
    from robosmi.metamodels import ccode
    from robosmi.query import all_of_kind
    from robosmi.transformations.t2m.c_source.on_demand import open_program

    start = time.perf_counter()
    model = open_program(path, platform=PLATFORM)
    calls = all_of_kind(model, ccode.Call)
    names = {str(call.calleeName) for call in calls}
    assert "high" in names
    assert len(model.all_of_kind("Function")) > 10
    return time.perf_counter() - start, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def growth(lines: int) -> list[tuple[int, float, float]]:
    """(lines, seconds, megabytes) of reading on demand a tenth, a half and the whole; each in its own process."""
    found = []
    with tempfile.TemporaryDirectory() as folder:
        for part in (lines // 10, lines // 2, lines):
            path = Path(folder) / f"synthetic_{part}.c"
            path.write_text(synthetic(part))
            script = f"from tests.bench.c_source import on_demand; print(*on_demand({str(path)!r}))"
            out = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True, cwd=ROOT).stdout
            took, memory = map(float, out.split())
            found.append((part, took, memory))
    return found


def _one(job: tuple[str, Path, Sequence[str]]) -> None:
    from robosmi.errors import RobosmiError

    stage, path, folders = job
    with suppress(RobosmiError):
        STAGES[stage](path, folders)


def pooled(stage: str, paths: Sequence[Path], folders: Sequence[str]) -> float:
    """Seconds of a stage over all files in a pool of processes, with a progress bar on a terminal."""
    context: Any = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(os.cpu_count(), mp_context=context) as pool:
        list(pool.map(_one, [(stage, paths[0], folders)] * 8))  # so that every process has loaded what it needs
        start = time.perf_counter()
        for done, _ in enumerate(pool.map(_one, [(stage, path, folders) for path in paths], chunksize=8), 1):
            if sys.stderr.isatty() and (done % 20 == 0 or done == len(paths)):
                bar = "#" * (40 * done // len(paths))
                print(f"\r{stage:12} [{bar:40}] {done}/{len(paths)}", end="\n" if done == len(paths) else "", file=sys.stderr)
        return time.perf_counter() - start


def figures() -> Iterator[Figure]:
    """Ratios to the bare parse, one by one and in a pool of processes; growth of time and memory with the size of a program."""
    paths = corpus()
    sample = paths[:: max(1, len(paths) // FILES)]
    for folders in [[], headers()] if headers() else [[]]:
        kind = "with headers" if folders else "without headers"
        times = seconds(sample, folders)
        for stage in ("partition", "everything"):
            ratio, each = times[stage] / times["bare parse"], times[stage] / len(sample) * 1000
            note = f"to a bare parse; {each:.1f} ms a file, {len(sample)} files"
            yield Figure(f"C reader, {stage}, {kind}", ratio, "x", BOUNDS[stage, bool(folders)], note=note)
    if not headers():
        yield not_measured("C reader, with headers", "set ROBOSMI_CORPUS to a folder with programs and parallaxinc's headers")
    rows = growth(most_lines())
    (few, little, _), (lines, took, memory) = rows[0], rows[-1]
    yield Figure(
        f"{lines:,} lines on demand, peak memory", memory, "MB", MEGABYTES, note=f"{took:.1f} s; the most that the reader takes"
    )
    yield Figure(f"{lines:,} lines on demand, time per line", took / lines / (little / few), "x", 2, note=f"to {few:,} lines")
    for folders in [[], headers()] if headers() else [[]]:
        kind = "with headers" if folders else "without headers"
        times = {stage: pooled(stage, paths, folders) for stage in STAGES}
        for stage in ("partition", "everything"):
            note = f"to a bare parse; {len(paths)} files in {times[stage]:.1f} s"
            yield Figure(f"C reader in a pool, {stage}, {kind}", times[stage] / times["bare parse"], "x", POOL, note=note)
