"""The files of a program for any target, as rules of EGX: the program's units, its adapters, and its report by itself.

A generator names its templates and gives the values for its project file. Each rule makes a file from a template; values that a
template needs beyond the plan are prepared by the module of that file. Templates name their parts, so that every generated line
is traced to its elements and to the step of the method that made it.

Two files have their values from here: the table in which a program looks up the pin of a port that it has as a number of the
source, and the sketch that tests the hardware on the bench, one component at a time. In that sketch the user chooses a component
over the serial line, and it is moved or read within safe limits. How a component is tested is data of its kind (`bench` in
parts/electrical.toml), else follows from its role. The sketch needs no library beyond the core, and leaves the pins of its own
serial line alone. Everything is read from the models.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from msgspec import Struct

from robosmi.base.data_text import Json
from robosmi.errors import UsageError
from robosmi.generate import Gen, Generation
from robosmi.metamodels import ccode, hardware, migration
from robosmi.transformations.m2t.adapters import adapter_pieces, adapters, separate_placeholders, with_own_types
from robosmi.transformations.m2t.first_screen import Counted
from robosmi.transformations.m2t.program_text import file_name, own_header, program_text
from robosmi.transformations.m2t.retained_text import MOVED_PINS, moved_pins, retained_parts
from robosmi.transformations.m2t.task_list import report
from robosmi.transformations.queries.circuits.circuit import pin_literal
from robosmi.transformations.queries.circuits.connector_names import wire_name
from robosmi.transformations.queries.plans.plan import target_of
from robosmi.transformations.queries.plans.port_pins import (
    UNBOUND,
    looks_up_ports,
    number_name,
    port_literals,
    source_name,
    table_is_declared,
)  # fmt: skip
from robosmi.transformations.queries.plans.retained_pins import retains_platform
from robosmi.transformations.queries.source_text import ADAPTERS_FILE, SourceText, is_header
from robosmi.transformations.queries.text_changes import all_changes

BENCH = "bench"
"""The folder beside the program that contains the sketch for testing components on the bench."""
REPORT = "MIGRATION.md"
"""The name of the report in the program's folder."""


class ProgramTemplates(Struct, frozen=True):
    """The templates of a target's files.

    Attributes:
        unit: template of a unit that is compiled.
        header: template of an own header.
        adapters: template of the adapters.
        project: template of the project file.
        project_file: name of the project file.
        more: further project files for other tools: name -> template.
        bench: template of the sketch that tests components on the bench; empty for a target without one.
        pins: template of the header in which a program whose platform stays looks up pins; empty for a target without one.
    """

    unit: str
    header: str
    adapters: str
    project: str
    project_file: str
    more: Mapping[str, str] = {}
    bench: str = ""
    pins: str = ""


def program_files(
    plan: migration.MigrationPlan, sources: Mapping[str, bytes], templates: ProgramTemplates, project: Mapping[str, Any]
) -> Generation:
    """The files of a program, their paths relative to the output folder; nothing is written.

    Args:
        plan: a plan with its decisions.
        sources: path of a unit -> its bytes.
        templates: of the target's files.
        project: what the project file shows beyond the plan.

    Raises:
        RuleError: a template is wrong.
        UsageError: a sketch for the bench is wanted, and the target has none.
    """
    if plan.bench and not templates.bench:
        name = target_of(plan).name
        fix = "leave out --bench, or choose a board as the target, as in --target uno -o OTHER"
        raise UsageError(f"the target '{name}' has no sketch for the bench", fix=fix)
    g = Gen()
    assert plan.program is not None
    kept = retains_platform(plan)
    late, changes = with_own_types(plan), all_changes(plan)
    texts = {unit: SourceText(unit, sources[unit.path], changes) for unit in plan.program.units}

    @g.rule(
        domain=plan.program.units,
        template=lambda u: templates.header if kept or is_header(u) else templates.unit,
        target=lambda u: f"{plan.name}/{file_name(u, plan)}",
    )
    def Program(unit: ccode.SourceUnit) -> dict[str, Any]:
        text = texts[unit]
        if kept:
            return {"code": retained_parts(text)}
        return (
            own_header(plan, text)
            if is_header(unit)
            else {"plan": plan, "literal": pin_literal, **program_text(plan, text, late, texts)}
        )

    @g.rule(domain=[] if kept else [plan], template=templates.adapters, target=f"{plan.name}/{ADAPTERS_FILE}")
    def Adapters(_: migration.MigrationPlan) -> dict[str, Any]:
        listed = adapters(plan, separate_placeholders(plan))
        return {
            "plan": plan,
            **adapter_pieces(plan),
            "ports": port_table(plan),
            "adapters": [a for a in listed if a.use not in late],
            "renamed": [use for use in plan.adapterUses if use.targetName not in ("", use.name)],
        }

    looked_up = [plan] if kept and looks_up_ports(plan) else []

    @g.rule(domain=looked_up, template=templates.pins, target=f"{plan.name}/{MOVED_PINS}")
    def MovedPins(_: migration.MigrationPlan) -> dict[str, Any]:
        return {"plan": plan, **moved_pins(plan)}

    @g.rule(template=templates.project, target=f"{plan.name}/{templates.project_file}")
    def Project() -> Mapping[str, Json]:
        return {"plan": plan, **project}

    @g.rule(domain=list(templates.more), template=lambda name: templates.more[name], target=lambda name: f"{plan.name}/{name}")
    def Tools(_: str) -> Mapping[str, Json]:
        return {"plan": plan, **project}

    trial = f"{plan.name}_bench"
    benches = [trial] if plan.bench else []
    suffix = target_of(plan).fileSuffix

    @g.rule(domain=benches, template=templates.bench, target=f"{BENCH}/{trial}/{trial}{suffix}")
    def Bench(_: str) -> dict[str, Any]:
        return {"plan": plan, **bench(plan)}

    @g.rule(domain=benches, template=templates.project, target=f"{BENCH}/{trial}/{templates.project_file}")
    def BenchProject(_: str) -> Mapping[str, Json]:
        return {"plan": plan, **project, "libraries": [], "chosen": []}

    return g.make()


def report_file(plan: migration.MigrationPlan, sources: Mapping[str, bytes], known: Counted) -> Generation:
    """The report of a migration, its path relative to the output folder; nothing is written.

    Args:
        plan: a complete plan.
        sources: path of a unit -> its bytes.
        known: what was counted of the plan.

    Raises:
        RuleError: the template is wrong.
    """
    g = Gen()

    @g.rule(template="report/migration.md.j2", target=f"{plan.name}/{REPORT}")
    def Report() -> dict[str, Any]:
        return {"plan": plan, **report(plan, sources, known)}

    return g.make()


# ---- the table of ports

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
    called = {b.sourcePin: f": {b.name}" for b in plan.portBindings if b.sourcePin in texts and b.name != source_name(b)}
    count = max([_PORTS, *(number + 1 for number in texts)])
    return PortPins(
        UNBOUND,
        [texts.get(number, UNBOUND) for number in range(count)],
        [f"{number_name(plan.source, number)}{called.get(number, '')}" for number in range(count)],
    )


# ---- the bench sketch

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
