"""The values of expressions that programs write into registers: bits shifted to their places, masks, names of bits."""

from __future__ import annotations

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.platforms.avr_bits import avr_bits
from robosmi.transformations.queries.macros.constant_text import calculate
from robosmi.transformations.queries.values import Values

_SHIFTS = frozenset(["_BV", "bit"])


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
        return found[0].number if len(found) == 1 else None
    return None
