"""Proposes the pins of another board for the parts that are wired to a board's pins.

Each pin goes to one that has the abilities which it needs there: the line of a bus to that line of the new board, an analogue
part to an analogue input. Of these, the pin of the same name or number comes first, then the one that has most of the former
pin's abilities and fewest others, so that pins with rare abilities stay free. Pins that the board itself uses are never proposed.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from robosmi.errors import SourceError
from robosmi.metamodels import migration, platform
from robosmi.transformations.queries.circuits.connector_names import displayed_name
from robosmi.transformations.queries.circuits.electrical import Role, fed_parts, wiring
from robosmi.transformations.queries.plans.port_pins import bound_pin

_ANALOG, _DIGITAL = "analog_in", "digital"
_DIGITS = re.compile(r"[0-9]+\Z")


def proposed_pins(plan: migration.MigrationPlan, board: platform.Board) -> dict[str, str]:
    """Pin of a plan's board that is in use -> pin of another board, by their labels.

    Args:
        plan: the plan.
        board: the other board.

    Raises:
        SourceError: the board has too few pins for them.
    """
    used: dict[str, platform.Pin] = {}
    for connection in plan.connections:
        if connection.pin is not None:
            used.setdefault(str(connection.pin.label), connection.pin)
    for binding in plan.portBindings:
        pin = bound_pin(binding)
        if pin is not None and binding.chosenBy is migration.ChosenBy.person:
            used.setdefault(str(pin.label), pin)
    free = [pin for pin in board.pins if not pin.reserved and {_DIGITAL, _ANALOG} & {*pin.abilities}]
    if len(used) > len(free):
        raise SourceError(
            f"{board.title} has {len(free)} free pins, and the parts need {len(used)}",
            fix="choose a board with more pins, or draw the new hardware and give it with --hardware",
        )
    made: dict[str, str] = {}
    order = {str(pin.label): _rank(pin, plan) for pin in used.values()}
    for label, pin in sorted(used.items(), key=lambda each: order[each[0]]):
        best = max(free, key=lambda there: _points(pin, there, plan, free))
        free.remove(best)
        made[label] = str(best.label)
    return {label: made[label] for label in used}


def proposed_volts(plan: migration.MigrationPlan, board: platform.Board) -> dict[str, float]:
    """Identity of a part of a plan's drawing -> the voltage that is to feed it on another board.

    It stays as it is drawn. A sensor that has more than the pins of the other board have, and that works with theirs by its data
    sheet, gets theirs, so that its output does not harm them.
    """
    if plan.circuit is None:
        return {}
    w, made = wiring(plan.circuit), fed_parts(plan.circuit)
    for component in plan.circuit.components:
        rated, identity = w.facts(component).volts, str(component.elementId)
        if component.role is Role.Input and rated is not None and made.get(identity, 0.0) > board.volts >= rated[0]:
            made[identity] = board.volts
    return made


def _rank(pin: platform.Pin, plan: migration.MigrationPlan) -> int:
    """The lines of buses first, then analogue parts: fewer pins can take them."""
    return 0 if _lines(pin, plan) else 1 if _needs_analog(pin, plan) else 2


def _points(
    pin: platform.Pin, there: platform.Pin, plan: migration.MigrationPlan, free: Sequence[platform.Pin]
) -> tuple[bool, bool, bool, int, int, int]:
    had, has = {*pin.abilities}, {*there.abilities}
    needs = {_ANALOG} if _needs_analog(pin, plan) else set()
    wanted = had & {_DIGITAL, "pwm", "interrupt"} | needs
    same = wanted <= has and (there.label == pin.label or (_number(there) == _number(pin) and not {_ANALOG} & (had | has)))
    return (
        bool(_lines(pin, plan) & {*there.aliases}), needs <= has, same,
        len(wanted & has), -len(has - wanted), -free.index(there),
    )  # fmt: skip


def _number(pin: platform.Pin) -> str:
    """The number in a pin's label: pins of the same number are easily taken for each other, and so best remain the same."""
    found = _DIGITS.search(str(pin.label))
    return found[0] if found is not None else str(pin.label)


def _wired(pin: platform.Pin, plan: migration.MigrationPlan) -> list[migration.Connection]:
    return [c for c in plan.connections if c.pin is pin]


def _lines(pin: platform.Pin, plan: migration.MigrationPlan) -> set[str]:
    """The lines of buses (SDA, MOSI ...) that a pin is wired as: names of the pin that a connector there has, too."""
    names = {displayed_name(k).upper() for c in _wired(pin, plan) for k in c.connectors}
    return names & {str(alias) for alias in pin.aliases}


def _needs_analog(pin: platform.Pin, plan: migration.MigrationPlan) -> bool:
    """Whether a part with an analogue output, or a port that is measured, is on a pin with an analogue input."""
    if _ANALOG not in pin.abilities:
        return False
    ports = [b.conventionalPort for b in plan.portBindings if bound_pin(b) is pin and b.conventionalPort is not None]
    measured = any(port.capability is platform.PinCapability.analog for port in ports)
    return measured or bool(_wired(pin, plan)) or not ports
