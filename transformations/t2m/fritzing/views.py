"""Selects the view of a sketch that is used.

Fritzing stores the connections in each of its views, and they should agree. The breadboard view is used; where it connects no
parts, the schematic and then the PCB view; where the first two disagree, that is a finding. The views are never united, since
that would unite their errors.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

from robosmi.data_text import Json
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.transformations.t2m.connectivity import Leaders
from robosmi.transformations.t2m.fritzing.document import VIEWS, Instance
from robosmi.transformations.t2m.fritzing.nets import Has, ViewWiring, links_parts, partition, wiring


def believed(
    instances: Mapping[str, Instance],
    leaders: Leaders,
    by_bus: Collection[str],
    path: str,
    has: Has,
    twice: Collection[str] = (),
) -> tuple[ViewWiring, list[Finding]]:
    """The wiring of the view that is used, and findings where another view contradicts it.

    Args:
        instances: the live instances by identity.
        leaders: what parts join inside, by module id.
        by_bus: instances that only join connectors (breadboards), in which the views may differ.
        path: the file, for findings.
        has: whether an instance that is no wire has a connector.
        twice: model indices that several instances have.
    """
    first, second, last = VIEWS
    breadboard = wiring(first, instances, leaders, has, twice)
    linked = links_parts(breadboard, instances)
    alike = not breadboard.foreign_wires and all(i.view(first).edges == i.view(second).edges for i in instances.values())
    if linked and alike:
        return breadboard, []
    schematic = wiring(second, instances, leaders, has, twice)
    if linked:
        return breadboard, _differences(breadboard, schematic, instances, by_bus, path)
    others = (schematic, wiring(last, instances, leaders, has, twice))
    chosen = next((other for other in others if links_parts(other, instances)), None)
    if chosen is None:
        message = "no part is connected to another in this drawing"
        return breadboard, [_finding("RS212", message, path, "connect the parts in the breadboard view")]
    message = f"the {_spoken(first)} connects no parts; the {_spoken(chosen.view)} was read"
    return chosen, [_finding("RS201", message, path, "check the connections in the breadboard view")]


def _differences(
    chosen: ViewWiring, other: ViewWiring, instances: Mapping[str, Instance], by_bus: Collection[str], path: str
) -> list[Finding]:
    if not links_parts(other, instances):
        return []
    here, there = (partition(wired, instances, by_bus) for wired in (chosen, other))
    if here == there:
        return []
    odd = sorted({f"{identity}.{connector}" for net in here ^ there for identity, connector in net})
    message = (
        f"{_spoken(chosen.view)} and {_spoken(other.view)} connect the parts differently; the {_spoken(chosen.view)} was read"
    )
    return [_finding("RS202", message, path, "compare the two views in Fritzing", connectors=odd[:20])]


def _finding(rule: str, message: str, path: str, fix: str, **evidence: Json) -> Finding:
    return Finding(rule, Severity.warning, message, Location(path), fix=fix, evidence=evidence)


def _spoken(view: str) -> str:
    return view.removesuffix("View").replace("pcb", "PCB") + " view"
