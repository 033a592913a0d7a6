"""What a program does through pointers, as far as flows of values need it: functions taken as values, arrays walked through."""

from __future__ import annotations

from collections.abc import Sequence

from robosmi.metamodels import ccode
from robosmi.model.strict import Element
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.names import named_type


def pointed_functions(
    views: Sequence[CodeView],
) -> tuple[list[tuple[ccode.NameReference, CodeView]], list[tuple[ccode.NameReference, CodeView]]]:
    """The uses as a value of functions with pins: of the platform's, and of the program's own with any parameter."""
    platform, own = [], []
    for view in views:
        for reference in view.of_kind(ccode.NameReference):
            target = reference.target
            if isinstance(target, ccode.Function) and target.definition and len(target.parameters):
                own.append((reference, view))
            elif isinstance(target, ccode.ExternalSymbol | ccode.Function | None) and not view.defined(str(reference.name)):
                name = str(reference.name)
                entry = view.resolve(name)
                header = entry.header if entry is not None else str(target.header or "") if target is not None else None
                facts = view.api.pins(name, header) if header is not None else None
                if facts is not None and facts.parameters:
                    platform.append((reference, view))
    return platform, own


def gives_access(expression: Element | None) -> bool:
    """Whether who is given an expression may change what it stands for: an address, an array, a pointer."""
    if isinstance(expression, ccode.Unary):
        return str(expression.operator) == "&"
    use = named_type(expression)
    return use is not None and bool(use.arrayDims or use.pointerDepth)


def moved_pointer(expression: ccode.Binary) -> ccode.Expression | None:
    """The pointer or array that a sum or difference moves along, None where it computes a number."""
    if str(expression.operator) not in ("+", "-"):
        return None
    return next((side for side in (expression.left, expression.right) if gives_access(side)), None)
