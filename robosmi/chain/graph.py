"""What depends on what in a chain: steps, models and files as a directed graph, and the order in which steps are done."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

import networkx as nx

from robosmi.chain.steps import Step, relative
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, did_you_mean


def graph_of(steps: Sequence[Step], folder: Path, place: Location | None = None) -> nx.DiGraph[str]:
    """The graph: what is read -> step -> what is made.

    Args:
        steps: in the order of their declaration.
        folder: what paths are relative to.
        place: where the chain is declared, for errors.

    Returns:
        Nodes `step NAME`, `model NAME` and `file PATH`, with the attribute `kind` (step, model, file).

    Raises:
        SourceError: two steps make the same, or a model is used that no step makes.
    """
    graph: nx.DiGraph[str] = nx.DiGraph()
    makers: dict[str, Step] = {}
    for step in steps:
        node = f"step {step.name}"
        if node in graph:
            raise _wrong(f"two steps are called '{step.name}'", "give one of them another name", place)
        graph.add_node(node, kind="step")
        for made in [*([f"model {step.makes}"] if step.makes else []), *(f"file {relative(p, folder)}" for p in step.outputs())]:
            if made in makers and not (step.kind == "generate" and makers[made].kind == "generate"):
                both = f"'{makers[made].name}' and '{step.name}'"
                raise _wrong(f"two steps make the {made}: {both}", "give one of them another name or file", place)
            makers[made] = step
            graph.add_node(made, kind=made.partition(" ")[0])
            graph.add_edge(node, made)
    for step in steps:
        for model in step.models:
            if f"model {model}" not in makers:
                known = [name.partition(" ")[2] for name in makers if name.startswith("model ")]
                raise _wrong(
                    f"the step '{step.name}' uses the model '{model}', which no step makes{did_you_mean(model, known)}",
                    f"use one of: {', '.join(known) or 'none is made'}, or add a step that makes it",
                    place,
                )
            graph.add_edge(f"model {model}", f"step {step.name}")
        for path in step.inputs():
            name = f"file {relative(path, folder)}"
            if name not in graph:
                graph.add_node(name, kind="file")
            graph.add_edge(name, f"step {step.name}")
            for other in steps:  # a file in a folder that another step fills
                if other.folder is not None and other is not step and other.folder in path.parents:
                    graph.add_edge(f"file {relative(other.folder, folder)}", name)
    for gate, step in _gates(steps):
        graph.add_edge(f"step {gate.name}", f"step {step.name}", gate=True)
    return graph


def _gates(steps: Sequence[Step]) -> Iterable[tuple[Step, Step]]:
    """A validation and the later steps that use one of its models."""
    for number, gate in enumerate(steps):
        if gate.kind == "validate":
            for step in steps[number + 1 :]:
                if set(gate.models) & set(step.models):
                    yield gate, step


def in_order(steps: Sequence[Step], graph: nx.DiGraph[str], place: Location | None = None) -> list[Step]:
    """The steps, each behind those it depends on, else as they are declared.

    Raises:
        SourceError: they depend on each other in a circle.
    """
    position = {f"step {step.name}": number for number, step in enumerate(steps)}
    by_node = {f"step {step.name}": step for step in steps}
    try:
        nodes = list(nx.lexicographical_topological_sort(graph, key=lambda node: (position.get(node, -1), node)))
    except nx.NetworkXUnfeasible:
        circle = [edge[0] for edge in nx.find_cycle(graph)]
        told = " -> ".join([*circle, circle[0]])
        raise _wrong(f"the chain goes in a circle: {told}", "take out one of these dependencies", place) from None
    return [by_node[node] for node in nodes if node in by_node]


def missing(steps: Sequence[Step], graph: nx.DiGraph[str], folder: Path) -> list[tuple[Step, Path]]:
    """Files and folders that a step reads, that are not there and that no step makes."""
    found = []
    for step in steps:
        for path in step.inputs():
            made = graph.in_degree(f"file {relative(path, folder)}") > 0
            if not made and not path.exists():
                found.append((step, path))
    return found


def _wrong(message: str, fix: str, place: Location | None) -> SourceError:
    return SourceError(message, location=place, fix=f"{fix}; nothing was done")
