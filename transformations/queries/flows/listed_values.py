"""Lists of values of C and C++: `(struct led){4, 5}`, `return {4, 5}`, `on({4})`, `[GREEN] = 9`."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import ancestor_of_kind
from robosmi.transformations.queries.expression_type import type_of
from robosmi.transformations.queries.flows.classes import Classes
from robosmi.transformations.queries.initialisers import record_of


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
