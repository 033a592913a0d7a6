"""How the type of a cast is written; a type without a name is written as `__typeof__` of the place that gets the value."""

from __future__ import annotations

import re

from robosmi.metamodels import ccode
from robosmi.transformations.queries.expression_type import ValueType

_WORDS = frozenset({"struct", "union", "enum", "const", "volatile", "static", "extern", "register"})
_OR_TEXT = re.compile(r'\?\s*:\s*"(?:[^"\\]|\\.)*"\Z')


def unnamed(kind: ValueType) -> bool:
    """Whether a type has no name that a cast could use."""
    return not kind.function and set(kind.spelling.replace("*", " ").split()) <= _WORDS


def written_type(value: ccode.Expression, wanted: ValueType, data: bytes) -> str:
    """The type to write in a cast of a value; empty if there is no way to name it.

    Args:
        value: the value.
        wanted: the type of the place that gets the value.
        data: the bytes of its unit.
    """
    if wanted.rows and not unnamed(wanted):
        return f"{wanted.spelling.partition('(*')[0].removesuffix('*' * wanted.dimensions).strip()} (*){wanted.rows}"
    if not unnamed(wanted):
        return wanted.spelling
    place = value.eContainer()
    while isinstance(place, ccode.ConditionalExpression):
        place = place.eContainer()
    if isinstance(place, ccode.Variable) and place.name:
        return f"__typeof__({place.name})"
    if isinstance(place, ccode.Assignment) and place.left is not None:
        return f"__typeof__({data[place.left.startOffset : place.left.endOffset].decode('utf-8', 'replace')})"
    return ""


def gives_text(value: ccode.Expression | None) -> bool:
    """Whether a value is a string literal or an address within one."""
    if isinstance(value, ccode.StringLiteral):
        return True
    if isinstance(value, ccode.ConditionalExpression):
        return gives_text(value.whenTrue) or gives_text(value.whenFalse)
    if isinstance(value, ccode.UnknownExpression):  # `text ?: "none"`
        return _OR_TEXT.search(str(value.text)) is not None
    if isinstance(value, ccode.Binary):
        return value.operator in ("+", "-") and gives_text(value.left) != gives_text(value.right)
    if isinstance(value, ccode.Unary) and value.operator == "&" and isinstance(value.operand, ccode.Index):
        return gives_text(value.operand.array)
    return False
