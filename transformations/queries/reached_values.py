"""Upper bounds: all values that an expression may have at run time, also of names that the text gives several values.

`values` finds the one value that a name has. Here all values count that are assigned to it, and if it is stepped (`pin++`, `pin
+= 2`, a recursive call with `pin + 1`) all numbers up to those that it is compared with. Values from outside stay unknown.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.transformations.queries.values import LIMIT, RUNTIME, Value, Values, passed_arguments

_UP = {"<": -1, "<=": 0, ">": 0, ">=": -1, "!=": -1, "==": 0}
"""Comparison of a rising number with a bound -> how far above the bound the number may get."""
_DOWN = {">": 1, ">=": 0, "<": 0, "<=": 1, "!=": 1, "==": 0}
"""Comparison of a falling number with a bound -> how far above the bound the number may end."""


class ReachedValues(Values):
    """Computes all values that expressions of one program may have."""

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
        numbers = [value.number for value in found]
        known = [number for number in numbers if number is not None]
        return self._stepped(target, known, steps) if known and len(known) == len(numbers) else [RUNTIME]

    def _step_of(self, expression: ccode.Expression | None, operator: str) -> int | None:
        """The step of a compound assignment, negative for `-=`; None where the text does not give it."""
        values = self.of(expression)
        number = values[0].number if len(values) == 1 else None
        return None if number is None or operator not in ("+=", "-=") else number if operator == "+=" else -number

    def _stepped(self, target: ccode.Declaration, first: list[int], steps: list[int | None]) -> list[Value]:
        """All numbers between the initial ones and those that a stepped name is compared with; unknown if nothing bounds it."""
        if None in steps:
            return [RUNTIME]
        low, high = min(first), max(first)
        bounds = list(self.bounds(target))
        if any(step is not None and step > 0 for step in steps):
            tops = [number + _UP[operator] for operator, number, _ in bounds]
            if not tops:
                return [RUNTIME]
            high = max(high, *tops)
        if any(step is not None and step < 0 for step in steps):
            bottoms = [number + _DOWN[operator] - behind for operator, number, behind in bounds]
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
            if isinstance(parent, ccode.Unary) and str(parent.operator) in ("++", "--"):
                side, parent = parent, parent.eContainer()
                behind = int(side.startOffset == reference.startOffset)
            if not isinstance(parent, ccode.Binary) or str(parent.operator) not in _UP:
                continue
            first = parent.left is side
            operator = str(parent.operator) if first else _TURNED[str(parent.operator)]
            for value in self.of(parent.right if first else parent.left):
                if value.number is not None:
                    yield operator, value.number, behind


_TURNED = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "!=": "!=", "==": "=="}


def _own_step(expression: Element | None, target: ccode.Declaration) -> tuple[str, ccode.Expression | None] | None:
    """Operator and step if a name is given an expression of itself, such as `pin + 1`; None for any other expression."""
    if not isinstance(expression, ccode.Binary) or str(expression.operator) not in ("+", "-"):
        return None
    left = expression.left
    return (
        (str(expression.operator), expression.right) if isinstance(left, ccode.NameReference) and left.target is target else None
    )
