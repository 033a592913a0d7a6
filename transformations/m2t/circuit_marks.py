"""Where findings about a circuit belong in its picture: to a component, to pins of a board, to a net.

A finding is located by its element, by `model_index`, `pins` and `net` in its evidence, or by its message: quoted titles and
labels of pins. One without any of these is about the drawing as a whole. Nothing is drawn here.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from msgspec import Struct

from robosmi.diagnostics import Finding, Severity
from robosmi.metamodels import hardware

_ELEMENT = re.compile(r"//@(components|nets)\.(\d+)")
_QUOTED = re.compile(r"'([^']+)'")
_LABEL = re.compile(r"\b[DA]\d{1,2}\b")
_COLOURS = {Severity.error: "#c00000", Severity.warning: "#b45f06", Severity.info: "#3d6b99"}


class Mark(Struct, frozen=True):
    """A finding in the picture: its rule, its message, the colour of its severity."""

    rule: str
    message: str
    colour: str


class Marks:
    """The marks of a picture: by component, by connector, and those of the drawing as a whole."""

    def __init__(self) -> None:
        self.components: dict[hardware.Component, list[Mark]] = {}
        self.connectors: dict[hardware.Connector, Mark] = {}
        self.whole: list[Mark] = []


def marks(circuit: hardware.Circuit, findings: Iterable[Finding]) -> Marks:
    """The marks of findings, the worst first; each stands once at a component.

    Args:
        circuit: what the findings are about.
        findings: of all severities.
    """
    made = Marks()
    by_identity = {c.elementId: c for c in circuit.components}
    by_title: dict[str, list[hardware.Component]] = {}
    for component in circuit.components:
        by_title.setdefault(component.title, []).append(component)
    nets = {net.name: net for net in circuit.nets}
    for finding in sorted(findings, key=lambda f: (-f.severity, f.rule)):
        mark = Mark(finding.rule, finding.message, _COLOURS[finding.severity])
        about = _components(finding, circuit, by_identity, by_title)
        net = nets.get(str(finding.evidence.get("net", ""))) or _net(finding, circuit)
        for connector in _pins(finding, about):
            made.connectors.setdefault(connector, mark)
        if net is not None:
            for connector in net.connectors:
                made.connectors.setdefault(connector, mark)
            about = about or list(dict.fromkeys(c.component for c in net.connectors if c.component is not None))
        for component in about:
            mine = made.components.setdefault(component, [])
            if mark not in mine:
                mine.append(mark)
        if not about:
            made.whole.append(mark)
    return made


def _components(
    finding: Finding,
    circuit: hardware.Circuit,
    by_identity: dict[str, hardware.Component],
    by_title: dict[str, list[hardware.Component]],
) -> list[hardware.Component]:
    found = _ELEMENT.search(finding.element or "")
    if found is not None and found[1] == "components" and int(found[2]) < len(circuit.components):
        return [circuit.components[int(found[2])]]
    if (component := by_identity.get(str(finding.evidence.get("model_index", "")))) is not None:
        return [component]
    quoted = [by_title.get(title, []) for title in _QUOTED.findall(finding.message)]
    return [components[0] for components in quoted if len(components) == 1]


def _net(finding: Finding, circuit: hardware.Circuit) -> hardware.Net | None:
    found = _ELEMENT.search(finding.element or "")
    if found is None or found[1] != "nets" or int(found[2]) >= len(circuit.nets):
        return None
    return circuit.nets[int(found[2])]


def _pins(finding: Finding, components: Iterable[hardware.Component]) -> list[hardware.Connector]:
    """The connectors on the pins that a finding names, limited to some components."""
    told = finding.evidence.get("pins")
    named = told.split(",") if told and isinstance(told, str) else [str(each) for each in finding.listed("pins")]
    labels = {label.strip() for label in named or (match[0] for match in _LABEL.finditer(finding.message))}
    return [c for component in components for c in component.connectors if labels & _labels(c)]


def _labels(connector: hardware.Connector) -> set[str]:
    if connector.pin:
        return {connector.pin}
    net = connector.net
    return {other.pin for other in net.connectors if other.pin} if net is not None and not net.rail else set()
