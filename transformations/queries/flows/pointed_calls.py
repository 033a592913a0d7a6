"""Which functions of a program each call through a pointer may reach: a points-to analysis, insensitive to control flow.

Functions are followed from where they are named through initial values, assignments, arguments and results to variables,
parameters and members; members are told apart by name only. A pointer with a source that is not followed may reach any function
that the program uses as a value and that has as many parameters as the call has arguments.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Sequence

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import ancestor_of_kind
from robosmi.transformations.queries.initialisers import members_given, record_of
from robosmi.transformations.queries.programs.live_code import identity
from robosmi.transformations.queries.values import calls_of_value, passed_arguments


def is_pointed(call: ccode.Call) -> bool:
    """Whether a call goes through a function pointer."""
    named = _named(call.calleeExpression)
    return call.calleeExpression is not None and not isinstance(named, (ccode.Function, ccode.ExternalSymbol))


def called_name(call: ccode.Call) -> str:
    """The name that a call is written with: of the function, or of the variable, array or member that holds a pointer to it."""
    called = call.calleeExpression
    while called is not None:
        if isinstance(called, (ccode.NameReference, ccode.Member)):
            return str(called.name)
        if isinstance(called, ccode.Index):
            called = called.array
        elif isinstance(called, (ccode.Cast, ccode.Unary)):
            called = called.operand
        else:
            break
    return str(call.calleeName or "a function pointer")


def _named(expression: ccode.Expression | None) -> ccode.Declaration | None:
    return expression.target if isinstance(expression, ccode.NameReference) else None


def pointed_calls(elements: Sequence[Element]) -> dict[int, list[ccode.Function]]:
    """The functions that each call through a pointer may reach, by the `id` of the call; empty where none is known.

    Args:
        elements: the reachable elements of the program.
    """
    calls = [each for each in elements if isinstance(each, ccode.Call) and is_pointed(each)]
    if not calls:
        return {}
    flows = _Flows(elements)
    return {id(call): flows.reached(call) for call in calls}


class _Flows:
    """Points-to sets: for each variable, parameter, member and result, the functions that may be stored in it."""

    def __init__(self, elements: Sequence[Element]) -> None:
        self._kept: dict[Hashable, list[ccode.Function]] = {}
        self._from: dict[Hashable, set[Hashable]] = {}
        self._all: list[ccode.Function] = []
        for element in elements:
            for place, value in _given(element):
                self._put(place, value)

    def _put(self, place: Hashable, value: ccode.Expression | None) -> None:
        for each in _values(value):
            function = _named(each)
            if isinstance(function, ccode.Function):
                self._kept.setdefault(place, []).append(function)
                self._all.append(function)
            elif not isinstance(each, (ccode.IntegerLiteral, ccode.StringLiteral)):
                self._from.setdefault(place, set()).add(_place(each))

    def reached(self, call: ccode.Call) -> list[ccode.Function]:
        """The functions with a body that a call through a pointer may reach."""
        found: list[ccode.Function] = []
        pending, seen = [_place(call.calleeExpression)], set[Hashable]()
        while pending:
            place = pending.pop()
            if place is None or (place not in self._kept and place not in self._from):
                found = self._all
                break
            if place not in seen:
                seen.add(place)
                found = [*found, *self._kept.get(place, ())]
                pending += self._from.get(place, ())
        fitting = {id(f): f for f in found if f.body is not None and len(f.parameters) == len(call.arguments)}
        return list(fitting.values())


def _given(element: Element) -> Iterator[tuple[Hashable, ccode.Expression | None]]:
    """The keys of the places that an element stores a value in, each with the value."""
    if isinstance(element, ccode.Variable) and element.initializer is not None:
        given = element.initializer
        if isinstance(given, ccode.InitializerList) and record_of(element.valueType) is not None:
            yield from ((_member(member), value) for member, value in members_given(element.valueType, given))
        else:
            yield identity(element), given
    elif isinstance(element, ccode.Assignment) and element.operator == "=":
        yield _place(element.left), element.right
    elif isinstance(element, ccode.Return):
        function = ancestor_of_kind(element, ccode.Function)
        if function is not None:
            yield ("value", str(function.name)), element.value
    elif isinstance(element, ccode.Call):
        taken = list(element.callee.parameters) if element.callee is not None else []
        for number, argument in enumerate(element.arguments):
            yield (id(taken[number]) if number < len(taken) else None), argument


def _values(value: ccode.Expression | None) -> Iterable[ccode.Expression]:
    """The expressions that a value may come from: branches and list elements, without casts and address operators."""
    if isinstance(value, ccode.InitializerList):
        return [each for element in value.elements for each in _values(element)]
    if isinstance(value, ccode.ConditionalExpression):
        return [*_values(value.whenTrue), *_values(value.whenFalse)]
    if isinstance(value, ccode.Cast):
        return _values(value.operand)
    if isinstance(value, ccode.Unary) and value.operator == "&" and isinstance(_named(value.operand), ccode.Function):
        return _values(value.operand)
    if isinstance(value, ccode.Assignment) and isinstance(value.eContainer(), ccode.InitializerList):
        return _values(value.right)
    return [value] if value is not None else []


def _place(expression: ccode.Expression | None) -> Hashable:
    """The key of the place that an expression denotes; None for one that is not followed."""
    if isinstance(expression, ccode.NameReference):
        target = expression.target
        if isinstance(target, ccode.Variable):
            return identity(target)
        return id(target) if isinstance(target, ccode.Parameter) else None
    if isinstance(expression, ccode.Index):
        return _place(expression.array)
    if isinstance(expression, ccode.Member):
        return ("member", str(expression.name))
    if isinstance(expression, (ccode.Cast, ccode.Unary)):
        return _place(expression.operand)
    if isinstance(expression, ccode.Call) and expression.callee is not None:
        return ("value", str(expression.callee.name))
    return None


def _member(member: ccode.Field) -> Hashable:
    return ("member", str(member.name))


def called_lambdas(call: ccode.Call) -> tuple[list[ccode.Lambda], bool]:
    """The lambdas that a call may run and whose calls are all known, and whether it runs nothing else.

    The variable or parameter that is called has them, or the call itself.
    """
    holder = _named(call.calleeExpression)
    given: list[ccode.Expression | None] = [call.calleeExpression] if isinstance(call.calleeExpression, ccode.Lambda) else []
    if isinstance(holder, ccode.Variable):
        given = [holder.initializer]
    elif isinstance(holder, ccode.Parameter):
        given = [*passed_arguments(holder)]
    found = []
    for each in given:
        made = each.object if isinstance(each, ccode.Member) else each  # its conversion to a pointer
        if isinstance(made, ccode.Lambda) and calls_of_value(made) is not None:
            found.append(made)
    return found, bool(found) and len(found) == len(given)
