"""The dependencies of a chain (steps, models and files) as a directed graph, and the order in which steps are done."""

from __future__ import annotations

import heapq
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from robosmi.chain.steps import GIVEN, Step, relative
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, did_you_mean


class Dependencies:
    """A directed graph from inputs to steps to outputs.

    Attributes:
        kinds: `step NAME`, `model NAME` or `file PATH` -> `step`, `model` or `file`, in the order of first mention.
        before: the same names -> their dependencies, each with whether it is a gate: a validation that only delays the step.
    """

    def __init__(self) -> None:
        self.kinds: dict[str, str] = {}
        self.before: dict[str, dict[str, bool]] = {}

    def node(self, name: str) -> None:
        """Add the node `step NAME`, `model NAME` or `file PATH`, unless it exists."""
        self.kinds.setdefault(name, name.partition(" ")[0])
        self.before.setdefault(name, {})

    def edge(self, first: str, then: str, *, gate: bool = False) -> None:
        """Add a dependency of `then` on `first`."""
        self.node(first)
        self.node(then)
        self.before[then][first] = gate

    def edges(self) -> Iterator[tuple[str, str, bool]]:
        """The edges, as (from, to, whether it is a gate)."""
        for then, firsts in self.before.items():
            for first, gate in firsts.items():
                yield first, then, gate

    def needed(self, names: Iterable[str]) -> set[str]:
        """The given nodes and all their direct and indirect dependencies."""
        found: set[str] = set()
        left = list(names)
        while left:
            name = left.pop()
            if name not in found:
                found.add(name)
                left += self.before.get(name, ())
        return found


def graph_of(steps: Sequence[Step], folder: Path | None, place: Location | None = None) -> Dependencies:
    """The graph of a chain.

    Args:
        steps: in the order of their declaration.
        folder: what paths are relative to; None where no step reads or makes a file.
        place: where the chain is declared, for errors.

    Raises:
        SourceError: two steps make the same, or a model is used that no step makes.
    """
    graph = Dependencies()
    makers: dict[str, Step] = {}
    for step in steps:
        node = f"step {step.name}"
        if node in graph.kinds:
            raise _wrong(f"two steps are called '{step.name}'", "give one of them another name", place)
        graph.node(node)
        for made in [*([f"model {step.makes}"] if step.makes else []), *(_file(p, folder) for p in step.outputs())]:
            if made in makers and not (step.kind == "generate" and makers[made].kind == "generate"):
                both = f"'{makers[made].name}' and '{step.name}'"
                raise _wrong(f"two steps make the {made}: {both}", "give one of them another name or file", place)
            makers[made] = step
            graph.edge(node, made)
    for step in steps:
        for model in step.models:
            if f"model {model}" not in makers:
                known = [name.partition(" ")[2] for name in makers if name.startswith("model ")]
                raise _wrong(
                    f"the step '{step.name}' uses the model '{model}', which no step makes{did_you_mean(model, known)}",
                    f"use one of: {', '.join(known) or 'none is made'}, or add a step that makes it",
                    place,
                )
            graph.edge(f"model {model}", f"step {step.name}")
        for path in step.inputs():
            name = _file(path, folder)
            graph.edge(name, f"step {step.name}")
            for other in steps:  # a file in a folder that another step fills
                if other.folder is not None and other is not step and other.folder in path.parents:
                    graph.edge(_file(other.folder, folder), name)
    for gate, step in _gates(steps):
        graph.edge(f"step {gate.name}", f"step {step.name}", gate=True)
    return graph


def _file(path: Path, folder: Path | None) -> str:
    return f"file {relative(path, folder) if folder is not None else path}"


def _gates(steps: Sequence[Step]) -> Iterable[tuple[Step, Step]]:
    """Pairs of a validation and a later step that uses one of its models."""
    for number, gate in enumerate(steps):
        if gate.kind == "validate":
            for step in steps[number + 1 :]:
                if set(gate.models) & set(step.models):
                    yield gate, step


def topological_order(steps: Sequence[Step], graph: Dependencies, place: Location | None = None) -> list[Step]:
    """The steps in topological order; independent ones in the order of declaration.

    Raises:
        SourceError: they depend on each other in a circle.
    """
    position = {f"step {step.name}": number for number, step in enumerate(steps)}
    waits = {name: len(firsts) for name, firsts in graph.before.items()}
    then: dict[str, list[str]] = {name: [] for name in graph.kinds}
    for first, second, _ in graph.edges():
        then[first].append(second)
    ready = [(position.get(name, -1), name) for name, count in waits.items() if not count]
    heapq.heapify(ready)
    ordered: list[Step] = []
    done = 0
    while ready:
        number, name = heapq.heappop(ready)
        done += 1
        if number >= 0:
            ordered.append(steps[number])
        for second in then[name]:
            waits[second] -= 1
            if not waits[second]:
                heapq.heappush(ready, (position.get(second, -1), second))
    if done < len(waits):
        circle = " -> ".join(_circle(graph.before))
        raise _wrong(f"the chain goes in a circle: {circle}", "take out one of these dependencies", place)
    return ordered


def _circle(before: Mapping[str, Iterable[str]]) -> list[str]:
    from graphlib import CycleError, TopologicalSorter  # needed for a wrong chain only

    try:
        TopologicalSorter(before).prepare()
    except CycleError as error:
        circle: list[str] = error.args[1]  # each is read by the next one
        return circle
    return []


def missing(steps: Sequence[Step], graph: Dependencies, folder: Path | None) -> list[tuple[Step, Path]]:
    """Files and folders that a step reads, that do not exist and that no step makes."""
    return [
        (step, path)
        for step in steps
        if step.kind != GIVEN
        for path in step.inputs()
        if not graph.before[_file(path, folder)] and not path.exists()
    ]


def _wrong(message: str, fix: str, place: Location | None) -> SourceError:
    return SourceError(message, location=place, fix=f"{fix}; nothing was done")
