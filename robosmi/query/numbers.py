"""EOL's operations on numbers; each takes the number first.

Names that Python has keep a `_` at the end. `floor`, `ceiling`, `round_` give an Integer, as in the engine at most 2147483647.
Not here: the operators, which are in `operators`. Source: NumberOperationContributor and IntegerOperationContributor of Epsilon.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from robosmi.query.collections import Q
from robosmi.query.operators import greater, is_long, less, wrapped
from robosmi.query.problems import OperandError
from robosmi.query.types import fits_integer
from robosmi.query.values import INT_MAX, INT_MIN, Long, is_number

if TYPE_CHECKING:
    from robosmi.query.values import Answer


def _integer(value: Any, name: str) -> int:
    if not fits_integer(value):
        raise OperandError(f"{name} needs Integers, not {value!r}")
    return int(value)


def _number(value: Answer, name: str) -> Any:
    if not is_number(value):
        raise OperandError(f"{name} needs numbers, not {value!r}")
    return value


def _saturated(value: float) -> int:
    if math.isnan(value):
        return 0
    return int(max(INT_MIN, min(INT_MAX, value)))


def abs_(number: Any) -> Any:
    """The absolute value, of the same type."""
    return abs(number) if isinstance(number, float) else wrapped(abs(number), is_long(number))


def ceiling(number: Any) -> int:
    """The least integer that is not less."""
    return _saturated(float(number) if math.isinf(number) or math.isnan(number) else math.ceil(number))


def floor(number: Any) -> int:
    """The greatest integer that is not greater."""
    return _saturated(float(number) if math.isinf(number) or math.isnan(number) else math.floor(number))


def round_(number: Any) -> int:
    """The nearest integer, halves upwards (2.5 gives 3, -2.5 gives -2).

    >>> round_(2.5), round_(-2.5)
    (3, -2)
    """
    if isinstance(number, float) and (math.isinf(number) or math.isnan(number)):
        return _saturated(number)
    whole = math.floor(number)
    return _saturated(whole + (number - whole >= 0.5))


def pow_(number: Any, exponent: Any) -> Any:
    """A power: an Integer if both are and the exponent is positive, else a Real."""
    base, power = float(number), float(_number(exponent, "pow"))
    try:
        result = base**power
    except OverflowError:
        result = math.copysign(math.inf, base) if power % 2 == 1 else math.inf
    except ZeroDivisionError:
        result = math.inf
    if isinstance(result, complex):
        result = math.nan
    return _saturated(result) if fits_integer(number) and fits_integer(exponent) and exponent > 0 else result


def log(number: Any) -> float:
    """The natural logarithm; of zero minus infinity, of less no number."""
    return math.log(number) if number > 0 else -math.inf if number == 0 else math.nan


ln = log


def log10(number: Any) -> float:
    """The logarithm to base ten; of zero minus infinity, of less no number."""
    return math.log10(number) if number > 0 else -math.inf if number == 0 else math.nan


def min_(number: Answer, other: Answer) -> Any:
    """The lesser of two numbers."""
    return number if less(number, _number(other, "min")) else other


def max_(number: Answer, other: Answer) -> Any:
    """The greater of two numbers."""
    return number if greater(number, _number(other, "max")) else other


def factorial(number: Any) -> Long:
    """The factorial, a Long.

    Raises:
        OperandError: the number is below 0 or above 20.
    """
    n = int(number)
    if not 0 <= n <= 20:
        raise OperandError(f"the factorial of {n} is out of range (0 to 20)")
    return Long(math.factorial(n))


def mod(number: Any, other: Any) -> int:
    """The remainder of Integers, with the sign of the dividend.

    Raises:
        OperandError: an operand is no Integer, or the divisor is zero.

    >>> mod(-7, 3)
    -1
    """
    if _integer(other, "mod") == 0:
        raise OperandError(f"{number} is divided by zero")
    return int(math.fmod(_integer(number, "mod"), other))


def to(number: Any, end: Any) -> Q[int]:
    """The Sequence of Integers from one to the other, both included, upwards or downwards."""
    return integer_range(_integer(number, "to"), _integer(end, "to"))


def iota(number: Answer, end: Answer, step: Answer) -> Q[int]:
    """The Sequence of Integers up to an end, in steps. It only counts upwards: a negative step gives an empty Sequence.

    Raises:
        OperandError: the step is zero, or leads away from the end.
    """
    start, last, width = _integer(number, "iota"), _integer(end, "iota"), _integer(step, "iota")
    if width == 0 or (start < last and width < 0) or (start > last and width > 0):
        raise OperandError(f"iota from {start} cannot reach {last} in steps of {width}")
    if start == last and width < 0:
        raise OperandError("iota with equal ends and a negative step does not end in EOL; it is refused")
    return Q(range(start, last + 1, width) if width > 0 else ())


def to_binary(number: Answer) -> str:
    """The binary digits, of a negative Integer those of its 32 bits."""
    return f"{_integer(number, 'toBinary') % 2**32:b}"


def to_hex(number: Answer) -> str:
    """The hexadecimal digits, without `0x`; of a negative Integer those of its 32 bits."""
    return f"{_integer(number, 'toHex') % 2**32:x}"


def as_integer(number: Any) -> int:
    """The number without its fraction."""
    return _saturated(number) if isinstance(number, float) else wrapped(int(number))


def as_long(number: Any) -> Long:
    """The number without its fraction, a Long."""
    return Long(max(-(2**63), min(2**63 - 1, int(number))))


def as_real(number: Any) -> float:
    """The number as a Real (EOL asReal, asFloat, asDouble)."""
    return float(number)


def integer_range(first: int, last: int) -> Q[int]:
    """The Sequence from first to last, both included (EOL `Sequence{1..9}`); downwards if last is less.

    >>> integer_range(3, 1)
    Q([3, 2, 1])
    """
    if not INT_MIN <= min(first, last) <= max(first, last) <= INT_MAX:
        raise OperandError(f"{first}..{last} leaves 32 bits")
    return Q._of(list(range(first, last + 1) if first <= last else range(first, last - 1, -1)))
