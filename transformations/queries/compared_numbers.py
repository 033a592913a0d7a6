"""The numbers with which a program compares those that it reads, such as what is typed on its console.

A number that was read is followed by names: through assignments, arguments, results of functions and pointers to what is to
hold it. Names are not told apart by the function that they belong to, so that a number too many may be found.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator

from robosmi.metamodels import ccode
from robosmi.model.strict import Element
from robosmi.query import all_contents
from robosmi.transformations.queries.numbers import COMPARISONS
from robosmi.transformations.queries.place_names import named, names_within
from robosmi.transformations.queries.values import Values


def compared_numbers(program: ccode.Program, reads: Collection[str]) -> list[int]:
    """The constants with which a program compares numbers that it has read, in text order, each once.

    Args:
        program: the program.
        reads: the names of the functions that read numbers, and give them as results or through arguments.
    """
    units = [(unit, list(all_contents(unit))) for unit in program.units]
    holders = {f"{name}()" for name in reads}
    known = 0
    while known < len(holders):
        known = len(holders)
        for element in (each for _, elements in units for each in elements):
            holders.update(_given(element, holders, reads))
    found: list[int] = []
    for unit, elements in units:
        values = Values(program, unit)
        for element in elements:
            for constant in _compared(element, holders):
                if not any(isinstance(each, ccode.CharacterLiteral) for each in (constant, *all_contents(constant))):
                    found += [value.number for value in values.of(constant) if value.number is not None]
    return list(dict.fromkeys(found))


def _given(element: Element, holders: set[str], reads: Collection[str]) -> Iterator[str]:
    """The names that get a number that was read, or a pointer to what gets one, by an element."""
    if isinstance(element, ccode.Assignment):
        if _holds(element.right, holders):
            yield from _holder(element.left)
    elif isinstance(element, ccode.Variable):
        if _holds(element.initializer, holders):
            yield str(element.name)
    elif isinstance(element, ccode.Function):
        if any(isinstance(each, ccode.Return) and _holds(each.value, holders) for each in all_contents(element)):
            yield f"{element.name}()"
    elif isinstance(element, ccode.Call):
        parameters = [] if element.callee is None else [str(each.name) for each in element.callee.parameters]
        for number, argument in enumerate(element.arguments):
            parameter = parameters[number] if number < len(parameters) else ""
            if element.calleeName in reads or (parameter in holders and _is_address(argument)):
                yield from _holder(argument)
            elif parameter and _holds(argument, holders):
                yield parameter


def _compared(element: Element, holders: set[str]) -> Iterator[Element]:
    """The expressions with which an element compares a number that was read."""
    if isinstance(element, ccode.Binary) and str(element.operator) in COMPARISONS:
        for side, other in ((element.left, element.right), (element.right, element.left)):
            if other is not None and _holds(side, holders):
                yield other
    elif isinstance(element, ccode.Switch) and _holds(element.selector, holders):
        for case in all_contents(element):
            if isinstance(case, ccode.Case) and case.constant is not None:
                yield case.constant


def _is_address(expression: Element) -> bool:
    return isinstance(expression, ccode.Unary) and str(expression.operator) == "&"


def _holder(expression: Element | None) -> Iterator[str]:
    """The name of the variable or member that an expression denotes, or points to; a member's name begins with a point."""
    while isinstance(expression, (ccode.Index, ccode.Unary, ccode.Cast)):
        expression = expression.array if isinstance(expression, ccode.Index) else expression.operand
    yield from named(expression)


def _holds(expression: Element | None, holders: set[str]) -> bool:
    """Whether an expression has a number that was read."""
    return not holders.isdisjoint(names_within(expression))
