"""The values of expressions that programs write into registers: bits shifted to their places, masks, names of bits."""

from __future__ import annotations

import re

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.platforms.avr_bits import avr_bits
from robosmi.transformations.queries.macros.constant_text import calculate, macro_number
from robosmi.transformations.queries.macros.expansion import MacroTexts
from robosmi.transformations.queries.values import Values

_SHIFTS = frozenset(["_BV", "bit"])
_SHIFT = re.compile(r"\b(?:_BV|bit)\s*\(\s*(\w+)\s*\)")


def register_value(expression: ccode.Expression | None, values: Values) -> int | None:
    """The value of an expression; None if it is not constant."""
    if isinstance(expression, (ccode.IntegerLiteral, ccode.CharacterLiteral)):
        return int(expression.value)
    if isinstance(expression, ccode.Cast):
        return register_value(expression.operand, values)
    if isinstance(expression, ccode.Call) and str(expression.calleeName) in _SHIFTS and len(expression.arguments) == 1:
        number = register_value(expression.arguments[0], values)
        return 1 << number if number is not None and 0 <= number < 32 else None
    if isinstance(expression, ccode.Unary) and expression.operator in ("~", "-", "+"):
        operand = register_value(expression.operand, values)
        return None if operand is None else {"~": ~operand, "-": -operand, "+": operand}[str(expression.operator)]
    if isinstance(expression, ccode.Binary):
        left, right = register_value(expression.left, values), register_value(expression.right, values)
        return calculate(str(expression.operator), left, right) if left is not None and right is not None else None
    if isinstance(expression, (ccode.NameReference, ccode.UnknownExpression)):
        name = str(expression.name if isinstance(expression, ccode.NameReference) else expression.text)
        if (known := avr_bits().value(name)) is not None and name not in values.macros:
            return known
        found = values.of(expression)
        if len(found) == 1 and found[0].number is not None:
            return found[0].number
        text = macro_text(name, values)
        return macro_number(_SHIFT.sub(r"(1<<\1)", text), MacroTexts({}), avr_bits().value) if text is not None else None
    return None


def macro_text(name: str, values: Values) -> str | None:
    """What a macro of the program without parameters stands for, expanded; None for a name that is none."""
    if name not in values.macros:
        return None
    return MacroTexts(values.macros).expanded(name)
