"""Constraints on program, drawing and libraries in combination: directions, timers, serial port, number of pins.

They apply to a plan with a drawing. Constraints on the drawing alone are in `electrical`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from robosmi.base.quantities import quantity
from robosmi.diagnostics import Finding, Location
from robosmi.metamodels import hardware, migration, platform
from robosmi.model import EmfModel
from robosmi.model.elements.strict import Element
from robosmi.query import ancestor_of_kind, root_of
from robosmi.transformations.constraints.electrical import electrical
from robosmi.transformations.constraints.finding_locations import drawing, fault, worst_first
from robosmi.transformations.knowledge.libraries.library_ranking import architecture_facts, library_index
from robosmi.transformations.knowledge.libraries.library_takes import taken_of
from robosmi.transformations.queries.circuits.circuit import role_on
from robosmi.transformations.queries.circuits.connector_names import displayed_name
from robosmi.transformations.queries.circuits.electrical import Kind, Role, Wiring, listed, who, wiring
from robosmi.transformations.queries.plans.motors import SERVO, channel_of, without_motor
from robosmi.transformations.queries.plans.plan_adapters import port_calls
from robosmi.transformations.queries.plans.port_pins import bound_pin, of_own_serial_port
from robosmi.validate import EVL, Fail

together = EVL()
"""The constraints on program, drawing and libraries in combination; evaluate them on a plan."""

by_index = EVL()
"""Those of them that need the repository's index of libraries, too."""

_both = EVL()  # one run, so that the wiring is made once
_both.include(electrical)
_both.include(together)

TONE = "tone"
"""The name, in the data of microcontrollers, of the core function that drives a speaker."""


def plan_faults(plan: migration.MigrationPlan, model: EmfModel | None = None, index: bool = True) -> list[Finding]:
    """The findings on a plan's drawing, alone and in combination with program and libraries, the most severe first.

    Args:
        plan: the plan; without a drawing nothing is found.
        model: the plan wrapped as a model, if available; its instances are indexed already.
        index: whether to evaluate `by_index`, too.
    """
    if plan.circuit is None:
        return []
    judged = EVL()
    judged.include(_both)
    if index:
        judged.include(by_index)

    @judged.pre
    def BoardIsThatOfThePlan() -> None:  # the first to ask makes the wiring of a run: stored plans need no repository
        wired(plan)

    model = model if model is not None else EmfModel(plan, name="plan")
    return worst_first(judged.run(EmfModel(plan.circuit, name="hardware"), model).findings())


def plan_rules(index: bool = True) -> frozenset[str]:
    """The ids of the constraints that `plan_faults` evaluates."""
    return frozenset(constraint.id for module in ((_both, by_index) if index else (_both,)) for constraint in module.declared())


MOTOR_DRIVER = "motor driver"
"""Kinds of components at a port, and that of a part, as the repository's data call them."""


def of_plan(element: Element) -> migration.MigrationPlan | None:
    """The plan that contains an element; None if there is none."""
    found = root_of(element)
    return found if isinstance(found, migration.MigrationPlan) else None


def is_drawn(element: Element) -> bool:
    """Whether the element's plan has a drawing."""
    plan = of_plan(element)
    return plan is not None and plan.circuit is not None


def wired(plan: migration.MigrationPlan) -> Wiring:
    """The wiring of a plan's drawing."""
    assert plan.circuit is not None
    known = wiring(plan.circuit)
    if plan.boardComponent is not None and plan.board is not None:
        known.know_board(plan.boardComponent, plan.board)
    return known


def place(element: Element) -> Location | None:
    """The drawing of a plan's element."""
    plan = of_plan(element)
    return drawing(plan.circuit.components[0]) if plan is not None and plan.circuit is not None else None


bindings = together.context(
    migration.PortBinding, guard=lambda b: is_drawn(b) and (b.connection is not None or b.pin is not None)
)
plans = together.context(migration.MigrationPlan, guard=is_drawn)
connections = together.context(migration.Connection)
choices = together.context(migration.LibraryChoice, guard=lambda c: is_drawn(c) and c.chosen is not None)
indexed_choices = by_index.context(migration.LibraryChoice, guard=lambda c: is_drawn(c) and c.chosen is not None)


def is_sensed(connection: migration.Connection | None) -> bool:
    """Whether a connection carries the output signal of a sensor."""
    return (
        connection is not None
        and connection.component is not None
        and connection.signal is migration.Signal.read
        and role_on(connection) == "Input"
        and connection.component.role is Role.Input
    )


def _is_written(binding: migration.PortBinding) -> bool:
    return binding.signal is migration.Signal.write


def _is_scanned(connection: migration.Connection) -> bool:
    """Whether a component without supply, such as a keypad, is scanned: the program writes one pin of it and reads another."""
    component, plan = connection.component, of_plan(connection)
    assert component is not None
    assert plan is not None
    if any(c.kind in (Kind.supply, Kind.ground) or (c.net is not None and c.net.rail) for c in component.connectors):
        return False
    others = (b for b in plan.portBindings if b.connection is not connection)
    return any(b.connection is not None and b.connection.component is component and not _is_written(b) for b in others)


@bindings.constraint(
    id="RS260",
    location=place,
    advice="bind the port to another pin, or correct the drawing",
    guard=lambda b: is_sensed(b.connection),
)
def DoesNotDriveASensor(b: migration.PortBinding) -> bool | Fail:
    """The program does not drive a pin that is wired to a sensor's output."""
    connection = b.connection
    assert connection is not None
    assert connection.component is not None
    if not _is_written(b) or _is_scanned(connection):
        return True
    component, label = connection.component, connection.pin.label if connection.pin is not None else ""
    return fault(
        component, f"the program drives the port '{b.name}' ({label}), but the sensor '{who(component)}' outputs its signal there"
    )


@bindings.critique(
    id="RS261", info=True, location=place, advice="nothing, if the sensor needs this", guard=lambda b: is_sensed(b.connection)
)
def OnlyListensToASensor(b: migration.PortBinding) -> bool | Fail:
    """A pin that is wired to a sensor's output is only read."""
    connection = b.connection
    assert connection is not None
    assert connection.component is not None
    if b.signal is not migration.Signal.bus:
        return True
    sensor = connection.component
    return fault(sensor, f"the program may drive the port '{b.name}' before it reads '{who(sensor)}' there")


@bindings.constraint(
    id="RS269",
    location=place,
    advice="wire the channel to pins of the board as the message says, or bind the port to the signal pin of a continuous servo",
    guard=lambda b: b.role == SERVO,
)
def DriverTurnsAMotor(b: migration.PortBinding) -> bool | Fail:
    """A servo's port on a motor driver has a complete channel of its own, and functions that an adapter drives a motor for."""
    plan, pin = of_plan(b), bound_pin(b)
    assert plan is not None
    parts = [c.component for c in plan.connections if c.component is not None and c.pin is not None and c.pin is pin]
    driver = next((part for part in parts if wired(plan).facts(part).kind == MOTOR_DRIVER), None)
    if driver is None:
        return True
    where = pin.label if pin is not None else ""
    why = _no_motor(plan, b, where)
    what = f"the port '{b.name}' ({where}) cannot turn a motor through '{who(driver)}'"
    return not why or fault(driver, f"{what}: {why}", pin=where)


def _no_motor(plan: migration.MigrationPlan, b: migration.PortBinding, where: str) -> str:
    """Why a port of a servo on a motor driver turns no motor; empty if it does."""
    channel = channel_of(b, plan.motorChannels)
    if channel is None:
        return f"{where} is at no input for PWM or direction of a known motor driver"
    if channel.missing:
        return "; ".join(channel.missing)
    if other := next((o for o in plan.portBindings if o is not b and channel_of(o, [channel]) is not None), None):
        return f"the port '{other.name}' is on the same channel"
    return without_motor(plan, b)


@bindings.critique(
    id="RS270",
    location=place,
    advice="add a capacitor from the pin to ground and take the divider's resistor out, or read the voltage with analogRead",
    guard=lambda b: bool(b.discharges) and b.connection is not None,
)
def HasACapacitor(b: migration.PortBinding) -> bool | Fail:
    """Where functions measure the discharge of a capacitor, the part at the pin gives no voltage of its own without one."""
    plan, connection = of_plan(b), b.connection
    assert plan is not None
    assert connection is not None
    component = connection.component
    w = wired(plan)
    nets = [end.net for end in (*connection.connectors, *connection.boardConnectors) if end.net is not None]
    if component is None or any(_is_capacitor(owner) for net in nets for owner, _ in w.on(net)):
        return True
    if any(_is_capacitor(part) for part in connection.via):
        return True
    if not _gives_voltage(w, connection) and not _is_divided(w, component, nets):
        return True
    label = connection.pin.label if connection.pin is not None else ""
    what = f"the port '{b.name}' ({label}) measures the discharge of a capacitor"
    does = "drives its output" if w.facts(component).output == _DRIVES else "is a voltage divider without one"
    return fault(component, f"{what}, but '{who(component)}' there {does}", pin=label)


_DRIVES = "push-pull"


def _is_capacitor(part: hardware.Component) -> bool:
    return "capacitor" in f"{part.family} {part.partTitle} {part.title}".lower()


def _gives_voltage(w: Wiring, connection: migration.Connection) -> bool:
    """Whether a component drives its output, or a connector is called the output of a voltage."""
    assert connection.component is not None
    facts = w.facts(connection.component)
    outputs = () if "*" in facts.analog else facts.analog  # bare parts are not called anything
    ends = connection.connectors
    return facts.output == _DRIVES or any(w.means(end, "analog") or end.name.strip().lower() in outputs for end in ends)


def _is_divided(w: Wiring, component: hardware.Component, nets: Sequence[hardware.Net]) -> bool:
    """Whether a component of two terminals and a resistor, or both ends of a potentiometer, join a pin to two different rails."""
    own = {net for _, net in w.nets(component) if net.rail}
    if w.facts(component).kind == "potentiometer":
        return len(own) > 1
    return len(component.connectors) == 2 and bool(own) and any(_resistor_rails(w, net) - own for net in nets if not net.rail)


def _resistor_rails(w: Wiring, net: hardware.Net) -> set[hardware.Net]:
    """The rails that a resistor joins a net to."""
    passive = [owner for owner, _ in w.on(net) if owner.role is Role.Passive]
    resistors = [owner for owner in passive if "resistor" in f"{owner.family} {owner.partTitle}".lower()]
    return {far for owner in resistors for _, far in w.nets(owner) if far.rail}


@bindings.critique(
    id="RS271",
    location=place,
    advice="use a continuous rotation servo there, or a motor with a motor driver",
    guard=lambda b: b.role == SERVO and b.connection is not None and b.connection.component is not None,
)
def TurnsOnAsAWheel(b: migration.PortBinding) -> bool | Fail:
    """A servo that turns to an angle is not driven as a wheel."""
    plan, connection = of_plan(b), b.connection
    assert plan is not None
    assert connection is not None
    component = connection.component
    assert component is not None
    wheel = "it is a wheel of the drive" if b.conventionalPort is not None else _speed_function(plan, b)
    if not wheel or not component.positional:
        return True
    label = connection.pin.label if connection.pin is not None else ""
    what = f"'{who(component)}' ({label}) turns to an angle and cannot turn on"
    return fault(component, f"{what}, but for the port '{b.name}' {wheel}", pin=label)


def _speed_function(plan: migration.MigrationPlan, b: migration.PortBinding) -> str:
    """The function that sets a speed at a port, as half a sentence; empty if there is none."""
    called = {str(call.calleeName) for call in port_calls(plan, b)}
    for use in plan.adapterUses:
        told = use.function is not None and any(p.meaning is platform.Meaning.speed for p in use.function.parameters)
        if told and str(use.name) in called:
            return f"{use.name} sets a speed"
    return ""


@bindings.critique(
    id="RS272",
    location=place,
    advice="add a level shifter or a voltage divider between them",
    guard=lambda b: b.signal is not migration.Signal.read and bound_pin(b) is not None,
)
def HostBearsTheLevels(b: migration.PortBinding) -> bool | Fail:
    """The program does not drive a pin that is wired directly to another computer or board whose pins bear a lower voltage."""
    plan, pin = of_plan(b), bound_pin(b)
    assert plan is not None
    assert pin is not None
    volts = float(plan.board.volts) if plan.board is not None else 0.0
    for host, end in _others_at(plan, pin):
        most = wired(plan).facts(host).signal_volts
        if host.role in (Role.Unknown, Role.Board) and most is not None and volts > most:
            what = f"the program drives {pin.label} with {volts:g} V, and it is wired to {displayed_name(end)} of '{who(host)}'"
            return fault(host, f"{what}, whose pins bear {most:g} V", pin=pin.label)
    return True


def _others_at(plan: migration.MigrationPlan, pin: platform.Pin) -> list[tuple[hardware.Component, hardware.Connector]]:
    """What is wired to a pin, with its connectors: components, and boards that run other programs."""
    w, board = wired(plan), plan.boardComponent
    nets = [net for end, net in w.nets(board) if end.pin == pin.label and not net.rail] if board is not None else []
    return [(owner, end) for net in nets for owner, end in w.on(net) if owner is not board]


@bindings.critique(
    id="RS262", location=place, advice="draw the part there, or bind the port to another pin",
    guard=lambda b: b.connection is None and b.pin is not None and not of_own_serial_port(b),
)  # fmt: skip
def SomethingIsThere(b: migration.PortBinding) -> bool | Fail:
    """A port of the program is bound to a pin that is wired in the drawing."""
    plan, pin = of_plan(b), b.pin
    assert plan is not None
    assert pin is not None
    if "LED_BUILTIN" in pin.aliases or any(c.pin is pin for c in plan.connections):
        return True
    if any(owner.role is Role.Board for owner, _ in _others_at(plan, pin)):
        return True
    return Fail(f"the program uses the port '{b.name}' on {pin.label}, but nothing is wired there", pin=pin.label)


@plans.constraint(id="RS267", location=place, advice="use a board with more pins, or let devices share a bus")
def PinsAreEnough(p: migration.MigrationPlan) -> bool | Fail:
    """The board has as many pins as the program uses."""
    used = {b.sourcePin for b in p.portBindings if b.sourcePin >= 0}
    has = len(p.board.pins) if p.board is not None else len(used)
    if len(used) <= has:
        return True
    assert p.board is not None
    return Fail(
        f"the program uses {quantity(len(used), 'pin')}, but {p.board.title or p.board.name} has {has}", used=len(used), has=has
    )


@plans.constraint(id="RS268", location=place, advice="separate the pins in the drawing, or bind one of the ports to another pin")
def WrittenPinsAreApart(p: migration.MigrationPlan) -> bool | Fail:
    """Pins that the program drives are not connected to each other."""
    w, board = wired(p), p.boardComponent
    written = {pin.label: b for b in p.portBindings if _is_written(b) and (pin := bound_pin(b)) is not None}
    for _, net in w.nets(board) if board is not None else ():
        labels = [label for owner, label in w.pins_at(net) if owner is board and label in written]
        if len(labels) > 1 and not net.rail:
            return Fail(f"the program drives {listed(labels)}, which are joined in the drawing", pins=", ".join(labels))
    return True


@plans.critique(id="RS263", location=place, advice="choose another library for one of them")
def TimersAreNotShared(p: migration.MigrationPlan) -> bool | Fail:
    """No two libraries that the sketch includes, or that the user chose, use the same timer."""
    clashes = []
    users = timer_users(p)
    for timer in sorted({timer for timers, _ in users.values() for timer in timers}):
        sharing = [f"{name}{f' (when {when})' if when else ''}" for name, (timers, when) in users.items() if timer in timers]
        if len(sharing) > 1:
            clashes.append(f"{timer} is needed by {listed(sharing)}")
    return not clashes or Fail("; ".join(clashes))


def timer_users(plan: migration.MigrationPlan) -> dict[str, tuple[tuple[str, ...], str]]:
    """The users of timers in a plan, by name, each with its timers and the condition under which it uses them.

    They are the chosen libraries, and the core's function for speakers if one is driven without a library.
    """
    core = taken_of(plan.board, platform.UserKind.function) if plan.board is not None else {}
    found = {
        c.chosen.name: (tuple(c.chosen.timers), c.chosen.takesWhen)
        for c in plan.libraryChoices
        if c.chosen is not None and _counts(c) and c.chosen.timers
    }
    chosen = {c.component for c in plan.libraryChoices if c.chosen is not None}
    w = wired(plan)
    sounded = [
        c.component
        for c in plan.connections
        if c.component is not None
        and c.component not in chosen
        and c.signal is migration.Signal.write
        and w.facts(c.component).tone
    ]
    if sounded and TONE in core:
        found[f"{TONE}() for '{who(sounded[0])}'"] = (core[TONE].timers, "")
    return found


@plans.critique(id="RS264", location=place, advice="use a pin whose PWM comes from another timer")
def PwmIsNotTaken(p: migration.MigrationPlan) -> bool | Fail:
    """A device that needs PWM is not on a pin whose timer a library uses."""
    users = timer_users(p)
    lost = [
        f"{c.pin.label} of '{who(c.component)}' ({name} uses {c.pin.timer})"
        for c in p.connections
        if c.pin is not None and c.component is not None and c.pin.timer and _wants_pwm(wired(p), c)
        for name, (timers, _) in users.items()
        if c.pin.timer in timers
    ]
    return not lost or Fail(f"no PWM on {listed(lost)}")


def _wants_pwm(w: Wiring, connection: migration.Connection) -> bool:
    component = connection.component
    assert component is not None
    if "pwm" in w.facts(component).wants:
        return True
    return bool(component.driver) and any(w.means(c, "pwm") for c in connection.connectors)


def _counts(choice: migration.LibraryChoice) -> bool:
    """Whether a chosen library is included by the sketch, or was chosen by the user and so is meant to be used."""
    return bool(choice.included) or choice.chosenBy is migration.ChosenBy.person


@choices.critique(id="RS265", location=place, guard=_counts, advice="move the device to another pin, or choose another library")
def PinsAreNotTaken(c: migration.LibraryChoice) -> bool | Fail:
    """A library that the sketch includes, or that the user chose, does not use a pin that another device is on."""
    plan, library = of_plan(c), c.chosen
    assert plan is not None
    assert library is not None
    own = {o.component for o in plan.libraryChoices if o.chosen is library}
    for connection in plan.connections:
        device = connection.component
        pin = connection.pin.label if connection.pin is not None else ""
        if pin in library.pins and device is not None and device not in own and connection.signal is not migration.Signal.bus:
            return fault(device, f"{library.name}, chosen for {_for(c)}, uses {pin}, but '{who(device)}' is on that pin", pin=pin)
    return True


@indexed_choices.critique(id="RS274", location=place, advice="choose a library that lists the architecture, or none")
def LibraryWorksOnTheBoard(c: migration.LibraryChoice) -> bool | Fail:
    """Nothing is known against a chosen library on the architecture of the board."""
    plan, library = of_plan(c), c.chosen
    assert plan is not None
    assert library is not None
    architecture = plan.target.architecture if plan.target is not None else ""
    if not architecture or architecture in library.architectures or plan.targetDescription is None:
        return True
    index = str(plan.targetDescription.libraryIndex)
    found = library_index(index).library_named(str(library.name)) if index else None
    why = architecture_facts(index).objection(found, str(architecture)) if found is not None else ""
    message = f"{library.name}, chosen for {_for(c)}, {why}"
    return not why or (fault(c.component, message) if c.component is not None else Fail(message))


def _for(choice: migration.LibraryChoice) -> str:
    return f"'{who(choice.component)}'" if choice.component is not None else "another component"


@connections.critique(
    id="RS266", location=place, advice="move it to another pin", guard=lambda c: is_drawn(c) and _is_at_serial(c)
)
def SerialPinIsFree(c: migration.Connection) -> bool | Fail:
    """A pin of the serial port to the computer is free if the program uses that port."""
    plan, pin, component = of_plan(c), c.pin, c.component
    assert plan is not None
    assert pin is not None
    assert component is not None
    talking = next(terminal_functions(plan), None)
    if talking is None:
        return True
    message = f"the program uses the serial port ({talking}), but '{who(component)}' is on its pin {pin.label}"
    return fault(component, message, pin=pin.label)


def _is_at_serial(connection: migration.Connection) -> bool:
    pin = connection.pin
    return pin is not None and connection.component is not None and bool(pin.reserved) and "uart" in pin.abilities


def terminal_functions(plan: migration.MigrationPlan) -> Iterator[str]:
    """The functions called by the program whose first argument is text for the terminal."""
    for use in plan.adapterUses:
        function = use.function
        if function is not None and len(use.calls) and ancestor_of_kind(function, platform.Header) is not None:
            parameters = list(function.parameters)
            if parameters and parameters[0].meaning is platform.Meaning.text:
                yield function.name
