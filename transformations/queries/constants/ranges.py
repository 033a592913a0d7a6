"""Value ranges of a program's expressions, as far as the text bounds them: constants, counters, remainders, masks.

A range bounds the values that the program itself gives (`given`), or only those that a type can hold. Values that come from
outside (a sensor, the user, an unknown function) have no range. `numbers` tells what machines make of them.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.transformations.queries.constants.declared_uses import DeclaredUses
from robosmi.transformations.queries.expression_type import of_use
from robosmi.transformations.queries.macros.constant_text import calculate
from robosmi.transformations.queries.numbers import COMPARISONS, Numbers
from robosmi.transformations.queries.values import Values, calls_of_value, passed_arguments

MAX_DEPTH = 40
"""Depth of names and operators to which the values of an expression are followed."""


class Range(NamedTuple):
    """The least and the greatest value, and whether the program's text gives both (`given`) or only a type bounds them."""

    low: int
    high: int
    given: bool = True

    @property
    def single(self) -> bool:
        """Whether the range is a single value."""
        return self.low == self.high

    def within(self, low: int, high: int) -> bool:
        """Whether the range lies between these bounds, inclusive."""
        return low <= self.low and self.high <= high


class Ranges:
    """Computes the ranges of expressions in a program.

    Args:
        numbers: the types of the program's expressions on its own machine.
        values: the values of the program's macros.
        program: the program.
        results: name of a function that the program does not define -> the least and the greatest value that it returns.
        wrapping: variables that take all values of their type, by `id`.
        uses: the uses of the program's variables, where `wrapping` has members.
        of_bits: macros that write a bit of their first argument.
    """

    def __init__(
        self, numbers: Numbers, values: Values, program: ccode.Program,
        results: Mapping[str, tuple[int, int]] = MappingProxyType({}), wrapping: Collection[int] = (),
        uses: DeclaredUses | None = None, of_bits: Collection[str] = (),
    ) -> None:  # fmt: skip
        self.numbers = numbers
        self._results, self._wrapping, self._uses, self._of_bits = results, wrapping, uses, of_bits
        declared = Counter(d.name for u in program.units for d in u.declarations)
        self._shared = {n for n, count in declared.items() if count > 1} | {e.name for e in program.externals}
        self.values = values
        self._known: dict[int, Range | None] = {}
        self._depth = 0

    def of(self, expression: ccode.Expression | None) -> Range | None:
        """The range of an expression, None where the text does not say it."""
        key = id(expression)
        if key not in self._known:
            self._known[key] = None  # where it depends on itself
            if self._depth >= MAX_DEPTH:
                return None
            self._depth += 1
            try:
                self._known[key] = self._rule(expression)
            finally:
                self._depth -= 1
        return self._known[key]

    def _rule(self, expression: ccode.Expression | None) -> Range | None:
        rule = _RULES.get(type(expression).__name__)
        found = rule(self, expression) if rule is not None else None
        if found is not None:
            return found
        number = self.numbers.of(expression)
        narrow = number is not None and not number.real and number.bits < self.numbers.machine.int_bits
        return Range(number.least, number.most, given=False) if narrow and number is not None else None

    def _binary(self, binary: ccode.Binary) -> Range | None:
        operator = str(binary.operator)
        if operator in COMPARISONS or operator in ("&&", "||"):
            return Range(0, 1)
        left, right = self.of(binary.left), self.of(binary.right)
        if operator == "%" and right is not None and right.single and right.low > 0:
            low = 0 if left is not None and left.low >= 0 else 1 - right.low
            whole = left is not None and left.low >= 0 and left.high < right.low
            return left if whole else Range(low, right.low - 1)
        if operator == "&" and (mask := _mask(left, right)) is not None:
            return Range(0, mask)
        if left is None or right is None:
            return None
        given = left.given and right.given
        if operator in ("+", "-", "*", "<<", ">>") or (operator == "/" and right.single) or (left.single and right.single):
            ends = [calculate(operator, a, b) for a in (left.low, left.high) for b in (right.low, right.high)]
            known = [x for x in ends if x is not None]
            return Range(min(known), max(known), given) if len(known) == 4 else None
        if operator in ("|", "^") and left.low >= 0 and right.low >= 0:
            return Range(0, (1 << max(left.high, right.high).bit_length()) - 1, given)
        return None

    def _unary(self, unary: ccode.Unary) -> Range | None:
        operand, operator = self.of(unary.operand), str(unary.operator)
        if operator == "!":
            return Range(0, 1)
        if operator == "*":
            return self._pointed(unary.operand)
        if operand is None or operator not in ("+", "-", "~"):
            return None
        if operator == "+":
            return operand
        less = int(operator == "~")
        return Range(-operand.high - less, -operand.low - less, operand.given)

    def _conditional(self, choice: ccode.ConditionalExpression) -> Range | None:
        return _union([self.of(choice.whenTrue), self.of(choice.whenFalse)])

    def _cast(self, cast: ccode.Cast) -> Range | None:
        inner, number = self.of(cast.operand), self.numbers.of(cast)
        if number is None or number.real or inner is None:
            return None
        return inner if inner.within(number.least, number.most) else None

    def _name(self, reference: ccode.NameReference) -> Range | None:
        target = reference.target
        if isinstance(target, ccode.EnumerationLiteral):
            return Range(int(target.value), int(target.value))
        if isinstance(target, (ccode.Variable, ccode.Parameter)):
            key = id(target)
            if key not in self._known:
                self._known[key] = None
                self._known[key] = self._variable(target) or (self._pointed(reference) if _refers(target) else None)
            return self._known[key]
        if target is None and reference.name in self.values.macros:
            known = self.values.of(reference)
            number = known[0].number if len(known) == 1 else None
            return Range(number, number) if number is not None else None
        return None

    def _variable(self, variable: ccode.Variable | ccode.Parameter) -> Range | None:
        """The union of the ranges of all values that a variable is given; None where something unknown may write it."""
        use = variable.valueType
        if use is None or use.arrayDims or use.pointerDepth:
            return None
        number = self.numbers.declared(use)
        if number is None or number.real:
            return None
        if id(variable) in self._wrapping:
            return Range(number.least, number.most)
        found: list[Range | None] = []
        if isinstance(variable, ccode.Parameter):
            arguments = _all_arguments(variable)
            if not arguments:
                return None
            found += [self.of(a) for a in arguments]
        elif variable.initializer is not None:
            found.append(self.of(variable.initializer))
        elif isinstance(variable.eContainer(), ccode.SourceUnit):
            found.append(Range(0, 0))
        if self._seen_elsewhere(variable):
            return None
        for reference in variable.references:
            parent: Element | None = reference.eContainer()
            if isinstance(parent, ccode.Assignment) and parent.left is reference:
                found.append(self.of(parent.right) if parent.operator == "=" else None)
            elif isinstance(parent, ccode.Unary) and parent.operator in ("++", "--", "&"):
                found.append(self._counted(parent, variable))
            elif isinstance(parent, ccode.Call) and self._is_written_by(parent, reference):
                found.append(None)
            if found and found[-1] is None:
                return None
        return _union(found)

    def _pointed(self, expression: ccode.Expression | None) -> Range | None:
        """The range of a member, an element, or what a pointer points to: that of its type if it takes all values."""
        holders = self._uses.holders(expression) if self._uses is not None else []
        if not holders or any(id(each) not in self._wrapping for each in holders):
            return None
        kinds = [of_use(each.valueType) for each in holders]
        numbers = [self.numbers.machine.number(kind.base.rstrip("& ")) if kind is not None else None for kind in kinds]
        return _union([Range(n.least, n.most) if n is not None and not n.real else None for n in numbers])

    def _call(self, call: ccode.Call) -> Range | None:
        """What a function of the platform returns, or one that limits or scales its first argument."""
        name, arguments = str(call.calleeName), list(call.arguments)
        if call.callee is not None and call.callee.definition:
            return None
        if name == "constrain" and len(arguments) == 3:
            return _union([self.of(each) for each in arguments[1:]])
        if name == "map" and len(arguments) == 5:
            value, *ends = (self.of(each) for each in arguments)
            start, shown = _union(ends[:2]), _union(ends[2:])
            return shown if value is not None and start is not None and value.within(start.low, start.high) else None
        if name == "bit" and len(arguments) == 1 and (place := self.of(arguments[0])) is not None:
            return Range(1 << place.low, 1 << place.high) if place.within(0, 31) else None
        if name == "random" and arguments and (end := self.of(arguments[-1])) is not None:
            start = self.of(arguments[0]) if len(arguments) > 1 else Range(0, 0)
            return Range(start.low, max(start.low, end.high - 1)) if start is not None else None
        if self.numbers.joins_operands(call) and (joined := self._of_operands(call)) is not None:
            return joined
        found = self._results.get(name)
        return Range(*found) if found is not None else None

    def _of_operands(self, call: ccode.Call) -> Range | None:
        """What a macro makes of its arguments, as they are in the type that they have together."""
        number, name = self.numbers.of(call), str(call.calleeName)
        ranges = [self.of(each) for each in call.arguments]
        if number is None or number.real or None in ranges:
            return None
        whole = Range(number.least, number.most)
        first, *others = (each if each.within(number.least, number.most) else whole for each in ranges if each is not None)
        if name == "abs" and first.low < 0:
            return Range(0, min(max(-first.low, first.high), number.most), first.given)
        if name == "sq":
            ends = (first.low * first.low, first.high * first.high)
            return Range(0 if first.low < 0 < first.high else min(ends), max(ends), first.given)
        if name in ("min", "max") and others:
            choose = min if name == "min" else max
            return Range(choose(first.low, others[0].low), choose(first.high, others[0].high), first.given and others[0].given)
        return first if name == "abs" else None

    def _assigned(self, assignment: ccode.Assignment) -> Range | None:
        return self.of(assignment.right) if assignment.operator == "=" else None

    def _seen_elsewhere(self, variable: ccode.Variable | ccode.Parameter) -> bool:
        """Whether another file may write a variable, through a declaration of its own."""
        if not isinstance(variable, ccode.Variable) or not isinstance(variable.eContainer(), ccode.SourceUnit):
            return False
        if variable.storage is ccode.Storage.staticStorage:
            return False
        return variable.storage is ccode.Storage.externStorage or variable.name in self._shared

    def _is_written_by(self, call: ccode.Call, reference: ccode.NameReference) -> bool:
        """Whether a call may write an argument: a macro that sets a bit, or a function of the program that takes a reference."""
        if call.calleeName in self._of_bits:
            return bool(call.arguments) and call.arguments[0] is reference
        takes = zip(call.arguments, call.callee.parameters, strict=False) if call.callee is not None else ()
        return any(given is reference and "&" in str(p.valueType.spelling) for given, p in takes if p.valueType is not None)

    def _counted(self, step: ccode.Unary, variable: ccode.Declaration) -> Range | None:
        """The range of a for loop's counter, up to the bound of its condition; None for any other `++`, `--` or `&`."""
        loop = step.eContainer()
        up = step.operator == "++"
        if not isinstance(loop, ccode.For) or loop.step is not step:
            return None
        condition = loop.condition
        if not isinstance(condition, ccode.Binary):
            return None
        counter = condition.left
        if not isinstance(counter, ccode.NameReference) or counter.target is not variable:
            return None
        operator, bound = str(condition.operator), self.of(condition.right)
        if bound is None or not bound.given or operator not in (("<", "<=", "!=") if up else (">", ">=", "!=")):
            return None
        past = int(operator in ("<=", ">="))
        return Range(bound.low, bound.high + past) if up else Range(bound.low - past, bound.high)

    def _index(self, index: ccode.Index) -> Range | None:
        """The range of all elements of an array that is given known values alone."""
        array = index.array
        if (wrapping := self._pointed(array)) is not None:
            return wrapping
        target = array.target if isinstance(array, ccode.NameReference) else None
        if not isinstance(target, ccode.Variable) or target.valueType is None or not target.valueType.arrayDims:
            return None
        if target.initializer is not None and not isinstance(target.initializer, ccode.InitializerList):
            return None
        key = id(target.valueType)  # one range for all elements
        if key not in self._known:
            self._known[key] = None
            self._known[key] = self._elements(target)
        return self._known[key]

    def _elements(self, target: ccode.Variable) -> Range | None:
        if self._seen_elsewhere(target):
            return None
        values = target.initializer
        elements = [self.of(each) for each in values.elements] if isinstance(values, ccode.InitializerList) else []
        for reference in target.references:
            use = reference.eContainer()
            if not (isinstance(use, ccode.Index) and use.array is reference) and not isinstance(use, ccode.SizeOf):
                return None
            outer = use.eContainer()
            while isinstance(outer, ccode.Index) and outer.array is use:
                use, outer = outer, outer.eContainer()
            if isinstance(outer, ccode.Assignment) and outer.left is use:
                elements.append(self.of(outer.right) if outer.operator == "=" else None)
            elif isinstance(outer, ccode.Unary) and outer.operator in ("++", "--", "&"):
                return None
        return _union([*elements, Range(0, 0)]) if elements and None not in elements else None


def _all_arguments(parameter: ccode.Parameter) -> list[ccode.Expression]:
    """The arguments that all callers pass for a parameter, through pointers, too; none where somebody unknown may call."""
    function = parameter.eContainer()
    if isinstance(function, ccode.Lambda):
        return passed_arguments(parameter)
    if not isinstance(function, ccode.Function):
        return []
    pointed = [calls_of_value(reference) for reference in function.references]
    calls = [*function.calls, *(call for some in pointed for call in some or ())]
    position = list(function.parameters).index(parameter)
    found = [call.arguments[position] for call in calls if position < len(call.arguments)]
    return found if None not in pointed and len(found) == len(calls) else []


def _mask(left: Range | None, right: Range | None) -> int | None:
    masks = [x.low for x in (left, right) if x is not None and x.single and x.low >= 0]
    return min(masks) if masks else None


def _union(ranges: Sequence[Range | None]) -> Range | None:
    known = [r for r in ranges if r is not None]
    if not known or len(known) < len(ranges):
        return None
    return Range(min(r.low for r in known), max(r.high for r in known), all(r.given for r in known))


def _refers(target: ccode.Variable | ccode.Parameter) -> bool:
    return target.valueType is not None and "&" in str(target.valueType.spelling)


def _constant(_: Ranges, literal: ccode.IntegerLiteral) -> Range:
    return Range(int(literal.value), int(literal.value))


_RULES: dict[str, Callable[[Ranges, Any], Range | None]] = {
    "IntegerLiteral": _constant,
    "CharacterLiteral": _constant,
    "Binary": Ranges._binary,
    "Unary": Ranges._unary,
    "ConditionalExpression": Ranges._conditional,
    "Cast": Ranges._cast,
    "NameReference": Ranges._name,
    "Index": Ranges._index,
    "Assignment": Ranges._assigned,
    "Call": Ranges._call,
    "Member": Ranges._pointed,
}
