"""Constraints on the ports of a migration plan: one decision for each port, and one port on each pin.

`migrate` evaluates these on a new plan, `check` on a stored one together with all others (`plan`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import takewhile

from robosmi.base.quantities import quantity
from robosmi.diagnostics import Finding, Severity
from robosmi.metamodels import ccode, hardware, migration, platform
from robosmi.model import EmfModel
from robosmi.model.elements.strict import Element
from robosmi.query import root_of
from robosmi.transformations.constraints.electrical_plan import terminal_functions
from robosmi.transformations.knowledge.adapters.adapter_ranges import parameter_names
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.queries.circuits.component_kinds import kinds_of
from robosmi.transformations.queries.circuits.connector_names import displayed_names
from robosmi.transformations.queries.names import name_of
from robosmi.transformations.queries.plans.motors import SERVO, channel_of
from robosmi.transformations.queries.plans.plan_adapters import closure
from robosmi.transformations.queries.plans.port_pins import CONSOLE, bound_pin, source_name
from robosmi.transformations.queries.plans.retained_pins import retains_platform
from robosmi.transformations.queries.plans.waiting_calls import unwired_needs
from robosmi.transformations.queries.ports.macro_calls import MacroCalls
from robosmi.validate import EVL, Fail

ports = EVL()
"""The constraints on ports; evaluate them on a plan."""

by_words = EVL()
"""The constraints on ports that need the repository's data on which words mean which kinds of components."""

bindings = ports.context(migration.PortBinding)
uses = ports.context(migration.AdapterUse)
worded_bindings = by_words.context(migration.PortBinding)
connections = ports.context(migration.Connection)
MANY = 3
"""From this number on, components on one pin are a warning; with two, one may be a pull-up or an indicator."""


def port_faults(plan: migration.MigrationPlan, words: bool = True, model: EmfModel | None = None) -> list[Finding]:
    """The findings of these constraints on a plan.

    Args:
        plan: the plan.
        words: whether to evaluate `by_words`, too.
        model: the plan wrapped as a model, if available; its instances are indexed already.
    """
    judged = EVL()
    judged.include(ports)
    if words:
        judged.include(by_words)
    return judged.run(model if model is not None else EmfModel(plan, name="plan")).findings()


def plan_of(decision: Element) -> migration.MigrationPlan:
    """The plan that contains an element."""
    found = root_of(decision)
    assert isinstance(found, migration.MigrationPlan)
    return found


def _before(binding: migration.PortBinding) -> Iterator[migration.PortBinding]:
    """The bindings of the plan that come before one, so that two that contradict each other are reported once, at the second."""
    return takewhile(lambda other: other is not binding, plan_of(binding).portBindings)


def named(decision: migration.Decision) -> str:
    """How messages call a decision."""
    if isinstance(decision, migration.PortBinding):
        return f"port '{decision.name}'" if decision.name else f"port P{decision.sourcePin}"
    if isinstance(decision, migration.LibraryChoice):
        return f"library of '{decision.component.title}'" if decision.component is not None else "library of no component"
    element = decision.element if isinstance(decision, (migration.Disposition, migration.Widening)) else None
    if element is None:
        return "decision"
    return f"{name_of(element) or element.eClass.name} in line {element.line}"


@bindings.constraint(
    id="RS702", severity=Severity.warning, guard=lambda b: bound_pin(b) is not None, advice="bind one of them to another pin"
)
def PinIsBoundOnce(b: migration.PortBinding) -> bool | Fail:
    """No two ports of the source are bound to one pin."""
    pin = bound_pin(b)
    for other in _before(b):
        if bound_pin(other) is pin and (other.sourcePin != b.sourcePin or b.sourcePin < 0):
            assert pin is not None
            return Fail(f"the {named(b)} and the {named(other)} are both bound to pin {pin.label}", pin=pin.label)
    return True


@bindings.constraint(
    id="RS731",
    severity=Severity.warning,
    advice="check which part is on the port in the original's wiring; give both names its pin if they mean one part",
    guard=lambda b: b.sourcePin >= 0 and _on_one_pin(b),
)
def PortIsOnOnePin(b: migration.PortBinding) -> bool | Fail:
    """A port of the source that has several names is on one pin of the target."""
    pin = bound_pin(b)
    for other in _before(b):
        there = bound_pin(other)
        if other.sourcePin == b.sourcePin and _on_one_pin(other) and there is not pin:
            assert pin is not None
            assert there is not None
            parts = [listed_parts(each) for each in (other, b)]
            differ = f", with different parts ({parts[0]} and {parts[1]})" if all(parts) and parts[0] != parts[1] else ""
            return Fail(
                f"the original uses {source_name(b)} for the {named(other)} and the {named(b)}; they are now on separate pins, "
                f"{there.label} and {pin.label}{differ}",
                pin=pin.label,
            )
    return True


def listed_parts(b: migration.PortBinding) -> str:
    """The parts on the pin of a binding, in quotes; empty if nothing is drawn there."""
    pin = bound_pin(b)
    titles = (c.component.title for c in plan_of(b).connections if c.pin is pin and c.component is not None)
    return ", ".join(f"'{title}'" for title in dict.fromkeys(titles))


def _on_one_pin(b: migration.PortBinding) -> bool:
    """Whether a binding has a pin, and not one more on which its component answers."""
    return bound_pin(b) is not None and b.answer is None


@bindings.constraint(id="RS714", guard=lambda b: bool(plan_of(b).portFlows), advice="keep one of them, or migrate again")
def PortIsDecidedOnce(b: migration.PortBinding) -> bool | Fail:
    """A port of the source, identified by its number or, if conventional, by its name, has a single binding."""
    for other in _before(b):
        number = b.sourcePin >= 0 and other.sourcePin == b.sourcePin and "convention" not in (b.origin, other.origin)
        if number or other.name == b.name:
            return Fail(f"the {named(b)} has two bindings, to {other.choice or 'nothing'} and to {b.choice or 'nothing'}")
    return True


@bindings.constraint(
    id="RS720", severity=Severity.warning, advice="bind it to another pin",
    guard=lambda b: b.chosenBy is migration.ChosenBy.person and bound_pin(b) is not None,
)  # fmt: skip
def SerialLineIsFree(b: migration.PortBinding) -> bool | Fail:
    """No port is bound to a pin of the serial line to the computer if the program uses that line."""
    pin, talking = bound_pin(b), next(terminal_functions(plan_of(b)), None)
    assert pin is not None
    if talking is None or not pin.reserved or "uart" not in pin.abilities:
        return True
    return Fail(f"the {named(b)} is on {pin.label}, a pin of the serial port that the program uses ({talking})", pin=pin.label)


@bindings.constraint(
    id="RS725", severity=Severity.warning, guard=lambda b: bound_pin(b) is not None,
    advice="use a sensor with one signal wire, join both wires if its data sheet allows it, or write the body for two pins",
)  # fmt: skip
def WireIsTheOneOfTheComponent(b: migration.PortBinding) -> bool | Fail:
    """A function that sends and receives on one wire is used with a component that answers on the same wire."""
    plan, pin = plan_of(b), bound_pin(b)
    both = {str(use.name) for use in plan.adapterUses if use.adapter is not None and _on_one_wire(use.adapter)}
    calls = (call for flow in plan.portFlows if b in flow.bindings for call in flow.calls)
    call = next((call for call in calls if call.calleeName in both), None)
    component = next((c.component for c in plan.connections if c.pin is pin and c.component is not None), None)
    if call is None or component is None or b.answer is not None:
        return True
    wires = {c.signal: c for c in plan.connections if c.component is component and c.pin is not None}
    sent, heard = wires.get(migration.Signal.write), wires.get(migration.Signal.read)
    if sent is None or heard is None or sent.pin is heard.pin:
        return True
    assert sent.pin is not None
    assert heard.pin is not None
    where = f"'{component.title}' has two: {_wire(sent)} on {sent.pin.label} and {_wire(heard)} on {heard.pin.label}"
    return Fail(f"{call.calleeName} sends and listens on one wire ({named(b)}), and {where}")


@bindings.constraint(
    id="RS726", severity=Severity.warning, guard=lambda b: bound_pin(b) is not None,
    advice="bind the port to another pin, and move the wire",
)  # fmt: skip
def PinDoesWhatIsAsked(b: migration.PortBinding) -> bool | Fail:
    """A pin has the abilities that the functions of its port need; no other adapter uses its timer, no other port its output."""
    pin = bound_pin(b)
    assert pin is not None
    can = pin.abilities
    for name, capability, asked in (*requested_functions(b), *_retained_functions(b)):
        if capability is platform.PinCapability.digital and "digital" not in can and "analog_in" in can:
            if asked is None or asked.direction is not platform.Direction.input:
                return Fail(f"{name} drives the {named(b)}, but {pin.label} cannot be an output", pin=pin.label)
            if "interrupt" not in can:  # one with an interrupt reads levels, as the inputs of an ESP32
                return Fail(f"{name} reads the level of the {named(b)}, but {pin.label} only measures voltages", pin=pin.label)
        if capability is platform.PinCapability.pwm and "pwm" not in can:
            return Fail(f"{pin.label} of the {named(b)} has no PWM, so {name} only switches it on or off", pin=pin.label)
        if capability is platform.PinCapability.analog and "analog_in" not in can:
            return Fail(f"{name} measures a voltage, but {pin.label} of the {named(b)} cannot", pin=pin.label)
        if capability is platform.PinCapability.interrupt and "interrupt" not in can and retains_platform(plan_of(b)):
            return Fail(f"{pin.label} of the {named(b)} has no interrupt, so {name} cannot watch it", pin=pin.label)
        takers = [use.name for use in plan_of(b).adapterUses if use.name != name and pin.timer in _timers(use)]
        if capability is platform.PinCapability.pwm and pin.timer and takers:
            message = f"{name} needs the PWM of {pin.label} for the {named(b)}, but {takers[0]} uses its timer {pin.timer}"
            return Fail(message, pin=pin.label)
        if capability is platform.PinCapability.pwm and (other := _sharer(b, _output, capability)):
            message = f"{pin.label} of the {named(b)} has the same output of {pin.timer} as {other}: {name} changes both"
            return Fail(message, pin=pin.label)
        if capability is platform.PinCapability.interrupt and (other := _sharer(b, _line, capability)):
            message = f"{pin.label} of the {named(b)} has the same line of interrupts as {other}: one of them has no interrupt"
            return Fail(message, pin=pin.label)
    return True


def _output(pin: platform.Pin) -> tuple[str, str]:
    return pin.timer, pin.channel


def _line(pin: platform.Pin) -> tuple[str, str]:
    return "interrupt", pin.interruptLine


def _sharer(b: migration.PortBinding, shared: Callable[[platform.Pin], tuple[str, str]], needed: platform.PinCapability) -> str:
    """An earlier port that needs an ability on another pin with what is shared, as messages call it; empty if there is none."""
    pin = bound_pin(b)
    for other in _before(b) if pin is not None and all(shared(pin)) else ():
        there = bound_pin(other)
        if there is None or pin is None or there is pin or shared(there) != shared(pin):
            continue
        if any(each is needed for _, each, _ in (*requested_functions(other), *_retained_functions(other))):
            return f"the {named(other)} on {there.label}"
    return ""


_Request = tuple[str, platform.PinCapability, platform.AdapterPin | platform.ConventionalPort | None]
"""A function, the ability that it needs of a pin, and what tells whether it reads or drives the pin; None: it drives it."""
_NEEDED = {
    "digital": platform.PinCapability.digital,
    "pwm": platform.PinCapability.pwm, "analog_in": platform.PinCapability.analog, "interrupt": platform.PinCapability.interrupt
}  # fmt: skip


def _retained_functions(b: migration.PortBinding) -> Iterator[_Request]:
    """The functions of a platform that stays, each with the ability that it needs and that the pin of the source board has."""
    plan = plan_of(b)
    if not retains_platform(plan) or plan.source is None:
        return
    old = next((each.board for each in plan.source.boardMappings if each.board is not None), None)
    label = source_name(b)
    there = next((pin for pin in old.pins if pin.label == label), None) if old is not None else None
    needs = ApiIndex.load(str(plan.source.name)).settings.get("ports", {}).get("abilities", {})
    for flow in plan.portFlows if there is not None else ():
        for call in flow.calls if b in flow.bindings else ():
            ability = needs.get(str(call.calleeName), "")
            if there is not None and ability in there.abilities:
                yield str(call.calleeName), _NEEDED[ability], None


def requested_functions(b: migration.PortBinding) -> Iterator[_Request]:
    """The functions that receive a port, each with the ability that it needs of the pin."""
    if b.conventionalPort is not None:
        yield b.name, b.conventionalPort.capability, b.conventionalPort
    plan = plan_of(b)
    adapters = {str(use.name): use.adapter for use in plan.adapterUses if use.adapter is not None}
    for flow in plan.portFlows:
        for call in flow.calls if b in flow.bindings else ():
            adapter = adapters.get(str(call.calleeName))
            if adapter is None:
                continue
            names = [name for signature in adapter.signatures[:1] for name in parameter_names(signature)]
            for pin in adapter.pins:
                if len(adapter.pins) == 1 or (pin.name in names and _is_given(b, call, names.index(pin.name))):
                    yield str(call.calleeName), pin.capability, pin


def _is_given(b: migration.PortBinding, call: ccode.Call, position: int) -> bool:
    """Whether a call's argument at a position is a port, by name or by number."""
    argument = call.arguments[position] if position < len(call.arguments) else None
    if isinstance(argument, ccode.IntegerLiteral):
        return bool(argument.value == b.sourcePin)
    return isinstance(argument, ccode.NameReference) and argument.name in (b.name, *b.names)


def _timers(use: migration.AdapterUse) -> set[str]:
    """The timers that a use's adapter and the pieces it needs occupy."""
    return {str(t) for piece in closure([use.adapter] if use.adapter is not None else []) for t in piece.timers}


@uses.constraint(
    id="RS730", severity=Severity.warning, guard=lambda u: u.adapter is not None,
    advice="bind the port to the pin where such a part is wired, or remove the calls",
)  # fmt: skip
def WhatIsAskedIsWired(u: migration.AdapterUse) -> bool | Fail:
    """A function does not read a sensor that the user declared as not wired."""
    missing = [b for b in unwired_needs(plan_of(u), u)[0] if b.signal is migration.Signal.read]
    if not missing or u.adapter is None:
        return True
    names = " and ".join(f"'{b.name}'" for b in missing)
    known = f"; its adapter {'; '.join(str(limit) for limit in u.adapter.limits)}" if u.adapter.limits else ""
    count = len(u.calls) + len(MacroCalls(plan_of(u)).of(u))
    return Fail(
        f"'{u.name}' ({quantity(count, 'call')}) reads {names}, "
        f"but {'it is' if len(missing) == 1 else 'they are'} not wired{known}"
    )


@bindings.constraint(
    id="RS732", severity=Severity.warning, guard=lambda b: b.role == SERVO and bound_pin(b) is not None,
    advice="let a servo board such as a PCA9685 make the pulses of some, or choose a board whose library Servo has more places",
)  # fmt: skip
def ServoHasAPlace(b: migration.PortBinding) -> bool | Fail:
    """The servos on pins are no more than the target makes pulses for; the first one beyond is reported."""
    plan = plan_of(b)
    used = [use.adapter for use in plan.adapterUses if use.adapter is not None]
    most = min((int(piece.mostServos) for piece in closure(used) if piece.mostServos), default=0)
    before = list(dict.fromkeys(pin for other in _before(b) if (pin := _servo_pin(other)) is not None))
    pin = _servo_pin(b)
    if not most or pin is None or pin in before or len(before) != most:
        return True
    total = len({each.label for other in plan.portBindings if (each := _servo_pin(other)) is not None})
    message = f"{total} servos are on pins of the board, which makes pulses for {most} at a time: those that move last get none"
    return Fail(message, pin=pin.label)


def _servo_pin(b: migration.PortBinding) -> platform.Pin | None:
    """The pin of a port with a servo that gets pulses; None for others, and for motors that stand for servos."""
    turned = b.role == SERVO and channel_of(b, plan_of(b).motorChannels) is None
    return bound_pin(b) if turned else None


@bindings.constraint(
    id="RS733", severity=Severity.warning, guard=lambda b: b.choice == CONSOLE,
    advice="bind the other port to the console, too, or this one to a pin",
)  # fmt: skip
def LineIsTheConsoleWhole(b: migration.PortBinding) -> bool | Fail:
    """A serial line whose one port is the console, which has no pins, does not have its other port on a pin."""
    flows = plan_of(b).portFlows
    calls = [call for flow in flows if b in flow.bindings for call in flow.calls]
    for other in (other for flow in flows if any(call in calls for call in flow.calls) for other in flow.bindings):
        if (pin := bound_pin(other)) is not None:
            return Fail(
                f"the {named(b)} is the console's, and the {named(other)} of the same line is on {pin.label}: "
                f"the line uses {pin.label} alone, and nothing of it reaches the console", pin=pin.label,
            )  # fmt: skip
    return True


@worded_bindings.constraint(
    id="RS727", severity=Severity.warning, advice="check whether another connection is intended",
    guard=lambda b: b.chosenBy is migration.ChosenBy.person and b.connection is not None and b.connection.component is not None,
)  # fmt: skip
def ComponentIsWhatTheProgramExpects(b: migration.PortBinding) -> bool | Fail:
    """A port that the user binds is on a component of the kind that its functions expect, and an output device is not read.

    A motor driver's channel turns a motor instead of a servo (RS269).
    """
    connection = b.connection
    assert connection is not None
    assert connection.component is not None
    title, kinds = connection.component.title, kinds_of(connection)
    turned = b.role == SERVO and channel_of(b, plan_of(b).motorChannels) is not None
    if b.role and kinds and b.role not in kinds and not turned:
        return Fail(f"the {named(b)} is bound to '{title}' ({', '.join(sorted(kinds))}), but its functions expect: {b.role}")
    reads = b.origin != "convention" and b.signal is not migration.Signal.write and connection.signal is migration.Signal.write
    silent = reads and connection.component.role is hardware.Role.Output
    return not silent or Fail(f"the program reads the {named(b)}, but '{title}' there has no output")


def _on_one_wire(adapter: platform.Adapter) -> bool:
    return any(pin.direction is platform.Direction.both and pin.componentRole for pin in adapter.pins)


def _wire(connection: migration.Connection) -> str:
    return next(iter(displayed_names(connection.connectors)), str(connection.name))


@connections.critique(id="RS724", info=True, advice="check that the drawing is right; bind ports by the mapping's name")
def PinReachesOneComponent(c: migration.Connection) -> bool | Fail:
    """A pin that is not a bus reaches one component; with several, a port bound to the pin is named after the first."""
    titles = _on_pin(c)
    if len(titles) != MANY - 1:
        return True
    assert c.pin is not None
    return Fail(f"pin {c.pin.label} reaches {len(titles)} components: {', '.join(titles)}", pin=c.pin.label)


@connections.constraint(id="RS715", severity=Severity.warning, advice="check that the drawing is right")
def PinReachesFewComponents(c: migration.Connection) -> bool | Fail:
    """A pin that is not a bus reaches two components at most."""
    titles = _on_pin(c)
    if len(titles) < MANY:
        return True
    assert c.pin is not None
    return Fail(f"pin {c.pin.label} reaches {len(titles)} components: {', '.join(titles)}", pin=c.pin.label)


def _on_pin(c: migration.Connection) -> list[str]:
    """The titles of the components on a connection's pin; empty for a bus, and for all but the pin's first connection."""
    of_plan = plan_of(c).connections
    if c.pin is None or next(other for other in of_plan if other.pin is c.pin) is not c:
        return []
    same = [other for other in of_plan if other.pin is c.pin]
    if any(other.signal is migration.Signal.bus for other in same):
        return []
    return list(dict.fromkeys(str(o.component.title) for o in same if o.component is not None))
