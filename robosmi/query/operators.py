"""EOL's operators as functions, for where Python's own give another answer.

Python's `and`, `or`, `not`, `if` are right for Booleans; here are the strict forms, `implies` and `xor`, and arithmetic as the
engine does it: Integers of 32 bits that wrap around, `/` of Integers towards zero, text + anything joins, `<` of anything but
numbers is False. A right operand of a logical operator may be a function, which is called only if it is needed.
Source: the operator classes and NumberUtil of Epsilon; measured, docs/reference/eol.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, TypeVar

from robosmi.query.collections import Q
from robosmi.query.live_collections import collection
from robosmi.query.problems import OperandError
from robosmi.query.values import INT_MAX, INT_MIN, Long, as_string, collection_kind, equal, is_number

V = TypeVar("V")
W = TypeVar("W")


def wrapped(value: int, long: bool = False) -> int:
    """An integer as 32 bits, or as a Long of 64, hold it.

    >>> wrapped(2**31)
    -2147483648
    """
    if long:
        return Long((value + 2**63) % 2**64 - 2**63)
    return (value + 2**31) % 2**32 - 2**31


def is_long(value: V) -> bool:
    """Whether a number is an integer, but no Integer of 32 bits."""
    return isinstance(value, Long) or (isinstance(value, int) and value.__class__ is int and not INT_MIN <= value <= INT_MAX)


def _fit(value: int | float, left: int | float, right: int | float) -> int | float:
    return value if isinstance(value, float) else wrapped(value, is_long(left) or is_long(right))


def plus(left: V, right: W) -> int | float | str | Q[Any]:
    """`+`: adds numbers, joins collections (the left one's kind), and joins anything else as text.

    >>> plus("v", 1.5), plus(2147483647, 1), plus([1], [2])
    ('v1.5', -2147483648, Q([1, 2]))
    """
    if is_number(left) and is_number(right):
        return _fit(left + right, left, right)
    if collection_kind(left) is not None and collection_kind(right) is not None:
        return collection(left).including_all(collection(right))
    return as_string(left) + as_string(right)


def minus(left: V, right: W) -> int | float | Q[Any] | None:
    """`-`: subtracts numbers, removes a collection's items from another; None for anything else, as in EOL."""
    if is_number(left) and is_number(right):
        return _fit(left - right, left, right)
    if collection_kind(left) is not None and collection_kind(right) is not None:
        return collection(left).excluding_all(collection(right))
    return None


def times(left: V, right: W) -> int | float:
    """`*` of numbers; 0 for anything else, as in EOL."""
    if is_number(left) and is_number(right):
        return _fit(left * right, left, right)
    return 0


def divided(left: V, right: W) -> int | float:
    """`/`: of Integers towards zero, of Reals as IEEE 754 has it.

    Raises:
        OperandError: division of an integer by zero, or an operand that is no number.

    >>> divided(9, 2), divided(-9, 2), divided(9, 2.0)
    (4, -4, 4.5)
    """
    if not (is_number(left) and is_number(right)):
        raise OperandError(f"cannot divide {as_string(left)} by {as_string(right)}")
    if isinstance(left, float) or isinstance(right, float):
        if right == 0:
            sign = math.copysign(1.0, left) * math.copysign(1.0, right)
            return math.nan if left == 0 or math.isnan(left) else math.copysign(math.inf, sign)
        return left / right
    if right == 0:
        raise OperandError(f"{left} is divided by zero")
    quotient = abs(left) // abs(right)
    return _fit(quotient if (left < 0) == (right < 0) else -quotient, left, right)


def negative(value: V) -> V | int | float:
    """Unary `-` of a number; anything else as it is."""
    return _fit(-value, value, value) if is_number(value) else value


def less(left: V, right: W) -> bool:
    """`<` of numbers; False for anything else, texts too."""
    return is_number(left) and is_number(right) and bool(left < right)


def greater(left: V, right: W) -> bool:
    """`>` of numbers; False for anything else, texts too."""
    return is_number(left) and is_number(right) and bool(left > right)


def less_or_equal(left: V, right: W) -> bool:
    """`<=`: less, or equal (which texts can be)."""
    return less(left, right) or equal(left, right)


def greater_or_equal(left: V, right: W) -> bool:
    """`>=`: greater, or equal (which texts can be)."""
    return greater(left, right) or equal(left, right)


def unequal(left: V, right: W) -> bool:
    """`<>`."""
    return not equal(left, right)


def truth(value: Any, operator: str = "a condition") -> bool:
    """A Boolean as it is; anything else is refused, as EOL does where Python would take its truth value.

    Raises:
        OperandError: it is no Boolean.
    """
    if value.__class__ is not bool:
        raise OperandError(f"{operator} needs Booleans, not {as_string(value) or value!r}")
    return bool(value)


def _right(value: Any) -> Any:
    return value() if callable(value) else value


def both(left: V, right: W) -> bool:
    """`and`; the right operand may be a function, called only if the left one is true."""
    return truth(left, "and") and truth(_right(right), "and")


def either(left: V, right: W) -> bool:
    """`or`; the right operand may be a function, called only if the left one is false."""
    return truth(left, "or") or truth(_right(right), "or")


def xor(left: V, right: W) -> bool:
    """`xor` of two Booleans."""
    return truth(left, "xor") is not truth(right, "xor")


def implies(left: V, right: W) -> bool:
    """`implies`: true if the left is false or the right is true; the right operand may be a function.

    >>> implies(False, lambda: 1 / 0), implies(True, False)
    (True, False)
    """
    return not truth(left, "implies") or truth(_right(right), "implies")


def negated(value: V) -> bool:
    """`not` of a Boolean."""
    return not truth(value, "not")


def elvis(value: V | None, otherwise: W | Callable[[], W]) -> V | W:
    """`value ?: otherwise`: the value unless it is None; otherwise may be a function, called only if it is needed.

    >>> elvis(None, 1), elvis(False, 1)
    (1, False)
    """
    return value if value is not None else otherwise() if callable(otherwise) else otherwise
