"""The name under which a program keeps a number: the constant, array element or member whose initial value it is.

A name counts only while nothing writes to it. What the number means is judged elsewhere.
"""

from __future__ import annotations

from robosmi.metamodels import ccode
from robosmi.query import ancestor_of_kind
from robosmi.transformations.queries.initialisers import is_designated, record_of


def _written(reference: ccode.Expression) -> bool:
    """Whether a reference to a variable, or to an element of it, changes it."""
    inner, outer = reference, reference.eContainer()
    while isinstance(outer, ccode.Index) and outer.array is inner:
        inner, outer = outer, outer.eContainer()
    if isinstance(outer, ccode.Assignment):
        return outer.left is inner
    return isinstance(outer, ccode.Unary) and str(outer.operator) in ("++", "--")


class Initialisers:
    """What many literals of one list or variable ask for, computed once."""

    def __init__(self) -> None:
        self._numbers: dict[ccode.InitializerList, dict[ccode.Located, int] | None] = {}
        self._written: dict[ccode.Variable, bool] = {}

    def numbers(self, values: ccode.InitializerList) -> dict[ccode.Located, int] | None:
        """The index of each value of a list; None where a value is designated."""
        if values not in self._numbers:
            designated = any(is_designated(each) for each in values.elements)
            self._numbers[values] = None if designated else {each: number for number, each in enumerate(values.elements)}
        return self._numbers[values]

    def is_written(self, variable: ccode.Variable) -> bool:
        """Whether a reference to a variable, or to an element of it, changes it."""
        if variable not in self._written:
            self._written[variable] = any(_written(reference) for reference in variable.references)
        return self._written[variable]


def initialised_constant(
    literal: ccode.IntegerLiteral | ccode.NameReference, known: Initialisers
) -> tuple[str, str, ccode.Located]:
    """The constant that a literal initialises: its name, the function that declares it, the element that holds the value.

    The names are empty, and the element is the literal, where the literal initialises no constant.
    """
    inner: ccode.Located = literal
    outer = literal.eContainer()
    index = None
    while isinstance(outer, (ccode.Cast, ccode.InitializerList)):
        if isinstance(outer, ccode.InitializerList):
            numbers = known.numbers(outer)
            if index is not None or numbers is None:
                return "", "", literal
            index = numbers[inner]
        inner, outer = outer, outer.eContainer()
    if not isinstance(outer, ccode.Variable):
        return "", "", literal
    function = ancestor_of_kind(outer, ccode.Function)
    if known.is_written(outer):
        return "", "", literal  # the name says no longer which port it is
    name = str(outer.name) if index is None else f"{outer.name}[{index}]"
    if (record := record_of(outer.valueType)) is not None and outer.valueType is not None:
        if outer.valueType.arrayDims or index is None or index >= len(record.fields):
            return "", "", literal
        name = f"{outer.name}.{record.fields[index].name}"
    return name, str(function.name) if function is not None else "", outer if index is None else literal
