"""The figures of the rule languages, measured: transforming, looking up a trace, validating, each beside the same loop in bare
Python.

Times are medians of several runs in this process, references measured between them, since other work on the
machine only adds; what counts is the ratio. A look-up in a trace a hundred times as long misses the processor's caches more
often; a linear one would take a hundred times as long. The elements are of a metamodel
made here, strict classes as users have them.
"""

from __future__ import annotations

import gc
import statistics
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.emf import EmfModel
from robosmi.transform import ETL, Flock
from robosmi.validate import EVL, Fail
from tests.bench.figures import Figure

SIZE = 100_000

ECORE = """<ecore:EPackage xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
 xmlns:ecore="http://www.eclipse.org/emf/2002/Ecore" name="net" nsURI="http://robosmi/bench/net" nsPrefix="net">
 <eClassifiers xsi:type="ecore:EClass" name="Net">
  <eStructuralFeatures xsi:type="ecore:EReference" name="nodes" upperBound="-1" eType="#//Node" containment="true"/>
 </eClassifiers>
 <eClassifiers xsi:type="ecore:EClass" name="Node">
  <eStructuralFeatures xsi:type="ecore:EAttribute" name="name" eType="ecore:EDataType http://www.eclipse.org/emf/2002/Ecore#//EString"/>
  <eStructuralFeatures xsi:type="ecore:EAttribute" name="weight" eType="ecore:EDataType http://www.eclipse.org/emf/2002/Ecore#//EInt"/>
  <eStructuralFeatures xsi:type="ecore:EReference" name="next" eType="#//Node"/></eClassifiers>
</ecore:EPackage>"""


def metamodel() -> Metamodel:
    """The metamodel of the bench."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "net.ecore"
        path.write_text(ECORE, encoding="utf-8")
        return Metamodel.load(path)


def net(kinds: Metamodel, size: int) -> Any:
    """A model of so many nodes, each with a reference to another."""
    nodes = [kinds.Node(name=f"n{i}", weight=i % 100) for i in range(size)]
    for i, node in enumerate(nodes):
        node.next = nodes[(i * 7 + 1) % size]
    return EmfModel(kinds.Net(nodes=nodes), kinds, "M")


def bare_transformation(source: Any, kinds: Metamodel) -> None:
    """The loop that the transformation rule replaces: first targets and a map, then features and references."""
    cls, made = kinds.Node, {}
    nodes = source.all_of_type("Node")
    for node in nodes:
        made[node] = cls()
    for node in nodes:
        target = made[node]
        target.name = node.name
        target.next = made[node.next]


def transformation(source: Any, kinds: Metamodel) -> ETL:
    """The same as a rule."""
    M, G = source, EmfModel((), kinds, "G")
    t = ETL(M, G)

    @t.rule(M.Node, to=G.Node)
    def Node2Node(node: Any, target: Any) -> None:
        target.name = node.name
        target.next = t.equivalent(node.next)

    t.run()
    return t


CHECKS: list[Callable[[Any], Any]] = [
    lambda n: n.name != "",
    lambda n: n.weight >= 0,
    lambda n: n.next is not None,
    lambda n: n.next is not n or Fail("itself"),
    lambda n: n.weight < 99 or Fail(f"{n.name} weighs {n.weight}"),
    lambda n: n.name.startswith("n"),
    lambda n: n.next.weight < 100,
    lambda n: len(n.name) < 12,
    lambda n: n.weight != 1000,
    lambda n: n.eContainer() is not None,
]


def bare_validation(source: Any) -> None:
    """The loop that the constraints replace."""
    found = []
    for node in source.all_of_kind("Node"):
        for check in CHECKS:
            if not check(node):
                found.append((check, node))


def validation(source: Any) -> None:
    """The same as an EVL module."""
    v = EVL(source)
    context = v.context(source.Node)
    for number, check in enumerate(CHECKS):
        context.constraint(name=f"C{number}")(check)
    v.run()


def seconds(run: Callable[[], object]) -> float:
    """How long one run takes, garbage of earlier ones collected before."""
    gc.collect()
    start = time.perf_counter()
    run()
    return time.perf_counter() - start


def ratio(run: Callable[[], object], reference: Callable[[], object], times: int) -> tuple[float, float, float]:
    """Medians of a run and of its reference, and of their ratios, run by turns."""
    pairs = [(seconds(run), seconds(reference)) for _ in range(times)]
    return tuple(statistics.median(x) for x in ([a for a, _ in pairs], [b for _, b in pairs], [a / b for a, b in pairs]))  # type: ignore[return-value]


def looking_up(kinds: Metamodel, size: int) -> Callable[[], float]:
    """A function that gives the seconds of 10,000 look-ups in a trace of that size, both ways."""
    source = net(kinds, size)
    t = transformation(source, kinds)
    some = source.all_of_type("Node")[:: size // 1000][:1000]
    targets = [t.equivalent(node) for node in some]
    t.trace.origins(targets[0])

    def run() -> float:
        start = time.perf_counter()
        for _ in range(10):
            for node in some:
                t.equivalent(node)
            for target in targets:
                t.trace.origins(target)
        return time.perf_counter() - start

    return run


def figures() -> Iterator[Figure]:
    """Ratios of rules to bare loops, and of a long trace to a short one."""
    kinds = metamodel()
    source = net(kinds, SIZE)
    source.all_of_kind("Node"), source.all_of_type("Node")
    transform = ratio(lambda: transformation(source, kinds), lambda: bare_transformation(source, kinds), 3)
    validate = ratio(lambda: validation(source), lambda: bare_validation(source), 3)
    migrate = ratio(
        lambda: Flock(source, EmfModel((), kinds, "New")).run(), lambda: bare_transformation(source, kinds), 1
    )  # fmt: skip
    small, large = looking_up(kinds, 1000), looking_up(kinds, SIZE)
    pairs = [(large(), small()) for _ in range(15)]
    lookup = tuple(statistics.median(x) for x in ([a for a, _ in pairs], [b for _, b in pairs], [a / b for a, b in pairs]))
    rows: list[tuple[str, tuple[float, ...], float | None, str]] = [
        (f"ETL, {SIZE:,} elements, a reference each", transform, 4.0, "a bare loop"),
        (f"EVL, {SIZE:,} elements, 10 constraints", validate, 2.0, "a bare loop"),
        (f"20,000 look-ups in a trace of {SIZE:,}", lookup, 5.0, "a trace of 1,000"),
        (f"Flock, {SIZE:,} elements, conservative copy", migrate, None, "a bare loop"),
    ]
    for title, (median, reference, found), bound, what in rows:
        yield Figure(title, found, "x", bound, note=f"{median * 1000:.0f} ms to {what} of {reference * 1000:.0f} ms")
