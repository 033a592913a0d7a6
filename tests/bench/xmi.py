"""XMI against its peers, measured in one run: pyecore's own resource, and Eclipse EMF where Java is installed.

The model is that of research: a program of functions,
statements, calls with opposites, literals. Ratios are what counts; seconds depend on the machine and are shown for information.
Bounds: load 4 times and save 5 times faster than pyecore (cyclic garbage collection on, as users
have it), bytes equal to EMF's, a million objects within 1.5 times per object and below 3 GB.
"""

from __future__ import annotations

import gc
import re
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from pyecore.resources import URI, ResourceSet

from robosmi.files.files import write_atomic
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.xmi.xmi_reader import read_models
from robosmi.model.xmi.xmi_writer import to_xmi
from tests.bench.figures import Figure, not_measured

ROOT = Path(__file__).resolve().parents[2]
BENCH = ROOT / "tests" / "emf" / "bench.ecore"
RUNS = 5
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


def emf(path: Path, runs: int) -> tuple[list[tuple[float, float]], bytes] | str:
    """Seconds that EMF takes in one process, first run first, and what it writes; why not, where it cannot run."""
    target = path.with_name("emf.xmi")
    command = ["sh", str(ROOT / "tests/emf/check.sh"), str(BENCH), str(path), "-q", "--resave", str(target), "--bench", str(runs)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        return "needs a shell"
    if done.returncode:
        return " ".join((done.stderr or done.stdout).split())[-100:]
    cold = re.search(r"\(load ([\d.]+) s, save ([\d.]+) s\)", done.stdout)
    warm = re.findall(r"bench \d+: load ([\d.]+) s, save ([\d.]+) s", done.stdout)
    assert cold
    return [(float(a), float(b)) for a, b in [cold.groups(), *warm]], target.read_bytes()


def compare(path: Path, count: int, metamodel: Metamodel) -> Iterator[Figure]:
    """One size against the peers."""
    mine, pyecore = [], []
    for _ in range(RUNS):
        mine.append(ours(path, metamodel))
        pyecore.append(theirs(path))
    own, peer = medians(mine), medians(pyecore)
    for what, seconds, other, bound in zip(("load", "save"), own, peer, (4, 5), strict=True):
        note = f"{seconds:.3f} s against {other:.3f} s, medians of {RUNS}"
        yield Figure(f"XMI, {count:,} objects, {what}, pyecore to ours", other / seconds, "x", bound, at_least=True, note=note)
    judged = emf(path, max(3, RUNS))
    if isinstance(judged, str):
        yield not_measured(f"XMI, {count:,} objects, against EMF", f"needs Java and EMF: {judged}")
        return
    times, written = judged
    for what, seconds, other in zip(("load", "save"), own, medians(times[1:]), strict=True):
        yield Figure(f"XMI, {count:,} objects, {what}, warm EMF to ours", other / seconds, "x", note=f"{other:.3f} s")
    yield Figure(f"XMI, {count:,} objects, files that differ from EMF's", written != path.read_bytes(), "", 0)


def medians(measured: list[tuple[float, float]]) -> list[float]:
    """Median seconds to load and to save."""
    return [statistics.median(column) for column in zip(*measured, strict=True)]


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


def growth(folder: Path, small: tuple[Path, int], metamodel: Metamodel, runs: int) -> Iterator[Figure]:
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
    for what, before, after in zip(("load", "save"), little, big, strict=False):
        ratio = after / count / (before / small[1])
        yield Figure(
            f"XMI, {count:,} objects, {what} per object", ratio, "x", 1.5, note=f"to {small[1]:,} objects; {after:.2f} s"
        )
    yield Figure(f"XMI, {count:,} objects, peak memory", big[2], "MB", 3000)


def figures() -> Iterator[Figure]:
    """Loading and saving of three sizes."""
    metamodel = Metamodel.load(BENCH)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for objects in (10_000, 100_000):
            path = folder / f"model{objects}.xmi"
            count = write_model(path, objects, metamodel)
            yield from compare(path, count, metamodel)
        yield from growth(folder, (path, count), metamodel, 3)
