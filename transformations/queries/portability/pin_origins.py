"""Where a program writes the numbers of its pins: the literal, constant or macro that a pin's argument leads to.

An argument is followed through variables, arrays, parameters of functions and constructors, and members that these set. Limits: a
value that is calculated has no origin; members are told apart by their names alone.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.values import passed_arguments

_DEEPEST = 12


class PinOrigin(Struct, frozen=True):
    """A number, and the element of the program that has it."""

    number: int
    at: ccode.Located


class PinOrigins:
    """Follows the arguments of one program.

    Args:
        views: a view of each of its units.
    """

    def __init__(self, views: Sequence[CodeView]) -> None:
        self._views = views

    def of_calls(self, view: CodeView) -> Iterator[PinOrigin]:
        """Where the numbers of the pins that a unit's calls use are written, in any unit."""
        for function in view.called().values():
            facts = view.api.pins(function.name, function.header)
            for call in (*function.calls, *function.made) if facts is not None else ():
                for parameter in facts.parameters if facts is not None else ():
                    if parameter.position < len(call.arguments):
                        yield from self.of(call.arguments[parameter.position], view)

    def of(self, expression: Element | None, view: CodeView, depth: int = 0) -> Iterator[PinOrigin]:
        """Where the numbers that an expression may have are written."""
        if expression is None or depth > _DEEPEST:
            return
        if isinstance(expression, ccode.IntegerLiteral):
            yield PinOrigin(int(expression.value), expression)
        elif isinstance(expression, ccode.Cast):
            yield from self.of(expression.operand, view, depth + 1)
        elif isinstance(expression, ccode.InitializerList):
            for element in expression.elements:
                yield from self.of(element, view, depth + 1)
        elif isinstance(expression, ccode.Index):
            yield from self.of(expression.array, view, depth + 1)
        elif isinstance(expression, ccode.Member):
            yield from self._of_member(str(expression.name), view, depth)
        elif isinstance(expression, ccode.NameReference):
            yield from self._of_name(expression, view, depth)

    def is_result_of(self, expression: Element | None, view: CodeView, function: str, depth: int = 0) -> bool:
        """Whether a value comes from a call of a function, directly or through a variable, a member or a parameter."""
        if expression is None or depth > _DEEPEST:
            return False
        if isinstance(expression, ccode.Call):
            return expression.calleeName == function
        given: list[Element | None] = []
        target = expression.target if isinstance(expression, ccode.NameReference) else None
        if isinstance(expression, ccode.NameReference) and target is None:
            macro = view.values.macros.get(str(expression.name))
            return macro is not None and re.search(rf"\b{function}\b", str(macro.body or "")) is not None
        if isinstance(expression, ccode.Member) or isinstance(target, ccode.Field):
            given += self._members.get(str(getattr(expression, "name", "")), ())
        elif isinstance(target, ccode.Variable):
            written = (each.eContainer() for each in target.references)
            given += [target.initializer, *(each.right for each in written if isinstance(each, ccode.Assignment))]
        elif isinstance(target, ccode.Parameter):
            given += [*passed_arguments(target), *self._constructed_with(target)]
        elif isinstance(expression, ccode.InitializerList):
            given += expression.elements
        else:
            given += [getattr(expression, "operand", None), getattr(expression, "array", None)]
        return any(self.is_result_of(each, view, function, depth + 1) for each in given)

    def _of_name(self, reference: ccode.NameReference, view: CodeView, depth: int) -> Iterator[PinOrigin]:
        target = reference.target
        macro = view.values.macros.get(str(reference.name)) if target is None else None
        if macro is not None:
            yield from (PinOrigin(value.number, macro) for value in view.values.of(reference) if value.number is not None)
        elif isinstance(target, ccode.EnumerationLiteral):
            yield PinOrigin(int(target.value), target)
        elif isinstance(target, ccode.Variable):
            yield from self.of(target.initializer, view, depth + 1)
        elif isinstance(target, ccode.Field):
            yield from self._of_member(str(target.name), view, depth)
        elif isinstance(target, ccode.Parameter):
            for argument in (*passed_arguments(target), *self._constructed_with(target)):
                yield from self.of(argument, view, depth + 1)

    def _of_member(self, name: str, view: CodeView, depth: int) -> Iterator[PinOrigin]:
        for value in self._members.get(name, ()):
            yield from self.of(value, view, depth + 1)

    def _constructed_with(self, parameter: ccode.Parameter) -> list[ccode.Expression]:
        """What the objects of a class are made with for a parameter of its constructor."""
        function = parameter.eContainer()
        if not isinstance(function, ccode.Function):
            return []
        place = list(function.parameters).index(parameter)
        made = self._constructions.get(str(function.name).rpartition("::")[2], ())
        return [arguments[place] for arguments in made if place < len(arguments)]

    @cached_property
    def _constructions(self) -> Mapping[str, list[list[ccode.Expression]]]:
        found: dict[str, list[list[ccode.Expression]]] = {}
        for view in self._views:
            for made in view.of_kind(ccode.ConstructorCall):
                found.setdefault(str(made.className), []).append(list(made.arguments))
        return found

    @cached_property
    def _members(self) -> Mapping[str, list[ccode.Expression]]:
        """Name of a member -> the values that the program gives it."""
        found: dict[str, list[ccode.Expression]] = {}
        for view in self._views:
            for field in view.of_kind(ccode.Field):
                if field.initializer is not None:
                    found.setdefault(str(field.name), []).append(field.initializer)
            for initial in view.of_kind(ccode.MemberInitializer):
                found.setdefault(str(initial.name), []).extend(initial.arguments)
            for assignment in view.of_kind(ccode.Assignment):
                left = assignment.left
                if assignment.operator == "=" and assignment.right is not None and _is_member(left):
                    found.setdefault(str(left.name), []).append(assignment.right)  # type: ignore[union-attr]
        return found


def _is_member(left: ccode.Expression | None) -> bool:
    return isinstance(left, ccode.Member) or (isinstance(left, ccode.NameReference) and isinstance(left.target, ccode.Field))
