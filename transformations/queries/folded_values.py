"""What expressions of a program give and change where the values of its variables are partly known.

What a function that the program calls does to a variable is not followed: then its value is not known. What is carried out is
kept as it is met. Statements, and what a compiler leaves of a program, are `folded_code`'s.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from robosmi.metamodels import ccode
from robosmi.model.strict import Element
from robosmi.query import all_contents
from robosmi.transformations.queries.constant_text import calculate
from robosmi.transformations.queries.live_code import beginnings, identity, is_global, leads_to, what_is_defined
from robosmi.transformations.queries.values import Values
from robosmi.typed import class_name, paired

Key = int | str
State = dict[Key, int | None]
"""Variables whose value is at hand: the number where it is known, None where it is not but need not be read from memory."""
Answer = Callable[[ccode.Call], int | None]
"""What a call gives and changes nothing else; None where that is not known."""

DEPTH = 120
"""What nests deeper counts as carried out, whatever its values."""
_OCTET = 8
PURE = frozenset([
    "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "sqrt", "pow", "exp", "log", "log10", "floor",
    "ceil", "fabs", "fmod", "abs", "labs", "hypot", "round", "strlen", "strcmp", "strncmp", "strchr", "strrchr", "strstr",
    "memcmp", "isdigit", "isalpha", "isspace", "toupper", "tolower", "atoi", "atof", "atol",
])  # fmt: skip
"""Functions of the C library that change no variable."""


class ReadProgram:
    """What is found out of a program once, however often it is gone through.

    Args:
        units: of the program.

    Attributes:
        defined: name -> the function with that body, or the variable that several files may declare.
        beginnings: what is carried out or named whatever else is.
        values: those that its text gives; None for no program.
    """

    def __init__(self, units: Sequence[ccode.SourceUnit]) -> None:
        self.units = units
        self.defined = what_is_defined(units)
        self.beginnings = beginnings(units)
        program = units[0].program if units else None
        self.values = Values(program, units[0]) if program is not None else None


class FoldedValues:
    """Expressions of a program, the values that they have, and what of them is carried out and reads memory.

    Args:
        program: the program.
        answers: what calls give, where that is known.
        known: values of variables that never change, by `live_code.identity`; None for one that is no whole number.
        lasting: identities of local variables that last as long as the program.
        names: values of names of the platform.

    Attributes:
        elements: what may be carried out, in no order.
        loads: identities of the names whose values are read from memory.
        arguments: identity of a call -> the values of its arguments, None for those that are not known.
    """

    def __init__(
        self,
        program: ReadProgram,
        answers: Answer,
        known: Mapping[Key, int | None],
        lasting: Iterable[Key] = (),
        names: Mapping[str, int] | None = None,
    ) -> None:
        self.elements: list[Element] = []
        self.loads: set[int] = set()
        self.arguments: dict[int, list[int | None]] = {}
        self._names = names or {}
        self._answers, self._known, self._lasting = answers, known, frozenset(lasting)
        self.seen: set[int] = set()
        self._defined = program.defined
        self.pending = list(program.beginnings)
        self._started = {id(each) for each in self.pending}
        self._trackable: dict[int, bool] = {}
        self.depth = 0
        self._values = program.values

    def see(self, element: Element) -> None:
        """Something may be carried out; so may what it leads to."""
        if id(element) in self.seen:
            return
        self.seen.add(id(element))
        self.elements.append(element)
        for led in leads_to(element, self._defined):
            if id(led) not in self._started:
                self._started.add(id(led))
                self.pending.append(led)

    def whatever(self, element: Element, state: State | None = None) -> None:
        """All in an element may be carried out, in any order."""
        for each in (element, *all_contents(element)):
            self.see(each)
            if isinstance(each, ccode.NameReference):
                self.loads.add(id(each))
        if state is not None:
            state.clear()

    # ---- expressions

    def value(self, expression: ccode.Expression | None, state: State) -> int | None:
        """Evaluate an expression: its value where that is known."""
        if expression is None:
            return None
        if self.depth > DEPTH:
            self.whatever(expression, state)
            return None
        self.depth += 1
        self.see(expression)
        method = _EXPRESSIONS.get(class_name(expression))
        result = method(self, expression, state) if method is not None else self._parts(expression, state)
        self.depth -= 1
        return result

    def _parts(self, expression: ccode.Expression, state: State) -> int | None:
        """Evaluate all that stands in an expression of which no value is asked."""
        for part in expression.eContents:
            if isinstance(part, ccode.Expression):
                self.value(part, state)
            else:
                self.whatever(part)
        return None

    def _literal(self, literal: ccode.IntegerLiteral | ccode.CharacterLiteral, _: State) -> int:
        return int(literal.value)

    def _measured(self, measured: ccode.SizeOf, _: State) -> None:
        for each in all_contents(measured):
            self.see(each)

    def _name(self, reference: ccode.NameReference, state: State) -> int | None:
        target = reference.target
        if isinstance(target, ccode.Variable):
            key = identity(target)
            if key in state:
                return state[key]
            if key in self._known and not _is_array(target):
                return self._known[key]
            self.loads.add(id(reference))
            return self._text(reference) if _is_constant(target) else None
        if target is None or isinstance(target, (ccode.EnumerationLiteral, ccode.ExternalSymbol)):
            known = self._names.get(str(reference.name))
            return known if known is not None else self._text(reference)
        return None

    def _text(self, reference: ccode.NameReference) -> int | None:
        """The value that the text gives a name."""
        found = self._values.of(reference) if self._values is not None else []
        return found[0].number if len(found) == 1 else None

    def _assignment(self, assignment: ccode.Assignment, state: State) -> int | None:
        value = self.value(assignment.right, state)
        if assignment.operator != "=":
            before = self.value(assignment.left, state)
            value = _calculated(str(assignment.operator)[:-1], before, value)
        elif isinstance(assignment.left, ccode.NameReference):
            self.see(assignment.left)
        else:
            self._place(assignment.left, state)
        return self._store(assignment.left, value, state)

    def _place(self, expression: ccode.Expression | None, state: State) -> None:
        """Find out where something lies, without reading it."""
        if expression is None:  # what the reader could not tell
            return
        if self.depth > DEPTH:
            self.whatever(expression, state)
            return
        self.see(expression)
        self.depth += 1
        if isinstance(expression, ccode.Member) and not expression.arrow:
            self._place(expression.object, state)
        elif isinstance(expression, ccode.Index):
            array = expression.array
            plain = (
                isinstance(array, ccode.NameReference) and isinstance(array.target, ccode.Variable) and _is_array(array.target)
            )
            if plain or isinstance(array, ccode.Member):
                self._place(array, state)
            else:
                self.value(array, state)
            self.value(expression.index, state)
        elif not isinstance(expression, ccode.NameReference):
            self._parts(expression, state)
        self.depth -= 1

    def _store(self, left: ccode.Expression | None, value: int | None, state: State) -> int | None:
        if isinstance(left, ccode.NameReference) and isinstance(left.target, ccode.Variable):
            return self.set_(left.target, value, state)
        return None

    def set_(self, variable: ccode.Variable, value: int | None, state: State) -> int | None:
        """Give a variable a value, and tell what it has then."""
        if self._tracked(variable):
            value = _fitting(value, variable.valueType)
            state[identity(variable)] = value
            return value
        return None

    def _unary(self, unary: ccode.Unary, state: State) -> int | None:
        operator = str(unary.operator)
        if operator == "&":
            self._place(unary.operand, state)
            return None
        value = self.value(unary.operand, state)
        if operator in ("++", "--"):
            changed = None if value is None else value + (1 if operator == "++" else -1)
            stored = self._store(unary.operand, changed, state)
            return value if unary.postfix else stored
        change = _CHANGES.get(operator)
        return change(value) if change is not None and value is not None else None

    def _binary(self, binary: ccode.Binary, state: State) -> int | None:
        operator = str(binary.operator)
        left = self.value(binary.left, state)
        if operator not in ("&&", "||"):
            right = self.value(binary.right, state)
            zero = operator in ("&", "*") and 0 in (left, right)
            return 0 if zero else _calculated(operator, left, right)
        if left is not None and bool(left) == (operator == "||"):
            return int(bool(left))
        other = dict(state)
        right = self.value(binary.right, other)
        both = join([state, other]) if left is None else other
        state.clear()
        state.update(both or {})
        if right is None:
            return None
        return int(bool(right)) if left is not None or bool(right) == (operator == "||") else None

    def _conditional(self, conditional: ccode.ConditionalExpression, state: State) -> int | None:
        value = self.value(conditional.condition, state)
        if value is not None:
            return self.value(conditional.whenTrue if value else conditional.whenFalse, state)
        other = dict(state)
        first, second = self.value(conditional.whenTrue, state), self.value(conditional.whenFalse, other)
        both = join([dict(state), other]) or {}
        state.clear()
        state.update(both)
        return first if first == second else None

    def _cast(self, cast: ccode.Cast, state: State) -> int | None:
        return _fitting(self.value(cast.operand, state), cast.target)

    def _call(self, call: ccode.Call, state: State) -> int | None:
        answer = self._answers(call)
        if call.callee is None and call.calleeExpression is not None:
            self.value(call.calleeExpression, state)
        given = [self.value(argument, state) for argument in call.arguments]
        before = self.arguments.get(id(call), given)
        self.arguments[id(call)] = [one if one == other else None for one, other in paired(before, given)]
        if not self.harmless(call):
            for key in [key for key in state if self.in_memory(key)]:
                del state[key]
        return answer

    def harmless(self, call: ccode.Call) -> bool:
        """Whether a call changes no variable."""
        return self._answers(call) is not None or (
            str(call.calleeName) in PURE and (call.callee is None or call.callee.body is None)
        )

    # ---- variables

    def lasts(self, variable: ccode.Variable) -> bool:
        """Whether a variable lasts as long as the program."""
        return is_global(variable) or variable.storage.name == "staticStorage" or identity(variable) in self._lasting

    def in_memory(self, key: Key) -> bool:
        """Whether a variable is one that functions which are called may change."""
        return isinstance(key, str) or key in self._lasting

    def _tracked(self, variable: ccode.Variable) -> bool:
        """Whether the value of a variable is followed: a number or a pointer whose address nothing takes."""
        found = self._trackable.get(id(variable))
        if found is None:
            found = self._trackable[id(variable)] = self._is_tracked(variable)
        return found

    def _is_tracked(self, variable: ccode.Variable) -> bool:
        use = variable.valueType
        if use is None or use.arrayDims or "volatile" in str(use.spelling or "") or variable.storage.name == "staticStorage":
            return False
        number = bool(use.pointerDepth) or not isinstance(use.declaration, ccode.Record)
        return number and not any(self._addressed(reference) for reference in variable.references)

    def _addressed(self, reference: ccode.NameReference) -> bool:
        """Whether the address of a variable is taken, for more than a call that does nothing with it."""
        element: Element = reference
        container = element.eContainer()
        while isinstance(container, (ccode.Member, ccode.Index, ccode.Cast)):
            element, container = container, container.eContainer()
        if not isinstance(container, ccode.Unary) or container.operator != "&":
            return False
        around = container.eContainer()
        while isinstance(around, ccode.Cast):
            around = around.eContainer()
        return not (isinstance(around, ccode.Call) and self._answers(around) is not None)


_CHANGES: dict[str, Callable[[int], int]] = {
    "-": lambda v: -v,
    "+": lambda v: v,
    "~": lambda v: ~v,
    "!": lambda v: int(not v),
}
_EXPRESSIONS: dict[str, Callable[[FoldedValues, Any, State], int | None]] = {
    "IntegerLiteral": FoldedValues._literal,
    "CharacterLiteral": FoldedValues._literal,
    "SizeOf": FoldedValues._measured,
    "NameReference": FoldedValues._name,
    "Assignment": FoldedValues._assignment,
    "Unary": FoldedValues._unary,
    "Binary": FoldedValues._binary,
    "ConditionalExpression": FoldedValues._conditional,
    "Cast": FoldedValues._cast,
    "Call": FoldedValues._call,
}


def join(states: Iterable[State | None]) -> State | None:
    """What holds on all ways that meet; None where there is none."""
    there = [state for state in states if state is not None]
    if not there:
        return None
    first, *others = there
    return {
        key: value if all(other[key] == value for other in others) else None
        for key, value in first.items()
        if all(key in other for other in others)
    }


def _calculated(operator: str, left: int | None, right: int | None) -> int | None:
    if left is None or right is None or (operator == "/" and right and left % right):
        return None  # which may be of fractions
    return calculate(operator, left, right)


def _fitting(value: int | None, use: ccode.TypeUse | None) -> int | None:
    """A value that a type holds; None where it may become another."""
    bits = int(use.bits) if use is not None and use.bits and not use.pointerDepth else 2 * _OCTET
    return value if value is not None and -(1 << bits - 1) <= value < 1 << bits - 1 else None


def _is_array(variable: ccode.Variable) -> bool:
    return bool(variable.valueType is not None and variable.valueType.arrayDims)


def _is_constant(variable: ccode.Variable) -> bool:
    return bool(variable.valueType is not None and variable.valueType.constant and not variable.valueType.pointerDepth)
