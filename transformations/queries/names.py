"""What elements of a program are called, and the declared types of what they name; nothing is looked up by name here."""

from __future__ import annotations

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element

_WRITTEN = (
    ccode.IntegerLiteral, ccode.FloatingLiteral, ccode.CharacterLiteral, ccode.StringLiteral, ccode.UnknownExpression,
)  # fmt: skip
_NAMED = (
    ccode.Declaration, ccode.Macro, ccode.MacroUse, ccode.UnresolvedCall, ccode.Label, ccode.NameReference, ccode.Member,
)  # fmt: skip


def name_of(element: Element | None) -> str:
    """The name that an element declares or refers to; empty where it has none."""
    return str(element.name or "") if isinstance(element, _NAMED) else ""


def name_or_text(element: Element | None) -> str:
    """The name of an element of a program, or the text of one that stands for itself, such as a literal."""
    return str(element.text or "") if isinstance(element, _WRITTEN) else name_of(element)


def named_type(expression: Element | None) -> ccode.TypeUse | None:
    """The declared type of the variable, parameter or field that an expression names; None for any other expression."""
    target = expression.target if isinstance(expression, ccode.NameReference) else None
    return target.valueType if isinstance(target, (ccode.Variable, ccode.Parameter, ccode.Field)) else None
