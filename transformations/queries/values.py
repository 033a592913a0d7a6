"""Which values an expression of a program can have where the text decides it: constants, counters, arrays, parameters.

An abstract interpretation without execution: a name has a value when the text gives it one and never another. The value of a
parameter is looked up at the callers. A value that the text does not decide is None, with the origin `runtime`.

Names may be defined by each other. `BoundedWalk` evaluates them recursively and remembers the results; it decides in which order,
and when a name is given up as unknown: recursion and repetition are bounded.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Hashable, Mapping
from typing import Any, ClassVar, Generic, TypeVar

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import ancestor_of_kind
from robosmi.transformations.queries.macros.constant_text import calculate, macro_number
from robosmi.transformations.queries.macros.expansion import MacroTexts
from robosmi.transformations.queries.own_headers import included
from robosmi.transformations.queries.written_arrays import WrittenArrays

D = TypeVar("D", bound=Element)
LIMIT = 64
_SIGNED = frozenset({"<", ">", "<=", ">=", "/", "%", ">>"})
"""Operators whose result depends on whether their operands have a sign."""
BOOLEAN = frozenset({"bool", "_Bool"})
"""The type of truth values, 0 and 1, in C++ and C."""
PIN_BITS = 32
"""The width of a pin, in bits."""
_SIZE = re.compile(r"\[\s*(\d+)\s*\]")


class Value(Struct, frozen=True):
    """A number, None if only the running program knows it, and how the text gives it (literal, constant, array, runtime)."""

    number: int | None
    origin: str


RUNTIME = Value(None, "runtime")


class Values:
    """Computes the values of expressions in one program.

    Args:
        program: the program, for its callers and macros.
        unit: the unit whose macros take precedence.
        constants: constant of the platform -> its value on the board of the program.
        reads: (function of the platform, position) -> whether it surely only reads an array that it gets there.
    """

    _methods: ClassVar[Mapping[str, Callable[[Any, Any], list[Value]]]]
    """Kind of an expression -> how its values are computed."""

    def __init__(
        self,
        program: ccode.Program,
        unit: ccode.SourceUnit,
        constants: Mapping[str, int] | None = None,
        reads: Callable[[str, int], bool] | None = None,
    ) -> None:
        self._constants = constants or {}
        self.macros = {str(m.name): m for u in program.units for m in u.macros} | {str(m.name): m for m in unit.macros}
        self._own_macros = {str(m.name) for u in (unit, *included(unit)) for m in u.macros}
        """Macros of the unit and of the headers it includes; the parser may resolve their names to other declarations."""
        self._texts = MacroTexts(self.macros)
        self.names: dict[str, ccode.Declaration] = {}
        for declaration in (d for u in program.units for d in u.declarations):
            self.names.setdefault(str(declaration.name), declaration)
            if isinstance(declaration, ccode.Enumeration):
                self.names.update({str(literal.name): literal for literal in declaration.literals})
        self._walk = BoundedWalk([RUNTIME])
        self._written = WrittenArrays(reads)

    def of(self, expression: Element | None) -> list[Value]:
        """The values of an expression, in text order, each once."""
        method = self._methods.get(type(expression).__name__)
        return _distinct(self._walk.ask(lambda: method(self, expression))) if method else [RUNTIME]

    def _guarded(self, element: D, what: str, body: Callable[[D], list[Value]], *given: Hashable) -> list[Value]:
        """Evaluate an element unless it is being evaluated already; answers are remembered for each `given`."""
        guard = (what, id(element))
        return self._walk.name(guard, (guard, given), lambda: body(element))

    def _integer(self, literal: ccode.IntegerLiteral) -> list[Value]:
        return [Value(int(literal.value), "literal")]

    def _cast(self, cast: ccode.Cast) -> list[Value]:
        return _in_type(self.of(cast.operand), cast.target)

    def _unary(self, unary: ccode.Unary) -> list[Value]:
        change = _CHANGES.get(str(unary.operator))
        if change is None:
            return [RUNTIME]
        sign = str(unary.operator) in "+-"
        values = self.of(unary.operand)
        return [
            RUNTIME if v.number is None else Value(change(v.number), v.origin if sign or v.origin != "literal" else "constant")
            for v in values
        ]

    def _binary(self, binary: ccode.Binary) -> list[Value]:
        left, right = self.of(binary.left), self.of(binary.right)
        if len(left) * len(right) > LIMIT:
            return [RUNTIME]
        operator, found = str(binary.operator), []
        for a in left:
            for b in right:
                number = None if a.number is None or b.number is None else calculate(operator, a.number, b.number)
                if number is not None and operator in _SIGNED and min(a.number or 0, b.number or 0) < 0 and _unsigned(binary):
                    number = None
                origin = "array" if "array" in (a.origin, b.origin) else "constant"
                found.append(RUNTIME if number is None else Value(number, origin))
        return found

    def _name(self, reference: ccode.NameReference) -> list[Value]:
        target = reference.target
        if isinstance(target, ccode.EnumerationLiteral):
            return [Value(int(target.value), "constant")]
        if isinstance(target, ccode.Variable):
            counter = self._counter(reference, target)
            return counter if counter is not None else self._guarded(target, "variable", self._held)
        if isinstance(target, ccode.Parameter):
            return self._guarded(target, "parameter", self._held)
        if (target is None and str(reference.name) in self.macros) or str(reference.name) in self._own_macros:
            return self._macro(str(reference.name))
        return self._constant(str(reference.name))

    def _constant(self, name: str) -> list[Value]:
        """The value of a constant of the platform; unknown for any other name."""
        return [Value(self._constants[name], "constant") if name in self._constants else RUNTIME]

    def _variable(self, variable: ccode.Variable) -> list[Value]:
        """The value of a variable that the whole text gives exactly one value, else unknown."""
        if variable.valueType is not None and variable.valueType.arrayDims:
            return [RUNTIME]
        assigned: list[ccode.Expression | None] = [variable.initializer] if variable.initializer is not None else []
        for reference in variable.references:
            container = reference.eContainer()
            if isinstance(container, ccode.Assignment) and container.left is reference:
                if str(container.operator) != "=":
                    return [RUNTIME]
                assigned.append(container.right)
            elif _written(reference) or self._written.is_referred(reference):
                return [RUNTIME]
        if len(assigned) != 1:
            return [RUNTIME]
        return [v if v.origin in ("array", "runtime") else Value(v.number, "constant") for v in self.of(assigned[0])]

    def _held(self, target: ccode.Variable | ccode.Parameter) -> list[Value]:
        """The values of a variable or parameter, as its type holds them."""
        given = self._variable(target) if isinstance(target, ccode.Variable) else self._parameter(target)
        return _in_type(given, target.valueType)

    def _counter(self, reference: ccode.NameReference, variable: ccode.Variable) -> list[Value] | None:
        """The values of a variable that is the counter of a for loop around the reference; None if there is no such loop."""
        loop = ancestor_of_kind(reference, ccode.For)
        while loop is not None:
            start = _start(loop, variable)
            if start is not None and _in(loop, reference):
                return self._counted(loop, variable, start)
            loop = ancestor_of_kind(loop, ccode.For)
        return None

    def _counted(self, loop: ccode.For, variable: ccode.Variable, start: ccode.Expression) -> list[Value]:
        return self._guarded(loop, "loop", lambda found: self._count(found, variable, start), id(variable))

    def _count(self, loop: ccode.For, variable: ccode.Variable, start: ccode.Expression | None) -> list[Value]:
        step = self._step(loop.step, variable)
        condition = loop.condition
        if step is None or not isinstance(condition, ccode.Binary) or not _refers(condition.left, variable):
            return [RUNTIME]
        for reference in variable.references:
            if _written(reference) and _in(loop.body, reference):
                return [RUNTIME]
        first, bound = self.of(start), self.of(condition.right)
        if len(first) != 1 or len(bound) != 1 or first[0].number is None or bound[0].number is None:
            return [RUNTIME]
        found: list[Value] = []
        number = first[0].number
        while len(found) <= LIMIT and calculate(str(condition.operator), number, bound[0].number):
            found.append(Value(number, "constant"))
            number += step
        return found if found and len(found) <= LIMIT else [RUNTIME]

    def _step(self, step: ccode.Expression | None, variable: ccode.Declaration) -> int | None:
        if isinstance(step, ccode.Unary) and _refers(step.operand, variable):
            return {"++": 1, "--": -1}.get(str(step.operator))
        if isinstance(step, ccode.Assignment) and _refers(step.left, variable):
            right = step.right
            operator = str(step.operator)
            if operator == "=" and isinstance(right, ccode.Binary) and _refers(right.left, variable):
                operator = f"{right.operator}="
                right = right.right
            values = self.of(right)
            if len(values) == 1 and values[0].number and operator in ("+=", "-="):
                return values[0].number if operator == "+=" else -values[0].number
        return None

    def _parameter(self, parameter: ccode.Parameter) -> list[Value]:
        """The values that callers pass, first caller first; unknown if nobody calls or the function changes the parameter."""
        function = parameter.eContainer()
        if any(_written(r) for r in parameter.references) or (isinstance(function, ccode.Function) and function.references):
            return [RUNTIME]  # who has the function as a value may pass anything
        arguments = passed_arguments(parameter)
        return [value for argument in arguments for value in self.of(argument)] or [RUNTIME]

    def _macro(self, name: str) -> list[Value]:
        return self._guarded(self.macros[name], "macro", self._macro_value)

    def _macro_itself(self, macro: ccode.Macro) -> list[Value]:
        return [RUNTIME] if macro.functionLike else self._guarded(macro, "macro", self._macro_value)

    def _macro_value(self, macro: ccode.Macro) -> list[Value]:
        number = macro_number(str(macro.name), self._texts, self._by_name)
        return [RUNTIME if number is None else Value(number, "constant")]

    def _by_name(self, name: str) -> int | None:
        """The value of an enumerator or constant that a macro's body names; None where it has none or several."""
        declaration = self.names.get(name)
        if declaration is None:
            return self._constants.get(name)
        if isinstance(declaration, ccode.EnumerationLiteral):
            return int(declaration.value)
        values = self._guarded(declaration, "variable", self._held) if isinstance(declaration, ccode.Variable) else []
        return values[0].number if len(values) == 1 else None

    def _index(self, index: ccode.Index) -> list[Value]:
        elements = self.elements(index.array)
        if elements is None:
            return [RUNTIME]
        positions = self.of(index.index)
        if len(positions) == 1 and positions[0].number is not None:
            return [elements[positions[0].number]] if 0 <= positions[0].number < len(elements) else [RUNTIME]
        return elements

    def elements(self, array: Element | None) -> list[Value] | None:
        """The elements of an array that is initialised with constants and never written, None for any other.

        A parameter stands for the arrays that callers pass.
        """
        target = array.target if isinstance(array, ccode.NameReference) else None
        if isinstance(target, ccode.Parameter):
            passed = [self.elements(a) for a in passed_arrays(target)]
            return None if not passed or any(p is None for p in passed) else [v for p in passed for v in p or []]
        if not isinstance(target, ccode.Variable) or not isinstance(target.initializer, ccode.InitializerList):
            return None
        if self._written.is_written(target):
            return None
        found: list[Value] = []
        following = 0
        for element in target.initializer.elements:
            values = self.of(element.right if isinstance(element, ccode.Assignment) else element)
            if len(values) != 1 or values[0].number is None:
                return None
            places = self._places(element, following)
            if not places:
                return None
            following = places.stop
            found += [Value(0, "array")] * (following - len(found))
            found[places.start : following] = [Value(_in_type(values, target.valueType)[0].number, "array")] * len(places)
        size = _SIZE.fullmatch(str(target.valueType.arrayDims or "")) if target.valueType is not None else None
        rest = min(int(size[1]), LIMIT) - len(found) if size is not None else 0
        return found + [Value(0, "array")] * max(rest, 0)

    def _places(self, element: Element, following: int) -> range:
        """The indexes that an initialiser's element is for, those of its designator, else `following`; empty if not known."""
        if not isinstance(element, ccode.Assignment):
            return range(following, following + 1)
        said = element.left.index if isinstance(element.left, ccode.Index) and element.left.array is None else None
        ends = [said.left, said.right] if isinstance(said, ccode.Binary) and said.operator == "..." else [said, said]
        first, last = (found[0].number if len(found := self.of(end)) == 1 else None for end in ends)
        return range(first, last + 1) if first is not None and last is not None and 0 <= first <= last < LIMIT else range(0)


Values._methods = {
    "IntegerLiteral": Values._integer,
    "CharacterLiteral": Values._integer,
    "Cast": Values._cast,
    "Unary": Values._unary,
    "Binary": Values._binary,
    "NameReference": Values._name,
    "Index": Values._index,
    "Macro": Values._macro_itself,
}
_CHANGES: dict[str, Callable[[int], int]] = {"-": lambda v: -v, "+": lambda v: v, "~": lambda v: ~v, "!": lambda v: int(not v)}


def _unsigned(expression: ccode.Expression | None) -> bool:
    """Whether something in an expression may have no sign, so that a negative number beside it is a large one.

    Of an expression of very many parts this is not asked.
    """
    pending, seen = [expression], 0
    while pending:
        one, seen = pending.pop(), seen + 1
        if seen > LIMIT:
            return True
        if isinstance(one, ccode.Binary):
            pending += [one.left, one.right]
        elif isinstance(one, ccode.Unary):
            pending.append(one.operand)
        elif isinstance(one, ccode.IntegerLiteral):
            if "u" in str(one.text).lower():
                return True
        elif not isinstance(one, ccode.CharacterLiteral):
            target = one.target if isinstance(one, (ccode.NameReference, ccode.Cast)) else None
            use = target.valueType if isinstance(target, (ccode.Variable, ccode.Parameter)) else target
            if not isinstance(target, ccode.EnumerationLiteral) and not (isinstance(use, ccode.TypeUse) and use.signed):
                return True
    return False


def _in_type(values: list[Value], use: ccode.TypeUse | None) -> list[Value]:
    """What is left of values in a type, or in the elements of an array."""
    if use is None or use.pointerDepth or not 0 < use.bits < PIN_BITS:
        return values
    return [v if v.number is None else Value(left_in(use, v.number, use.bits, use.signed), v.origin) for v in values]


def left_in(use: ccode.TypeUse, number: int, bits: int, signed: bool) -> int:
    """What is left of a number in an object of an integer type (C99 6.3.1.2, 6.3.1.3), which may be a bit field.

    Args:
        use: the type, or that of an array whose element the object is.
        number: the number that is stored.
        bits: the width of the object.
        signed: whether it has a sign.
    """
    if str(use.canonical).removeprefix("const ").partition("[")[0] in BOOLEAN:
        return int(bool(number))
    number %= 1 << bits
    return number - (1 << bits) if signed and number >> (bits - 1) else number


def _distinct(values: list[Value]) -> list[Value]:
    first: dict[int | None, Value] = {}
    for value in values:
        first.setdefault(value.number, value)
    return list(first.values())


def _refers(expression: ccode.Expression | None, variable: ccode.Declaration) -> bool:
    return isinstance(expression, ccode.NameReference) and expression.target is variable


def _in(element: ccode.Located | None, reference: ccode.NameReference) -> bool:
    return element is not None and bool(element.startOffset <= reference.startOffset < element.endOffset)


def _written(element: Element) -> bool:
    container = element.eContainer()
    if isinstance(container, ccode.Assignment):
        return container.left is element
    return isinstance(container, ccode.Unary) and str(container.operator) in ("++", "--", "&")


def _start(loop: ccode.For, variable: ccode.Variable) -> ccode.Expression | None:
    """The initial value of a for loop's counter, None if the loop's first clause does not set the variable."""
    initial = loop.initial
    if isinstance(initial, ccode.DeclarationStatement):
        return next((d.initializer for d in initial.declarations if d is variable), None)
    pending = [initial.expression] if isinstance(initial, ccode.ExpressionStatement) else []
    while pending:
        one = pending.pop()
        if isinstance(one, ccode.Assignment) and str(one.operator) == "=" and _refers(one.left, variable):
            return one.right
        if isinstance(one, ccode.Binary) and str(one.operator) == ",":
            pending += [one.left, one.right]
    return None


def passed_arguments(parameter: ccode.Parameter) -> list[ccode.Expression]:
    """The arguments that callers pass for a parameter, in text order; none for a lambda that others may call, too."""
    function = parameter.eContainer()
    if not isinstance(function, (ccode.Function, ccode.Lambda)):
        return []
    position = list(function.parameters).index(parameter)
    called = function.calls if isinstance(function, ccode.Function) else calls_of_value(function) or ()
    calls = sorted(called, key=lambda c: int(c.startOffset))
    return [list(c.arguments)[position] for c in calls if position < len(c.arguments)]


def calls_of_value(value: ccode.Lambda | ccode.NameReference) -> list[ccode.Call] | None:
    """The calls of a lambda, or of a function that is used as a value, where the text shows all of them.

    Args:
        value: a lambda, or the name of a function that is not called there.

    Returns:
        The calls through the variable that has it, or through the parameter that it is handed to; None if others may call it.
    """
    at: Element = value
    outer = at.eContainer()
    while isinstance(outer, ccode.Member) or (isinstance(outer, ccode.Unary) and outer.operator == "&"):
        at, outer = outer, outer.eContainer()  # its conversion to a pointer
    holder: Element | None = outer if isinstance(outer, ccode.Variable) else None
    if isinstance(outer, ccode.Call):
        if outer.calleeExpression is at:
            return [outer]
        place = next((number for number, given in enumerate(outer.arguments) if given is at), None)
        callee = outer.callee
        if place is not None and callee is not None and callee.definition and place < len(callee.parameters):
            holder = callee.parameters[place]
    if not isinstance(holder, (ccode.Variable, ccode.Parameter)):
        return None
    uses = [(each, each.eContainer()) for each in holder.references]
    calls = [use for each, use in uses if isinstance(use, ccode.Call) and use.calleeExpression is each]
    return calls if len(calls) == len(uses) else None


def passed_arrays(parameter: ccode.Parameter) -> list[ccode.Expression]:
    """The arrays that callers pass for a parameter, followed through parameters of the callers; each array once."""
    found: dict[int, ccode.Expression] = {}
    pending = list(reversed(passed_arguments(parameter)))
    seen = {id(parameter)}
    while pending:
        argument = pending.pop()
        target = argument.target if isinstance(argument, ccode.NameReference) else None
        if not isinstance(target, ccode.Parameter):
            found.setdefault(id(argument if target is None else target), argument)
        elif id(target) not in seen:
            seen.add(id(target))
            pending += reversed(given := passed_arguments(target))
            found |= {} if given else {id(target): argument}
    return list(found.values())


# ---- evaluation of names

A = TypeVar("A")
B = TypeVar("B")
Question = Callable[[], A]

DEEPEST = 100
"""Depth of nested names and expressions; a longer chain restarts from its deepest name, so that Python's own stack suffices."""
_NAME = 2
"""How many nested expressions take as much of Python's stack as a nested name."""
MOST_REPEATS = 1000
"""How often one question may evaluate names again that depend on themselves and whose answer is therefore not kept."""


class _TooDeep(Exception, Generic[A]):
    def __init__(self, key: Hashable, again: Question[A]) -> None:
        super().__init__()
        self.key = key
        self.again = again


class _TooOften(Exception):
    pass


class BoundedWalk(Generic[A]):
    """Evaluates names recursively; a name that is asked for while it is being evaluated is unknown.

    The answer for a name that depends on itself therefore depends on the path by which it was reached. Only such names are
    evaluated more than once; where there are too many paths through them, they are unknown altogether.

    Args:
        unknown: the answer for what is given up.
    """

    def __init__(self, unknown: A) -> None:
        self._unknown = unknown
        self._known: dict[Hashable, A] = {}
        self._active: dict[Hashable, int] = {}
        self._lowest = 0
        self._nested = 0
        self._begin()

    def _begin(self) -> None:
        self._asked: set[Hashable] = set()
        self._looped: set[Hashable] = set()
        self._repeats = 0

    def ask(self, question: Question[B]) -> B:
        """Answer a question that evaluates names by calling `name`; questions may be nested.

        Args:
            question: computes the answer; it may be called more than once.
        """
        if self._active:
            self._nested += 1
            try:
                return question()
            finally:
                self._nested -= 1
        first: list[_TooDeep[A]] = []
        while True:
            self._begin()
            try:
                if not first:
                    return question()
                self._known[first[-1].key] = first[-1].again()
                first.pop()
            except _TooDeep as deep:
                if any(deep.key == other.key for other in first):
                    self._known[deep.key] = self._unknown
                else:
                    first.append(deep)
            except _TooOften:
                self._known |= dict.fromkeys(self._looped, self._unknown)

    def name(self, guard: Hashable, key: Hashable, answer: Question[A]) -> A:
        """The answer for a name, from memory if it was found before.

        Args:
            guard: identifies the evaluation: asked for again while it is active, it is answered with unknown.
            key: identifies the answer in memory; questions with one key have the same answer.
            answer: computes it.
        """
        if guard in self._active:
            self._looped.add(key)
            self._lowest = min(self._lowest, self._active[guard])
            return self._unknown
        if key in self._known:
            return self._known[key]
        depth = len(self._active)
        if depth * _NAME + self._nested >= DEEPEST:
            raise _TooDeep(key, lambda: self.name(guard, key, answer))
        self._repeats += key in self._asked
        self._asked.add(key)
        if self._repeats > MOST_REPEATS:
            raise _TooOften
        around, self._lowest = self._lowest, depth + 1
        self._active[guard] = depth
        try:
            found = answer()
        finally:
            del self._active[guard]
            own, self._lowest = self._lowest, min(around, self._lowest)
        if own > depth:
            self._known[key] = found  # it does not depend on itself, so that each way to it gives the same
        return found
