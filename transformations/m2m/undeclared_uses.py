"""Infers from its uses what a type that nothing declares must support: pointers, initializer lists, arithmetic."""

from __future__ import annotations

from collections.abc import Iterable

from robosmi.metamodels import ccode
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import type_of


def pointers_in(views: Iterable[CodeView]) -> set[str]:
    """The names of members to which the program assigns a pointer or a function."""
    assigned = (a for view in views for a in view.of_kind(ccode.Assignment) if isinstance(a.left, ccode.Member))
    return {str(a.left.name) for a in assigned if isinstance(a.left, ccode.Member) and is_pointer(a.right)}


def is_pointer(value: ccode.Expression | None) -> bool:
    """Whether a value is a pointer: a string literal, a function, or an expression of pointer type."""
    if isinstance(value, ccode.StringLiteral) or (
        isinstance(value, ccode.NameReference) and isinstance(value.target, ccode.Function)
    ):
        return True
    kind = type_of(value, {})
    return kind is not None and (kind.depth > 0 or kind.function)


def listed_values(name: str, views: Iterable[CodeView]) -> list[ccode.Expression]:
    """The longest initializer list of a variable of the type."""
    variables = (v for view in views for v in view.of_kind(ccode.Variable) if isinstance(v.initializer, ccode.InitializerList))
    kinds = [(v.valueType, v.initializer) for v in variables if v.valueType is not None]
    lists = [
        list(value.elements)
        for kind, value in kinds
        if isinstance(value, ccode.InitializerList)
        and kind.declaration is not None
        and kind.declaration.name == name
        and not kind.arrayDims
    ]
    return max(lists, key=len, default=[])


def is_computed(name: str, views: Iterable[CodeView]) -> bool:
    """Whether a value of the type is used in arithmetic or is assigned a number."""
    for view in views:
        variables: tuple[ccode.Variable | ccode.Parameter, ...] = (
            *view.of_kind(ccode.Variable),
            *view.of_kind(ccode.Parameter),
        )
        for variable in variables:
            use = variable.valueType
            if use is None or use.declaration is None or use.declaration.name != name or use.pointerDepth or use.arrayDims:
                continue
            if isinstance(variable, ccode.Variable) and isinstance(variable.initializer, (ccode.IntegerLiteral, ccode.Binary)):
                return True
            if any(_calculates(r) for r in variable.references):
                return True
    return False


def _calculates(reference: ccode.NameReference) -> bool:
    container = reference.eContainer()
    if isinstance(container, ccode.Assignment):
        return isinstance(container.right, (ccode.IntegerLiteral, ccode.Binary)) or container.operator != "="
    return isinstance(container, ccode.Binary) or (isinstance(container, ccode.Unary) and container.operator not in ("&", "*"))
