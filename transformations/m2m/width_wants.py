"""What has to be written otherwise so that numbers keep their widths: found by `width_rules`, written by `width_changes`."""

from __future__ import annotations

from msgspec import Struct

from robosmi.transformations.queries.numbers import Number
from robosmi.transformations.queries.typed import TypedExpression

WIDEN, READ, NAME, SHIFT, TEXT, ORDER = "widen", "unsigned-char", "wider-function", "spelled-out", "format", "order"
"""Rules: convert to a wider type, read without a sign, take a wider sister, spell out an assignment, name the width in a format,
hand over a function whose result is an int."""


class Want(Struct):
    """A place that has to be written otherwise.

    Attributes:
        rule: `widen`, `unsigned-char`, `wider-function`, `spelled-out`, `format` or `order`.
        node: the expression.
        number: the type wanted by `widen`.
        text: the new name, or the operator that is spelled out.
        other: the right side of what is spelled out.
        offsets: where a format names too few bits.
    """

    rule: str
    node: TypedExpression
    number: Number | None = None
    text: str = ""
    other: TypedExpression | None = None
    offsets: tuple[int, ...] = ()
