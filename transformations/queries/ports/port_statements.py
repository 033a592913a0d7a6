"""What a program does with pins by the registers of their ports on an AVR: `PORTB |= _BV(5)`, `DDRD = 0xF0`, `PINC & 4`.

A register has a bit for each of eight pins. PORT sets outputs, and at inputs the pull-up; DDR makes pins outputs; writing a one
into PIN toggles an output. Source: ATmega328P data sheet DS40002061, section 14. An expression that is not told here is not
understood: a part of a register at run time, a mask that is not constant.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.query import all_contents
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.constants.register_values import register_value
from robosmi.transformations.queries.expression_text import expression_text
from robosmi.transformations.queries.flows.pin_uses import PinUse

HIGH, LOW, TOGGLE, VALUE, OUTPUT, INPUT, READ, PULL_UP = "high", "low", "toggle", "value", "output", "input", "read", "pull-up"
_REGISTER = re.compile(r"(PORT|PIN|DDR)([A-L])")
_DIRECTION = {HIGH: "out", LOW: "out", TOGGLE: "out", VALUE: "out", OUTPUT: "out", INPUT: "in", READ: "in", PULL_UP: "in"}
_ALL = 0xFF


class PinStep(Struct, frozen=True):
    """What is done with one pin: its bit in the register, its number on the board, and what."""

    bit: int
    number: int
    what: str


class PortStatement(Struct, frozen=True):
    """An expression that writes or reads a register of a port.

    Attributes:
        view: its unit.
        element: the expression.
        steps: what it does, in the order of the bits.
    """

    view: CodeView
    element: ccode.Assignment | ccode.Binary
    steps: tuple[PinStep, ...]


def port_statements(views: Sequence[CodeView]) -> list[PortStatement]:
    """The expressions of a program that are understood, in text order."""
    pins = views[0].api.board.ports if views and views[0].api.board is not None else {}
    if not pins:
        return []
    read = [found for view in views for reference in view.of_kind(ccode.NameReference) if (found := _understood(view, reference))]
    outputs = {(port, bit) for _, _, register, port, masks in read if register == "DDR" for bit in _bits(masks.get(OUTPUT, 0))}
    known = {
        (port, bit)
        for _, element, _, port, masks in read
        for what, mask in masks.items()
        if not (element.operator == "=" and what in (INPUT, LOW, VALUE))
        for bit in _bits(mask)
    }
    found = []
    for view, element, register, port, masks in read:
        steps = []
        for what, mask in masks.items():
            for bit in _bits(mask):
                number = pins.get(f"P{port}{bit}")
                if what in (INPUT, LOW) and element.operator == "=" and (port, bit) not in known | outputs:
                    continue  # a pin that the program does not use otherwise stays as it is after a reset
                if number is None or (what == VALUE and (port, bit) not in outputs):
                    continue
                pulled = what == HIGH and register == "PORT" and (port, bit) not in outputs
                steps.append(PinStep(bit, number, PULL_UP if pulled else what))
        if steps:
            found.append(PortStatement(view, element, tuple(sorted(steps, key=lambda step: step.bit))))
    return found


def port_uses(views: Sequence[CodeView]) -> list[PinUse]:
    """The pins that the statements use."""
    return [
        PinUse(
            step.number, expression_text(each.element), "literal", _register_of(each.element), _DIRECTION[step.what],
            int(each.element.line), each.element,
        )
        for each in port_statements(views)
        for step in each.steps
    ]  # fmt: skip


_Read = tuple[CodeView, ccode.Assignment | ccode.Binary, str, str, dict[str, int]]


def _understood(view: CodeView, reference: ccode.NameReference) -> _Read | None:
    """The expression around a register, the register, its port, and what is done with which bits; None if not understood."""
    named = _REGISTER.fullmatch(str(reference.name))
    outer = reference.eContainer()
    if named is None or isinstance(reference.target, (ccode.Variable, ccode.Parameter)):
        return None
    if isinstance(outer, ccode.Assignment) and outer.left is reference and _is_statement(outer):
        masks = _written(named[1], str(outer.operator), register_value(outer.right, view.values))
        if masks is None and named[1] == "PORT" and outer.operator == "=" and _is_pure(outer.right):
            masks = {VALUE: _ALL}
        return (view, outer, named[1], named[2], masks) if masks is not None else None
    if isinstance(outer, ccode.Binary) and outer.operator == "&" and named[1] != "DDR":
        mask = register_value(outer.right if outer.left is reference else outer.left, view.values)
        return (view, outer, named[1], named[2], {READ: mask & _ALL}) if mask is not None else None
    return None


def _is_pure(value: ccode.Expression | None) -> bool:
    """Whether an expression may be evaluated once for each bit: it changes nothing, calls nothing, and reads no register."""
    inside = [value, *all_contents(value)] if value is not None else []
    for each in inside:
        if isinstance(each, (ccode.Call, ccode.Assignment)) or (isinstance(each, ccode.Unary) and each.operator in ("++", "--")):
            return False
        if isinstance(each, ccode.NameReference) and _REGISTER.fullmatch(str(each.name)):
            return False
    return bool(inside)


def _is_statement(assignment: ccode.Assignment) -> bool:
    """Whether nothing takes the value of an assignment."""
    return isinstance(assignment.eContainer(), (ccode.Statement, ccode.Case, ccode.Label)) and not isinstance(
        assignment.eContainer(), ccode.Return
    )


def _written(register: str, operator: str, value: int | None) -> dict[str, int] | None:
    if value is None:
        return None
    on, off = (OUTPUT, INPUT) if register == "DDR" else (HIGH, LOW)
    if register == "PIN":
        return {TOGGLE: value & _ALL} if operator in ("=", "|=") else None
    if operator == "=":
        return {on: value & _ALL, off: ~value & _ALL}
    if operator == "|=":
        return {on: value & _ALL}
    if operator == "&=":
        return {off: ~value & _ALL}
    return {TOGGLE: value & _ALL} if operator == "^=" and register == "PORT" else None


def _bits(mask: int) -> Iterator[int]:
    return (bit for bit in range(8) if mask >> bit & 1)


def _register_of(element: ccode.Assignment | ccode.Binary) -> str:
    sides = (element.left, element.right)
    return next(str(s.name) for s in sides if isinstance(s, ccode.NameReference) and _REGISTER.fullmatch(str(s.name)))
