"""Expressions with their types on the source platform, and the places of a program's text where each can be changed.

`t2m.c_source.typed` makes the trees from the text with the program's own macros expanded, so that the contents of a macro's
body or argument are expressions like any other. `m2m.widths.width_rules` uses them.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import NamedTuple

from msgspec import Struct

from robosmi.transformations.queries.macros.macro_definitions import TextPlace
from robosmi.transformations.queries.numbers import Number

MAX_DEPTH = 6000
"""Python's recursion limit for expression trees as deep as the parser's, with several calls a level."""


@contextmanager
def raised_recursion_limit() -> Iterator[None]:
    """Raise Python's recursion limit to `MAX_DEPTH`: sums of hundreds of terms are trees as deep as that."""
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(max(limit, MAX_DEPTH))
    try:
        yield
    finally:
        sys.setrecursionlimit(limit)


class NumberKind(NamedTuple):
    """A type as far as conversions need it.

    Attributes:
        number: the number it is; None for pointers, records, functions and what is not known.
        char: it is plain char.
        pointer: it is a pointer or an array.
        target: the number that a declaration of this type is on the target; None where that is not known.
        base: its plain name (`int`, `unsigned long`), empty for what is no number.
        enumeration: the enumeration that it is, or is a constant of; empty for others.
    """

    number: Number | None = None
    char: bool = False
    pointer: bool = False
    target: Number | None = None
    base: str = ""
    enumeration: str = ""


_UNKNOWN = NumberKind()


class TypedExpression(Struct):
    """An expression, or a statement or declaration that holds some.

    Attributes:
        form: `literal`, `character`, `text`, `name`, `member`, `call`, `unary`, `binary`, `compound`, `assign`, `conditional`,
            `index`, `cast`, `size`, `list`, `return`, `switch`, `case`, `if`, `declaration`, `macro`, `other`, or `lambda`, which
            a function with a deduced result is, too.
        operator: of unary, binary and compound ones.
        kind: its type on the source.
        converted: the type that it is converted to where it stands.
        children: operands, arguments and what else stands in it, in text order.
        places: where it can be changed, parentheses around it included; the outermost first.
        inner: the same without parentheses.
        layers: all of these, and those with some of the parentheses, from the outside to the inside.
        name: what a name, member or call refers to.
        origin: of a name or call: `program`, `standard`, `platform`, or `parameter` of a function.
        text: a literal as it is written.
        value: of an integer constant expression, where it is one.
        postfix: the operator stands behind.
        bracketed: it stands in parentheses.
        bits: of a member that is a bit-field, else -1.
        fixed: parameters of a called function that takes more than it names, else -1.
        deduced: which children give their type to a parameter of a template or to a variable that is declared as `auto`.
    """

    form: str
    operator: str = ""
    kind: NumberKind = _UNKNOWN
    converted: NumberKind = _UNKNOWN
    children: list[TypedExpression] = []
    places: tuple[TextPlace, ...] = ()
    inner: tuple[TextPlace, ...] = ()
    layers: tuple[TextPlace, ...] = ()
    name: str = ""
    origin: str = ""
    text: str = ""
    value: int | None = None
    postfix: bool = False
    bracketed: bool = False
    bits: int = -1
    fixed: int = -1
    deduced: tuple[int, ...] = ()
