"""Writes and reads of port registers become calls for the pins that their bits are bound to, one for each bit.

A statement changes only if all its pins are bound. What it does with other bits of the register is nothing that the program uses.
A value that calls something, or reads a register itself, is computed once.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from msgspec import Struct
from msgspec.structs import replace

from robosmi.metamodels import ccode, migration, platform
from robosmi.transformations.m2m.ports.port_texts import BY_REGISTER
from robosmi.transformations.queries.circuits.circuit import pin_literal
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.names import named_type
from robosmi.transformations.queries.plans.port_pins import bound_pin
from robosmi.transformations.queries.ports.port_statements import (
    HIGH,
    HIGH_IF,
    INPUT,
    IS_CLEAR,
    IS_SET,
    LEVEL,
    LOW,
    LOW_IF,
    OUTPUT,
    PULL_UP,
    READ,
    TOGGLE,
    TOGGLE_IF,
    VALUE,
    WAIT_CLEAR,
    WAIT_SET,
    PinStep,
    PortStatement,
    is_pure,
    port_statements,
)  # fmt: skip
from robosmi.transformations.queries.ports.register_idioms import CHANGE, CONVERT, idiom_statements
from robosmi.transformations.queries.ports.register_values import register_value
from robosmi.transformations.queries.ports.timer_outputs import ATTACH, PULSE, PWM

_CALLS = {
    HIGH: "digitalWrite({pin}, HIGH)", LOW: "digitalWrite({pin}, LOW)", TOGGLE: "digitalWrite({pin}, !digitalRead({pin}))",
    OUTPUT: "pinMode({pin}, OUTPUT)", INPUT: "pinMode({pin}, INPUT)", PULL_UP: "pinMode({pin}, INPUT_PULLUP)",
    CHANGE: "attachInterrupt(digitalPinToInterrupt({pin}), {handler}, CHANGE)", CONVERT: "analogRead({pin})",
    VALUE: "digitalWrite({pin}, {value} >> {bit} & 1)", LEVEL: "digitalWrite({pin}, {value} ? HIGH : LOW)",
    HIGH_IF: "if ({value} >> {bit} & 1) digitalWrite({pin}, HIGH)",
    LOW_IF: "if (!({value} >> {bit} & 1)) digitalWrite({pin}, LOW)",
    TOGGLE_IF: "if ({value} >> {bit} & 1) digitalWrite({pin}, !digitalRead({pin}))",
    READ: "(digitalRead({pin}) << {bit})", IS_SET: "digitalRead({pin})", IS_CLEAR: "!digitalRead({pin})",
    WAIT_SET: "do {} while (!digitalRead({pin}))", WAIT_CLEAR: "do {} while (digitalRead({pin}))",
    PWM: "analogWrite({pin}, {value})", PULSE: "{handler}.writeMicroseconds({value})",
    ATTACH: "{handler}.attach({pin}, 200, 3000{value})",  # any pulse that the library can make, and the first one
}  # fmt: skip
_ONCE = frozenset([HIGH_IF, LOW_IF, TOGGLE_IF])
"""What is a statement, and no expression."""
_OF_TIMER = frozenset([PWM, PULSE, ATTACH])
_SHIFT = re.compile(r"\b_BV(?=\s*\()")


class _Change(Struct, frozen=True):
    """A statement with the bindings and pins of its steps."""

    statement: PortStatement
    bindings: tuple[migration.PortBinding, ...]
    literals: tuple[str, ...]

    @property
    def start(self) -> int:
        return int(self.statement.element.startOffset)

    @property
    def end(self) -> int:
        return int(self.statement.element.endOffset)

    def contains(self, other: _Change) -> bool:
        """Whether another statement is a part of this one."""
        inside = self.start <= other.start and other.end <= self.end
        return inside and self is not other and self.statement.view.unit is other.statement.view.unit


def change_registers(
    views: Sequence[CodeView], bindings: Sequence[migration.PortBinding], sources: Mapping[str, bytes], same_registers: bool,
    drives_pins: bool,
) -> None:  # fmt: skip
    """Add the changes of the statements to the bindings of their first pins.

    Args:
        views: a view of each unit of the program.
        bindings: the bindings of its ports.
        sources: path of a unit -> its bytes.
        same_registers: whether the target's microcontroller has the registers, too; then only statements change whose pins are
            not at the same bits there.
        drives_pins: whether analogWrite and servos of the target take the place of timers that drive pins.
    """
    numbers = {int(binding.sourcePin): binding for binding in bindings}
    found: list[_Change] = []
    idioms = [] if same_registers else [s for s in idiom_statements(views) if drives_pins or s.steps[0].what not in _OF_TIMER]
    for each in (*port_statements(views), *idioms):
        bound = [numbers.get(step.number) for step in each.steps]
        pins = [bound_pin(binding) if binding is not None else None for binding in bound]
        if not all(pins):
            continue
        if same_registers and all(_is_in_place(step, pin, views) for step, pin in zip(each.steps, pins, strict=True)):
            continue
        literals = tuple(pin_literal(pin) for pin in pins if pin is not None)
        found.append(_Change(each, tuple(binding for binding in bound if binding is not None), literals))
    for change in found:
        if any(other.contains(change) for other in found):
            continue
        names = ", ".join(str(binding.name) for binding in change.bindings)
        change.bindings[0].changes.append(
            migration.TextChange(
                unit=change.statement.view.unit, startOffset=change.start, endOffset=change.end,
                replacement=_text(change, found, sources), rule=BY_REGISTER, step=migration.Step.hardware,
                reason=f"the bits of the register are {names}",
            )
        )  # fmt: skip


def _is_in_place(step: PinStep, pin: platform.Pin | None, views: Sequence[CodeView]) -> bool:
    """Whether a pin of the target is at the port and bit that the pin of a step has on the source board."""
    board = views[0].api.board
    places = {number: port for port, number in board.ports.items()} if board is not None else {}
    return pin is not None and str(pin.port) == places.get(step.number)


def _text(change: _Change, changes: Sequence[_Change], sources: Mapping[str, bytes]) -> str:
    statement = change.statement
    steps = list(zip(statement.steps, change.literals, strict=True))
    if all(step.what in _OF_TIMER for step, _ in steps):
        return _of_timer(change, _value(statement.steps[0].value, change, changes, sources))
    given = {id(step.value): step.value for step in statement.steps if step.value is not None}
    once = any(step.what in _ONCE for step, _ in steps) or not all(is_pure(value, statement.view) for value in given.values())
    if not once or len(given) != 1 or all(step.what == LEVEL for step, _ in steps):
        calls = [_call(step, literal, statement, f"({_value(step.value, change, changes, sources)})") for step, literal in steps]
        if _reads(statement):
            return calls[0] if len(calls) == 1 else f"({' | '.join(calls)})"
        return ", ".join(calls)
    inside = " ".join(f"{_call(step, literal, statement, 'bits')};" for step, literal in steps)
    [value] = given.values()
    return f"[](uint8_t bits) {{ {inside} }}({_value(value, change, changes, sources)})"


def _of_timer(change: _Change, text: str) -> str:
    """What takes the place of a statement of a timer that drives pins."""
    statement = change.statement
    called = statement.handler.split(",")
    filled = zip(statement.steps, change.literals, called, strict=True)
    return ", ".join(
        _call(step, literal, replace(statement, handler=name), _scaled(step, statement, text)) for step, literal, name in filled
    )


def _scaled(step: PinStep, statement: PortStatement, text: str) -> str:
    """The text of a value in the unit of the call that takes it; of a first pulse with its comma."""
    value, scale = register_value(step.value, statement.view.values), statement.scale
    if step.what == ATTACH:
        return f", {round(value * scale)}" if value is not None else ""
    if value is not None:
        return str(round(value * scale))
    factor = f"{scale.numerator}UL * " if scale.numerator != 1 else ""
    return f"{factor}({text}) / {scale.denominator}" if scale != 1 else text


def _reads(statement: PortStatement) -> bool:
    """Whether a statement is an expression that reads pins."""
    return all(step.what in (READ, CONVERT) for step in statement.steps)


def _is_asked(value: ccode.Expression) -> bool:
    """Whether only that a value is zero or not counts."""
    outer = value.eContainer()
    if isinstance(outer, (ccode.If, ccode.Loop, ccode.ConditionalExpression)):
        return outer.condition is value
    if isinstance(outer, (ccode.Unary, ccode.Binary)):
        return outer.operator in ("!", "&&", "||")
    use = outer.valueType if isinstance(outer, ccode.Variable) else None
    if isinstance(outer, ccode.Assignment) and outer.operator == "=":
        use = named_type(outer.left)
    return use is not None and str(use.canonical) == "bool"


def _call(step: PinStep, literal: str, statement: PortStatement, value: str) -> str:
    filled = {"pin": literal, "bit": str(step.bit), "handler": statement.handler, "value": value}
    alone = len(statement.steps) == 1 and _is_asked(statement.element)
    what = IS_SET if step.what == READ and (not step.bit or alone) else step.what
    return re.sub(r"\{(pin|bit|handler|value)\}", lambda found: filled[found[1]], _CALLS[what])


def _value(value: ccode.Expression | None, change: _Change, changes: Sequence[_Change], sources: Mapping[str, bytes]) -> str:
    """The text of a value, in which registers are read by their pins."""
    if value is None:
        return ""
    data, start, end = sources[str(change.statement.view.unit.path)], int(value.startOffset), int(value.endOffset)
    inner = [c for c in changes if change.contains(c) and start <= c.start and c.end <= end]
    text, at = "", start
    for each in sorted((c for c in inner if not any(o.contains(c) for o in inner)), key=lambda c: c.start):
        text += data[at : each.start].decode("utf-8", "replace") + _text(each, changes, sources)
        at = each.end
    return _SHIFT.sub("bit", text + data[at:end].decode("utf-8", "replace"))
