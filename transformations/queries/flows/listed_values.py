"""Lists of values of C and C++: `(struct led){4, 5}`, `return {4, 5}`, `on({4})`, `[GREEN] = 9`.

A value is kept under a name (`Initialisers`): the constant, array element or member whose initial value it is. A name
counts only while nothing writes to it. What the number means is judged elsewhere.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import ancestor_of_kind
from robosmi.transformations.queries.expression_type import type_of
from robosmi.transformations.queries.flows.classes import Classes
from robosmi.transformations.queries.initialisers import is_designated, record_of


def listed_types(
    values: ccode.InitializerList,
    classes: Classes,
    sources: Mapping[str, bytes],
    called: Callable[[ccode.Call], Sequence[ccode.Function]],
) -> list[ccode.TypeUse]:
    """The types that a list of values may be of; empty where the text does not say one.

    Args:
        values: the list.
        classes: the classes of the program.
        sources: path of a unit -> its bytes.
        called: the functions that a call may run.
    """
    around = values.eContainer()
    found: list[ccode.TypeUse | None] = []
    if isinstance(around, ccode.Cast) and around.target is not None:
        found = [around.target]
    elif isinstance(around, ccode.Cast) or (isinstance(around, ccode.Unary) and around.operator == "new"):
        unit = ancestor_of_kind(around, ccode.SourceUnit)
        text = sources[unit.path][around.startOffset : values.startOffset] if unit is not None else b""
        record = classes.named(text.decode("latin-1").strip().rpartition(" ")[2].rpartition("::")[2])
        found = [ccode.TypeUse(declaration=record)] if record is not None else []
    elif isinstance(around, (ccode.Field, ccode.Parameter)):
        found = [around.valueType]
    elif isinstance(around, ccode.Return):
        function = ancestor_of_kind(around, ccode.Function)
        found = [function.returnType] if function is not None else []
    elif isinstance(around, ccode.Assignment):
        kind = type_of(around.left, {})
        found = [ccode.TypeUse(declaration=kind.declaration)] if kind is not None and kind.declaration is not None else []
    elif isinstance(around, ccode.Call):
        place = list(around.arguments).index(values)
        found = [f.parameters[place].valueType for f in called(around) if place < len(f.parameters)]
    return [use for use in found if use is not None]


def designates(member: ccode.Member) -> bool:
    """Whether a member without an object says in a list of initial values which member a value is for."""
    inner: Element = member
    outer = member.eContainer()
    while isinstance(outer, (ccode.Member, ccode.Index)):
        inner, outer = outer, outer.eContainer()
    return isinstance(outer, ccode.Assignment) and outer.left is inner and isinstance(outer.eContainer(), ccode.InitializerList)


def gone_through(loop: ccode.For) -> ccode.Variable | None:
    """The array of numbers that a loop over a range goes through; None for any other range."""
    array = loop.range.target if isinstance(loop.range, ccode.NameReference) else None
    if not isinstance(array, ccode.Variable) or array.valueType is None:
        return None
    return array if array.valueType.arrayDims and record_of(array.valueType) is None else None


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

    def constant(self, literal: ccode.IntegerLiteral | ccode.NameReference) -> tuple[str, str, ccode.Located]:
        """The constant that a literal initialises: its name, the function that declares it, the element that holds the value.

        The names are empty, and the element is the literal, where the literal initialises no constant.
        """
        inner: ccode.Located = literal
        outer = literal.eContainer()
        index = None
        while isinstance(outer, (ccode.Cast, ccode.InitializerList)):
            if isinstance(outer, ccode.InitializerList):
                numbers = self.numbers(outer)
                if index is not None or numbers is None:
                    return "", "", literal
                index = numbers[inner]
            inner, outer = outer, outer.eContainer()
        if not isinstance(outer, ccode.Variable):
            return "", "", literal
        function = ancestor_of_kind(outer, ccode.Function)
        if self.is_written(outer):
            return "", "", literal  # the name says no longer which port it is
        name = str(outer.name) if index is None else f"{outer.name}[{index}]"
        if (record := record_of(outer.valueType)) is not None and outer.valueType is not None:
            if outer.valueType.arrayDims or index is None or index >= len(record.fields):
                return "", "", literal
            name = f"{outer.name}.{record.fields[index].name}"
        return name, str(function.name) if function is not None else "", outer if index is None else literal
