"""What an expression makes of each of the eight bits of a register: `(PORTB & 0xF0) | (step & 0x0F)` changes the four lower ones.

A bit is set, cleared, kept or turned over; or it is that of a value which only the running program knows, alone or together with
what was there. Anything else, such as a sum with the register, is not understood.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.query import all_contents
from robosmi.transformations.queries.ports.register_values import register_value
from robosmi.transformations.queries.values import Values

ZERO, ONE, SAME, NOT, EQUAL, OR, AND, XOR = "zero", "one", "same", "not", "equal", "or", "and", "xor"
WIDTH = 8
_INVERTED = {ZERO: ONE, ONE: ZERO, SAME: NOT, NOT: SAME}
_JOINED = {"|": OR, "&": AND, "^": XOR}


class BitValue(Struct, frozen=True):
    """What a bit becomes.

    Attributes:
        what: ZERO, ONE, SAME or NOT, or how it is made of the bit of a value: EQUAL to it; or OR, AND, XOR of it and of what
            was there.
        value: that value, of which the bit at the same place is meant.
    """

    what: str
    value: ccode.Expression | None = None


Bits = Sequence[BitValue]
_IsRegister = Callable[[ccode.NameReference], bool]


def bit_values(expression: ccode.Expression | None, is_register: _IsRegister, values: Values) -> Bits | None:
    """What an expression makes of the bits of a register; None if it is not understood.

    Args:
        expression: the value that is assigned to the register.
        is_register: whether a name in it means the register.
        values: the values of names in it.
    """
    if expression is None:
        return None
    if (number := register_value(expression, values)) is not None:
        return constant_bits(number)
    if isinstance(expression, ccode.NameReference) and is_register(expression):
        return [BitValue(SAME)] * WIDTH
    if isinstance(expression, ccode.Cast):
        return bit_values(expression.operand, is_register, values)
    found = None
    if isinstance(expression, ccode.Unary) and expression.operator == "~":
        operand = bit_values(expression.operand, is_register, values)
        found = [BitValue(_INVERTED.get(each.what, "")) for each in operand] if operand is not None else None
    elif isinstance(expression, ccode.Binary) and str(expression.operator) in _JOINED:
        left, right = (bit_values(side, is_register, values) for side in (expression.left, expression.right))
        if left is not None and right is not None:
            found = joined(str(expression.operator), left, right)
    if found is not None and all(each.what for each in found):
        return found
    inside = (expression, *all_contents(expression))
    if any(isinstance(each, ccode.NameReference) and is_register(each) for each in inside):
        return None
    return [BitValue(EQUAL, expression)] * WIDTH


def assigned_bits(assignment: ccode.Assignment, is_register: _IsRegister, values: Values) -> Bits | None:
    """What an assignment makes of the bits of a register; None if it is not understood."""
    operator = str(assignment.operator)
    right = bit_values(assignment.right, is_register, values)
    if right is None or operator not in ("=", "|=", "&=", "^="):
        return None
    bits = right if operator == "=" else joined(operator[0], [BitValue(SAME)] * WIDTH, right)
    return bits if all(each.what for each in bits) else None


def joined(operator: str, left: Bits, right: Bits) -> list[BitValue]:
    """The bits of two values joined by `|`, `&` or `^`; one without `what` is not understood."""
    return [_joined(operator, one, other) for one, other in zip(left, right, strict=True)]


def constant_bits(number: int) -> list[BitValue]:
    """The bits of a number."""
    return [BitValue(ONE if number >> bit & 1 else ZERO) for bit in range(WIDTH)]


def bits_of(mask: int) -> Iterator[int]:
    """The numbers of the bits that are set."""
    return (bit for bit in range(WIDTH) if mask >> bit & 1)


def _joined(operator: str, one: BitValue, other: BitValue) -> BitValue:
    for first, second in ((one, other), (other, one)):
        if first.what == ZERO:
            return second if operator != "&" else first
        if first.what == ONE:
            if operator == "^":
                return BitValue(_INVERTED.get(second.what, ""))
            return second if operator == "&" else first
    if one.what == other.what == SAME and operator in ("|", "&"):
        return one
    for first, second in ((one, other), (other, one)):
        if first.what == SAME and second.what == EQUAL:
            return BitValue(_JOINED[operator], second.value)
    return BitValue("")
