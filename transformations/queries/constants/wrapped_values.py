"""Where a program's numbers may leave the 16 bits of its int: variables that wrap around, and expressions whose result does.

On a board with a wider int such a variable counts on, and such a result keeps its upper bits. What decides is evidence in the
text: values that are too large or too small, and sums that nothing bounds. Nothing is said of values that come from unknown
functions. A counter that is compared with a bound and then set, or that runs in a loop of known length, is bounded.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from functools import cached_property
from math import isfinite
from operator import add, mul, sub, truediv
from typing import TypeGuard

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import all_contents, ancestor_of_kind
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.constants.declared_uses import Declared, DeclaredUses
from robosmi.transformations.queries.constants.ranges import Range, Ranges
from robosmi.transformations.queries.expression_type import FunctionType, of_use
from robosmi.transformations.queries.numbers import COMPARISONS, Machine, Number, Numbers

_GROWING = frozenset(["+", "-", "*", "<<"])
_CLOSED = _GROWING | {"&", "|", "^"}
"""Operators whose result modulo a power of two depends only on the operands modulo that power."""
_REAL_RULES: Mapping[str, Callable[[float, float], float]] = {"+": add, "-": sub, "*": mul, "/": truediv}
_MOST_NESTED = 100
"""Levels of a calculation with real numbers that are followed."""
_LOOKED_AT = (ccode.Binary, ccode.Unary, ccode.Cast, ccode.Call, ccode.ConditionalExpression)
_STEPS = frozenset(["+=", "-=", "*=", "<<="])
_BITWISE = frozenset(["|=", "^=", "&="])
_ROUNDS = 3


class WrappedValues:
    """Finds them in a program, whose files are given as views.

    Args:
        views: a view of each unit.
        here: the machine of the source.
        there: the machine of the target, whose int is wider.
        results: what functions return (see `Ranges`).
        of_operands: macros whose result has the common type of their arguments (see `Numbers`).
        of_bits: macros that write a bit of their first argument, whose number is the second.
    """

    def __init__(
        self, views: Sequence[CodeView], here: Machine, there: Machine, results: Mapping[str, tuple[int, int]],
        of_operands: Collection[str] = (), of_bits: Collection[str] = (),
    ) -> None:  # fmt: skip
        self.views, self.here, self.there, self._results = views, here, there, results
        self.of_operands, self._of_bits = of_operands, of_bits
        self._wrapping: set[int] = set()
        self.uses = DeclaredUses(views)
        self._ranges = self._made()
        for _ in range(_ROUNDS):  # what takes the value of a variable that wraps may wrap as well
            found = {id(each) for each in self._holders if self._leaves(each)}
            if found <= self._wrapping:
                break
            self._wrapping |= found
            self._ranges = self._made()

    def _made(self) -> Ranges:
        self._known_ends: dict[int, tuple[float, float] | None] = {}  # which follow from ranges
        functions = {
            each.name: FunctionType(each.entry.detail, ())
            for view in self.views
            for each in view.called().values()
            if each.entry is not None and each.entry.kind == "function"
        }
        macros = {str(m.name): str(m.body or "") for view in self.views for m in view.unit.macros if not m.functionLike}
        values = self.views[0].values
        numbers = Numbers(self.here, functions, {}, macros, self._aliases, self.of_operands, self.uses.holders)
        return Ranges(numbers, values, self.views[0].program, self._results, self._wrapping, self.uses, self._of_bits)

    @cached_property
    def _aliases(self) -> dict[str, str]:
        """The platform's types that are numbers: name -> the type of the language."""
        found = {}
        for view in self.views:
            for used in view.types():
                entry = view.resolve(used.name)
                if entry is not None and entry.detail.startswith("typedef "):
                    found[used.name] = entry.detail.removeprefix("typedef ")
        return found

    @cached_property
    def _holders(self) -> list[Declared]:
        """What is of the type int, signed or not, an array of it, or a pointer or reference to it."""
        every: list[Declared] = []
        for view in self.views:
            every += [*view.of_kind(ccode.Variable), *view.of_kind(ccode.Parameter), *view.of_kind(ccode.Field)]
        return [each for each in every if self.is_int(each.valueType)]

    def is_int(self, use: ccode.TypeUse | None) -> bool:
        """Whether a type is int or unsigned int, whose width differs, an array of it, or a pointer or reference to it."""
        number, kind = self._number_in(use), of_use(use)
        if number is None or number.real or number.fixed or kind is None or kind.function:
            return False
        return number.bits == self.here.int_bits and not kind.base.endswith("_t")

    def _number_in(self, use: ccode.TypeUse | None) -> Number | None:
        """The type of the numbers that a variable has, or points or refers to."""
        kind = of_use(use)
        if kind is not None and kind.base == "auto":
            return self._ranges.numbers.declared(use)
        if kind is None or kind.depth - kind.dimensions > (not kind.dimensions):
            return None
        base = kind.base.replace("&", "").strip()
        return self.here.number(self._aliases.get(base, base))

    @property
    def variables(self) -> list[Declared]:
        """The variables, parameters and members that may leave 16 bits, or whose numbers may, in text order."""
        return [each for each in self._holders if id(each) in self._wrapping]

    def wraps(self, holder: Element | None) -> bool:
        """Whether a variable is one of these."""
        return id(holder) in self._wrapping

    def number(self, expression: ccode.Expression | None) -> Number | None:
        """The type of an expression on the source; int where functions of the platform are combined whose results are known."""
        found = self._ranges.numbers.of(expression)
        return self.here.integer if found is None and self._of_results(expression) else found

    def joins_operands(self, expression: ccode.Expression | None) -> bool:
        """Whether an expression is the use of one of the macros whose result has the type of their arguments."""
        return self._ranges.numbers.joins_operands(expression)

    def _of_results(self, expression: ccode.Expression | None) -> bool:
        if isinstance(expression, ccode.Binary) and expression.operator in _CLOSED:
            of_right = expression.operator == "<<" or self._of_results(expression.right)
            return of_right and self._of_results(expression.left)
        return isinstance(expression, ccode.Call) and str(expression.calleeName) in self._results

    def range_of(self, expression: ccode.Expression | None) -> Range | None:
        """The range of an expression if nothing wraps within it."""
        return self._ranges.of(expression)

    # ---- variables

    def _leaves(self, holder: Declared) -> bool:
        number, points = self._number_in(holder.valueType), _points(holder)
        if number is None:
            return False
        first = None if points or isinstance(holder, ccode.Parameter) else holder.initializer
        given: list[ccode.Expression | None] = list(first.elements) if isinstance(first, ccode.InitializerList) else [first]
        for reference in self.uses.of(holder):
            written = _written(reference, within=points)
            if written is None:
                if self._writes_sign(reference, number):
                    return True
                continue
            if isinstance(written, ccode.Assignment) and written.operator == "=":
                given.append(written.right)
                if (
                    self._mentions(written.right, holder)
                    and self._grows_by(written.right, holder)
                    and not self._bounded(written, holder)
                ):
                    return True
            elif isinstance(written, ccode.Unary) or written.operator in _STEPS:
                if not self._bounded(written, holder):
                    return True
            elif isinstance(written, ccode.Assignment) and written.operator in _BITWISE:
                given.append(written.right)
        return any(self.leaves(each, number) for each in given)

    def _writes_sign(self, reference: Element, number: Number) -> bool:
        """Whether a macro writes the bit of a name or an element that is its sign on the source, or one that it lacks there.

        Any bit may be the sign where the text does not say which one.
        """
        place, call = _place(reference)
        written = isinstance(call, ccode.Call) and call.calleeName in self._of_bits and len(call.arguments) > 1
        if not written or not isinstance(call, ccode.Call) or call.arguments[0] is not place:
            return False
        bit = self._ranges.of(call.arguments[1])
        return number.signed if bit is None or not bit.given else 1 << min(max(bit.high, 0), 64) > number.most

    def leaves(self, expression: ccode.Expression | None, number: Number) -> bool:
        """Whether the value of an expression is known to lie beyond a type at times, or wraps on its way."""
        found = self._ranges.of(expression)
        if found is None:
            return self._real_leaves(expression, number) or self._changes_sign(expression, number)
        return not found.within(number.least, number.most)

    def _changes_sign(self, expression: ccode.Expression | None, number: Number) -> bool:
        """Whether a result wraps in a type of the same width that has a sign where the other has none."""
        of = self.number(expression)
        other = of is not None and not of.real and of.bits == number.bits and of.signed != number.signed
        return other and of is not None and self.exceeds(expression, of)

    def _real_leaves(self, expression: ccode.Expression | None, number: Number) -> bool:
        """Whether a real number is known to be too large or too small for a type at times: AVR keeps its lower bits."""
        of, ends = self.number(expression), self._ends(expression)
        if of is None or not of.real or ends is None:
            return False
        return not number.least <= int(ends[0]) <= int(ends[1]) <= number.most

    def _ends(self, expression: ccode.Expression | None, depth: int = 0) -> tuple[float, float] | None:
        """The least and the greatest value of a calculation with real numbers; None where the text does not say them.

        Neither are they known where it nests too deep, also by constants of constants.
        """
        if id(expression) not in self._known_ends:
            self._known_ends[id(expression)] = self._ends_of(expression, depth + 1) if depth < _MOST_NESTED else None
        return self._known_ends[id(expression)]

    def _ends_of(self, expression: ccode.Expression | None, depth: int) -> tuple[float, float] | None:
        if isinstance(expression, ccode.FloatingLiteral):
            try:
                value = float(str(expression.text).rstrip("fFlL"))
            except ValueError:  # hexadecimal, or with marks between its digits
                return None
            return (value, value) if isfinite(value) else None
        if isinstance(expression, ccode.Cast):
            return self._ends(expression.operand, depth)
        if isinstance(expression, ccode.NameReference) and isinstance(held := expression.target, ccode.Variable):
            of = self.number(expression)
            if of is not None and of.real:
                constant = held.valueType is not None and "const" in str(held.valueType.spelling).split()
                return self._ends(held.initializer, depth) if constant else None
        if not isinstance(expression, ccode.Binary) or (of := self.number(expression)) is None or not of.real:
            found = self._ranges.of(expression)
            return (found.low, found.high) if found is not None else None
        left, right = self._ends(expression.left, depth), self._ends(expression.right, depth)
        rule = _REAL_RULES.get(str(expression.operator))
        if rule is None or left is None or right is None or (expression.operator == "/" and right[0] <= 0 <= right[1]):
            return None
        every = [rule(a, b) for a in left for b in right]
        return (min(every), max(every)) if all(map(isfinite, every)) else None

    def _grows_by(self, value: ccode.Expression | None, holder: Declared) -> bool:
        """Whether an assigned value is the old one with something added, so that no range tells where it ends."""
        if self._ranges.of(value) is not None and not self.wraps(holder):
            return False
        return self._grows(value, holder)

    def _grows(self, value: ccode.Expression | None, holder: Declared) -> bool:
        while isinstance(value, (ccode.Cast, ccode.Unary)):
            value = value.operand
        if isinstance(value, ccode.ConditionalExpression):
            ways = (value.whenTrue, value.whenFalse)
        elif isinstance(value, ccode.Binary) and value.operator in ("|", "^"):
            ways = (value.left, value.right)
        else:
            return isinstance(value, ccode.Binary) and value.operator in _GROWING
        return any(self._mentions(each, holder) and self._grows(each, holder) for each in ways)

    def _bounded(self, written: ccode.Assignment | ccode.Unary, holder: Declared) -> bool:
        """Whether a loop of known length bounds a step, or a comparison that guards it or sets the variable."""
        loop = written.eContainer()
        if isinstance(loop, ccode.For) and loop.step is written:
            return self._compared(loop.condition, holder)
        if self._few_rounds(written, holder):
            return True
        for reference in self.uses.of(holder):
            comparison = reference.eContainer()
            if not isinstance(comparison, ccode.Binary) or comparison.operator not in COMPARISONS:
                continue
            if not self._compared(comparison, holder):
                continue
            decided = _decided_by(comparison)
            if decided is None:
                continue
            inside = {id(each) for each in all_contents(decided)}
            sets = (
                r
                for r in self.uses.of(holder)
                if id(r) in inside and isinstance(w := _written(r), ccode.Assignment) and w.operator == "="
            )
            if id(written) in inside or any(True for _ in sets):
                return True
        return False

    def _compared(self, condition: ccode.Expression | None, holder: Declared) -> bool:
        """Whether a condition compares a variable with a value that is known to lie within its type."""
        if isinstance(condition, ccode.Binary) and condition.operator in ("&&", "||"):
            return self._compared(condition.left, holder) or self._compared(condition.right, holder)
        if not isinstance(condition, ccode.Binary) or condition.operator not in COMPARISONS:
            return False
        number = self._number_in(holder.valueType)
        sides = (condition.left, condition.right)
        for own, other in (sides, sides[::-1]):
            if any(each is holder for each in self.uses.holders(own)) and number is not None:
                found = self._ranges.of(other)
                return found is None or found.within(number.least, number.most)
        return False

    def _few_rounds(self, written: ccode.Assignment | ccode.Unary, holder: Declared) -> bool:
        """Whether a local variable is only added to in loops of known length, by known values, and so stays within its type."""
        if not isinstance(holder, ccode.Variable) or holder.storage is ccode.Storage.staticStorage:
            return False
        function, number = ancestor_of_kind(holder, ccode.Function), self._ranges.numbers.declared(holder.valueType)
        start = self._ranges.of(holder.initializer)
        if function is None or number is None or start is None:
            return False
        low, high = start.low, start.high
        for reference in holder.references:
            step = _written(reference)
            if step is None:
                continue
            if isinstance(step, ccode.Assignment) and step.operator not in ("+=", "-="):
                return False
            added = Range(1, 1) if isinstance(step, ccode.Unary) else self._ranges.of(step.right)
            rounds = self._rounds(step, holder)
            if added is None or rounds is None:
                return False
            down = step.operator in ("-=", "--")
            least, most = (-added.high, -added.low) if down else (added.low, added.high)
            low, high = low + rounds * min(least, 0), high + rounds * max(most, 0)
        return number.least <= low and high <= number.most

    def _rounds(self, step: Element, holder: Declared) -> int | None:
        """How often a statement runs each time a variable is made; None if that is not known."""
        inside = holder.eContainer()
        while inside is not None and not isinstance(inside, (ccode.Block, ccode.Function)):
            inside = inside.eContainer()
        rounds, at = 1, step.eContainer()
        while at is not None and at is not inside:
            if isinstance(at, ccode.Loop):
                counter = at.condition.left if isinstance(at, ccode.For) and isinstance(at.condition, ccode.Binary) else None
                found = self._ranges.of(counter) if isinstance(counter, ccode.NameReference) else None
                if found is None or not found.given:
                    return None
                rounds *= max(1, found.high - found.low)
            at = at.eContainer()
        return rounds if at is inside else None

    # ---- expressions

    def exceeding(self, view: CodeView) -> Iterator[tuple[ccode.Expression, Number]]:
        """The expressions of a unit that wrap on the source where their value is looked at, with their types there."""
        for expression in view.elements:
            if not isinstance(expression, _LOOKED_AT) and not self._is_macro(expression):
                continue
            known = isinstance(expression, ccode.Call)  # not taken for an int, as in a sum
            number = self._ranges.numbers.of(expression) if known else self.number(expression)
            if number is None or number.real or number.bits != self.here.int_bits or number.fixed:
                continue
            exceeds = self.exceeds(expression, number) or self._is_widened_product(expression, number)
            if exceeds and self._looked_at(expression, number):
                yield expression, self._taken_as(expression) or number

    def _is_widened_product(self, expression: ccode.Expression, number: Number) -> bool:
        """Whether ints of which nobody knows how great they are, are multiplied, and a wider type takes the product.

        It is too late there for the bits beyond an int: the product has lost them on the source.
        """
        if not isinstance(expression, ccode.Binary) or expression.operator != "*" or self._ranges.of(expression) is not None:
            return False
        at, outer = expression, expression.eContainer()
        while isinstance(outer, ccode.Binary) and outer.operator not in COMPARISONS and self.number(outer) == number:
            at, outer = outer, outer.eContainer()
        taken = None
        if isinstance(outer, ccode.Binary) and outer.operator in COMPARISONS:
            taken = self.number(outer.left if outer.right is at else outer.right)
        elif isinstance(outer, ccode.Binary):
            taken = self.number(outer)
        elif isinstance(outer, ccode.Variable) and outer.initializer is at:
            taken = self._number_in(outer.valueType)
        elif isinstance(outer, ccode.Assignment) and outer.right is at:
            taken = self.number(outer.left)
        return taken is not None and (taken.real or taken.bits > number.bits)

    def _taken_as(self, expression: ccode.Expression) -> Number | None:
        """The int as which a function of the program returns or takes a result, which may have another sign."""
        outer, use = expression.eContainer(), None
        if isinstance(outer, ccode.Return) and ancestor_of_kind(outer, ccode.Lambda) is None:
            function = ancestor_of_kind(outer, ccode.Function)
            use = function.returnType if function is not None else None
        elif isinstance(outer, ccode.Call) and outer.callee is not None and outer.callee.definition:
            taken = zip(outer.arguments, outer.callee.parameters, strict=False)
            use = next((parameter.valueType for given, parameter in taken if given is expression), None)
        return self.here.number(str(use.spelling)) if use is not None and self.is_int(use) else None

    def returned(self, view: CodeView) -> Iterator[tuple[ccode.Expression, Number]]:
        """The results of functions of a unit that are cut to an int there, with the type of the function."""
        for statement in view.of_kind(ccode.Return):
            function, value = ancestor_of_kind(statement, ccode.Function), statement.value
            within = ancestor_of_kind(statement, ccode.Lambda)  # whose type the model does not have
            use = function.returnType if function is not None and within is None else None
            number = self.here.number(str(use.spelling)) if self.is_int(use) and use is not None else None
            of = self.number(value)
            if value is None or number is None or of is None or of.bits <= number.bits:
                continue
            if self.leaves(value, number):
                yield value, number

    def exceeds(self, expression: ccode.Expression | None, number: Number) -> bool:
        """Whether a result may have bits beyond its type on the source."""
        if isinstance(expression, ccode.Cast):
            return self._cut_off(expression, number)
        if isinstance(expression, ccode.Unary) and expression.operator in ("-", "~", "+"):
            operands = [expression.operand]
        elif isinstance(expression, ccode.Binary) and expression.operator in _CLOSED:
            operands = [expression.left] if expression.operator == "<<" else [expression.left, expression.right]
        elif isinstance(expression, ccode.ConditionalExpression):
            operands = [expression.whenTrue, expression.whenFalse]
            if not number.signed and any(map(self.may_be_negative, operands)):
                return True
        elif self._is_macro(expression) or isinstance(expression, ccode.Call):
            operands = []
            if isinstance(expression, ccode.Call) and expression.calleeName == "max" and not number.signed:
                return any(map(self.may_be_negative, expression.arguments))
        else:
            return False
        found = self._ranges.of(expression)
        if found is not None:
            return not found.within(number.least, number.most)
        if isinstance(expression, ccode.Binary) and expression.operator == "<<" and self._joins(expression, number):
            return True
        if isinstance(expression, ccode.Unary) and expression.operator in ("-", "~") and not number.signed:
            return True
        if (
            isinstance(expression, ccode.Binary)
            and expression.operator in ("+", "-", "*")
            and any(map(self._takes_all, operands))
        ):
            return True
        return any(
            self.exceeds(each, of) for each in operands if (of := self.number(each)) is not None and of.bits == number.bits
        )

    def _takes_all(self, expression: ccode.Expression | None) -> bool:
        """Whether an expression is a variable that wraps, or is of one, so that it has all values of its type."""
        holders = self.uses.holders(_object(expression))
        return bool(holders) and all(map(self.wraps, holders))

    def may_be_negative(self, expression: ccode.Expression | None) -> bool:
        """Whether an int, or what becomes one, is not known to be 0 or more."""
        of, found = self.number(expression), self._ranges.of(expression)
        return of is not None and not of.real and of.signed and of.bits <= self.here.int_bits and (found is None or found.low < 0)

    @staticmethod
    def _is_macro(expression: Element | None) -> TypeGuard[ccode.NameReference]:
        """Whether an expression is the name of a macro, whose body may calculate beyond its type."""
        return isinstance(expression, ccode.NameReference) and expression.target is None

    def _cut_off(self, cast: ccode.Cast, number: Number) -> bool:
        """Whether a cast to int cuts a wider value that is not known to fit, or a written number that does not."""
        inner, found = self.number(cast.operand), self._ranges.of(cast.operand)
        literal = cast.operand.operand if isinstance(cast.operand, ccode.Unary) else cast.operand
        written = isinstance(literal, ccode.IntegerLiteral) or self._is_macro(literal)
        if inner is not None and inner.real:
            return self._real_leaves(cast.operand, number)
        negative = not number.signed and found is not None and found.low < 0
        turned = inner is not None and number.signed and not inner.signed and inner.bits == number.bits
        wider = turned or (inner is not None and (inner.bits > number.bits or written or negative))
        return wider and (found is None or not found.within(number.least, number.most))

    def cuts(self, expression: ccode.Expression | None, number: Number) -> bool:
        """Whether a type cuts a value: it is known not to fit, or wider and not known to."""
        of, found = self.number(expression), self._ranges.of(expression)
        if of is not None and of.real:
            return self._real_leaves(expression, number)
        return not found.within(number.least, number.most) if found is not None else of is not None and of.bits > number.bits

    def _joins(self, shift: ccode.Binary, number: Number) -> bool:
        """Whether a value is shifted by half an int or more and out of it, as when two bytes are joined, or nobody knows it."""
        by, value = self._ranges.of(shift.right), self._ranges.of(shift.left)
        if by is None or not self.here.int_bits // 2 <= by.low < self.here.int_bits:
            return False
        return value is None or value.high << by.low > number.most

    def _looked_at(self, expression: ccode.Expression, number: Number) -> bool:
        """Whether the context of an expression depends on bits beyond its type on the source."""
        outer = expression.eContainer()
        if isinstance(outer, ccode.Binary) and outer.operator in _CLOSED:
            of = self.number(outer)
            same = of is not None and not of.real and of.bits == number.bits
            return not same or (outer.operator == "<<" and outer.right is expression)
        if isinstance(outer, ccode.Unary) and outer.operator in ("-", "~", "+"):
            return False
        if isinstance(outer, ccode.Assignment) and outer.right is expression:
            targets = self.uses.holders(_object(outer.left))
            return not targets or not all(map(self._cuts, targets))
        if isinstance(outer, ccode.Variable):
            return not self._cuts(outer)
        if isinstance(outer, ccode.Cast):
            to = self.there.number(str(outer.target.spelling)) if outer.target is not None else None
            return to is None or to.real or to.bits > number.bits
        return not isinstance(outer, (ccode.ExpressionStatement, ccode.For))

    def is_narrow_there(self, expression: ccode.Expression | None) -> bool:
        """Whether a name, member, element or cast has 16 bits on the target as well, where int is wider."""
        if isinstance(expression, ccode.Cast):
            kind = self.there.number(str(expression.target.spelling)) if expression.target is not None else None
            return kind is not None and not kind.real and kind.bits <= self.here.int_bits
        of = self.number(expression)
        if isinstance(expression, ccode.NameReference) and isinstance(expression.target, ccode.EnumerationLiteral):
            return of is not None and not of.signed  # an enumeration with 40000 is an unsigned int here, and an int there
        if isinstance(expression, ccode.IntegerLiteral) or self._is_macro(expression):  # 0x8000 has no sign here, and one there
            found = self._ranges.of(expression)
            return (
                of is not None
                and not of.signed
                and found is not None
                and found.high > self.here.integer.most
                and not (isinstance(expression, ccode.IntegerLiteral) and "u" in str(expression.text).lower())
            )
        holders = self.uses.holders(_object(expression))
        return bool(holders) and all(map(self._cuts, holders))

    def _cuts(self, holder: Declared) -> bool:
        """Whether what is stored in a variable is cut to 16 bits there, on the target as well."""
        if self.wraps(holder):
            return True
        kind = self._number_in(holder.valueType)
        return kind is not None and not kind.real and kind.fixed and kind.bits <= self.here.int_bits

    def _mentions(self, expression: ccode.Expression | None, holder: Declared) -> bool:
        inside = [expression, *all_contents(expression)] if expression is not None else []
        return any(holder is found for each in inside for found in self.uses.holders(each))


def _object(place: ccode.Expression | None) -> ccode.Expression | None:
    """The expression for the variable that a place is, is an element of, or is what it points to."""
    while isinstance(place, ccode.Index) or (isinstance(place, ccode.Unary) and place.operator == "*"):
        place = place.array if isinstance(place, ccode.Index) else place.operand
    return place


def _points(holder: Declared) -> bool:
    """Whether a variable is a pointer, so that its numbers are where it points."""
    return holder.valueType is not None and bool(holder.valueType.pointerDepth)


def _written(reference: Element, *, within: bool = False) -> ccode.Assignment | ccode.Unary | None:
    """The assignment or step by which a name, an element, or what a pointer points to is written; None where it is read.

    Args:
        reference: the name.
        within: whether it is a pointer, and only what it points to counts.
    """
    at, outer = _place(reference)
    if within and at is reference:
        return None
    if isinstance(outer, ccode.Assignment) and outer.left is at:
        return outer
    return outer if isinstance(outer, ccode.Unary) and outer.operator in ("++", "--") else None


def _place(reference: Element) -> tuple[Element, Element | None]:
    """The place that a name is, or whose object it names, and what contains the expression for it."""
    at: Element = reference
    outer = at.eContainer()
    while (isinstance(outer, ccode.Index) and outer.array is at) or (isinstance(outer, ccode.Unary) and outer.operator == "*"):
        at, outer = outer, outer.eContainer()
    return at, outer


def _decided_by(comparison: ccode.Binary) -> ccode.Statement | ccode.ConditionalExpression | None:
    """The statement or expression whose way a comparison decides, alone or with others."""
    at: Element = comparison
    outer = at.eContainer()
    while isinstance(outer, ccode.Binary) and outer.operator in ("&&", "||"):
        at, outer = outer, outer.eContainer()
    if isinstance(outer, (ccode.If, ccode.Loop)) and outer.condition is at:
        return outer
    return outer if isinstance(outer, ccode.ConditionalExpression) and outer.condition is at else None
