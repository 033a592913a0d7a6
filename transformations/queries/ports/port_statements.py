"""What a program does with pins by the registers of their ports on an AVR: `PORTB |= _BV(5)`, `DDRD = 0xF0`, `PINC & 4`.

A register has a bit for each of eight pins. PORT sets outputs, and at inputs the pull-up; DDR makes pins outputs; writing a one
into PIN toggles an output. Source: ATmega328P data sheet DS40002061, section 14. Whether a bit of PORT is an output or a pull-up
follows from DDR and pinMode in all of the program. An expression that is not told here is not understood: a pin that is an input
and an output in turn, a pointer to a register, arithmetic with it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence, Set as AbstractSet
from fractions import Fraction

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.query import all_contents
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.flows.pin_uses import pin_uses
from robosmi.transformations.queries.ports.bit_values import (
    AND,
    EQUAL,
    NOT,
    ONE,
    OR,
    SAME,
    WIDTH,
    XOR,
    ZERO,
    Bits,
    BitValue,
    assigned_bits,
    bit_values,
    bits_of,
)  # fmt: skip
from robosmi.transformations.queries.ports.register_values import macro_text, register_value

HIGH, LOW, TOGGLE, OUTPUT, INPUT, READ, PULL_UP = "high", "low", "toggle", "output", "input", "read", "pull-up"
VALUE, HIGH_IF, LOW_IF, TOGGLE_IF, LEVEL = "value", "high-if", "low-if", "toggle-if", "level"
IS_SET, IS_CLEAR, WAIT_SET, WAIT_CLEAR = "is-set", "is-clear", "wait-set", "wait-clear"
READS = frozenset([READ, IS_SET, IS_CLEAR, WAIT_SET, WAIT_CLEAR])
"""What reads a pin."""
BY_VALUE = {EQUAL: VALUE, OR: HIGH_IF, AND: LOW_IF, XOR: TOGGLE_IF}
_REGISTER = re.compile(r"(PORT|PIN|DDR)([A-L])")
_BIT = re.compile(r"P([A-L])([0-7])")
_ALL = (1 << WIDTH) - 1
MODE = "pinMode"
_CALLS = {
    "bitRead": IS_SET, "bit_is_set": IS_SET, "bit_is_clear": IS_CLEAR, "loop_until_bit_is_set": WAIT_SET,
    "loop_until_bit_is_clear": WAIT_CLEAR, "bitSet": HIGH, "bitClear": LOW, "bitToggle": TOGGLE, "bitWrite": LEVEL,
}  # fmt: skip
"""Macros of Arduino and avr-libc that take a register and the number of a bit -> what they do."""


class PinStep(Struct, frozen=True):
    """What is done with one pin: its bit in the register, its number on the board, what, and the value that it depends on."""

    bit: int
    number: int
    what: str
    value: ccode.Expression | None = None


class PortStatement(Struct, frozen=True):
    """An expression that writes or reads a register of a port.

    Attributes:
        view: its unit.
        element: the expression.
        steps: what it does, in the order of the bits.
        register: the register.
        handler: the function that a change of a pin calls, or the objects that drive its pins, with commas.
        scale: what the value is multiplied with.
    """

    view: CodeView
    element: ccode.Expression
    steps: tuple[PinStep, ...]
    register: str = ""
    handler: str = ""
    scale: Fraction = Fraction(1)


class _Use(Struct, frozen=True):
    """An expression around a register, before it is known which of its pins are outputs."""

    view: CodeView
    element: ccode.Expression
    register: str
    port: str
    bits: Bits = ()
    read: int = 0
    done: str = ""
    plain: bool = False

    def made(self, *whats: str) -> set[tuple[str, int]]:
        """The bits of the port that get one of these values."""
        return {(self.port, number) for number, bit in enumerate(self.bits) if bit.what in whats}


class _Modes(Struct, frozen=True):
    """Which bits of ports are outputs, which inputs, and whether the program sets the mode of pins that nothing tells."""

    outputs: frozenset[tuple[str, int]]
    inputs: frozenset[tuple[str, int]]
    unknown: bool


def port_statements(views: Sequence[CodeView]) -> list[PortStatement]:
    """The expressions of a program that are understood, in text order."""
    pins = views[0].api.board.ports if views and views[0].api.board is not None else {}
    if not pins:
        return []
    uses = [use for view in views for each in view.of_kind(ccode.NameReference) if (use := _use(view, each)) is not None]
    modes = _modes(views, uses, pins)
    known = {
        (use.port, number)
        for use in uses
        for number in range(WIDTH)
        if use.read >> number & 1 or (use.bits and use.bits[number].what not in (SAME, *((ZERO, EQUAL) if use.plain else ())))
    }
    found = []
    left: list[ccode.Expression] = []  # what stays as it is, with what it reads
    for use in sorted(uses, key=lambda each: bool(each.read)):
        steps = _read(use, modes) if use.read else _write(use, modes, known | modes.outputs)
        placed = [
            PinStep(bit, number, what, value)
            for bit, what, value in steps or ()
            if (number := pins.get(f"P{use.port}{bit}")) is not None
        ]
        if not placed:
            left.append(use.element)
        elif not (use.read and any(outer is use.element for each in left for outer in all_contents(each))):
            found.append(PortStatement(use.view, use.element, tuple(placed), use.register + use.port))
    order = {id(view): number for number, view in enumerate(views)}
    return sorted(found, key=lambda each: (order[id(each.view)], int(each.element.startOffset)))


def register_of(reference: ccode.NameReference, view: CodeView) -> str:
    """The register of a port that a name means, by itself or as a macro; empty for any other name."""
    name = str(reference.name)
    if isinstance(reference.target, (ccode.Variable, ccode.Parameter)):
        return ""
    text = (macro_text(name, view.values) or name).strip("() ")
    return text if _REGISTER.fullmatch(text) else ""


def is_statement(expression: ccode.Expression) -> bool:
    """Whether nothing takes the value of an expression."""
    outer = expression.eContainer()
    loop = isinstance(outer, ccode.For) and expression is not outer.condition
    return loop or isinstance(outer, (ccode.ExpressionStatement, ccode.Case, ccode.Label))


def is_pure(value: ccode.Expression | None, view: CodeView) -> bool:
    """Whether an expression may be evaluated once for each bit: it changes nothing, calls nothing, and reads no register."""
    inside = [value, *all_contents(value)] if value is not None else []
    for each in inside:
        if isinstance(each, (ccode.Call, ccode.Assignment)) or (isinstance(each, ccode.Unary) and each.operator in ("++", "--")):
            return False
        if isinstance(each, ccode.NameReference) and register_of(each, view):
            return False
    return bool(inside)


def _use(view: CodeView, reference: ccode.NameReference) -> _Use | None:
    """The expression around a register that is understood, if there is one."""
    name = register_of(reference, view)
    if not name:
        return None
    register, port = name[:-1], name[-1]
    outer = reference.eContainer()
    if isinstance(outer, ccode.Assignment) and outer.left is reference:
        bits = _assigned(outer, name, view) if is_statement(outer) else None
        return _Use(view, outer, register, port, bits, plain=outer.operator == "=") if bits is not None else None
    if isinstance(outer, ccode.Call) and (done := _CALLS.get(str(outer.calleeName))) and outer.arguments[0] is reference:
        number = register_value(outer.arguments[1], view.values) if len(outer.arguments) > 1 else None
        if number is None or not 0 <= number < WIDTH:
            return None
        if done in READS:
            return _Use(view, outer, register, port, read=1 << number, done=done)
        return _called(view, outer, register, port, number) if is_statement(outer) else None
    if _stays(reference, name, view) or not _is_read(reference, view):
        return None
    element, mask = _masked(reference, view)
    return _Use(view, element, register, port, read=mask, done=READ)


def _called(view: CodeView, call: ccode.Call, register: str, port: str, number: int) -> _Use | None:
    """A call of a macro that changes one bit."""
    value = {HIGH: BitValue(ONE), LOW: BitValue(ZERO), TOGGLE: BitValue(NOT)}.get(_CALLS[str(call.calleeName)])
    if value is None:
        given = call.arguments[2] if len(call.arguments) > 2 else None
        level = register_value(given, view.values)
        value = BitValue(EQUAL, given) if level is None else BitValue(ONE if level else ZERO)
    bits = [value if bit == number else BitValue(SAME) for bit in range(WIDTH)]
    if register == "PIN":
        return None
    return _Use(view, call, register, port, bits, done=LEVEL if value.what == EQUAL else "")


def _assigned(assignment: ccode.Assignment, name: str, view: CodeView) -> Bits | None:
    """What an assignment makes of the bits of a register; None if it is not understood."""
    is_register = lambda each: register_of(each, view) == name  # noqa: E731
    if not name.startswith("PIN"):
        return assigned_bits(assignment, is_register, view.values)
    right = bit_values(assignment.right, is_register, view.values) if assignment.operator in ("=", "|=") else None
    if right is None or any(each.what not in (ONE, ZERO) for each in right):
        return None
    return [BitValue(NOT if each.what == ONE else SAME) for each in right]


def _stays(reference: ccode.NameReference, name: str, view: CodeView) -> bool:
    """Whether a register is read in an assignment to a register that says itself what its bits become, or is not understood."""
    each = reference.eContainer()
    while isinstance(each, ccode.Expression):
        left = each.left if isinstance(each, ccode.Assignment) else None
        if isinstance(each, ccode.Assignment) and isinstance(left, ccode.NameReference) and (other := register_of(left, view)):
            return other == name or not is_statement(each) or _assigned(each, other, view) is None
        each = each.eContainer()
    return False


def _is_read(reference: ccode.NameReference, view: CodeView) -> bool:
    """Whether an expression takes the value of a register; not where something may change it, or take its address."""
    outer = reference.eContainer()
    if isinstance(outer, ccode.Unary):
        return outer.operator in ("~", "!", "-", "+")
    if isinstance(outer, ccode.Assignment):
        return outer.right is reference
    if isinstance(outer, ccode.Call):
        own = isinstance(outer.callee, ccode.Function) and isinstance(outer.callee.eContainer(), ccode.SourceUnit)
        return not own and str(outer.calleeName) not in view.values.macros
    known = (
        ccode.Binary,
        ccode.Cast,
        ccode.ConditionalExpression,
        ccode.Variable,
        ccode.Return,
        ccode.If,
        ccode.While,
        ccode.DoWhile,
        ccode.Switch,
    )
    return isinstance(outer, known)


def _masked(reference: ccode.NameReference, view: CodeView) -> tuple[ccode.Expression, int]:
    """The expression that reads a register, and the bits of it that count."""
    element: ccode.Expression = reference
    outer = reference.eContainer()
    while isinstance(outer, ccode.Cast):
        outer = outer.eContainer()
    if isinstance(outer, ccode.Binary):
        number = register_value(outer.right if outer.left is reference else outer.left, view.values)
        if number is not None and outer.operator == "&":
            return (outer, number & _ALL) if reference.eContainer() is outer else (element, number & _ALL)
        if number is not None and outer.operator == ">>" and outer.left is reference and 0 <= number < WIDTH:
            further, mask = outer.eContainer(), _ALL
            if isinstance(further, ccode.Binary) and further.operator == "&":
                below = register_value(further.right if further.left is outer else further.left, view.values)
                mask = _ALL if below is None else below << number & _ALL
            return element, mask & (_ALL << number) & _ALL
    return element, _ALL


def _modes(views: Sequence[CodeView], uses: Sequence[_Use], pins: Mapping[str, int]) -> _Modes:
    """The modes of all pins of ports."""
    places = {number: (found[1], int(found[2])) for name, number in pins.items() if (found := _BIT.fullmatch(name)) is not None}
    outputs = {bit for use in uses if use.register == "DDR" for bit in use.made(ONE)}
    inputs = {bit for use in uses if use.register == "DDR" and not use.plain for bit in use.made(ZERO)}
    unknown = False
    for use in (each for each in pin_uses(views) if each.function == MODE):
        mode = use.call.arguments[1] if isinstance(use.call, ccode.Call) and len(use.call.arguments) > 1 else None
        is_output = isinstance(mode, ccode.NameReference) and mode.name == "OUTPUT"
        if use.pin is None:
            unknown |= is_output or not isinstance(mode, ccode.NameReference)
        elif use.pin in places:
            (outputs if is_output else inputs).add(places[use.pin])
    return _Modes(frozenset(outputs), frozenset(inputs), unknown)


_Steps = list[tuple[int, str, ccode.Expression | None]]


def _read(use: _Use, modes: _Modes) -> _Steps | None:
    """What is read, of which bits; a bit of PORT says whether an output is high, or else whether there is a pull-up."""
    bits = list(bits_of(use.read))
    if use.register == "DDR" or (use.register == "PORT" and any((use.port, bit) not in modes.outputs for bit in bits)):
        return None
    return [(bit, use.done, None) for bit in bits]


def _write(use: _Use, modes: _Modes, known: AbstractSet[tuple[str, int]]) -> _Steps | None:
    """What is done with which bits; None if it depends on what nothing tells.

    A pin that is cleared with its whole port and that the program does not use otherwise stays as it is after a reset.
    """
    steps: _Steps = []
    for number, bit in enumerate(use.bits):
        at = (use.port, number)
        if bit.what == SAME or (use.plain and bit.what in (ZERO, EQUAL) and at not in known):
            continue
        if use.register == "DDR":
            if bit.what not in (ONE, ZERO):
                return None
            steps.append((number, OUTPUT if bit.what == ONE else INPUT, None))
        elif at in modes.outputs and at not in modes.inputs:
            fixed = {ONE: HIGH, ZERO: LOW, NOT: TOGGLE}
            what = fixed.get(bit.what) or (LEVEL if use.done == LEVEL else BY_VALUE[bit.what])
            steps.append((number, what, bit.value))
        elif bit.what == EQUAL and at not in modes.inputs and use.done != LEVEL and not modes.unknown:
            continue
        elif at in modes.outputs or modes.unknown or bit.what not in (ONE, ZERO):
            return None
        else:
            steps.append((number, PULL_UP if bit.what == ONE else INPUT, None))
    return steps
