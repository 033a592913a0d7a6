"""What ports of the source are called on the target: the texts that stand for their pins in what is generated."""

from __future__ import annotations

from robosmi.metamodels import migration, platform
from robosmi.transformations.queries.circuit import pin_literal
from robosmi.transformations.queries.plan_adapters import emitted

NOT_WIRED = "none"
"""The choice of a port that is on no pin, by a person's word."""
UNBOUND = "255"
"""A number that is no pin of any target: what adapters are given for a port that is on none."""

NO_PIN = "no-pin-in-macro"
"""Id of the rule that gives no pin to calls of macros whose ports no text can look up."""


def port_text(binding: migration.PortBinding) -> str | None:
    """What a port is called on the target: its connection's name, its pin's literal, or None where it is on no pin."""
    if binding.connection is not None:
        return str(binding.connection.name)
    return pin_literal(binding.pin) if binding.pin is not None else None


def text_in_place(binding: migration.PortBinding) -> str:
    """What takes the place of the port's number in the text: its pin, or no pin with a remark that says which port it is."""
    text = port_text(binding)
    if text is not None:
        return text
    called = f"P{binding.sourcePin}" if binding.sourcePin >= 0 else binding.name
    return f"{UNBOUND} /* {called} is not wired{'' if binding.choice == NOT_WIRED else ' yet'} */"


def measures(pin: platform.Pin, binding: migration.PortBinding) -> bool:
    """Whether a pin has the converter that a conventional port needs; True for a port that needs none."""
    port = binding.conventionalPort
    return port is None or port.capability is not platform.PinCapability.analog or "analog_in" in pin.abilities


def port_literals(plan: migration.MigrationPlan) -> tuple[dict[str, str], dict[int, str]]:
    """Name of a conventional port -> its pin, and number of a port of the source -> its pin; ports without a pin are left out.

    A number that is used by itself and by convention has its own pin in the second.
    """
    names: dict[str, str] = {}
    numbers: dict[int, str] = {}
    conventional = [b for b in plan.portBindings if b.origin == "convention"]
    for binding in conventional:
        text = port_text(binding)
        if text is not None:
            named = [binding.conventionalPort.name] if binding.conventionalPort is not None else []
            names |= dict.fromkeys([binding.name, *binding.names, *named], text)
    for binding in (*conventional, *(b for b in plan.portBindings if b.origin != "convention")):
        if binding.sourcePin >= 0:
            pin = _pin(binding)
            numbers.pop(binding.sourcePin, None)
            if pin is not None:
                numbers[binding.sourcePin] = pin_literal(pin)
    return names, numbers


def _pin(binding: migration.PortBinding) -> platform.Pin | None:
    return binding.connection.pin if binding.connection is not None else binding.pin


def looks_up_ports(plan: migration.MigrationPlan) -> bool:
    """Whether the changed text of the program asks for the pin of a port (`port(x)`)."""
    return any(change.rule != NO_PIN for flow in plan.portFlows for change in flow.changes)


def table_is_declared(plan: migration.MigrationPlan) -> bool:
    """Whether a piece of the plan's adapters declares the table that ports are looked up in."""
    return any(piece.tables for piece in emitted(plan))


def of_own_serial_port(binding: migration.PortBinding) -> bool:
    """Whether a port is a line of the serial port that the board itself has (its console), bound there by its number."""
    by_rule = binding.chosenBy is migration.ChosenBy.rule and binding.connection is None
    return by_rule and binding.pin is not None and "uart" in binding.pin.abilities
