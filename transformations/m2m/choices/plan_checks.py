"""The checks for the user at the bench before the robot runs on its own: one for each component that the program uses.

A check names the component with its connectors and pins, the ports bound there, and the functions by which the program drives
or reads them. Without a drawing, each pin that a port is bound to takes the component's place.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from robosmi.metamodels import ccode, hardware, migration, platform
from robosmi.model.elements.strict import Element
from robosmi.query import all_of_kind, ancestor_of_kind
from robosmi.transformations.queries.circuits.connector_names import wire_name
from robosmi.transformations.queries.plans.bus_pins import USB, BusPin, bus_pins
from robosmi.transformations.queries.plans.plan_adapters import port_calls, setup_statements
from robosmi.transformations.queries.plans.port_pins import of_own_serial_port
from robosmi.transformations.queries.ports.idle_ports import is_idle

RULE = "RS340"
"""The id of the rule under which checks are reported."""
_CONSOLE = re.compile(r"Serial\.begin\((\d+)\)")
_RECEIVES = frozenset(
    ["available", "read", "readBytes", "readBytesUntil", "readString", "readStringUntil", "parseInt", "parseFloat"]
)
"""Methods of serial ports that receive."""
_MOST = 4
"""Limit on the functions that a check names."""
_OTHERWISE = ("check that it responds to {}", platform.Direction.unknown)
_SEEN = {
    hardware.Role.Input: ("check that {} the real value", platform.Direction.input),
    hardware.Role.Output: ("check that it responds to {}", platform.Direction.output),
}
"""For each role of a component, what the user should observe, and the direction of the functions that show it."""


def plan_checks(plan: migration.MigrationPlan) -> list[migration.PlanTask]:
    """The checks of a plan: the console first, then component by component in the order of the pins.

    Args:
        plan: the plan, complete but for its checks; those that were there are not looked at.
    """
    return [*_console(plan), *_buses(plan), *_components(plan), *_bare_pins(plan)]


def _console(plan: migration.MigrationPlan) -> Iterable[migration.PlanTask]:
    if bauds := _bauds(plan):
        others = list(
            dict.fromkeys(str(c.calleeName) for b in plan.portBindings if of_own_serial_port(b) for c in port_calls(plan, b))
        )
        rate = f"{bauds[0]} baud" + (f" (or the rate that {', '.join(others)} sets)" if others else "")
        message = f"open the Serial Monitor at {rate} and check that the messages appear"
        yield migration.PlanTask(rule=RULE, severity=migration.SeverityLevel.info, message=message)


def _bauds(plan: migration.MigrationPlan) -> list[str]:
    """The baud rates at which the program opens its console in setup."""
    return [found[1] for statement in setup_statements(plan) if (found := _CONSOLE.search(statement))]


def _buses(plan: migration.MigrationPlan) -> Iterable[migration.PlanTask]:
    """One check for each bus some of whose pins are others on the target; a console that only prints is no wire."""
    moved: dict[str, list[BusPin]] = {}
    heard = _read_ports(plan)
    for pin in bus_pins(plan):
        if pin.old != pin.new and (pin.new != USB or pin.bus in heard):
            moved.setdefault(pin.bus, []).append(pin)
    for bus, pins in moved.items():
        lost = [pin for pin in pins if pin.new in ("", USB)]
        wires = ", ".join(f"{pin.signal} from {pin.old} to {pin.new or 'no known pin'}" for pin in pins)
        message = f"move the wires of {bus}: {wires}"
        if lost:
            message = f"{bus} was on {', '.join(pin.old for pin in lost)}, and {'is USB' if lost[0].new else 'has no known pins'}"
            message += " on the target: a part that is wired there needs another serial port"
        yield migration.PlanTask(rule=RULE, severity=migration.SeverityLevel.info, message=message)


def _read_ports(plan: migration.MigrationPlan) -> set[str]:
    """The objects whose methods that receive are called."""
    members = (call.calleeExpression for unit in _units(plan) for call in all_of_kind(unit, ccode.Call))
    return {
        str(member.object.name)
        for member in members
        if isinstance(member, ccode.Member) and isinstance(member.object, ccode.NameReference) and member.name in _RECEIVES
    }


def _units(plan: migration.MigrationPlan) -> list[ccode.SourceUnit]:
    return list(plan.program.units) if plan.program is not None else []


def _components(plan: migration.MigrationPlan) -> Iterable[migration.PlanTask]:
    of_component: dict[hardware.Component, list[migration.Connection]] = {}
    for connection in plan.connections:
        if connection.component is not None:
            of_component.setdefault(connection.component, []).append(connection)
    titles = [c.title for c in of_component]
    for component, connections in of_component.items():
        ports = [b for b in plan.portBindings if b.connection is not None and any(b.connection is c for c in connections)]
        ports = [b for b in ports if not is_idle(plan, b)]
        if not ports:
            continue
        title = component.title if titles.count(component.title) == 1 else f"{component.title} #{component.elementId}"
        used = [c for c in connections if any(b.connection is c or b.answer is c for b in ports)]
        wires = ", ".join(f"{wire_name(c.connectors)} on {c.pin.label if c.pin is not None else 'no pin'}" for c in used)
        yield _check(plan, f"'{title}' ({wires})", ports, [component, *ports])


def _bare_pins(plan: migration.MigrationPlan) -> Iterable[migration.PlanTask]:
    of_pin: dict[str, list[migration.PortBinding]] = {}
    has_console = bool(_bauds(plan))
    for binding in plan.portBindings:
        seen = (has_console and of_own_serial_port(binding)) or is_idle(plan, binding)
        if binding.connection is None and binding.pin is not None and not seen:
            of_pin.setdefault(str(binding.pin.label), []).append(binding)
    for label, ports in of_pin.items():
        yield _check(plan, f"what is on '{label}'", ports, list(ports))


def _check(
    plan: migration.MigrationPlan, what: str, ports: list[migration.PortBinding], elements: list[Element]
) -> migration.PlanTask:
    names = ", ".join(dict.fromkeys(str(b.name) for b in ports))
    first = next((b.element for b in ports if b.element is not None), None)
    unit = ancestor_of_kind(first, ccode.SourceUnit) if first is not None else None
    return migration.PlanTask(
        rule=RULE, severity=migration.SeverityLevel.info, message=f"{what}, port {names}: {_expected(plan, ports)}",
        path=unit.path if unit is not None else "", line=first.line if first is not None and unit is not None else 0,
        column=first.column if first is not None and unit is not None else 0, elements=elements,
    )  # fmt: skip


def _expected(plan: migration.MigrationPlan, ports: list[migration.PortBinding]) -> str:
    """The instruction what the user should observe at the given ports."""
    calls = [call for port in ports for call in port_calls(plan, port)]
    component = ports[0].connection.component if ports[0].connection is not None else None
    role = component.role if component is not None else None
    said, way = _SEEN.get(role, _OTHERWISE) if role is not None else _OTHERWISE
    ways = {str(use.name): {p.direction for p in use.function.parameters} for use in plan.adapterUses if use.function is not None}
    fitting = [call for call in calls if way in ways.get(str(call.calleeName), ())] or calls
    names = list(dict.fromkeys(str(call.calleeName) for call in fitting))
    if not names:
        return "check that it does what the program expects"
    shown = ", ".join(names[:_MOST]) + (" ..." if len(names) > _MOST else "")
    if role is hardware.Role.Input:
        shown = f"{shown} {'read' if len(names) > 1 else 'reads'}"
    return said.format(shown)
