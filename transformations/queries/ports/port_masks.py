"""Upper bounds of bit masks: which bits of an expression such as `1 << pins[i]` or `mask |= ...` may be set.

The bound of a mask that is put together, stored, passed and returned is the union of all its sources. None where a source comes
from outside or where nothing bounds it. Which bits of a register a use touches is computed by `register_bits`.

`GivenValues` finds the sources: the expressions that give variables, parameters, results and members their values. It reads the
code model alone, without regard to order: a thing may have any value that it is given anywhere in the program. Things count as
one if a change of one may change the other: a pointer or reference and what it leads to, the elements of an array, the members of
a union. What the text does not give values (parameters of constructors, of operators and of functions that are called through
pointers, variables whose address a function of the platform takes) is given the element that says so, which has no known value.

The sets are defined by each other. `FixedPoints` computes the least solution of their equations for what is asked and what that
needs. It is the top-down solver of Le Charlier and Van Hentenryck (A universal top-down fixpoint algorithm, 1992): an equation
is evaluated again only if a set that it has read has grown since. The cost is that of the equations times the number of times
that sets grow, whatever the number of paths between them.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Sequence
from functools import cached_property
from typing import Any, Generic, TypeVar

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import ancestor_of_kind
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.flows.classes import Classes
from robosmi.transformations.queries.flows.cores import handed_over
from robosmi.transformations.queries.flows.pointers import gives_access, moved_pointer
from robosmi.transformations.queries.initialisers import leaves, members_given, record_of
from robosmi.transformations.queries.macros.constant_text import calculate
from robosmi.transformations.queries.member_records import (
    all_fields,
    has_several_types,
    record_key,
    record_of_member,
    records_as_bytes,
    records_of_cast,
    whole_of_member,
)
from robosmi.transformations.queries.reached_values import ReachedValues
from robosmi.transformations.queries.values import LIMIT, Value, Values

WORD = 32
"""Bits of a register."""
_ALL = (1 << WORD) - 1
_TRUTHS = frozenset(["==", "!=", "<", ">", "<=", ">=", "&&", "||"])

_T = TypeVar("_T", int, frozenset[int])
"""A set: the bits of a number, or numbers."""
_DEEPEST = 40
"""Equations that may wait for each other, within Python's own stack; what lies deeper is unbounded."""


class PortMasks:
    """Bounds the masks of one program.

    Args:
        views: a view of each of its units.
    """

    def __init__(self, views: Sequence[CodeView]) -> None:
        self._views = views
        self._values = {id(v.unit): Values(v.program, v.unit) for v in views}
        self._reached = {id(v.unit): ReachedValues(v.program, v.unit) for v in views}
        self._bits = FixedPoints(0)
        self._numbers: FixedPoints[frozenset[int]] = FixedPoints(frozenset())

    @cached_property
    def given(self) -> GivenValues:
        """What gives the program's things their values, read when a mask is asked for: most programs have none."""
        return GivenValues(self._views)

    def values(self, expression: Element | None) -> list[Value]:
        """The values of an expression as `Values` reads them in its unit."""
        return self._values[_unit(expression)].of(expression)

    def numbers(self, expression: Element | None) -> frozenset[int] | None:
        """The values of an expression as `Values` computes them in its unit."""
        return self._numbers_of(expression) or None

    def _numbers_of(self, expression: Element | None) -> frozenset[int] | None:
        """As `numbers`; while the values of a thing are computed from themselves, those that have been found so far."""
        reached = self._reached[_unit(expression)]
        for known in (self.values(expression), reached.of(expression)):
            found = {value.number for value in known}
            if None not in found:
                return frozenset(number for number in found if number is not None)
        if isinstance(expression, ccode.ConditionalExpression):
            return _together(self._numbers_of(way) for way in (expression.whenTrue, expression.whenFalse))
        if isinstance(expression, ccode.Binary):
            left, right = self._numbers_of(expression.left), self._numbers_of(expression.right)
            if left is None or right is None or len(left) * len(right) > LIMIT:
                return None
            made = {calculate(str(expression.operator), a, b) for a in left for b in right}
            return None if None in made else frozenset(number for number in made if number is not None)
        key = self._thing(expression)
        given = self.given.of(key) if key is not None else []
        return self._numbers.of(key, lambda: (self._numbers_of(one) for one in given)) if given else None

    def bits(self, expression: Element | None) -> int | None:
        """The bits that may be set in an expression's value; None where the text does not bound them."""
        numbers = [value.number for value in self.values(expression)]
        if None not in numbers:
            return union(numbers)
        rule = _RULES.get(type(expression).__name__)
        if rule is not None:
            return rule(self, expression)
        key = self._thing(expression)
        return None if key is None else self._kept(key)

    def _thing(self, expression: Element | None) -> Hashable | None:
        """The key of the thing whose value an expression is; for a member that nothing is assigned to, of its record."""
        key = self.given.key(expression)
        if isinstance(expression, ccode.Member) and not self.given.of(key):
            return self.given.key(expression.object)
        return key

    def _kept(self, key: Hashable) -> int | None:
        """The bits that the values of a thing may have: the least fixed point if it is computed from itself."""
        given = self.given.of(key)
        return self._bits.of(key, lambda: (self.bits(one) for one in given)) if given else None

    def cleared(self, expression: Element | None, whole: int) -> int | None:
        """The bits of `whole` that may be clear in an expression's value; None where the text does not bound them."""
        numbers = [value.number for value in self.values(expression)]
        if None not in numbers:
            return union(~number & whole for number in numbers if number is not None)
        if isinstance(expression, ccode.Cast):
            return self.cleared(expression.operand, whole)
        if isinstance(expression, ccode.Unary) and expression.operator == "~":
            return self.bits(expression.operand)
        if isinstance(expression, (ccode.Binary, ccode.Assignment)) and expression.operator in ("&", "&="):
            return union(self.cleared(side, whole) for side in (expression.left, expression.right))
        key = self.given.key(expression)
        given = self.given.of(key) if key is not None else []
        return self._bits.of(("cleared", key, whole), lambda: (self.cleared(one, whole) for one in given)) if given else None

    def _binary(self, binary: ccode.Binary) -> int | None:
        return self._combined(binary, str(binary.operator))

    def _assignment(self, assignment: ccode.Assignment) -> int | None:
        operator = str(assignment.operator)
        return self.bits(assignment.right) if operator == "=" else self._combined(assignment, operator.removesuffix("="))

    def _combined(self, sides: ccode.Binary | ccode.Assignment, operator: str) -> int | None:
        """The bits that may be set in an operator's result, in an expression or a compound assignment."""
        if operator in _TRUTHS:
            return 1
        if operator == ",":
            return self.bits(sides.right)
        if operator in ("<<", ">>"):
            return self._shifted(sides.left, self.numbers(sides.right), operator)
        left, right = self.bits(sides.left), self.bits(sides.right)
        if operator == "&":
            return right if left is None else left if right is None else left & right
        if left is None or right is None:
            return None
        if operator in ("|", "^") or (operator == "+" and not left & right):
            return left | right
        return left if operator == "-" and not right & ~left else None

    def _shifted(self, left: ccode.Expression | None, places: frozenset[int] | None, operator: str) -> int | None:
        again = self.given.key(left)
        bits = self.bits(left)
        if bits is None or places is None:
            return None
        bits, found = bits & _ALL, 0
        for place in places:  # a shift of the source counts the lower bits of its place
            found |= bits << place % WORD if operator == "<<" else bits >> place % WORD
        if again in self._bits.active and operator == "<<":
            return self._bounded(left, found)
        return found & _ALL

    def _bounded(self, stepped: ccode.Expression | None, found: int) -> int | None:
        """The bits of a mask that is shifted repeatedly, limited by the numbers that it is compared with."""
        target = stepped.target if isinstance(stepped, ccode.NameReference) else None
        compared = self._reached[_unit(stepped)].bounds(target) if target is not None else ()
        bounds = [n - (o in ("<", "!=")) for o, n, _ in compared if o not in (">", ">=") and n > 0]
        return found & ((1 << max(bounds).bit_length()) - 1) if bounds else None

    def _unary(self, unary: ccode.Unary) -> int | None:
        operator = str(unary.operator)
        if operator == "!":
            return 1
        if operator == "~":
            return _ALL
        key = self.given.key(unary)
        return None if key is None else self._kept(key)

    def _cast(self, cast: ccode.Cast) -> int | None:
        return self.bits(cast.operand)

    def _conditional(self, choice: ccode.ConditionalExpression) -> int | None:
        return union(self.bits(way) for way in (choice.whenTrue, choice.whenFalse))


_RULES: dict[str, Callable[[PortMasks, Any], int | None]] = {
    "Binary": PortMasks._binary,
    "Assignment": PortMasks._assignment,
    "Unary": PortMasks._unary,
    "Cast": PortMasks._cast,
    "ConditionalExpression": PortMasks._conditional,
}


def _unit(expression: Element | None) -> int:
    """The `id` of the unit that contains an expression."""
    return id(ancestor_of_kind(expression, ccode.SourceUnit) if expression is not None else None)


def union(parts: Iterable[int | None]) -> int | None:
    """The union of some masks; None if one of them is unknown."""
    return _united(parts, 0)


def _together(parts: Iterable[frozenset[int] | None]) -> frozenset[int] | None:
    return _united(parts, frozenset())


class MemberKey(Struct, frozen=True):
    """The key of a member.

    Attributes:
        name: of the member.
        record: the key of its record (`member_records`), None where the text does not say which it is.
    """

    name: str
    record: Hashable | None


class GivenValues:
    """Maps each thing of a program (variable, parameter, result, member, register) to the expressions that give it a value.

    Args:
        views: a view of each of its units.
    """

    def __init__(self, views: Sequence[CodeView]) -> None:
        self._views = views
        self._given: dict[Hashable, list[ccode.Located]] = {}
        self._members: dict[str, dict[Hashable | None, list[ccode.Located]]] = {}
        """Name of a member -> key of its record, None where the text does not tell it -> the expressions that it is given."""
        self._casts: dict[Hashable, set[Hashable]] = {}
        """Key of a record -> keys of the records that a cast converts to or from it."""
        self._registers = {name for v in views for name in v.api.settings.get("ports", {}).get("registers", {})}
        self._functions = {
            str(d.name): d for v in views for d in v.unit.declarations if isinstance(d, ccode.Function) and d.definition
        }
        self._shared = {
            str(d.name): d
            for v in views
            for d in v.unit.declarations
            if isinstance(d, ccode.Variable) and d.storage is not ccode.Storage.staticStorage
        }
        self._same: dict[Hashable, set[Hashable]] = {}
        """Key of a thing -> keys of things that are one with it."""
        self._handed: set[int] = set()
        """`id` of functions that other cores run, whose parameter is what they are handed."""
        for view in views:
            for element in view.elements:
                self._read(element, view)
        classes = Classes(views) if any(view.of_kind(ccode.Record) for view in views) else None
        for view in views:
            for reference in view.of_kind(ccode.NameReference):
                if isinstance(function := reference.target, ccode.Function) and id(function) not in self._handed:
                    self._unknown(function, reference)
            for record, element in records_as_bytes(view, classes.around, handed_over) if classes is not None else ():
                self._open(record, element)

    def of(self, key: Hashable) -> list[ccode.Located]:
        """The expressions that give a thing its values; a compound assignment, `++` and `--` are listed themselves."""
        if key not in self._same:
            return self._given_to(key)
        one, pending = {key}, [key]
        while pending:
            new = self._same[pending.pop()] - one
            one |= new
            pending += new
        return [expression for each in one for expression in self._given_to(each)]

    def _given_to(self, key: Hashable) -> list[ccode.Located]:
        if not isinstance(key, MemberKey):
            return self._given.get(key, [])
        records = self._members.get(key.name, {})
        alike = {None, *self._alike(key.record)} if key.record is not None else set(records)
        return [one for record, given in records.items() if record in alike for one in given]

    def _alike(self, record: Hashable) -> set[Hashable]:
        """A record with all records that casts connect it with, directly or through others."""
        found, pending = {record}, [record]
        while pending:
            new = self._casts.get(pending.pop(), set()) - found
            found |= new
            pending += new
        return found

    def key(self, expression: Element | None) -> Hashable | None:
        """The key of the thing whose value an expression is; None for a literal or a computation."""
        if isinstance(expression, ccode.Cast):
            return self.key(expression.operand)
        if isinstance(expression, ccode.Index):
            return self.key(expression.array)
        if isinstance(expression, ccode.Unary) and str(expression.operator) in ("*", "&"):
            return self.key(expression.operand)
        if isinstance(expression, ccode.Unary) and str(expression.operator) in ("++", "--"):
            return self.key(expression.operand) if gives_access(expression.operand) else None
        if isinstance(expression, ccode.Binary) and (array := moved_pointer(expression)) is not None:
            return self.key(array)
        if isinstance(expression, ccode.Member):
            whole = whole_of_member(expression)
            return self.key(whole) if whole is not None else MemberKey(str(expression.name), record_of_member(expression))
        if isinstance(expression, ccode.Call):
            own = self._own(expression)
            return ("result", str(own.name)) if own is not None else None
        if not isinstance(expression, ccode.NameReference):
            return None
        target = expression.target if expression.target is not None else self._shared.get(str(expression.name))
        if isinstance(target, (ccode.Variable, ccode.Parameter)):
            return self._declared(target)
        return ("register", str(expression.name)) if expression.name in self._registers else None

    def _declared(self, thing: ccode.Variable | ccode.Parameter) -> Hashable:
        """The key of a declaration: the name of what all files share, else the identity of the element."""
        if isinstance(thing, ccode.Parameter):
            function = thing.eContainer()
            if isinstance(function, ccode.Function):
                return ("parameter", str(function.name), list(function.parameters).index(thing))
        elif isinstance(thing.eContainer(), ccode.SourceUnit) and thing.storage is not ccode.Storage.staticStorage:
            return ("variable", str(thing.name))
        return ("element", id(thing))

    def _own(self, call: ccode.Call) -> ccode.Function | None:
        return self._functions.get(str(call.calleeName or "")) if call.callee is not None else None

    def _join(self, one: Hashable, other: Hashable) -> None:
        """Record that a change of one thing may change the other."""
        self._same.setdefault(one, set()).add(other)
        self._same.setdefault(other, set()).add(one)

    def _unknown(self, function: ccode.Function, why: ccode.Located) -> None:
        """Give a function's parameters a value that the text does not say."""
        for position in range(len(function.parameters)):
            self._give(("parameter", str(function.name), position), why)

    def _give(self, key: Hashable | None, expression: ccode.Located | None, use: ccode.TypeUse | None = None) -> None:
        """Record that a thing, of the type `use` if that is known, is given the value of an expression."""
        if key is None or expression is None:
            return
        if (use is not None and str(use.canonical or use.spelling).endswith("&")) or gives_access(expression):
            other = self.key(expression)
            if other is not None and other != key:
                self._join(key, other)
        if isinstance(key, MemberKey):
            self._members.setdefault(key.name, {}).setdefault(key.record, []).append(expression)
        else:
            self._given.setdefault(key, []).append(expression)

    def _read(self, element: Element, view: CodeView) -> None:
        if isinstance(element, ccode.Variable):
            self._initialised(element)
        elif isinstance(element, ccode.Assignment):
            if not isinstance(element.eContainer(), ccode.InitializerList):
                self._give(self.key(element.left), element.right if str(element.operator) == "=" else element)
        elif isinstance(element, ccode.Unary) and str(element.operator) in ("++", "--"):
            if not gives_access(element.operand):
                self._give(self.key(element.operand), element)
        elif isinstance(element, ccode.Cast) and (records := records_of_cast(element)) is not None:
            one, other = (record_key(record) for record in records)
            self._casts.setdefault(one, set()).add(other)
            self._casts.setdefault(other, set()).add(one)
        elif isinstance(element, ccode.Return):
            function = ancestor_of_kind(element, ccode.Function)
            if function is not None:
                self._give(("result", str(function.name)), element.value, function.returnType)
        elif isinstance(element, ccode.Call):
            self._called(element, view)
        elif isinstance(element, ccode.Function):
            self._declared_function(element)
        elif isinstance(element, ccode.For):
            if element.range is not None and isinstance(element.declaration, ccode.DeclarationStatement):
                self._each(element.declaration, element.range)
        elif isinstance(element, ccode.MemberInitializer):
            record = ancestor_of_kind(element, ccode.Record)
            for argument in element.arguments:
                for one in leaves(argument):
                    self._give(MemberKey(str(element.name), record_key(record) if record is not None else None), one)
        elif isinstance(element, ccode.Record):
            self._fields(element)
        elif isinstance(element, ccode.InitializerList):
            self._listed(element)

    def _declared_function(self, function: ccode.Function) -> None:
        """Give parameters their default values; constructors and operators are called without a call in the text."""
        for position, parameter in enumerate(function.parameters):
            self._give(("parameter", str(function.name), position), parameter.defaultValue)
        around = function.eContainer()
        if str(function.name).startswith("operator") or (isinstance(around, ccode.Record) and function.name == around.name):
            self._unknown(function, function)

    def _each(self, declaration: ccode.DeclarationStatement, values: ccode.Expression) -> None:
        """Give the variable of a loop over a range the values of the range."""
        for variable in declaration.declarations:
            if isinstance(variable, ccode.Variable):
                for one in leaves(values):
                    self._give(self._declared(variable), one, variable.valueType)

    def _fields(self, record: ccode.Record) -> None:
        keys = [MemberKey(str(field.name), record_key(record)) for field in record.fields]
        for key, field in zip(keys, record.fields, strict=True):
            for one in leaves(field.initializer):
                self._give(key, one)
            if record.recordKind is ccode.RecordKind.unionType:
                self._join(keys[0], key)
        uses = [field.valueType for field in record.fields]
        parts = any(use is not None and (use.arrayDims or record_of(use) is not None) for use in uses)
        if parts and record.recordKind is ccode.RecordKind.unionType and has_several_types(record):
            self._open(record, record)

    def _open(self, record: ccode.Record, why: ccode.Located) -> None:
        """Give the members of a record, and of the records in it, a value that the text does not say."""
        for field in all_fields(record):
            self._give(MemberKey(str(field.name), record_key(field.eContainer())), why)

    def _listed(self, values: ccode.InitializerList) -> None:
        """Give the members of a structure what a list without a variable gives them: `lamp = (struct lamp){16}`."""
        around = values.eContainer()
        if isinstance(around, ccode.Cast) and record_of(around.target) is not None:
            for member, one in members_given(around.target, values):
                self._give(MemberKey(str(member.name), record_key(member.eContainer())), one)
            return
        inside = isinstance(around, ccode.Assignment) and isinstance(around.eContainer(), ccode.InitializerList)
        if inside or isinstance(around, (ccode.Variable, ccode.InitializerList, ccode.MemberInitializer, ccode.Field)):
            return
        for record in (each for view in self._views for each in view.of_kind(ccode.Record)):
            if len(record.fields) >= len(values.elements):
                self._open(record, values)

    def _initialised(self, variable: ccode.Variable) -> None:
        first = variable.initializer
        if first is None:
            return
        if record_of(variable.valueType) is None:
            for one in leaves(first):
                self._give(self._declared(variable), one, variable.valueType)
        elif isinstance(first, ccode.InitializerList):
            for member, one in members_given(variable.valueType, first):
                self._give(MemberKey(str(member.name), record_key(member.eContainer())), one)

    def _called(self, call: ccode.Call, view: CodeView) -> None:
        own, arguments = self._own(call), list(call.arguments)
        if own is not None:
            for position, (parameter, argument) in enumerate(zip(own.parameters, arguments, strict=False)):
                self._give(("parameter", str(own.name), position), argument, parameter.valueType)
            return
        handed, code = handed_over(call, view.api)
        if code is not None and str(code.name) in self._functions:
            self._handed.add(id(code))
            self._give(("parameter", str(code.name), 0), handed)
        for argument in arguments:
            if argument is not handed and gives_access(argument):
                self._give(self.key(argument), call)


class FixedPoints(Generic[_T]):
    """Solves equations of the form: this set is the union of these parts, which may read other sets and this one.

    Args:
        nothing: the empty set.

    Attributes:
        active: the points whose equations are being evaluated, outermost first.
    """

    def __init__(self, nothing: _T) -> None:
        self._nothing: _T = nothing
        self.active: dict[Hashable, None] = {}
        self._found: dict[Hashable, _T | None] = {}
        self._readers: dict[Hashable, set[Hashable]] = {}
        self._settled: set[Hashable] = set()
        """Points whose sets follow from the present sets of what they read."""

    def of(self, point: Hashable, parts: Callable[[], Iterable[_T | None]]) -> _T | None:
        """The least solution for a point; while its own equation is evaluated, what has been found so far.

        Args:
            point: identifies the equation.
            parts: computes the sets whose union the point is; one that is None makes the point unbounded.
        """
        self._found.setdefault(point, self._nothing)
        while point not in self._settled and point not in self.active:
            if len(self.active) >= _DEEPEST:
                return None
            before = self._found[point]
            self._settled.add(point)
            self.active[point] = None
            for part in parts() if before is not None else ():
                self._found[point] = _united([self._found[point], part], self._nothing)  # later parts may read it
                if self._found[point] is None:
                    break
            del self.active[point]
            if self._found[point] != before:
                self._unsettle_readers(point)
        if self.active:
            self._readers.setdefault(point, set()).add(next(reversed(self.active)))
        return self._found[point]

    def _unsettle_readers(self, point: Hashable) -> None:
        """Have everything evaluated again that has read a set, directly or through others."""
        pending = [point]
        while pending:
            read = self._readers.pop(pending.pop(), set()) & self._settled
            self._settled -= read
            pending += read


def _united(parts: Iterable[_T | None], nothing: _T) -> _T | None:
    """The union of some sets; None if one of them is unbounded.

    Args:
        parts: the sets.
        nothing: the empty set.
    """
    found = nothing
    for part in parts:
        if part is None:
            return None
        found = found | part
    return found
