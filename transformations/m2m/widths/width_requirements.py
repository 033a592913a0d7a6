"""The kinds of changes that keep the widths of numbers: found by `width_rules`, written by `widths`."""

from __future__ import annotations

from msgspec import Struct

from robosmi.transformations.queries.numbers import Number
from robosmi.transformations.queries.typed import TypedExpression

WIDEN, READ, NAME, SHIFT, TEXT, ORDER = "widen", "unsigned-char", "wider-function", "spelled-out", "format", "order"
DEDUCED = "gives-type"
"""Rules: cast to a wider type, read plain char as unsigned, call a wider counterpart, expand a compound assignment, insert a
length into a format, wrap a comparison function so that its result fits an int, widen what gives its type to something.
"""


class WidthRequirement(Struct):
    """An expression that has to be written differently.

    Attributes:
        rule: `widen`, `unsigned-char`, `wider-function`, `spelled-out`, `format`, `order` or `gives-type`.
        node: the expression.
        number: the type to cast to.
        text: the new name, or the operator of an expanded assignment.
        other: the right operand of an expanded assignment.
        offsets: where a length has to be inserted into a format.
    """

    rule: str
    node: TypedExpression
    number: Number | None = None
    text: str = ""
    other: TypedExpression | None = None
    offsets: tuple[int, ...] = ()
