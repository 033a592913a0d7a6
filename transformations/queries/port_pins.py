"""Which pins of the target the ports of a plan are, as its program writes them."""

from __future__ import annotations

from robosmi.metamodels import migration
from robosmi.transformations.queries.circuit import pin_literal
from robosmi.transformations.queries.plan_adapters import emitted

UNBOUND = "255"
"""How a program writes a port that is not wired."""


def port_literals(plan: migration.MigrationPlan) -> tuple[dict[str, str], dict[int, str]]:
    """Name of a conventional port -> its pin, and number of a port of the source -> its pin; ports without a pin are left out."""
    numbers: dict[int, str] = {}
    own: dict[str, str] = {}
    conventional: dict[int, str] = {}
    for binding in plan.portBindings:
        pin = pin_literal(binding.pin) if binding.pin is not None else ""
        text = str(binding.connection.name) if binding.connection is not None else pin
        if not text:
            continue
        if binding.conventionalPort is not None:
            own[str(binding.conventionalPort.name)] = text
        if binding.origin == "convention":
            conventional.setdefault(int(binding.sourcePin), text)
        if binding.sourcePin >= 0:
            numbers.setdefault(int(binding.sourcePin), text)
    for piece in emitted(plan):
        for port in piece.ports:
            if port.number in conventional:
                own.setdefault(str(port.name), conventional[port.number])
    return own, numbers
