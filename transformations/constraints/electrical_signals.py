"""Constraints on signals: a single driver for each net, and pins with the abilities that the devices on them need.

The abilities of a pin are data of the board. Pins of boards without data are not checked.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from robosmi.metamodels import hardware
from robosmi.transformations.constraints.electrical_supply import of_table, wiring_of
from robosmi.transformations.constraints.finding_locations import drawing, fault
from robosmi.transformations.queries.circuits.connector_names import displayed_name
from robosmi.transformations.queries.circuits.electrical import BoardPin, Kind, Role, Wiring, listed, who
from robosmi.validate import EVL, Fail

signals = EVL()
"""The constraints on signals; evaluate them on a hardware model."""

nets = signals.context(hardware.Net, guard=lambda n: n.circuit is not None and not n.rail)
devices = signals.context(
    hardware.Component, guard=lambda c: c.circuit is not None and c.role in (Role.Input, Role.Output, Role.Both)
)


@nets.constraint(id="RS232", location=drawing, advice="give each its own pin")
def HasOneSource(n: hardware.Net) -> bool | Fail:
    """A net is driven by one sensor at most."""
    w = wiring_of(n)
    driving = [o for o, c in w.on(n) if o.role is Role.Input and w.facts(o).output == "push-pull" and w.means(c, "output")]
    if len(set(driving)) < 2:
        return True
    names = listed([f"'{who(o)}'" for o in driving])
    return fault(driving[1], f"the outputs of {names} are joined and drive against each other")


@nets.critique(id="RS233", location=drawing, advice="separate them, unless the data sheet allows it")
def DriversAreApart(n: hardware.Net) -> bool | Fail:
    """Outputs of drivers are not connected to each other."""
    w = wiring_of(n)
    driving = [(o, c) for o, c in w.on(n) if o.driver and w.means(c, "driver_output")]
    if len({(o, c.name) for o, c in driving}) < 2:  # one output may have two connectors
        return True
    said = listed([f"{displayed_name(c)} of '{who(o)}'" for o, c in driving])
    return fault(driving[1][0], f"outputs are joined: {said}")


@devices.critique(
    id="RS256", location=drawing,
    advice="add a resistor of 10 kilo-ohms from the pin to the other supply; an internal pull-up does not help, because the "
    "program's functions that read the pin switch it off",
)  # fmt: skip
def IsHeldWhileOpen(c: hardware.Component) -> bool | Fail:
    """A pin that a switch connects to a supply has a defined level while the switch is open."""
    w = wiring_of(c)
    rails = {net for _, net in w.nets(c) if net.rail}
    if of_table(c) or w.facts(c).output != "contact":
        return True
    if len(rails) != 1:  # of two rails a change-over switch always joins its pin to one
        return True
    open_pins = [p.label for p in w.board_pins(c) if not w.once("held", p.net, partial(_is_held, w, p.net))]
    message = f"no resistor holds {listed(open_pins)} while '{who(c)}' is open" if open_pins else ""
    return not open_pins or fault(c, message, pins=", ".join(open_pins))


def _is_held(w: Wiring, start: hardware.Net) -> bool:
    """Whether a net has a defined level: through resistors to a supply, or by a device other than a contact."""
    seen, todo = {start}, [start]
    while todo:
        net = todo.pop()
        for owner, _ in w.on(net):
            if owner.role is Role.Passive and "capacitor" not in f"{owner.family} {owner.partTitle}".lower():
                across = w.across(owner, net)
                if across is not None and across.rail:
                    return True
                if across is not None and across not in seen:
                    seen.add(across)
                    todo.append(across)
            elif owner.role in (Role.Input, Role.Output, Role.Both) and w.facts(owner).output != "contact":
                return True
    return False


def lacking(component: hardware.Component, ability: str, needs: Callable[[Wiring, BoardPin], bool]) -> list[str]:
    """The labels of the board pins on which a component needs an ability that they lack."""
    w = wiring_of(component)
    pins = [p for p in w.board_pins(component) if p.pin is not None]
    served = {p.net for p in pins if p.pin is not None and ability in p.pin.abilities}
    return [p.label for p in pins if p.net not in served and needs(w, p)]


def _analogue_input(c: hardware.Component) -> str:
    """The advice to use an analogue input, with one that the board of a component has."""
    w = wiring_of(c)
    models = [model for board in w.boards if (model := w.board_model(board)) is not None]
    labels = [str(pin.label) for model in models for pin in model.pins if "analog_in" in pin.abilities]
    return f"use an analogue input, such as {'A0' if 'A0' in labels or not labels else labels[0]}"


@devices.critique(id="RS240", location=drawing, advice=_analogue_input)
def IsMeasuredOnAnAnaloguePin(c: hardware.Component) -> bool | Fail:
    """An analogue voltage is on an analogue input."""
    given = wiring_of(c).facts(c).analog
    by_name = any(connector.name.strip().lower() in given for connector in c.connectors)

    def needs(w: Wiring, p: BoardPin) -> bool:
        name = p.connector.name.strip().lower()
        any_one = "*" in given and not by_name and p.connector.kind is Kind.unknown
        return any_one or name in given or w.means(p.connector, "analog")

    pins = lacking(c, "analog_in", needs) if c.role is Role.Input else []
    message = f"'{who(c)}' has an analogue output, but {listed(pins)} can only read high or low" if pins else ""
    return not pins or fault(c, message, pins=", ".join(pins))


@devices.critique(id="RS241", info=True, location=drawing, advice="use a pin with PWM to dim it")
def CanBeDimmed(c: hardware.Component) -> bool | Fail:
    """A device that is usually driven with PWM is on a pin with PWM."""
    wanted = "pwm" in wiring_of(c).facts(c).wants and c.role is Role.Output
    pins = lacking(c, "pwm", lambda w, p: wanted or (c.driver and w.means(p.connector, "pwm")))
    return not pins or fault(c, f"'{who(c)}' can only be on or off, because {listed(pins)} has no PWM", pins=", ".join(pins))


@devices.critique(id="RS242", info=True, location=drawing, advice="use a pin with an interrupt if edges must not be missed")
def CanInterrupt(c: hardware.Component) -> bool | Fail:
    """A device whose edges are counted is on a pin with an interrupt."""
    if "interrupt" not in wiring_of(c).facts(c).wants:
        return True
    pins = lacking(c, "interrupt", lambda w, p: p.connector.kind is not Kind.supply)
    w = wiring_of(c)
    if not pins or any(p.pin is not None and "interrupt" in p.pin.abilities for p in w.board_pins(c)):
        return True  # one phase of an encoder is enough
    return fault(c, f"'{who(c)}' is on {listed(pins)}, which has no interrupt", pins=", ".join(pins))


@devices.critique(id="RS243", info=True, location=drawing, advice="use the pins of a serial port, or a software serial port")
def IsOnASerialPort(c: hardware.Component) -> bool | Fail:
    """A serial device is on the pins of a serial port."""
    pins = lacking(c, "uart", lambda w, p: w.means(p.connector, "uart"))
    return not pins or fault(c, f"'{who(c)}' needs a serial port, and there is none on {listed(pins)}", pins=", ".join(pins))


@devices.constraint(id="RS244", location=drawing, advice="use a digital pin")
def PinCanWrite(c: hardware.Component) -> bool | Fail:
    """A driven device is on a pin that can be an output."""
    if c.role is not Role.Output:
        return True
    pins = lacking(c, "digital", lambda w, p: p.connector.namedDirection is not hardware.NamedDirection.read)
    return not pins or fault(c, f"'{who(c)}' needs an output, but {listed(pins)} is only an analogue input", pins=", ".join(pins))


@devices.critique(id="RS245", info=True, location=drawing, advice="use another pin if there is one free")
def PinIsFree(c: hardware.Component) -> bool | Fail:
    """A pin that the board itself uses is not wired to a device."""
    w = wiring_of(c)
    taken = [p for p in w.board_pins(c) if p.pin is not None and p.pin.reserved and not _serial(w, p)]
    return not taken or fault(
        c, f"'{who(c)}' is on {listed([p.label for p in taken])} of the board: {taken[0].pin.reserved}",  # type: ignore[union-attr]
        pins=", ".join(p.label for p in taken),
    )  # fmt: skip


def _serial(w: Wiring, p: BoardPin) -> bool:
    """Whether a serial device's data connector is on a UART pin."""
    return p.pin is not None and "uart" in p.pin.abilities and w.means(p.connector, "uart")


@devices.critique(id="RS255", location=drawing, advice="add a level shifter or a voltage divider between them")
def BearsTheSignals(c: hardware.Component) -> bool | Fail:
    """The pins of a board do not drive a device with a higher voltage than its inputs tolerate."""
    w = wiring_of(c)
    most = w.facts(c).signal_volts
    if most is None:
        return True
    for p in w.board_pins(c, through=False):
        model = w.board_model(p.board)
        if p.connector.kind is Kind.signal and model is not None and model.volts > most and not _gives(p.connector.name):
            return fault(
                c,
                f"{p.label} drives {displayed_name(p.connector)} of '{who(c)}' with {model.volts:g} V; its maximum is {most:g} V",
            )
    return True


_FEED = "feed the part with the board's own voltage if it works there, or "
_LEAD = (
    "lead the output through a level shifter or a voltage divider: 10 kilo-ohms to the pin, 18 kilo-ohms from the pin to ground "
    "for 5 V on a pin for 3.3 V"
)


def _divider(c: hardware.Component) -> str:
    """The advice to lower the voltage of an output; in a table, what is there is named."""
    cure = _LEAD if _least_volts(wiring_of(c), c) else _FEED + _LEAD
    return f"{cure}; then name it in the table's column 'through'" if of_table(c) else cure


@devices.constraint(id="RS258", location=drawing, advice=_divider)
def IsBorneByThePin(c: hardware.Component) -> bool | Fail:
    """No device puts a higher voltage on a pin than the pin bears.

    A device whose supply is not known has at least the voltage that it needs.
    """
    w = wiring_of(c)
    fed = w.fed_with(c)
    given = fed or _least_volts(w, c)
    for p in w.board_pins(c, through=False):
        bears = _borne(w, c, p)
        if 0 < bears < given and _reaches(w, c, p.connector):
            name, most = displayed_name(p.connector) or "the output", f"{p.label}, which bears {bears:g} V"
            message = f"{name} of '{who(c)}' gives up to {given:g} V to {most}"
            if not fed:
                message = f"'{who(c)}' needs a supply of {given:g} V or more, and {name} gives it to {most}"
            return fault(c, message, volts=given, most=bears, pin=p.label)
    return True


def _borne(w: Wiring, c: hardware.Component, p: BoardPin) -> float:
    """The voltage that a pin of a board bears, 0 if it is not known; a 5 V tolerant pin is none while it measures a voltage."""
    model = w.board_model(p.board)
    chip = model.microcontroller if model is not None else None
    of_chip = float(chip.pinVolts) if chip is not None else 0.0
    if p.pin is None or ("analog_in" in p.pin.abilities and _is_measured(w, c, p.connector)):
        return of_chip
    return float(p.pin.bearsVolts) or of_chip


def _least_volts(w: Wiring, c: hardware.Component) -> float:
    """The least voltage that a device needs, if what feeds it is not known; else 0."""
    known = w.facts(c).volts
    return known[0] if known is not None and not w.fed_with(c) else 0.0


def _reaches(w: Wiring, c: hardware.Component, connector: hardware.Connector) -> bool:
    """Whether a device's supply may reach a pin through one of its connectors: as its output, or by its own pull-up."""
    if connector.kind in (Kind.supply, Kind.ground):
        return False
    facts = w.facts(c)
    named = c.role is not Role.Output and w.means(connector, "output")  # `signal` of a servo is what the board drives
    if facts.output == "contact" or named or _gives(connector.name):
        return True
    if c.role is Role.Input and of_table(c) and not connector.name.strip():
        return True  # a table need not name the one wire of a sensor
    if _is_measured(w, c, connector):
        return True
    on_bus = w.means(connector, "sda") or w.means(connector, "scl")
    return bool(facts.pull_ups and on_bus)


def _is_measured(w: Wiring, c: hardware.Component, connector: hardware.Connector) -> bool:
    """Whether a device gives a voltage to be measured at a connector; a connector without a name may be the one that does."""
    name, given = connector.name.strip().lower(), w.facts(c).analog
    return "*" in given or name in given or bool(given and not name) or w.means(connector, "analog")


_OUTPUTS = frozenset(["do", "sdo", "so", "miso", "out", "echo", "rdy"])
"""Names of device outputs, besides those of serial and status lines."""


def _gives(name: str) -> bool:
    """Whether a connector is an output of its device, which the board does not drive."""
    word = name.strip().lower()
    return word in _OUTPUTS or word.startswith(("tx", "dout", "sout", "state", "stat", "irq", "int"))
