"""How generated text refers to the pins of the source's ports."""

from __future__ import annotations

from robosmi.metamodels import migration, platform
from robosmi.query import root_of
from robosmi.transformations.knowledge.platforms.board_pins import board_pins
from robosmi.transformations.knowledge.platforms.platform_api import PREFIX
from robosmi.transformations.queries.circuits.circuit import pin_literal
from robosmi.transformations.queries.plans.plan_adapters import emitted
from robosmi.transformations.queries.plans.retained_pins import retains_platform

NOT_WIRED = "none"
"""The recorded choice of a port that the user declared not to be wired."""
CONSOLE = "console"
"""The recorded choice of a port that is the console, where that is USB and takes no pins."""
WITHOUT_PIN = (NOT_WIRED, CONSOLE)
"""The recorded choices that no pin or connection belongs to."""
UNBOUND = "255"
"""The argument that adapters are given for a port without a pin: a number that is no pin of any target."""
CONSOLE_NUMBER = "254"
"""The argument that stands for a console without pins: no pin of any target, known to the hardware layers (`is_console`)."""

PIN_RULE = "RS345"
"""The rule of places in the finished program whose pin is not the plan's, or cannot be followed."""
NO_PIN = "no-pin-in-macro"
"""The rule by which calls in macros get no pin, because no text could look up their ports."""


def bound_pin(binding: migration.PortBinding) -> platform.Pin | None:
    """The pin of a binding: that of its connection, which generated text names, else the one that it refers to; None if neither.

    The two agree in a valid plan (RS704).
    """
    return binding.connection.pin if binding.connection is not None else binding.pin


def source_name(binding: migration.PortBinding) -> str:
    """What the port of a binding is called by its number on the source board; empty if it has none."""
    if binding.sourcePin < 0:
        return ""
    plan = root_of(binding)
    source = plan.source if isinstance(plan, migration.MigrationPlan) else None
    board = board_pins(source.boardMappings) if source is not None else None
    return board.labels.get(int(binding.sourcePin), "") if board is not None else number_name(source, int(binding.sourcePin))


def number_name(source: platform.Platform | None, number: int) -> str:
    """What a port of a platform whose programs name no board is called by its number."""
    return f"{source.portPrefix if source is not None else PREFIX}{number}"


def port_text(binding: migration.PortBinding) -> str | None:
    """The text for a port on the target: its connection's name, else its pin's literal; None if it has no pin.

    A program whose platform stays has no constants for connections.
    """
    if binding.connection is not None and not retains_platform(root_of(binding)):
        return str(binding.connection.name)
    pin = bound_pin(binding)
    return pin_literal(pin) if pin is not None else None


def text_in_place(binding: migration.PortBinding) -> str:
    """The replacement for a port's number in the text: its pin, or `UNBOUND` with a comment that names the port."""
    text = port_text(binding)
    if text is not None:
        return text
    called = source_name(binding) if binding.sourcePin >= 0 else binding.name
    if binding.choice == CONSOLE:
        return f"{CONSOLE_NUMBER} /* {called} is the console's */"
    return f"{UNBOUND} /* {called} is not wired{'' if binding.choice == NOT_WIRED else ' yet'} */"


def measures(pin: platform.Pin, binding: migration.PortBinding) -> bool:
    """Whether a pin has the analog input that a conventional port needs, or the port needs none."""
    port = binding.conventionalPort
    return port is None or port.capability is not platform.PinCapability.analog or "analog_in" in pin.abilities


def port_literals(plan: migration.MigrationPlan, *, by_name: bool = True) -> tuple[dict[str, str], dict[int, str]]:
    """Name of a conventional port -> its pin, and number of a port of the source -> its pin; ports without a pin are left out.

    A number that is used by itself and by convention has its own pin in the second.

    Args:
        plan: the plan.
        by_name: whether a connection's constant is declared where the text goes, so that the first may name it.
    """
    names: dict[str, str] = {}
    numbers: dict[int, str] = {}
    conventional = [b for b in plan.portBindings if b.origin == "convention"]
    for binding in conventional:
        pin = bound_pin(binding)
        text = port_text(binding) if by_name else pin_literal(pin) if pin is not None else None
        if text is not None:
            named = [binding.conventionalPort.name] if binding.conventionalPort is not None else []
            names |= dict.fromkeys([binding.name, *binding.names, *named], text)
    for binding in (*conventional, *(b for b in plan.portBindings if b.origin != "convention")):
        if binding.sourcePin >= 0:
            pin = bound_pin(binding)
            numbers.pop(binding.sourcePin, None)
            if pin is not None:
                numbers[binding.sourcePin] = pin_literal(pin)
            elif binding.choice == CONSOLE:
                numbers[binding.sourcePin] = CONSOLE_NUMBER
    return names, numbers


def looks_up_ports(plan: migration.MigrationPlan) -> bool:
    """Whether the changed text of the program looks up pins of ports at run time (`port(x)`)."""
    return any(change.rule != NO_PIN for flow in plan.portFlows for change in flow.changes)


def table_is_declared(plan: migration.MigrationPlan) -> bool:
    """Whether a piece of the plan's adapters declares the table that ports are looked up in."""
    return any(piece.tables for piece in emitted(plan))


def of_own_serial_port(binding: migration.PortBinding) -> bool:
    """Whether a port is a line of the board's own serial port (its console), bound there by a rule, or that is its USB."""
    if binding.choice == CONSOLE:
        return True
    by_rule = binding.chosenBy is migration.ChosenBy.rule and binding.connection is None
    return by_rule and binding.pin is not None and "uart" in binding.pin.abilities
