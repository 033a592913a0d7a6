"""The text of an expression, written anew from its element: for reports, where the source file is not at hand.

Parentheses are set where C needs them, blanks around binary operators. It is no copy of the source: generated programs take
their text from the file itself.
"""

from __future__ import annotations

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element

_LEVELS = ["*/%", "+-", ("<<", ">>"), ("<", ">", "<=", ">="), ("==", "!="), "&", "^", "|", ("&&",), ("||",), ","]


def _level(operator: str) -> int:
    return next((i for i, operators in enumerate(_LEVELS) if operator in operators), 0)


def expression_text(element: Element | None) -> str:
    """An expression as C text; empty for None."""
    if element is None:
        return ""
    if isinstance(element, ccode.NameReference):
        return str(element.name)
    if isinstance(element, ccode.Call):
        callee = str(element.calleeName or "") or f"({expression_text(element.calleeExpression)})"
        return f"{callee}({', '.join(expression_text(a) for a in element.arguments)})"
    if isinstance(element, ccode.Binary):
        level = _level(str(element.operator))
        left, right = (_operand(element.left, level, False), _operand(element.right, level, True))
        return f"{left}{'' if element.operator == ',' else ' '}{element.operator} {right}"
    if isinstance(element, ccode.Assignment):
        return f"{expression_text(element.left)} {element.operator} {expression_text(element.right)}"
    if isinstance(element, ccode.Unary):
        operand = _tight(element.operand)
        return f"{operand}{element.operator}" if element.postfix else f"{element.operator}{operand}"
    if isinstance(element, ccode.Cast):
        return f"({element.target.spelling if element.target is not None else ''}){_tight(element.operand)}"
    if isinstance(element, ccode.Index):
        return f"{_tight(element.array)}[{expression_text(element.index)}]"
    if isinstance(element, ccode.Member):
        return f"{_tight(element.object) if element.object is not None else ''}{'->' if element.arrow else '.'}{element.name}"
    if isinstance(element, ccode.ConditionalExpression):
        if element.condition is None:  # GNU C's `a ?: b`
            return f"{_tight(element.whenTrue)} ?: {expression_text(element.whenFalse)}"
        return f"{_tight(element.condition)} ? {expression_text(element.whenTrue)} : {expression_text(element.whenFalse)}"
    if isinstance(element, ccode.SizeOf):
        inner = element.measured.spelling if element.measured is not None else expression_text(element.operand)
        return f"sizeof({inner})"
    if isinstance(element, ccode.InitializerList):
        return "{" + ", ".join(expression_text(e) for e in element.elements) + "}"
    return getattr(element, "text", "") or ""


def _operand(element: Element | None, level: int, right: bool) -> str:
    text = expression_text(element)
    if isinstance(element, (ccode.Assignment, ccode.ConditionalExpression)):
        return f"({text})"
    if isinstance(element, ccode.Binary):
        own = _level(str(element.operator))
        return f"({text})" if own > level or (right and own == level) else text
    return text


def _tight(element: Element | None) -> str:
    text = expression_text(element)
    return f"({text})" if isinstance(element, (ccode.Binary, ccode.Assignment, ccode.ConditionalExpression)) else text
