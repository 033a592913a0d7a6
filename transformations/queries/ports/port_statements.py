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
from robosmi.query import all_contents, ancestor_of_kind
from robosmi.transformations.knowledge.platforms.avr_bits import avr_bits
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_text import expression_text
from robosmi.transformations.queries.flows.pin_uses import PinUse
from robosmi.transformations.queries.ports.register_values import register_value

HIGH, LOW, TOGGLE, VALUE, OUTPUT, INPUT, READ, PULL_UP = "high", "low", "toggle", "value", "output", "input", "read", "pull-up"
CHANGE, CONVERT = "change", "convert"
_REGISTER = re.compile(r"(PORT|PIN|DDR)([A-L])")
_DIRECTION = {
    CHANGE: "in",
    CONVERT: "in",
    HIGH: "out",
    LOW: "out",
    TOGGLE: "out",
    VALUE: "out",
    OUTPUT: "out",
    INPUT: "in",
    READ: "in",
    PULL_UP: "in",
}
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
        handler: the function that a change of a pin calls.
    """

    view: CodeView
    element: ccode.Expression
    steps: tuple[PinStep, ...]
    handler: str = ""


def port_statements(views: Sequence[CodeView]) -> list[PortStatement]:
    """The expressions of a program that are understood, in text order."""
    pins = views[0].api.board.ports if views and views[0].api.board is not None else {}
    if not pins:
        return []
    read = [told for view in views for reference in view.of_kind(ccode.NameReference) if (told := _understood(view, reference))]
    outputs = {(port, bit) for _, _, register, port, masks in read if register == "DDR" for bit in _bits(masks.get(OUTPUT, 0))}
    known = {
        (port, bit)
        for _, element, _, port, masks in read
        for what, mask in masks.items()
        if not (element.operator == "=" and what in (INPUT, LOW, VALUE))
        for bit in _bits(mask)
    }
    found: list[PortStatement] = []
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
        for each in (*port_statements(views), *idiom_statements(views))
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


def _register_of(element: ccode.Expression) -> str:
    """The register that an expression writes or reads."""
    sides = (element.left, element.right) if isinstance(element, (ccode.Assignment, ccode.Binary)) else (element,)
    return next(str(s.name) for s in sides if isinstance(s, ccode.NameReference) and str(s.name).isupper())


class PinChangeIdiom(Struct, frozen=True):
    """A pin change interrupt whose registers are only set to constants.

    Attributes:
        view: the unit of its function.
        handler: its function.
        enables: the statements that enable it, each with its unit.
        masks: the statements that say which pins it is for.
    """

    view: CodeView
    handler: ccode.Function
    enables: tuple[tuple[CodeView, ccode.Assignment], ...]
    masks: tuple[PortStatement, ...]


def pin_changes(views: Sequence[CodeView]) -> list[PinChangeIdiom]:
    """The pin change interrupts of a program that are understood."""
    pins = views[0].api.board.ports if views and views[0].api.board is not None else {}
    handlers = [(view, f) for view in views for f in view.of_kind(ccode.Function) if f.name in avr_bits().pin_changes and f.body]
    enabled = _constants(views, _ENABLES)
    groups = {avr_bits().pin_changes[str(f.name)].enable for _, f in handlers}
    if enabled is None or any(set(_bits(value)) - groups for _, _, value in enabled):
        return []
    found = []
    for view, handler in handlers:
        facts = avr_bits().pin_changes[str(handler.name)]
        masks = _constants(views, facts.mask)
        if not masks:
            continue
        statements = [
            PortStatement(
                seen, element,
                tuple(PinStep(bit, n, CHANGE) for bit in _bits(value) if (n := pins.get(f"P{facts.port}{bit}")) is not None),
                change_handler(handler),
            )
            for seen, element, value in masks
        ]  # fmt: skip
        if all(each.steps for each in statements):
            own = tuple((seen, element) for seen, element, _ in enabled)
            found.append(PinChangeIdiom(view, handler, own, tuple(statements)))
    return found


def change_handler(handler: ccode.Function) -> str:
    """The name of the function that takes the place of an interrupt function for changes of pins."""
    return f"onPinChange{re.sub('[^0-9]', '', str(handler.name))}"


def _constants(views: Sequence[CodeView], register: str) -> list[tuple[CodeView, ccode.Assignment, int]] | None:
    """The statements that set a register, or bits of it, to constants; None if the program uses it in any other way."""
    found = []
    for view in views:
        for reference in view.of_kind(ccode.NameReference):
            if reference.name != register:
                continue
            outer = reference.eContainer()
            if not isinstance(outer, ccode.Assignment) or outer.left is not reference or outer.operator not in ("=", "|="):
                return None
            value = register_value(outer.right, view.values) if _is_statement(outer) else None
            if value is None:
                return None
            found.append((view, outer, value))
    return found


class ConverterIdiom(Struct, frozen=True):
    """A program that reads one channel of the converter by its registers, with the supply as reference.

    Attributes:
        reads: where it reads results.
        rest: the statements that prepare a conversion or wait for it, each with its unit.
    """

    reads: tuple[PortStatement, ...]
    rest: tuple[tuple[CodeView, ccode.Located], ...]


def converter_reads(views: Sequence[CodeView]) -> ConverterIdiom | None:
    """The reads of a channel of the converter; None if the program uses the converter's registers in any other way."""
    facts, board = avr_bits().converter, views[0].api.board if views else None
    selects = _constants(views, facts.select)
    if not selects or board is None or any(value & facts.left for _, _, value in selects):
        return None
    channels = {value & facts.channel_mask for _, _, value in selects if value & facts.reference_mask == facts.supply}
    pin = board.channels.get(channels.pop(), -1) if len(channels) == 1 else -1
    if pin < 0 or any(value & facts.reference_mask != facts.supply for _, _, value in selects):
        return None
    rest: list[tuple[CodeView, ccode.Located]] = [(view, element) for view, element, _ in selects]
    reads = []
    for view in views:
        for reference in view.of_kind(ccode.NameReference):
            outer = reference.eContainer()
            if reference.name == facts.control:
                done = _prepares(reference, view)
                if done is None:
                    return None
                rest.append((view, done))
            elif reference.name in facts.results:
                if isinstance(outer, ccode.Assignment) and outer.left is reference:
                    return None
                reads.append(PortStatement(view, reference, (PinStep(0, pin, CONVERT),)))
    return ConverterIdiom(tuple(reads), tuple(rest)) if reads else None


def _prepares(reference: ccode.NameReference, view: CodeView) -> ccode.Located | None:
    """The statement that sets the control register to a constant, or waits for one of its bits; None for any other."""
    outer = reference.eContainer()
    if isinstance(outer, ccode.Assignment) and outer.left is reference:
        return outer if _is_statement(outer) and register_value(outer.right, view.values) is not None else None
    loop = ancestor_of_kind(reference, ccode.While)
    if loop is None or loop.condition is None or not any(each is reference for each in all_contents(loop.condition)):
        return None
    body = loop.body
    empty = isinstance(body, ccode.EmptyStatement) or (isinstance(body, ccode.Block) and not body.statements)
    return loop if empty else None


def idiom_statements(views: Sequence[CodeView]) -> list[PortStatement]:
    """The statements of the idioms that are for pins."""
    converted = converter_reads(views)
    changes = (mask for each in pin_changes(views) for mask in each.masks)
    return [*changes, *(converted.reads if converted is not None else ())]


_ENABLES = "PCICR"
"""The register that enables pin change interrupts."""
