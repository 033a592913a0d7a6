"""Upper bounds: all values that an expression may have at run time, also of names that the text gives several values.

`values` finds the one value that a name has. Here all values count that are assigned to it, and if it is stepped (`pin++`, `pin
+= 2`, a recursive call with `pin + 1`) all numbers up to those that it is compared with, and one step further where it is
used after a step and before it is compared again. Values from outside stay unknown.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
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
        if is_stepped:
            return found
        return self._guarded(reference, "beyond", lambda each: self._beyond(each, found), tuple(found))

    def _beyond(self, reference: ccode.NameReference, found: list[Value]) -> list[Value]:
        """The values of a name where it is used: perhaps one step beyond what it is compared with."""
        target = reference.target
        if not isinstance(target, (ccode.Variable, ccode.Parameter)) or id(target) not in self.stepped or RUNTIME in found:
            return found
        if isinstance(target, ccode.Variable) and self._counter(reference, target) is not None:
            return found
        known = [value.number for value in found if value.number is not None]
        for rising in (True, False):
            paths = Paths(target, reference, rising, self._is_known)
            sizes = [size for step, size in self._steps(target) if size and (size > 0) == rising and paths.uncompared(step)]
            if sizes:
                found = [*found, *self._stepped(target, known, sizes, sum(sizes))]
        return list(dict.fromkeys(found))

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
            elif (isinstance(container, ccode.Unary) and str(container.operator) == "&") or self._written.is_referred(reference):
                return [RUNTIME]
        own = [_own_step(expression, target) for expression in given]
        steps += [self._step_of(step[1], f"{step[0]}=") for step in own if step is not None]
        found = [value for expression, step in zip(given, own, strict=True) if step is None for value in self.of(expression)]
        if not steps:
            return found or [RUNTIME]
        self.stepped |= {id(target)}
        numbers = [value.number for value in found]
        known = [number for number in numbers if number is not None]
        if (
            not known
            or len(known) < len(numbers)
            or any(
                Paths(target, used, size > 0, self._is_known).repeats(step)
                for step, size in self._steps(target)
                if size and (used := _used(step, target)) is not None
            )
        ):
            return [RUNTIME]
        return self._stepped(target, known, steps)

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

    def _is_known(self, expression: ccode.Expression | None) -> bool:
        return all(value.number is not None for value in self.of(expression))

    def _step_of(self, expression: ccode.Expression | None, operator: str) -> int | None:
        """The step of a compound assignment, negative for `-=`; None where the text does not give it."""
        values = self.of(expression)
        number = values[0].number if len(values) == 1 else None
        return None if number is None or operator not in ("+=", "-=") else number if operator == "+=" else -number

    def _stepped(self, target: ccode.Declaration, first: list[int], steps: Sequence[int | None], further: int = 0) -> list[Value]:
        """All numbers between the initial ones and those that a stepped name is compared with; unknown if nothing bounds it.

        Args:
            target: the name.
            first: its initial numbers.
            steps: by how much it is stepped.
            further: how far it gets beyond what it is compared with.
        """
        if None in steps:
            return [RUNTIME]
        low, high = min(first), max(first)
        bounds = list(self.bounds(target))
        if any(step is not None and step > 0 for step in steps):
            tops = [number + (_UP[operator] + further if operator != "==" else 0) for operator, number, _ in bounds]
            if not tops or max(tops) < low:  # nothing stops it
                return [RUNTIME]
            high = max(high, *tops)
        if any(step is not None and step < 0 for step in steps):
            bottoms = [
                number + (_DOWN[operator] + further if operator != "==" else 0) - behind for operator, number, behind in bounds
            ]
            if not bottoms or min(bottoms) > high:
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
        rising: whether the steps go up; comparisons stop one direction only.
        is_known: whether the text gives the values of an expression; only a comparison with known numbers ends steps.
    """

    def __init__(
        self,
        target: ccode.Declaration,
        use: ccode.NameReference,
        rising: bool,
        is_known: Callable[[ccode.Expression | None], bool],
    ) -> None:
        self._use, self._at = use, int(use.startOffset)
        self._function = ancestor_of_kind(use, ccode.Function)
        self._compared: list[ccode.NameReference] = []
        self._passed: list[int] = []
        """Where comparisons end the steps before the use."""
        for each in target.references:
            parent = each.eContainer()
            side = parent if isinstance(parent, ccode.Unary) else each
            outer = side.eContainer()
            if isinstance(outer, ccode.Binary) and str(outer.operator) in _UP:
                self._compared.append(each)
                operator = str(outer.operator) if outer.left is side else _TURNED[str(outer.operator)]
                holds = operator in (("<", "<=", "!=") if rising else (">", ">=", "!="))
                parts = _where_known(outer, holds, target)
                other = outer.right if outer.left is side else outer.left
                if any(start <= self._at < end for start, end in parts) and is_known(other):
                    self._passed.append(int(each.startOffset))
            elif _is_set(each, target):
                statement = parent.eContainer() if parent is not None else None
                block = statement.eContainer() if statement is not None else None
                if isinstance(block, (ccode.Block, ccode.For)) and self._is_around(block):
                    self._passed.append(int(each.startOffset))  # it is set whatever was before

    def _is_around(self, element: ccode.Located) -> bool:
        return bool(element.startOffset <= self._at < element.endOffset)

    def _free(self, *parts: tuple[int, int]) -> bool:
        """Whether nothing in these parts of the text ends the steps, and the name is not set there."""
        return not any(start <= at < end for start, end in parts for at in self._passed)

    def repeats(self, step: ccode.Expression) -> bool:
        """Whether a step, whose name is the use, may come again and again without a comparison that ends it."""
        if (function := self._function) is None:
            return False
        first, last = (int(function.startOffset), int(step.endOffset)), (int(step.endOffset), int(function.endOffset))
        if isinstance(step, ccode.Binary):
            return self._free(first)
        if any(self._free((int(step.endOffset), end), (start, int(step.endOffset))) for start, end in _rounds(step, function)):
            return True
        elsewhere = any(ancestor_of_kind(each, ccode.Function) is not function for each in self._compared)
        return not self._is_local() and not elsewhere and self._free(first, last)

    def uncompared(self, step: ccode.Expression) -> bool:
        """Whether the use may come after a step without a comparison between them that ends the steps before the use."""
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
        into, out = (int(self._function.startOffset), self._at), (begins, int(function.endOffset))
        if isinstance(step, ccode.Binary):  # it is passed to the parameter
            return self._free(into)
        if function is not self._function:
            return self._free(out, into)
        if begins <= self._at and self._free((begins, self._at)):
            return True
        rounds = [*_rounds(step, function)]
        rounds = [(start, end) for start, end in rounds if start <= self._at < end]
        if any(self._free((begins, end), (start, self._at)) for start, end in rounds):
            return True
        return not self._is_local() and self._free(out, into)

    def _is_local(self) -> bool:
        target = self._use.target
        return (
            isinstance(target, ccode.Variable)
            and target.storage is not ccode.Storage.staticStorage
            and (not isinstance(target.eContainer(), ccode.SourceUnit))
        )


def _where_known(comparison: ccode.Expression, holds: bool, target: ccode.Declaration) -> Iterator[tuple[int, int]]:
    """The parts of the text that run only after a comparison of a name with this result, or after the name is set."""
    inner, outer = comparison, comparison.eContainer()
    while isinstance(outer, (ccode.Unary, ccode.Binary)):
        operator = str(outer.operator)
        if operator == "!":
            holds = not holds
        elif isinstance(outer, ccode.Binary) and operator in ("&&", "||"):
            if holds != (operator == "&&"):
                return
            if outer.left is inner and outer.right is not None:
                yield _range(outer.right)
        elif not isinstance(outer, ccode.Binary) or operator != "," or outer.right is not inner:
            return
        inner, outer = outer, outer.eContainer()
    if isinstance(outer, ccode.ConditionalExpression) and outer.condition is inner:
        arm = outer.whenTrue if holds else outer.whenFalse
        yield from [_range(arm)] if arm is not None else []
    elif isinstance(outer, ccode.Loop) and outer.condition is inner:
        yield _range(outer) if holds else (int(outer.endOffset), _end_around(outer))
    elif isinstance(outer, ccode.If) and outer.condition is inner:
        branch, other = (outer.thenBranch, outer.elseBranch) if holds else (outer.elseBranch, outer.thenBranch)
        yield from _after_branches(outer, branch, other, target)


def _after_branches(
    choice: ccode.If, branch: ccode.Statement | None, other: ccode.Statement | None, target: ccode.Declaration
) -> Iterator[tuple[int, int]]:
    """A branch of an if, and the text that only it leads to, as the other one leaves or sets the name."""
    function = ancestor_of_kind(choice, ccode.Function)
    end = _last(branch)
    if branch is not None:
        yield _range(branch)
    if isinstance(end, ccode.Goto) and function is not None:
        yield from ((int(label.startOffset), int(choice.endOffset)) for label in _labels(function, end))
    leave = _last(other)
    parts = list(other.statements) if isinstance(other, ccode.Block) else [other]
    is_set = any(_is_set(r, target) and any(_statement(r) is part for part in parts) for r in target.references)
    if not is_set and not isinstance(leave, (ccode.Return, ccode.Break, ccode.Continue, ccode.Goto)):
        return
    around = choice.eContainer()
    after = (int(choice.endOffset), _end_around(choice))
    back = _labels(function, leave) if isinstance(leave, ccode.Goto) and function is not None else []
    if not any(after[0] <= label.startOffset < after[1] for label in back):
        yield after
    loop = around if isinstance(around, ccode.Loop) else around.eContainer() if around is not None else None
    if isinstance(loop, ccode.Loop) and (is_set or isinstance(leave, (ccode.Return, ccode.Break))):
        yield _range(loop)
    if isinstance(loop, ccode.Function) and is_set:
        yield 0, sys.maxsize


def _range(element: ccode.Located) -> tuple[int, int]:
    return int(element.startOffset), int(element.endOffset)


def _end_around(statement: ccode.Statement) -> int:
    """Where the block ends that contains a statement."""
    around = statement.eContainer()
    return int(around.endOffset) if isinstance(around, ccode.Located) else int(statement.endOffset)


def _last(statement: ccode.Statement | None) -> ccode.Statement | None:
    """The statement with which a branch ends."""
    return statement.statements[-1] if isinstance(statement, ccode.Block) and statement.statements else statement


def _labels(function: ccode.Function, goto: ccode.Goto) -> list[ccode.Label]:
    return [label for label in all_of_kind(function, ccode.Label) if label.name == goto.labelName]


def _is_in(element: ccode.Located, part: ccode.Located) -> bool:
    return bool(element.startOffset <= part.startOffset < element.endOffset)


def _is_set(reference: ccode.NameReference, target: ccode.Declaration) -> bool:
    """Whether a name is assigned a value that is not a step from its own."""
    outer = reference.eContainer()
    if not isinstance(outer, ccode.Assignment) or outer.left is not reference:
        return False
    return str(outer.operator) == "=" and _own_step(outer.right, target) is None


def _statement(reference: ccode.NameReference) -> Element | None:
    """The statement that sets a name and does nothing else."""
    outer = reference.eContainer()
    return outer.eContainer() if outer is not None else None


def _used(step: ccode.Expression, target: ccode.Declaration) -> ccode.NameReference | None:
    """The name in a step."""
    return next((each for each in target.references if isinstance(each, ccode.NameReference) and _is_in(step, each)), None)


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
