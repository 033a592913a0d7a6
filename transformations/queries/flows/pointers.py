"""What the flows of values need to know about pointers: functions used as values, pointers into arrays."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import type_of
from robosmi.transformations.queries.names import named_type
from robosmi.transformations.queries.signature_text import split


def pointed_functions(
    views: Sequence[CodeView],
) -> tuple[list[tuple[ccode.NameReference, CodeView]], list[tuple[ccode.NameReference, CodeView]]]:
    """The uses of functions as values: of the platform's with pins, and of own ones with a parameter that may be a pin."""
    platform, own = [], []
    for view in views:
        for reference in view.of_kind(ccode.NameReference):
            target = reference.target
            if isinstance(target, ccode.Function) and target.definition:
                own += [(reference, view)] if any(_is_number(each) for each in target.parameters) else []
            elif isinstance(target, ccode.ExternalSymbol | ccode.Function | None) and not view.defined(str(reference.name)):
                name = str(reference.name)
                entry = view.resolve(name)
                header = entry.header if entry is not None else str(target.header or "") if target is not None else None
                facts = view.api.pins(name, header) if header is not None else None
                if facts is not None and facts.parameters:
                    platform.append((reference, view))
    return platform, own


def pinless_functions(views: Sequence[CodeView]) -> Iterator[str]:
    """The names of the platform's functions that are used as values and take no pin."""
    for view in views:
        for reference in view.of_kind(ccode.NameReference):
            target = reference.target
            if isinstance(target, ccode.ExternalSymbol) and not view.defined(name := str(reference.name)):
                entry = view.resolve(name)
                facts = view.api.pins(name, entry.header) if entry is not None else None
                if entry is not None and entry.callable and (facts is None or not facts.parameters):
                    yield name


def _is_number(parameter: ccode.Parameter) -> bool:
    """Whether a parameter may be a pin number: no pointer or array, as `void *` of a callback is."""
    use = parameter.valueType
    return use is None or not (use.pointerDepth or use.arrayDims)


def takes_number(call: ccode.Call, position: int) -> bool:
    """Whether a call through a pointer may pass a number at a position; True if the pointer's type says nothing."""
    called = call.calleeExpression
    while isinstance(called, ccode.Index) or (isinstance(called, ccode.Unary) and str(called.operator) == "*"):
        called = called.array if isinstance(called, ccode.Index) else called.operand
    kind = type_of(called, {})
    _, pointer, behind = kind.base.partition("(*") if kind is not None else ("", "", "")
    taken = split(behind.partition(")")[2].strip()[1:-1]) if pointer else []
    return position >= len(taken) or not set("*[") & set(taken[position])


def gives_access(expression: Element | None) -> bool:
    """Whether a called function can change a variable by this argument: an address, an array or a pointer."""
    if isinstance(expression, ccode.Unary):
        return str(expression.operator) == "&"
    use = named_type(expression)
    return use is not None and bool(use.arrayDims or use.pointerDepth)


def moved_pointer(expression: ccode.Binary) -> ccode.Expression | None:
    """The pointer or array that a sum or difference moves along, None where it computes a number."""
    if str(expression.operator) not in ("+", "-"):
        return None
    return next((side for side in (expression.left, expression.right) if gives_access(side)), None)
