"""How long each pass of a program's endless loop waits, as far as its text and the facts about the platform tell.

Only waiting functions count, with the time that their arguments ask for or the longest they may take; computing, sending and
printing do not count. A call through a pointer takes the time of any function that it may reach. A wait that ends by something
outside (the user, a sensor, a wheel), or a call through an unknown pointer, has no upper bound and is reported by name.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from functools import cached_property, reduce

from msgspec import Struct

from robosmi.metamodels import ccode, migration, platform
from robosmi.model.elements.strict import Element
from robosmi.query import all_contents
from robosmi.query.rules.deep_recursion import in_thread
from robosmi.transformations.queries.flows.pointed_calls import is_pointed, pointed_calls
from robosmi.transformations.queries.macros.constant_text import calculate
from robosmi.transformations.queries.programs.main_program import main_structure
from robosmi.transformations.queries.values import Value, Values

TICKS_A_SECOND = "clock ticks a second"
"""The meaning of a symbol of the source platform that stands for its clock rate."""
UP_TO = "rxTime"
"""Functions whose names end so wait for an event, at most as long as their argument says."""
TICKS = 80
"""Ticks of the source's clock in a microsecond, where its platform names none."""
_LEVELS = 20
"""Nesting of calls per thread; each nested call takes a Python frame for every statement around it."""
_UNITS = {platform.Meaning.milliseconds: 1000.0, platform.Meaning.microseconds: 1.0}


_WAYS_OUT = (ccode.Break, ccode.Continue, ccode.Return, ccode.Goto)
_LABELS = (ccode.Case, ccode.Default)


class Wait(Struct, frozen=True):
    """A wait without an upper bound: what waits (a function, a loop), and its line."""

    what: str
    line: int


class Time(Struct, frozen=True):
    """The least and the greatest time that a piece of code waits.

    Attributes:
        low, high: microseconds; `high` counts bounded waits only.
        unbounded: waits without an upper bound, each once, in text order.
    """

    low: float = 0.0
    high: float = 0.0
    unbounded: tuple[Wait, ...] = ()

    def then(self, other: Time) -> Time:
        """The time of two pieces of code one after the other."""
        return Time(self.low + other.low, self.high + other.high, _once(self.unbounded, other.unbounded))

    def either(self, other: Time) -> Time:
        """The time of two alternatives."""
        return Time(min(self.low, other.low), max(self.high, other.high), _once(self.unbounded, other.unbounded))

    def times(self, low: int, high: int) -> Time:
        """The time of a repetition, at least `low` and at most `high` times."""
        return Time(self.low * low, self.high * high, self.unbounded)


NOTHING = Time()


def loop_time(plan: migration.MigrationPlan) -> Time | None:
    """How long each pass of what a plan's program repeats for ever waits; None for a program that runs once.

    Args:
        plan: the plan.
    """
    for unit in plan.program.units if plan.program is not None else ():
        structure = main_structure(unit)
        if structure is not None and structure.loop is not None and structure.loop.body is not None:
            return LoopTimes(plan, unit).of(structure.loop.body)
    return None


def clock_rates(plan: migration.MigrationPlan) -> set[str]:
    """The names that a plan's program uses for the clock rate, such as `CLKFREQ`."""
    symbols = (use.symbol for use in plan.symbolUses)
    return {str(each.name) for each in symbols if each is not None and each.meaning == TICKS_A_SECOND}


def of_rate(expression: Element | None, rates: Collection[str], values: Callable[[Element | None], list[Value]]) -> int | None:
    """The value of an expression of the clock rate, such as `CLKFREQ / 1000 * 5`; None for any other expression.

    Args:
        expression: the expression.
        rates: names of the clock rate.
        values: gives the values of an expression as far as the text decides them.
    """
    if isinstance(expression, ccode.NameReference) and str(expression.name) in rates:
        return TICKS * 1_000_000
    if isinstance(expression, ccode.Cast):
        return of_rate(expression.operand, rates, values)
    if isinstance(expression, ccode.Binary):
        left, right = (of_rate(side, rates, values) for side in (expression.left, expression.right))
        return calculate(str(expression.operator), left, right) if left is not None and right is not None else None
    known = values(expression)
    return known[0].number if len(known) == 1 else None


class LoopTimes:
    """Computes the waiting times of statements and expressions of one program.

    Args:
        plan: the plan of the program.
        unit: the unit whose macros apply.
    """

    def __init__(self, plan: migration.MigrationPlan, unit: ccode.SourceUnit) -> None:
        assert plan.program is not None
        self._values = Values(plan.program, unit)
        self._platform: Mapping[str, platform.ApiFunction] = {
            str(use.name): use.function for use in plan.adapterUses if use.function is not None
        }
        self._own = {
            str(d.name): d for each in plan.program.units for d in each.declarations if isinstance(d, ccode.Function) and d.body
        }
        self._rates = clock_rates(plan)
        self._program = plan.program
        self._functions: dict[int, Time] = {}
        self._depth = 0

    @cached_property
    def _pointed(self) -> dict[int, list[ccode.Function]]:
        """The functions that calls through pointers may reach: asked for where the loop has one."""
        return pointed_calls(list(all_contents(self._program)))

    def of(self, element: Element | None) -> Time:
        """The time of a statement or expression, nothing for None."""
        if element is None:
            return NOTHING
        if isinstance(element, ccode.Block):
            return self._sequence(element.statements)
        if isinstance(element, ccode.If):
            return self.of(element.condition).then(self.of(element.thenBranch).either(self.of(element.elseBranch)))
        if isinstance(element, ccode.Switch):
            return self.of(element.selector).then(self._switch(element))
        if isinstance(element, ccode.Loop):
            return self._loop(element)
        if isinstance(element, ccode.ConditionalExpression):
            return self.of(element.condition).then(self.of(element.whenTrue).either(self.of(element.whenFalse)))
        if isinstance(element, ccode.Binary) and element.operator in ("&&", "||"):
            return self.of(element.left).then(NOTHING.either(self.of(element.right)))
        if isinstance(element, ccode.Call):
            return self._inside(element).then(self._call(element))
        return self._inside(element)

    def _sequence(self, statements: Iterable[Element]) -> Time:
        """The time of a sequence up to a statement that always leaves it; after one that may leave, the rest is optional."""
        reached = []
        for statement in statements:
            reached.append(statement)
            if _leaves(statement):
                break
        time = NOTHING
        for statement in reversed(reached):
            time = self._before(statement, time)
        return time

    def _before(self, statement: Element, rest: Time) -> Time:
        """The time of a statement and of `rest`, the code after it, on the paths on which the statement does not leave."""
        if isinstance(statement, (*_LABELS, ccode.Label)) and statement.statement is not None:
            return self._before(statement.statement, rest)
        if not isinstance(statement, ccode.If) or _stays(statement):
            return self.of(statement).then(rest)
        branches = [
            self.of(branch).then(NOTHING if _leaves(branch) else rest if _stays(branch) else NOTHING.either(rest))
            for branch in (statement.thenBranch, statement.elseBranch)
        ]
        return self.of(statement.condition).then(branches[0].either(branches[1]))

    def _switch(self, switch: ccode.Switch) -> Time:
        """The time of a switch: from any of its labels on, or nothing where no label need match."""
        body = switch.body
        statements = list(body.statements) if isinstance(body, ccode.Block) else [body] if body is not None else []
        labels = [at for at, each in enumerate(statements) if isinstance(each, _LABELS)]
        if len(labels) < sum(_is_first_label(each) for each in _within_switch(switch.body)):  # into the midst of a loop
            whole = self._inside(switch.body)
            return Time(0.0, whole.high, whole.unbounded)
        times = [self._sequence(statements[at:]) for at in labels]
        if not any(isinstance(each, ccode.Default) for each in _within_switch(switch.body)):
            times.append(NOTHING)
        return reduce(Time.either, times) if times else NOTHING

    def _inside(self, element: Element | None) -> Time:
        """The time of the direct children of an element, one after the other."""
        time = NOTHING
        for part in element.eContents if element is not None else ():
            if isinstance(part, (ccode.Statement, ccode.Expression, ccode.Declaration)):
                time = time.then(self.of(part))
        return time

    def _loop(self, loop: ccode.Loop) -> Time:
        step = loop.step if isinstance(loop, ccode.For) else None
        once = self.of(loop.condition).then(self.of(loop.body)).then(self.of(step))
        first = self.of(loop.initial) if isinstance(loop, ccode.For) else NOTHING
        if isinstance(loop, ccode.For) and loop.body is not None and (trips := self._trips(loop)) is not None:
            early = any(isinstance(e, (ccode.Break, ccode.Return, ccode.Goto)) for e in all_contents(loop.body))
            return first.then(once.times(0 if early else trips, trips))
        if loop.condition is not None and [v.number for v in self._values.of(loop.condition)] == [0]:  # do { ... } while (0)
            return once if isinstance(loop, ccode.DoWhile) else first.then(self.of(loop.condition))
        if not once.high and not once.unbounded and not self._outside(loop):
            return first
        least = 1 if isinstance(loop, ccode.DoWhile) else 0
        return first.then(Time(once.low * least, once.high, (Wait(_name(loop), int(loop.line)), *once.unbounded)))

    def _outside(self, loop: ccode.Loop) -> bool:
        """Whether a loop's condition calls a function of the platform, so that the outside world decides when it ends."""
        condition = [loop.condition, *all_contents(loop.condition)] if loop.condition is not None else []
        return any(isinstance(e, ccode.Call) and str(e.calleeName) in self._platform for e in condition)

    def _trips(self, loop: ccode.For) -> int | None:
        """The trip count of a for loop whose counter takes only values that the text gives; None for any other loop."""
        condition = loop.condition
        if not isinstance(condition, ccode.Binary) or not isinstance(condition.left, ccode.NameReference):
            return None
        inside = [e for e in all_contents(loop.body) if isinstance(e, ccode.NameReference)] if loop.body is not None else []
        uses = (
            [e for e in [*inside, *all_contents(loop.step)] if isinstance(e, ccode.NameReference)]
            if loop.step is not None
            else []
        )
        mine = next((e for e in uses if e.target is condition.left.target), None)
        values = self._values.of(mine) if mine is not None else []
        return len(values) if values and all(v.number is not None for v in values) else None

    def _call(self, call: ccode.Call) -> Time:
        if is_pointed(call):
            reached = self._pointed.get(id(call), ())
            if not reached:
                return Time(0.0, 0.0, (Wait(_pointer_name(call), int(call.line)),))
            return reduce(Time.either, [self._function(each, call) for each in reached])
        callee = self._own.get(str(call.calleeName))
        if callee is not None:
            return self._function(callee, call)
        function = self._platform.get(str(call.calleeName))
        return self._platform_call(call, function) if function is not None and _waits(function) else NOTHING

    def _function(self, callee: ccode.Function, call: ccode.Call) -> Time:
        """The time of a called function of the program, computed once."""
        known = self._functions.get(id(callee))
        if known is None:
            again = Wait(str(callee.name), int(call.line))
            self._functions[id(callee)] = Time(unbounded=(again,))  # for a function that calls itself
            self._depth += 1  # functions that call one another nest deeper than Python's stack
            known = self.of(callee.body) if self._depth % _LEVELS else in_thread(self.of, callee.body)
            self._depth -= 1
            if not known.high and known.unbounded == (again,):
                known = NOTHING
            self._functions[id(callee)] = known
        return known

    def _platform_call(self, call: ccode.Call, function: platform.ApiFunction) -> Time:
        """The time that a platform function waits: what its argument says, else up to its longest time, else unbounded."""
        for argument, parameter in zip(call.arguments, function.parameters, strict=False):
            factor = _UNITS.get(parameter.meaning, 1.0 / TICKS if parameter.meaning is platform.Meaning.ticks else 0.0)
            if factor:
                numbers = self._numbers(argument, ticks=parameter.meaning is platform.Meaning.ticks)
                if numbers:
                    least = 0 if str(call.calleeName).endswith(UP_TO) else min(numbers)
                    return Time(max(0, least) * factor, max(0, max(numbers)) * factor)
                return Time(0.0, 0.0, (Wait(_call_name(call), int(call.line)),))
        if function.longestMicroseconds:
            return Time(0.0, float(function.longestMicroseconds))
        return Time(0.0, 0.0, (Wait(_call_name(call), int(call.line)),))

    def _numbers(self, argument: ccode.Expression | None, *, ticks: bool) -> list[int]:
        """The values of an argument, empty where the text does not give them all.

        With `ticks`, an absolute time such as `CNT + n` counts as the n ticks from now.
        """
        values = self._values.of(argument)
        if all(v.number is not None for v in values):
            return [v.number for v in values if v.number is not None]
        if (rate := of_rate(argument, self._rates, self._values.of)) is not None:
            return [rate]
        if ticks and isinstance(argument, ccode.Binary) and str(argument.operator) == "+":
            for side in (argument.right, argument.left):
                if found := self._numbers(side, ticks=False):
                    return found
        return []


def _leaves(statement: Element | None) -> bool:
    """Whether control never continues after a statement: each path through it ends in break, continue, return or goto."""
    if isinstance(statement, ccode.Block):
        return any(_leaves(each) for each in statement.statements)
    if isinstance(statement, (*_LABELS, ccode.Label)):
        return _leaves(statement.statement)
    if isinstance(statement, ccode.If):
        return statement.elseBranch is not None and _leaves(statement.thenBranch) and _leaves(statement.elseBranch)
    return isinstance(statement, _WAYS_OUT)


def _stays(statement: Element | None) -> bool:
    """Whether a statement contains no break, continue, return or goto."""
    return statement is None or not any(isinstance(each, _WAYS_OUT) for each in (statement, *all_contents(statement)))


def _within_switch(body: Element | None) -> Iterator[Element]:
    """The labels of a switch, not those of others within it."""
    pending = [body] if body is not None else []
    while pending:
        element = pending.pop()
        if isinstance(element, _LABELS):
            yield element
        inner = (each for each in element.eContents if isinstance(each, ccode.Statement))
        pending.extend(each for each in inner if not isinstance(each, ccode.Switch))


def _is_first_label(label: Element) -> bool:
    """Whether a label is the first of consecutive ones: false for the second of `case 1: case 2:`."""
    return not isinstance(label.eContainer(), _LABELS)


def _waits(function: platform.ApiFunction) -> bool:
    return bool(function.blocking or function.longestMicroseconds)


def _once(first: Iterable[Wait], second: Iterable[Wait]) -> tuple[Wait, ...]:
    return tuple(dict.fromkeys((*first, *second)))


def _call_name(call: ccode.Call) -> str:
    return str(call.calleeName)


def _pointer_name(call: ccode.Call) -> str:
    """What a report calls a call through a pointer whose functions are not known."""
    pointer = call.calleeExpression
    while isinstance(pointer, (ccode.Unary, ccode.Cast, ccode.Index)):
        pointer = pointer.array if isinstance(pointer, ccode.Index) else pointer.operand
    if isinstance(pointer, (ccode.NameReference, ccode.Member)):
        return f"the function behind {pointer.name}"
    return "the function behind a pointer"


def _name(loop: ccode.Loop) -> str:
    kind = {"While": "while", "DoWhile": "do", "For": "for"}.get(type(loop).__name__, "loop")
    return f"the {kind} loop"
