"""The names by which expressions refer to values, to follow these from name to name through a program.

A variable has its name, a member its name with a point before it, the result of a function the function's name with parentheses.
Names are not distinguished by the function or record that they belong to.
"""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import all_contents


def named(expression: Element | None) -> Iterator[str]:
    """The name of what an expression itself denotes; none if it denotes no variable, member or result of a function."""
    if isinstance(expression, ccode.NameReference):
        yield str(expression.name)
    elif isinstance(expression, ccode.Member):
        yield f".{expression.name}"
    elif isinstance(expression, ccode.Call):
        yield f"{expression.calleeName}()"


def names_within(expression: Element | None) -> Iterator[str]:
    """The names of everything in an expression that has one, the expression itself included."""
    for each in () if expression is None else (expression, *all_contents(expression)):
        yield from named(each)
