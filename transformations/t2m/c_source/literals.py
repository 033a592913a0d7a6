"""Builders of literals: their text, radix and value.

A literal in the body of a macro has no text of its own in the file; then the parser's value stands for it.
"""

from __future__ import annotations

import re

from robosmi.metamodels import ccode
from robosmi.transformations.t2m.c_source.context import UnitContext
from robosmi.transformations.t2m.c_source.parsing.tree import Node

_ESCAPES = {"n": 10, "t": 9, "r": 13, "a": 7, "b": 8, "f": 12, "v": 11, "e": 27, "\\": 92, "'": 39, '"': 34, "?": 63, "0": 0}
_LONG = 1 << 63


def integer(context: UnitContext, node: Node) -> ccode.Expression:
    """An integer constant: decimal, octal, hexadecimal, or binary (GNU)."""
    text = context.text(node)
    value = integer_value(text)
    if value is None and not node.from_macro:  # it stands for what was cut (`bounds`)
        return ccode.UnknownExpression(text=text, **context.source.place(node.start, node.end))
    if value is None:
        value = evaluated(context, node) or 0
        text = str(value)
    radix = integer_radix(text)
    value &= 2 * _LONG - 1  # what is longer loses its high bits, as in GCC
    return ccode.IntegerLiteral(
        text=text, radix=radix, value=value if value < _LONG else value - 2 * _LONG, **context.source.place(node.start, node.end)
    )


def integer_radix(text: str) -> int:
    """2, 8, 10 or 16, by the prefix."""
    lower = text.lower()
    if lower.startswith("0x"):
        return 16
    if lower.startswith("0b"):
        return 2
    return 8 if len(lower.rstrip("ul")) > 1 and lower.startswith("0") else 10


def integer_value(text: str) -> int | None:
    """The value of an integer constant's text, None when it is none."""
    digits = text.lower().rstrip("ul")
    if not digits or not digits[0].isdigit():
        return None
    radix = integer_radix(text)
    try:
        return int(digits[2:] if radix in (2, 16) else digits, radix)
    except ValueError:
        return None


def floating(context: UnitContext, node: Node) -> ccode.Expression:
    """A real constant."""
    text = context.text(node)
    lower = text.lower().rstrip("fl")
    try:
        value = float.fromhex(lower) if lower.startswith("0x") else float(lower)
    except OverflowError:  # as `float` has it of a decimal number
        value = float("inf")
    except ValueError:
        value = 0.0
    return ccode.FloatingLiteral(text=text, value=value, **context.source.place(node.start, node.end))


def string(context: UnitContext, node: Node) -> ccode.Expression:
    """A string, with all its parts where it is written in several."""
    return ccode.StringLiteral(text=context.text(node), **context.source.place(node.start, node.end))


def character(context: UnitContext, node: Node) -> ccode.Expression:
    """A character constant."""
    text = context.text(node)
    return ccode.CharacterLiteral(text=text, value=character_value(text), **context.source.place(node.start, node.end))


def character_value(text: str) -> int:
    """The value of a character constant; 0 for a form whose value C leaves to the implementation."""
    inner = text[text.find("'") + 1 : text.rfind("'")]
    if len(inner) == 1:
        return ord(inner)
    if match := re.fullmatch(r"\\x([0-9a-fA-F]+)", inner):
        return int(match[1], 16) & 0xFF
    if match := re.fullmatch(r"\\([0-7]{1,3})", inner):
        return int(match[1], 8) & 0xFF
    return _ESCAPES.get(inner[1], 0) if len(inner) == 2 and inner[0] == "\\" else 0


def evaluated(context: UnitContext, node: Node) -> int | None:
    """libclang's value of an integer constant expression, None for any other expression."""
    result = context.lib.Cursor_Evaluate(node.cursor)
    if not result:
        return None
    try:
        if context.lib.EvalResult_getKind(result) != 1:  # CXEval_Int
            return None
        value: int = context.lib.EvalResult_getAsLongLong(result)
        return value
    finally:
        context.lib.EvalResult_dispose(result)
