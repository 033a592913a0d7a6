"""Writes and reads of port registers become calls for the pins that their bits are bound to, one for each bit.

A statement changes only if all its pins are bound. What it does with other bits of the register is nothing that the program uses.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from robosmi.metamodels import ccode, migration, platform
from robosmi.transformations.queries.circuits.circuit import pin_literal
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.plans.port_pins import bound_pin
from robosmi.transformations.queries.ports.port_statements import (
    CHANGE,
    CONVERT,
    HIGH,
    INPUT,
    LOW,
    OUTPUT,
    PULL_UP,
    READ,
    TOGGLE,
    VALUE,
    PinStep,
    PortStatement,
    idiom_statements,
    port_statements,
)  # fmt: skip

RULE = "port-register"
_CALLS = {
    HIGH: "digitalWrite({pin}, HIGH)", LOW: "digitalWrite({pin}, LOW)", TOGGLE: "digitalWrite({pin}, !digitalRead({pin}))",
    OUTPUT: "pinMode({pin}, OUTPUT)", INPUT: "pinMode({pin}, INPUT)", PULL_UP: "pinMode({pin}, INPUT_PULLUP)",
    CHANGE: "attachInterrupt(digitalPinToInterrupt({pin}), {handler}, CHANGE)", CONVERT: "analogRead({pin})",
    VALUE: "digitalWrite({pin}, ({value}) >> {bit} & 1)", READ: "(digitalRead({pin}) << {bit})",
}  # fmt: skip


def change_registers(
    views: Sequence[CodeView], bindings: Sequence[migration.PortBinding], sources: Mapping[str, bytes], same_registers: bool
) -> None:
    """Add the changes of the statements to the bindings of their first pins.

    Args:
        views: a view of each unit of the program.
        bindings: the bindings of its ports.
        sources: path of a unit -> its bytes.
        same_registers: whether the target's microcontroller has the registers, too; then only statements change whose pins are
            not at the same bits there.
    """
    numbers = {int(binding.sourcePin): binding for binding in bindings}
    for each in (*port_statements(views), *(idiom_statements(views) if not same_registers else ())):
        bound = [numbers.get(step.number) for step in each.steps]
        pins = [bound_pin(binding) if binding is not None else None for binding in bound]
        first = bound[0]
        if first is None or not all(pins):
            continue
        if same_registers and all(_is_in_place(step, pin, views) for step, pin in zip(each.steps, pins, strict=True)):
            continue
        literals = [pin_literal(pin) for pin in pins if pin is not None]
        element = each.element
        names = ", ".join(str(binding.name) for binding in bound if binding is not None)
        first.changes.append(
            migration.TextChange(
                unit=each.view.unit, startOffset=int(element.startOffset), endOffset=int(element.endOffset),
                replacement=_text(each, literals, sources), rule=RULE, step=migration.Step.hardware,
                reason=f"the bits of the register are {names}",
            )
        )  # fmt: skip


def _is_in_place(step: PinStep, pin: platform.Pin | None, views: Sequence[CodeView]) -> bool:
    """Whether a pin of the target is at the port and bit that the pin of a step has on the source board."""
    board = views[0].api.board
    places = {number: port for port, number in board.ports.items()} if board is not None else {}
    return pin is not None and str(pin.port) == places.get(step.number)


def _text(each: PortStatement, literals: Sequence[str], sources: Mapping[str, bytes]) -> str:
    value = ""
    if isinstance(each.element, ccode.Assignment) and (right := each.element.right) is not None:
        data = sources[str(each.view.unit.path)]
        value = data[int(right.startOffset) : int(right.endOffset)].decode("utf-8", "replace")
    calls = [
        _CALLS[step.what]
        .replace("{pin}", literal)
        .replace("{bit}", str(step.bit))
        .replace("{value}", value)
        .replace("{handler}", each.handler)
        for step, literal in zip(each.steps, literals, strict=True)
    ]
    if isinstance(each.element, ccode.Assignment):
        return ", ".join(calls)
    return calls[0] if len(calls) == 1 else f"({' | '.join(calls)})"
