"""The variables, parameters and functions of plain char that take negative values, or are asked whether they do."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from robosmi.metamodels import ccode
from robosmi.query import ancestor_of_kind
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.numbers import COMPARISONS

_CHAR = frozenset(["char", "const char", "volatile char", "static char"])


def negative_chars(views: Sequence[CodeView], results: Mapping[str, tuple[int, int]]) -> list[ccode.Declaration]:
    """Find them.

    Args:
        views: a view of each unit of the program.
        results: name of a function or method -> the least and the greatest value that it returns.
    """
    found: dict[int, ccode.Declaration] = {}
    for view in views:
        holders: list[ccode.Variable | ccode.Parameter] = [*view.of_kind(ccode.Variable), *view.of_kind(ccode.Parameter)]
        for holder in holders:
            if not _is_char(holder.valueType):
                continue
            if any(_negative(each, results) for each in _given(holder)) or any(map(_asks_for_sign, holder.references)):
                found.setdefault(id(holder), holder)
        for back in view.of_kind(ccode.Return):
            function = ancestor_of_kind(back, ccode.Function)
            if function is not None and _is_char(function.returnType) and _negative(back.value, results):
                found.setdefault(id(function), function)
        for call in view.of_kind(ccode.Call):
            parameters = list(call.callee.parameters) if call.callee is not None and call.callee.definition else []
            for parameter, argument in zip(parameters, call.arguments, strict=False):
                if _is_char(parameter.valueType) and _negative(argument, results):
                    found.setdefault(id(parameter), parameter)
    return list(found.values())


def _is_char(use: ccode.TypeUse | None) -> bool:
    return use is not None and not use.pointerDepth and " ".join(str(use.spelling).split()) in _CHAR


def _given(holder: ccode.Variable | ccode.Parameter) -> Iterator[ccode.Expression | None]:
    """What a variable, or an element of it, is given."""
    if isinstance(holder, ccode.Variable):
        initial = holder.initializer
        yield from initial.elements if isinstance(initial, ccode.InitializerList) else [initial]
    for reference in holder.references:
        at: ccode.Expression = reference
        outer = at.eContainer()
        while isinstance(outer, ccode.Index) and outer.array is at:
            at, outer = outer, outer.eContainer()
        if isinstance(outer, ccode.Assignment) and outer.left is at:
            yield outer.right


def _negative(value: ccode.Expression | None, results: Mapping[str, tuple[int, int]]) -> bool:
    """Whether a value is negative at times: something with a minus, or what a function returns."""
    if isinstance(value, ccode.Unary):
        return value.operator == "-" and not isinstance(value.operand, ccode.FloatingLiteral)
    if isinstance(value, ccode.ConditionalExpression):
        return _negative(value.whenTrue, results) or _negative(value.whenFalse, results)
    if isinstance(value, ccode.Cast):
        return _negative(value.operand, results)
    return isinstance(value, ccode.Call) and results.get(str(value.calleeName), (0, 0))[0] < 0


def _asks_for_sign(reference: ccode.NameReference) -> bool:
    """Whether a name, or an element of an array, is compared with a negative number, or with zero by `<` or its like."""
    at: ccode.Expression = reference
    outer = at.eContainer()
    while isinstance(outer, ccode.Index) and outer.array is at:
        at, outer = outer, outer.eContainer()
    if not isinstance(outer, ccode.Binary) or outer.operator not in COMPARISONS:
        return False
    other = outer.right if outer.left is at else outer.left
    if isinstance(other, ccode.Unary) and other.operator == "-":
        return True
    below = "<" if outer.left is at else ">"
    return isinstance(other, ccode.IntegerLiteral) and int(other.value) == 0 and outer.operator in (below, _OPPOSITE[below])


_OPPOSITE = {"<": ">=", ">": "<="}
