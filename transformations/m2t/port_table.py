"""The table in which a program looks up the pin of a port of the source that it has as a number."""

from __future__ import annotations

from msgspec import Struct

from robosmi.metamodels import migration
from robosmi.transformations.queries.port_pins import UNBOUND, looks_up_ports, port_literals, table_is_declared

_PORTS = 32


class PortPins(Struct, frozen=True):
    """The table as templates show it.

    Attributes:
        unbound: the literal for no pin.
        pins: the literal for the pin of each port, from 0 on.
        names: the number of each port, with its name in the program if it has a pin.
    """

    unbound: str
    pins: list[str]
    names: list[str]


def port_table(plan: migration.MigrationPlan) -> PortPins | None:
    """The table; None if the program looks up no ports, or if an adapter declares the table."""
    if not looks_up_ports(plan) or table_is_declared(plan):
        return None
    texts = port_literals(plan)[1]
    called = {b.sourcePin: f": {b.name}" for b in plan.portBindings if b.sourcePin in texts and b.name != f"P{b.sourcePin}"}
    count = max([_PORTS, *(number + 1 for number in texts)])
    return PortPins(
        UNBOUND,
        [texts.get(number, UNBOUND) for number in range(count)],
        [f"P{number}{called.get(number, '')}" for number in range(count)],
    )
