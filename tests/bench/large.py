"""Large models with ids and opposites, in processor seconds and in ratios to pyecore and to Eclipse EMF in a fresh Java process.

The model is a graph: groups contain nodes and edges, each with an xmi:id; an edge has a source and a target, and both sides of
each opposite stand in the file, as EMF writes them. Seconds of EMF are those of its first load and save (`--cpu`), with all
threads of its process; the time until Java has started does not count.
"""

from __future__ import annotations

import json
import os
import random
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from tests.bench.figures import Figure, not_measured

ROOT = Path(__file__).resolve().parents[2]
GRAPH = ROOT / "tests" / "model" / "split" / "g.ecore"
SIZES = (100_000, 1_000_000)
OURS = """
import json, resource, sys, time
from robosmi.model import open_model
from robosmi.query import ModelView
found = {}
def timed(name, run):
    start = time.process_time()
    result = run()
    found[name] = time.process_time() - start
    return result
model = timed("load", lambda: open_model(sys.argv[1], metamodel=sys.argv[2]))
found["memory"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
view = ModelView(model)
timed("first navigation", lambda: view.Node.all.size())
timed("nodes with many edges", lambda: view.Node.all.select(lambda n: len(n.out) > 2).size())
timed("edges to heavier nodes", lambda: view.Edge.all.select(lambda e: e.source.weight < e.target.weight).size())
timed("save", lambda: model.save(sys.argv[3]))
print(json.dumps(found))
"""
LAZILY = """
import json, resource, sys, time
start = time.process_time()
from robosmi.model import open_model
from robosmi.query import ModelView
view = ModelView(open_model(sys.argv[1], metamodel=sys.argv[2], lazy=True))
found = view.Edge.all.size() if sys.argv[3] == "size" else view.element("_n7").name
print(json.dumps([time.process_time() - start, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024]))
"""
BUILD = """
import sys, time
if sys.argv[1] == "ours":
    from robosmi.model.ecore.metamodel import Metamodel
    package = Metamodel.load(sys.argv[2])
    Graph, Group, Node, Edge = package.Graph, package.Group, package.Node, package.Edge
else:
    from pyecore.resources import URI, ResourceSet
    package = ResourceSet().get_resource(URI(sys.argv[2])).contents[0]
    Graph, Group, Node, Edge = map(package.getEClassifier, ("Graph", "Group", "Node", "Edge"))
start = time.process_time()
graph, nodes = Graph(name="g"), []
for number in range(300):
    group = Group(name=f"g{number}")
    graph.groups.append(group)
    for i in range(40):
        node = Node(name=f"n{i}", weight=i)
        group.nodes.append(node)
        nodes.append(node)
for number, group in enumerate(list(graph.groups)):
    for i in range(59):
        edge = Edge(name=f"e{i}")
        edge.source = nodes[(number * 59 + i) * 7 % len(nodes)]
        edge.target = nodes[(number * 59 + i) * 13 % len(nodes)]
        group.edges.append(edge)
print(time.process_time() - start)
"""


def write_graph(path: Path, objects: int) -> None:
    """Write a graph of about that many elements, as EMF writes it."""
    groups = objects // 100
    number = random.Random(1)
    ends = [(number.randrange(groups * 40), number.randrange(groups * 40)) for _ in range(groups * 59)]
    sides: tuple[list[list[str]], list[list[str]]] = ([[] for _ in range(groups * 40)], [[] for _ in range(groups * 40)])
    for edge, pair in enumerate(ends):
        for side, node in zip(sides, pair, strict=True):
            side[node].append(f"_e{edge}")
    with path.open("w", encoding="utf-8") as out:
        out.write('<?xml version="1.0" encoding="UTF-8"?>\n<g:Graph xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" ')
        out.write('xmlns:g="http://example.org/g" xmi:id="_root" name="root">\n')
        for group in range(groups):
            out.write(f'  <groups xmi:id="_g{group}" name="g{group}">\n')
            for node in range(group * 40, group * 40 + 40):
                links = [
                    f' {name}="{" ".join(side[node])}"' for name, side in zip(("out", "into"), sides, strict=True) if side[node]
                ]
                out.write(f'    <nodes xmi:id="_n{node}" name="n{node}" weight="{node % 97 + 1}"{"".join(links)}/>\n')
            for edge in range(group * 59, group * 59 + 59):
                source, target = ends[edge]
                out.write(f'    <edges xmi:id="_e{edge}" name="e{edge}" source="_n{source}" target="_n{target}"/>\n')
            out.write("  </groups>\n")
        out.write("</g:Graph>\n")


def ours(path: Path) -> dict[str, float]:
    """What our process measures."""
    saved = path.with_name("ours.xmi")
    done = subprocess.run(
        [sys.executable, "-c", OURS, str(path), str(GRAPH), str(saved)], check=True, capture_output=True, text=True, cwd=ROOT
    )
    assert saved.read_bytes() == path.read_bytes()
    found: dict[str, float] = json.loads(done.stdout)
    return found


def lazily(path: Path, full: dict[str, float]) -> Iterator[Figure]:
    """What one question to a model costs that is opened lazily, in its own process and with all imports."""
    for question, text in (("size", "number of a type"), ("id", "look-up by id")):
        command = [sys.executable, "-c", LAZILY, str(path), str(GRAPH), question]
        seconds, memory = json.loads(subprocess.run(command, check=True, capture_output=True, text=True, cwd=ROOT).stdout)
        for what, own, unit in (("load", seconds, "s"), ("memory", memory, "MB")):
            note = f"{own:.2f} to {full[what]:.2f} {unit}"
            yield Figure(f"graph, a million elements, {text}, lazy {what} to full", own / full[what], "x", 0.2, note=note)


def emf(path: Path) -> dict[str, float] | str:
    """Processor seconds and memory (MB) of EMF; why not, where it cannot run."""
    command = [
        "sh",
        str(ROOT / "tests/emf/check.sh"),
        str(GRAPH),
        str(path),
        "-q",
        "--no-validate",
        "--cpu",
    ]  # EMFCHECK_DEFER: else EMF searches the model for each id
    saved = path.with_name("emf.xmi")
    child = (
        "import resource, subprocess, sys; code = subprocess.run(sys.argv[1:]).returncode;"
        "print('memory', resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024); sys.exit(code)"
    )
    done = subprocess.run(
        [sys.executable, "-c", child, *command, "--resave", str(saved)],
        capture_output=True,
        text=True,
        check=False,
        env=os.environ | {"EMFCHECK_DEFER": "1"},
    )
    seconds = re.search(r"\(load ([\d.]+) s, save ([\d.]+) s\)", done.stdout)
    if done.returncode or seconds is None:
        return " ".join((done.stderr or done.stdout).split())[-100:]
    assert saved.read_bytes() == path.read_bytes()
    memory = re.search(r"^memory ([\d.]+)", done.stdout, re.M)
    assert memory is not None
    return {"load": float(seconds[1]), "save": float(seconds[2]), "memory": float(memory[1])}


def figures() -> Iterator[Figure]:
    """Ratios of two sizes to EMF, of queries to each other, and of building to pyecore."""
    built = {}
    for who in ("ours", "pyecore"):
        command = [sys.executable, "-c", BUILD, who, str(GRAPH)]
        built[who] = float(subprocess.run(command, check=True, capture_output=True, text=True, cwd=ROOT).stdout)
    note = f"{built['ours']:.2f} s of 30,001 elements"
    yield Figure(
        "graph, building in memory, pyecore to ours", built["pyecore"] / built["ours"], "x", 1.5, at_least=True, note=note
    )
    found: list[dict[str, float]] = []
    with tempfile.TemporaryDirectory() as name:
        for objects, load, save, memory in ((SIZES[0], 0.6, 1.0, None), (SIZES[1], 1.0, None, 1.0)):
            path = Path(name) / f"graph{objects}.xmi"
            write_graph(path, objects)
            found.append(ours(path))
            if objects == SIZES[1]:
                yield from lazily(path, found[-1])
            theirs: Any = emf(path)
            if isinstance(theirs, str):
                yield not_measured(f"graph, {objects:,} elements, against EMF", f"needs Java and EMF: {theirs}")
                continue
            for what, bound in (("load", load), ("save", save), ("memory", memory)):
                own, other = found[-1][what], theirs[what]
                text = f"{own:.2f} to {other:.2f} {'MB' if what == 'memory' else 's'}"
                yield Figure(f"graph, {objects:,} elements, {what}, ours to cold EMF", own / other, "x", bound, note=text)
    small, big = found
    for what in ("first navigation", "nodes with many edges", "edges to heavier nodes"):
        text = f"{small[what]:.2f} and {big[what]:.2f} s"
        yield Figure(f"graph, {what}, a million to 100,000", big[what] / small[what], "x", 10, note=text)
