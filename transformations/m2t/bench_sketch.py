"""The values for the sketch that tests the hardware on the bench, one component at a time.

The user chooses a component over the serial line, and it is moved or read within safe limits. How a component is tested is data
of its kind (`bench` in parts/electrical.toml), else follows from its role. The sketch needs no library beyond the core, and
leaves the pins of its own serial line alone. Everything is read from the models.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from msgspec import Struct

from robosmi.metamodels import hardware, migration
from robosmi.transformations.queries.circuit import pin_literal
from robosmi.transformations.queries.connector_names import wire_name

_NEUTRAL, _COILS = 1500, 4
_BY_ROLE = {hardware.Role.Output: "switch", hardware.Role.Input: "level"}


class BenchCall(Struct, frozen=True):
    """A call of a test function in the sketch: the function's name and its arguments as text."""

    name: str
    arguments: tuple[str, ...]


class BenchCheck(Struct, frozen=True):
    """The test of one component.

    Attributes:
        title: the component's title in the drawing, made unique.
        wires: its connectors with their pins, for people.
        calls: the calls that test it, in order.
        note: why a part of it is not tested; empty if all is.
        elements: the model elements that it comes from.
    """

    title: str
    wires: str
    calls: tuple[BenchCall, ...]
    note: str
    elements: tuple[Any, ...]


def bench(plan: migration.MigrationPlan) -> dict[str, Any]:
    """The values of the sketch's template: `checks`, the test functions that they `use`, and pins with a `rest` level."""
    checks = list(_checks(plan))
    rest = [c for c in plan.connections if c.restLevel and c.pin is not None and not _console(c)]
    return {
        "checks": checks,
        "used": sorted({call.name for check in checks for call in check.calls}),
        "rest": [(_pin(c), str(c.restLevel).upper(), c) for c in rest],
    }


def _checks(plan: migration.MigrationPlan) -> Iterator[BenchCheck]:
    of_component: dict[hardware.Component, list[migration.Connection]] = {}
    for connection in plan.connections:
        if connection.component is not None and connection.pin is not None:
            of_component.setdefault(connection.component, []).append(connection)
    titles = [c.title for c in of_component]
    for component, connections in of_component.items():
        title = component.title if titles.count(component.title) == 1 else f"{component.title} #{component.elementId}"
        wires = ", ".join(f"{wire_name(c.connectors)} on {c.pin.label}" for c in connections if c.pin is not None)
        free = [c for c in connections if not _console(c)]
        calls = tuple(_calls(component, free))
        note = "on the pins that this sketch talks over" if len(free) < len(connections) else ""
        if not calls and not note:
            note = "not tried alone"
        yield BenchCheck(title, wires, calls, note, (component, *connections))


def _calls(component: hardware.Component, connections: list[migration.Connection]) -> Iterator[BenchCall]:
    """The calls that test a component at its connections."""
    device = component.device
    kind = device.bench if device is not None else ""
    writes = [c for c in connections if c.signal is not migration.Signal.read]
    if kind == "none" or not connections:
        return
    if kind == "ranger":
        ends = _ranger(connections)
        if ends is not None:
            yield BenchCall("tryRanger", ends)
            return
    if _on_bus(connections) and (kind == "" or device is None or device.addresses):
        yield BenchCall("tryBus", ())
        return
    if kind == "stepper":
        yield from _stepped(writes)
    elif kind == "humidity":
        yield from (BenchCall("tryHumidity", (_pin(c),)) for c in connections[:1])
    elif kind == "count":
        yield from (BenchCall("tryCount", (_pin(c),)) for c in connections)
    elif kind == "servo":
        yield from (BenchCall("tryServo", (_pin(c), str(c.neutralMicroseconds or _NEUTRAL))) for c in writes)
    elif kind in ("motor", "switch", "sound"):
        yield from (BenchCall(*_driven(kind, c)) for c in writes)
    else:
        yield from (call for c in connections for call in _by_role(component, c))


def _stepped(connections: list[migration.Connection]) -> Iterator[BenchCall]:
    """The calls that test a stepper motor: by step and direction of a driver, else coil by coil in the order of their names."""
    named = {str(c.name).strip().lower(): connection for connection in connections for c in connection.connectors}
    step = next((named[name] for name in named if name.startswith(("step", "stp", "clk", "pul"))), None)
    turns = next((named[name] for name in named if name.startswith(("dir", "cw"))), None)
    if step is not None and turns is not None:
        yield BenchCall("trySteps", (_pin(step), _pin(turns)))
    elif len(connections) == _COILS:
        at = [named[name] for name in sorted(named, key=_coil)]
        yield BenchCall("tryCoils", tuple(_pin(connection) for connection in at))


def _coil(name: str) -> tuple[str, str]:
    """A sort key for the wires of coils: IN1 to IN4; of a motor with two coils A+, B+, A-, B-."""
    return (name[-1], name) if name[-1:] in ("+", "-") else ("", name)


def _driven(kind: str, connection: migration.Connection) -> tuple[str, tuple[str, ...]]:
    off = str(connection.restLevel or "low").upper()
    if kind == "sound":
        return "trySound", (_pin(connection),)
    if kind == "motor" and connection.pin is not None and "pwm" in connection.pin.abilities:
        return "tryMotor", (_pin(connection), off)
    return "trySwitch", (_pin(connection), off)


def _by_role(component: hardware.Component, connection: migration.Connection) -> Iterator[BenchCall]:
    pin, device = connection.pin, component.device
    assert pin is not None
    if connection.signal is migration.Signal.write or (
        component.role is hardware.Role.Output and connection.signal is not migration.Signal.read
    ):
        if "digital" in pin.abilities:
            yield BenchCall("trySwitch", (_pin(connection), str(connection.restLevel or "low").upper()))
        return
    measured = "analog_in" in pin.abilities and ((device is not None and bool(device.analog)) or "digital" not in pin.abilities)
    yield BenchCall("tryVoltage" if measured else "tryLevel", (_pin(connection),))


def _ranger(connections: list[migration.Connection]) -> tuple[str, str] | None:
    """The trigger and the echo pin of a distance sensor, the same for a sensor with one wire; None if it has neither."""
    named = {str(c.name).strip().lower(): connection for connection in connections for c in connection.connectors}
    asks = next((named[name] for name in named if name.startswith("trig")), None)
    tells = next((named[name] for name in named if name.startswith("echo")), None)
    if asks is not None and tells is not None:
        return _pin(asks), _pin(tells)
    return (_pin(connections[0]), _pin(connections[0])) if len(connections) == 1 else None


def _on_bus(connections: list[migration.Connection]) -> bool:
    lines = {alias for c in connections if c.pin is not None for alias in c.pin.aliases}
    return {"SDA", "SCL"} <= lines and len(connections) == 2


def _console(connection: migration.Connection) -> bool:
    """Whether a connection is on a pin of the serial line to the computer."""
    pin = connection.pin
    return pin is not None and bool(pin.reserved) and "uart" in pin.abilities


def _pin(connection: migration.Connection) -> str:
    assert connection.pin is not None
    return pin_literal(connection.pin)
