"""All electrical constraints on circuits: supplies, signals, loads, buses.

Constraints that need a plan, with the program and the chosen libraries, are in `electrical_plan`.
"""

from __future__ import annotations

from robosmi.diagnostics import Finding
from robosmi.metamodels import hardware
from robosmi.model import EmfModel
from robosmi.transformations.constraints.electrical_buses import buses
from robosmi.transformations.constraints.electrical_loads import loads
from robosmi.transformations.constraints.electrical_signals import signals
from robosmi.transformations.constraints.electrical_supply import supply
from robosmi.transformations.constraints.finding_locations import worst_first
from robosmi.validate import EVL

electrical = EVL()
"""All of them; evaluate them on a hardware model."""

for part in (supply, signals, loads, buses):
    electrical.include(part)


def electrical_findings(circuit: hardware.Circuit) -> list[Finding]:
    """The findings of the electrical constraints on a circuit, the most severe first.

    Args:
        circuit: the circuit.
    """
    return worst_first(electrical.run(EmfModel(circuit, name="hardware")).findings())
