"""Function types with an empty parameter list (`typedef int handler();`): unspecified parameters in C, none in C++.

If all functions that the program stores under such a type take the same parameters, the type is given them. Where they differ,
or nothing shows what the calls pass, `cpp_incompatibilities` reports it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.query import all_of_kind, ancestor_of_kind
from robosmi.transformations.m2m.language.text_change import Change
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import FunctionType, type_of
from robosmi.transformations.queries.initialisers import members_given, record_of
from robosmi.transformations.queries.macros.tokens import name_tokens
from robosmi.transformations.queries.programs.unprototyped_functions import parameters_of

_EMPTY = re.compile(rb"\(\s*\)\s*\Z")


class EmptyType(Struct, frozen=True):
    """A function type with an empty parameter list.

    Attributes:
        typedef: its definition.
        parameters: the parameter list of all functions stored under the type; None if they differ or none is known.
    """

    typedef: ccode.Typedef
    parameters: str | None


def empty_types(view: CodeView, data: bytes) -> Iterator[EmptyType]:
    """The types of a unit that need a parameter list in C++."""
    empty = [d for d in view.of_kind(ccode.Typedef) if d.name and _EMPTY.search(data[d.startOffset : d.endOffset])]
    if not empty:
        return
    units = view.program.units
    kept: dict[str, list[ccode.Function]] = {}
    for unit in units:
        for function in (d for d in unit.declarations if isinstance(d, ccode.Function)):
            for reference in function.references:
                for word in _words_of_place(reference):
                    kept.setdefault(word, []).append(function)
    called = {
        word for unit in units for call in all_of_kind(unit, ccode.Call) if call.arguments
        if (kind := type_of(call.calleeExpression, {})) is not None for word in _words(kind.spelling)
    }  # fmt: skip
    for typedef in empty:
        taken = {parameters_of(function)[1] for function in kept.get(str(typedef.name), ())}
        if taken - {""} or (typedef.name in called and not taken):
            yield EmptyType(typedef, next(iter(taken)) if len(taken) == 1 else None)


def explicit_parameters(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Find the types that can be given a parameter list."""
    for found in empty_types(view, data):
        if found.parameters:
            yield Change(found.typedef, "empty-parentheses", found.parameters, "in C++ an empty list means no parameters")


def _words(spelling: str) -> set[str]:
    return {name for _, _, name in name_tokens(spelling.encode())}


def _words_of_place(reference: ccode.NameReference) -> set[str]:
    """The type names in the type of the place that a function's address is stored in or passed to."""
    value: ccode.Expression = reference
    place = reference.eContainer()
    while isinstance(place, (ccode.Unary, ccode.ConditionalExpression)):
        value, place = place, place.eContainer()
    if isinstance(place, ccode.InitializerList) or isinstance(place and place.eContainer(), ccode.InitializerList):
        return _words_in_list(value)
    if isinstance(place, ccode.Variable):
        return _words_of_type(place.valueType)
    if isinstance(place, ccode.Assignment) and value is place.right:
        kind = type_of(place.left, {})
        return _words(kind.spelling) if kind is not None else set()
    if isinstance(place, ccode.Return):
        function = ancestor_of_kind(place, ccode.Function)
        return _words_of_type(function.returnType) if function is not None else set()
    if isinstance(place, ccode.Call) and place.callee is not None and value in place.arguments:
        number = list(place.arguments).index(value)
        taken = list(place.callee.parameters)
        return _words_of_type(taken[number].valueType) if number < len(taken) else set()
    return set()


def _words_in_list(value: ccode.Expression) -> set[str]:
    """The type names in the type of the array element or member that a value of an initializer list is for."""
    variable, given = ancestor_of_kind(value, ccode.Variable), value
    while isinstance(around := given.eContainer(), ccode.Expression):
        given = around
    if variable is None or given is not variable.initializer or not isinstance(given, ccode.InitializerList):
        return set()
    if record_of(variable.valueType) is None:
        return _words_of_type(variable.valueType)
    members = (member for member, each in members_given(variable.valueType, given) if each is value)
    return set().union(*(_words_of_type(member.valueType) for member in members))


def _words_of_type(use: ccode.TypeUse | None) -> set[str]:
    return _words(str(use.spelling or "")) if use is not None else set()
