"""Constraints on hardware models: unique titles, and nets and connectors of the same circuit.

This is the set of all constraints on hardware models, including the electrical ones of `electrical`.
"""

from __future__ import annotations

from robosmi.metamodels import hardware
from robosmi.query import ext
from robosmi.transformations.constraints.electrical import electrical
from robosmi.transformations.constraints.finding_locations import drawing
from robosmi.validate import EVL, Fail

circuit = EVL()
"""The constraints on a circuit; evaluate them on its model."""

circuit.include(electrical)

components = circuit.context(hardware.Component, guard=lambda c: c.circuit is not None)
connectors = circuit.context(hardware.Connector, guard=lambda c: c.net is not None)
wires = circuit.context(hardware.Wire, guard=lambda w: w.net is not None)


@components.critique(
    id="RS721", info=True, location=drawing, guard=lambda c: c.title != "" and c.role is not hardware.Role.Decoration,
    advice="name it by its model index (#1014) in options, or give it a unique title",
)  # fmt: skip
def TitleIsItsOwn(c: hardware.Component) -> bool | Fail:
    """A title identifies a single component, so that options can refer to it."""
    assert c.circuit is not None
    first = _firsts(c.circuit)[c.title]
    return first is c or Fail(f"another component is called '{c.title}' too (#{first.elementId} and #{c.elementId})")


def _firsts(circuit: hardware.Circuit) -> dict[str, hardware.Component]:
    """The first component with each title, computed once in a run."""
    known: dict[str, hardware.Component] | None = ext(circuit).first_of_title
    if known is None:
        known = ext(circuit).first_of_title = {c.title: c for c in reversed(circuit.components)}
    return known


@connectors.constraint(id="RS722", advice="read the drawing again")
def NetIsOfItsCircuit(c: hardware.Connector) -> bool | Fail:
    """The net of a connector belongs to the connector's circuit."""
    assert c.net is not None
    own = c.component.circuit if c.component is not None else None
    return c.net.circuit is own or Fail(f"the connector '{c.name or c.connectorId}' is on the net of another circuit")


@wires.constraint(id="RS723", advice="read the drawing again")
def WireEndsOnItsNet(w: hardware.Wire) -> bool | Fail:
    """The connectors at both ends of a wire are on the wire's net."""
    off = next((end for end in w.ends if end.net is not w.net), None)
    return off is None or Fail(f"the wire {w.elementId} ends at '{off.name or off.connectorId}', which is on another net")
