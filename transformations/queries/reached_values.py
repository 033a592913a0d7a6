"""Upper bounds: all values that an expression may have at run time, also of names that the text gives several values.

`values` finds the one value that a name has. Here all values count that are assigned to it, and if it is stepped (`pin++`, `pin
+= 2`, a recursive call with `pin + 1`) all numbers up to those that it is compared with, and one step further where it is
used after a step and before it is compared again. Values from outside stay unknown.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TypeGuard

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import all_of_kind, ancestor_of_kind
from robosmi.transformations.queries.values import LIMIT, RUNTIME, Value, Values, passed_arguments

_UP = {"<": -1, "<=": 0, ">": 0, ">=": -1, "!=": -1, "==": 0}
"""Comparison of a rising number with a bound -> how far above the bound the number may get."""
_DOWN = {">": 1, ">=": 0, "<": 0, "<=": 1, "!=": 1, "==": 0}
"""Comparison of a falling number with a bound -> how far above the bound the number may end."""


class ReachedValues(Values):
    """Computes all values that expressions of one program may have.

    Attributes:
        stepped: the variables and parameters, by `id`, that were found to be stepped.
    """

    stepped: frozenset[int] = frozenset()

    def passed(self, argument: Element | None) -> list[Value]:
        """The values of an argument, of a step that stands there (`high(++pin)`) those that its name has then."""
        if isinstance(argument, ccode.Assignment):
            argument = argument.left
        elif _is_increment(argument):
            argument = argument.operand
        found = self.of(argument)
        return self._beyond(argument, found) if isinstance(argument, ccode.NameReference) else found

    def _name(self, reference: ccode.NameReference) -> list[Value]:
        found = super()._name(reference)
        if id(reference.target) not in self.stepped:
            return found
        container = reference.eContainer()
        is_stepped = _is_increment(container) or (isinstance(container, ccode.Assignment) and container.left is reference)
        return found if is_stepped else self._beyond(reference, found)

    def _beyond(self, reference: ccode.NameReference, found: list[Value]) -> list[Value]:
        """The values of a name where it is used: perhaps one step beyond what it is compared with."""
        target = reference.target
        if not isinstance(target, (ccode.Variable, ccode.Parameter)) or id(target) not in self.stepped or RUNTIME in found:
            return found
        if isinstance(target, ccode.Variable) and self._counter(reference, target) is not None:
            return found
        paths = Paths(target, reference)
        for step, size in self._steps(target):
            if size and paths.uncompared(step):
                known = [value.number for value in found if value.number is not None]
                found = list(dict.fromkeys([*found, *self._stepped(target, known, [size], 1)]))
        return found

    def _counter(self, reference: ccode.NameReference, variable: ccode.Variable) -> list[Value] | None:
        found = super()._counter(reference, variable)
        return found if found is not None and RUNTIME not in found else None

    def _variable(self, variable: ccode.Variable) -> list[Value]:
        if variable.valueType is not None and variable.valueType.arrayDims:
            return [RUNTIME]
        return self._all_given(variable, [variable.initializer] if variable.initializer is not None else [])

    def _parameter(self, parameter: ccode.Parameter) -> list[Value]:
        function = parameter.eContainer()
        if isinstance(function, ccode.Function) and function.references:
            return [RUNTIME]  # who has the function as a value may pass anything
        return self._all_given(parameter, passed_arguments(parameter))

    def _all_given(self, target: ccode.Declaration, given: Sequence[Element | None]) -> list[Value]:
        """All values that a variable or parameter may have.

        Args:
            target: the variable or parameter.
            given: its initial value, or the arguments that callers pass.
        """
        steps: list[int | None] = []
        for reference in target.references:
            container = reference.eContainer()
            if isinstance(container, ccode.Assignment) and container.left is reference:
                operator = str(container.operator)
                if operator == "=":
                    given = [*given, container.right]
                else:
                    steps.append(self._step_of(container.right, operator))
            elif isinstance(container, ccode.Unary) and str(container.operator) in ("++", "--"):
                steps.append(1 if str(container.operator) == "++" else -1)
            elif isinstance(container, ccode.Unary) and str(container.operator) == "&":
                return [RUNTIME]
        own = [_own_step(expression, target) for expression in given]
        steps += [self._step_of(step[1], f"{step[0]}=") for step in own if step is not None]
        found = [value for expression, step in zip(given, own, strict=True) if step is None for value in self.of(expression)]
        if not steps:
            return found or [RUNTIME]
        self.stepped |= {id(target)}
        numbers = [value.number for value in found]
        known = [number for number in numbers if number is not None]
        return self._stepped(target, known, steps) if known and len(known) == len(numbers) else [RUNTIME]

    def _steps(self, target: ccode.Declaration) -> Iterator[tuple[ccode.Expression, int | None]]:
        """What steps a name, and by how much: `pin++`, `pin += 2`, `pin = pin + 2`, and `pin + 2` for a parameter of the call."""
        for reference in target.references:
            container = reference.eContainer()
            if isinstance(container, ccode.Assignment) and container.left is reference:
                own = _own_step(container.right, target)
                if own is not None:
                    yield container, self._step_of(own[1], f"{own[0]}=")
                elif str(container.operator) != "=":
                    yield container, self._step_of(container.right, str(container.operator))
            elif _is_increment(container):
                yield container, 1 if str(container.operator) == "++" else -1
        for argument in passed_arguments(target) if isinstance(target, ccode.Parameter) else ():
            if (own := _own_step(argument, target)) is not None:
                yield argument, self._step_of(own[1], f"{own[0]}=")

    def _step_of(self, expression: ccode.Expression | None, operator: str) -> int | None:
        """The step of a compound assignment, negative for `-=`; None where the text does not give it."""
        values = self.of(expression)
        number = values[0].number if len(values) == 1 else None
        return None if number is None or operator not in ("+=", "-=") else number if operator == "+=" else -number

    def _stepped(self, target: ccode.Declaration, first: list[int], steps: list[int | None], further: int = 0) -> list[Value]:
        """All numbers between the initial ones and those that a stepped name is compared with; unknown if nothing bounds it.

        Args:
            target: the name.
            first: its initial numbers.
            steps: by how much it is stepped.
            further: how many steps it goes beyond what it is compared with.
        """
        if None in steps:
            return [RUNTIME]
        low, high = min(first), max(first)
        bounds = list(self.bounds(target))
        if any(step is not None and step > 0 for step in steps):
            beyond = further * max(step or 0 for step in steps)
            tops = [number + (_UP[operator] + beyond if operator != "==" else 0) for operator, number, _ in bounds]
            if not tops:
                return [RUNTIME]
            high = max(high, *tops)
        if any(step is not None and step < 0 for step in steps):
            beyond = further * min(step or 0 for step in steps)
            bottoms = [
                number + (_DOWN[operator] + beyond if operator != "==" else 0) - behind for operator, number, behind in bounds
            ]
            if not bottoms:
                return [RUNTIME]
            low = min(low, *bottoms)
        return [Value(number, "constant") for number in range(low, high + 1)] if high - low < LIMIT else [RUNTIME]

    def bounds(self, target: ccode.Declaration) -> Iterator[tuple[str, int, int]]:
        """The comparisons of a name with known numbers: (operator, number, 1 if it is stepped afterwards else 0)."""
        for reference in target.references:
            side: ccode.Expression = reference
            parent = side.eContainer()
            behind = 0
            if _is_increment(parent):
                side, parent = parent, parent.eContainer()
                behind = int(side.startOffset == reference.startOffset)
            if not isinstance(parent, ccode.Binary) or str(parent.operator) not in _UP:
                continue
            first = parent.left is side
            operator = str(parent.operator) if first else _TURNED[str(parent.operator)]
            for value in self.of(parent.right if first else parent.left):
                if value.number is not None:
                    yield operator, value.number, behind


ReachedValues._methods = {**Values._methods, "NameReference": ReachedValues._name}


class Paths:
    """The ways from the steps of a name to one of its uses.

    Args:
        target: the name.
        use: the use.
    """

    def __init__(self, target: ccode.Declaration, use: ccode.NameReference) -> None:
        self._use, self._at = use, int(use.startOffset)
        self._function = ancestor_of_kind(use, ccode.Function)
        self._compared: list[int] = []
        self._again: list[int] = []
        for each in target.references:
            parent = each.eContainer()
            side = parent if isinstance(parent, ccode.Unary) else each
            outer = side.eContainer()
            if isinstance(outer, ccode.Binary) and str(outer.operator) in _UP:
                self._compared.append(int(each.startOffset))
            elif isinstance(parent, ccode.Assignment) and parent.left is each and _own_step(parent.right, target) is None:
                statement = parent.eContainer()
                block = statement.eContainer() if statement is not None else None
                if str(parent.operator) == "=" and isinstance(block, (ccode.Block, ccode.For)) and self._is_around(block):
                    self._again.append(int(each.startOffset))  # it is set whatever was before

    def _is_around(self, element: ccode.Located) -> bool:
        return bool(element.startOffset <= self._at < element.endOffset)

    def _free(self, *parts: tuple[int, int]) -> bool:
        """Whether the name is neither compared nor set in these parts of the text."""
        return not any(start <= at < end for start, end in parts for at in (*self._compared, *self._again))

    def uncompared(self, step: ccode.Expression) -> bool:
        """Whether the use may come after a step without a comparison between them."""
        function = ancestor_of_kind(step, ccode.Function)
        if function is None or self._function is None:
            return False
        outer = step.eContainer()
        after = (
            step.postfix
            if isinstance(step, ccode.Unary)
            else not isinstance(step, ccode.Assignment) or step.left is not self._use
        )
        begins = int(step.endOffset if after else step.startOffset)
        if isinstance(outer, ccode.For) and outer.step is step:
            begins = int(outer.endOffset)
        guarded = any(function.startOffset <= at < begins for at in self._compared)
        into, out = (int(self._function.startOffset), self._at), (begins, int(function.endOffset))
        if isinstance(step, ccode.Binary):  # it is passed to the parameter
            return guarded and self._free(into)
        if function is not self._function:
            return guarded and self._free(out, into)
        if begins <= self._at and self._free((begins, self._at)):
            return True
        rounds = [*_rounds(step, function)]
        rounds = [(start, end) for start, end in rounds if start <= self._at < end]
        if any(self._free((begins, end), (start, self._at)) for start, end in rounds):
            return True
        return guarded and not self._is_local() and self._free(out, into)

    def _is_local(self) -> bool:
        target = self._use.target
        return (
            isinstance(target, ccode.Variable)
            and target.storage is not ccode.Storage.staticStorage
            and (not isinstance(target.eContainer(), ccode.SourceUnit))
        )


def _rounds(element: ccode.Located, function: ccode.Function) -> Iterator[tuple[int, int]]:
    """Where the loops around an element begin and end, and the text from a label to a goto that leads back to it."""
    container = element.eContainer()
    while container is not None and container is not function:
        if isinstance(container, ccode.Loop):
            yield int(container.startOffset), int(container.endOffset)
        container = container.eContainer()
    labels = {str(label.name): int(label.startOffset) for label in all_of_kind(function, ccode.Label)}
    for goto in all_of_kind(function, ccode.Goto) if labels else ():
        if labels.get(str(goto.labelName), goto.endOffset) < goto.startOffset:
            yield labels[str(goto.labelName)], int(goto.endOffset)


_TURNED = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "!=": "!=", "==": "=="}


def _is_increment(element: Element | None) -> TypeGuard[ccode.Unary]:
    return isinstance(element, ccode.Unary) and str(element.operator) in ("++", "--")


def _own_step(expression: Element | None, target: ccode.Declaration) -> tuple[str, ccode.Expression | None] | None:
    """Operator and step if a name is given an expression of itself, such as `pin + 1`; None for any other expression."""
    if not isinstance(expression, ccode.Binary) or str(expression.operator) not in ("+", "-"):
        return None
    left = expression.left
    return (
        (str(expression.operator), expression.right) if isinstance(left, ccode.NameReference) and left.target is target else None
    )
