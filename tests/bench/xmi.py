"""XMI against its peers, measured in one run: pyecore's own resource, and Eclipse EMF where Java is installed.

`make bench`, or `python tests/bench/xmi.py [--objects N]... [--runs N]`. The model is that of research: a program of functions,
statements, calls with opposites, literals. Ratios are what counts; seconds depend on the machine and are shown for information.
Exit 1 when a ratio misses its bound: load 4 times and save 5 times faster than pyecore (cyclic garbage collection on, as users
have it), bytes equal to EMF's, a million objects within 1.5 times per object and below 3 GB.
"""

from __future__ import annotations

import argparse
import gc
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from pyecore.resources import URI, ResourceSet

from robosmi.files.files import write_atomic
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.xmi.xmi_reader import read_models
from robosmi.model.xmi.xmi_writer import to_xmi

ROOT = Path(__file__).resolve().parents[2]
BENCH = ROOT / "tests" / "emf" / "bench.ecore"
PER_FUNCTION = 41  # a function, 10 statements, each with a call of two literals


def write_model(path: Path, objects: int, metamodel: Metamodel) -> int:
    """Write the model of about that many objects, by our writer; the exact number."""
    functions = max(1, objects // PER_FUNCTION)
    kinds = list(metamodel.StmtKind.eLiterals)
    make = [metamodel.Function(name=f"f{i}", line=i, column=1) for i in range(functions)]
    for i, function in enumerate(make):
        body = []
        for j in range(10):
            args = [metamodel.Literal(value=f"v{q}", line=i, column=q) for q in range(2)]
            call = metamodel.Call(line=i * 10 + j, column=8, callee=make[(i * 7 + j) % functions], args=args)
            body.append(metamodel.Stmt(line=i * 10 + j, column=4, kind=kinds[j % 4], exprs=[call]))
        function.body.extend(body)
    program = metamodel.Program(name="p", functions=make)
    path.write_bytes(to_xmi({path.name: program})[path.name])
    return 1 + functions * PER_FUNCTION


def timed(what: Callable[[], Any]) -> tuple[float, Any]:
    """Seconds and result of a call."""
    gc.collect()
    start = time.perf_counter()
    found = what()
    return time.perf_counter() - start, found


def ours(path: Path, metamodel: Metamodel) -> tuple[float, float]:
    """Seconds to load and to save."""
    load, models = timed(lambda: read_models(path, metamodel))
    root = next(iter(models.values()))
    target = path.with_name("ours.xmi")
    save, _ = timed(lambda: write_atomic(target, to_xmi({target.name: root})[target.name]))
    assert target.read_bytes() == path.read_bytes()
    return load, save


def theirs(path: Path) -> tuple[float, float]:
    """Seconds that pyecore's resource takes to load and to save."""
    resources = ResourceSet()
    package = resources.get_resource(URI(str(BENCH))).contents[0]
    resources.metamodel_registry[package.nsURI] = package
    load, read = timed(lambda: resources.get_resource(URI(str(path))))
    written = resources.create_resource(URI(str(path.with_name("pyecore.xmi"))))
    written.append(read.contents[0])
    save, _ = timed(written.save)
    return load, save


def emf(path: Path, runs: int) -> tuple[list[tuple[float, float]], bytes] | None:
    """Seconds that EMF takes in one process, first run first, and what it writes; None without Java."""
    target = path.with_name("emf.xmi")
    command = ["sh", str(ROOT / "tests/emf/check.sh"), str(BENCH), str(path), "-q", "--resave", str(target), "--bench", str(runs)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        return None
    if done.returncode:
        print(f"EMF: {done.stderr.strip() or done.stdout.strip()}")
        return None
    cold = re.search(r"\(load ([\d.]+) s, save ([\d.]+) s\)", done.stdout)
    warm = re.findall(r"bench \d+: load ([\d.]+) s, save ([\d.]+) s", done.stdout)
    assert cold
    return [(float(a), float(b)) for a, b in [cold.groups(), *warm]], target.read_bytes()


def spread(values: list[float]) -> str:
    """Median with the extremes, seconds."""
    return f"{statistics.median(values):7.3f} ({min(values):.3f}-{max(values):.3f})"


def compare(path: Path, count: int, runs: int, metamodel: Metamodel) -> tuple[bool, float]:
    """One size against the peers; whether the bounds are kept, and our seconds to load."""
    size = path.stat().st_size
    print(f"\n{count:,} objects, {size / 1e6:.1f} MB: load s, save s, median (best-worst) of {runs} runs in turn")
    rows: dict[str, list[tuple[float, float]]] = {"ours": [], "pyecore": []}
    for _ in range(runs):
        rows["ours"].append(ours(path, metamodel))
        rows["pyecore"].append(theirs(path))
    judged = emf(path, max(3, runs))
    good = True
    if judged is not None:
        rows["EMF, first in a new process"], rows["EMF, warm"] = judged[0][:1], judged[0][1:]
        same = judged[1] == path.read_bytes()
        good &= same
    mine = [statistics.median(column) for column in zip(*rows["ours"], strict=True)]
    for name, measured in rows.items():
        columns = [list(column) for column in zip(*measured, strict=True)]
        ratios = [statistics.median(column) / own for column, own in zip(columns, mine, strict=True)]
        times = "" if name == "ours" else f"   {ratios[0]:5.1f} x   {ratios[1]:5.1f} x ours"
        print(f"  {name:28}{spread(columns[0]):>26}{spread(columns[1]):>26}{times}")
        if name == "pyecore":
            good &= ratios[0] >= 4 and ratios[1] >= 5
    print(f"  bytes equal to EMF's: {'not judged, no Java' if judged is None else 'yes' if same else 'NO'}")
    return good, mine[0]


GROWTH = """
import gc, resource, sys, time
from pathlib import Path
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.xmi.xmi_reader import read_models
from robosmi.model.xmi.xmi_writer import to_xmi
mm, path = Metamodel.load(sys.argv[1]), Path(sys.argv[2])
start = time.perf_counter()
root = next(iter(read_models(path, mm).values()))
load = time.perf_counter() - start
start = time.perf_counter()
data = to_xmi({path.name: root})[path.name]
save = time.perf_counter() - start
assert data == path.read_bytes()
print(load, save, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
"""


def growth(folder: Path, small: tuple[Path, int], metamodel: Metamodel, runs: int) -> bool:
    """A million objects against 100,000: seconds per object and memory, each in processes of their own."""
    path = folder / "million.xmi"
    count = write_model(path, 1_000_000, metamodel)
    gc.collect()
    found: dict[Path, list[list[float]]] = {small[0]: [], path: []}
    for _ in range(runs):
        for file, measured in found.items():
            out = subprocess.run(
                [sys.executable, "-c", GROWTH, str(BENCH), str(file)], check=True, capture_output=True, text=True, cwd=ROOT
            )
            measured.append([float(x) for x in out.stdout.split()])
    little, big = ([statistics.median(column) for column in zip(*found[f], strict=True)] for f in (small[0], path))
    ratios = [b / count / (a / small[1]) for a, b in zip(little[:2], big[:2], strict=True)]
    print(f"\n{count:,} objects, {path.stat().st_size / 1e6:.0f} MB, median of {runs} processes:")
    print(f"  load {big[0]:.2f} s, save {big[1]:.2f} s; most memory {big[2]:.0f} MB")
    print(f"  per object against {small[1]:,}: load {ratios[0]:.2f} x, save {ratios[1]:.2f} x")
    return bool(max(ratios) <= 1.5 and big[2] < 3000)


def main() -> int:
    """Measure, print, compare."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--objects", type=int, action="append", help="sizes; 10,000 and 100,000 if none is given")
    arguments.add_argument("--runs", type=int, default=5)
    arguments.add_argument("--no-million", action="store_true")
    given = arguments.parse_args()
    metamodel = Metamodel.load(BENCH)
    good = True
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for objects in given.objects or (10_000, 100_000):
            path = folder / f"model{objects}.xmi"
            count = write_model(path, objects, metamodel)
            kept, _ = compare(path, count, given.runs, metamodel)
            good &= kept
        if not given.no_million:
            good &= growth(folder, (path, count), metamodel, 3)
    print(
        f"most memory of this process {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MB; all bounds kept: {good}"
    )
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
