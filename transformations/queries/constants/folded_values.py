"""Constant folding of expressions where values of a program's variables are partly known.

What a called function of the program does to a variable is not followed: its value is unknown afterwards. The reachable
elements are collected on the way. Statements, and what a compiler keeps of a program, are handled in `compiled_code`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import all_contents
from robosmi.transformations.queries.macros.constant_text import calculate
from robosmi.transformations.queries.programs.live_code import beginnings, identity, is_global, leads_to, what_is_defined
from robosmi.transformations.queries.values import Values

Key = int | str
State = dict[Key, int | None]
"""The variables whose values a compiler has at hand (in a register or as a constant) at a point of the program: the number,
None if unknown. A variable that is not in it has to be read from memory.
"""
Answer = Callable[[ccode.Call], int | None]
"""What a call returns if it is known to change nothing; None for any other call."""

DEPTH = 120
"""Nesting depth below which code counts as reachable, whatever its values."""
_OCTET = 8
PURE = frozenset([
    "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "sqrt", "pow", "exp", "log", "log10", "floor",
    "ceil", "fabs", "fmod", "abs", "labs", "hypot", "round", "strlen", "strcmp", "strncmp", "strchr", "strrchr", "strstr",
    "memcmp", "isdigit", "isalpha", "isspace", "toupper", "tolower", "atoi", "atof", "atol",
])  # fmt: skip
"""Functions of the C library without side effects on variables."""


class ReadProgram:
    """Facts about a program that do not depend on values, computed once for several rounds of folding.

    Args:
        units: the program's units.

    Attributes:
        defined: name -> the function definition, or the global variable without static storage.
        beginnings: the roots of reachability: main, and the variables that macros name.
        values: the values that the text itself gives; None if there is no program.
    """

    def __init__(self, units: Sequence[ccode.SourceUnit]) -> None:
        self.units = units
        self.defined = what_is_defined(units)
        self.beginnings = beginnings(units)
        program = units[0].program if units else None
        self.values = Values(program, units[0]) if program is not None else None


class FoldedValues:
    """Evaluates expressions with the known values; collects the reachable elements and the names that are read from memory.

    Args:
        program: the facts about the program.
        answers: what calls return that change nothing.
        known: values of variables that never change, by `live_code.identity`; None for one that is no integer.
        lasting: `id` of each local variable that lives as long as the program.
        names: numbers that names of the platform have on the target.

    Attributes:
        elements: the reachable elements, in no particular order.
        loads: `id` of each name whose value is read from memory.
        arguments: `id` of each call -> the values of its arguments, None for an unknown one.
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
        self._stored_in_memory: set[Key] = set()
        self.depth = 0
        self._values = program.values

    def see(self, element: Element) -> None:
        """Mark an element as reachable and put the functions and global variables that it names on the work list."""
        if id(element) in self.seen:
            return
        self.seen.add(id(element))
        self.elements.append(element)
        for led in leads_to(element, self._defined):
            if id(led) not in self._started:
                self._started.add(id(led))
                self.pending.append(led)

    def whatever(self, element: Element, state: State | None = None) -> None:
        """Mark all of an element as reachable, its names as read, in unknown order; `state` forgets all values."""
        for each in (element, *all_contents(element)):
            self.see(each)
            if isinstance(each, ccode.NameReference):
                self.loads.add(id(each))
        if state is not None:
            state.clear()

    # ---- expressions

    def value(self, expression: ccode.Expression | None, state: State) -> int | None:
        """Evaluate an expression in a state, which is updated by its side effects: its value, None if unknown."""
        if expression is None:
            return None
        if self.depth > DEPTH:
            self.whatever(expression, state)
            return None
        self.depth += 1
        self.see(expression)
        method = _EXPRESSIONS.get(type(expression).__name__)
        result = method(self, expression, state) if method is not None else self._parts(expression, state)
        self.depth -= 1
        return result

    def _parts(self, expression: ccode.Expression, state: State) -> int | None:
        """Evaluate the operands of an expression whose own value is not computed; always None."""
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
        """The number that the text gives a name (a constant, enumerator or macro); None if it gives none or several."""
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
        """Evaluate an lvalue without reading it: only the indices and pointers that its address depends on."""
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
        """Assign a variable in `state` if it is tracked; the value that it then has, None if unknown."""
        if self._tracked(variable):
            value = _fitting(value, variable.valueType)
            key = identity(variable)
            state[key] = value
            if self.in_memory(key):
                self._stored_in_memory.add(key)
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
        self.arguments[id(call)] = [one if one == other else None for one, other in zip(before, given, strict=True)]
        if not self.harmless(call):
            for key in state.keys() & self._stored_in_memory:
                del state[key]
        return answer

    def harmless(self, call: ccode.Call) -> bool:
        """Whether a call changes no variable of the program."""
        return self._answers(call) is not None or (
            str(call.calleeName) in PURE and (call.callee is None or call.callee.body is None)
        )

    # ---- variables

    def lasts(self, variable: ccode.Variable) -> bool:
        """Whether a variable lives as long as the generated program: a global, a `static` or one moved out of main."""
        return is_global(variable) or variable.storage.name == "staticStorage" or identity(variable) in self._lasting

    def in_memory(self, key: Key) -> bool:
        """Whether a called function may change a tracked variable: a global, or a local moved out of main."""
        return isinstance(key, str) or key in self._lasting

    def _tracked(self, variable: ccode.Variable) -> bool:
        """Whether a variable's value is tracked: a number or pointer, not static or volatile, whose address is not taken."""
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
        """Whether a reference takes the address of its variable, other than as an argument of a call without effect."""
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
    """Lattice join where control-flow paths meet: keeps the variables that all reached paths have, with None for the value of
    one on which they differ. A path of None is not reached; the result is None if no path is.
    """
    there = [state for state in states if state is not None]
    if not there:
        return None
    first, *others = there
    joined = dict(first)
    for other in others:
        if joined != other:
            for key, _ in joined.items() - other.items():  # few, and found without a step of Python for each variable
                if key in other:
                    joined[key] = None
                else:
                    del joined[key]
    return joined


def _calculated(operator: str, left: int | None, right: int | None) -> int | None:
    if left is None or right is None or (operator == "/" and right and left % right):
        return None  # which may be of fractions
    return calculate(operator, left, right)


def _fitting(value: int | None, use: ccode.TypeUse | None) -> int | None:
    """The value if the type, 16 bits wide where its width is not known, holds it as a signed number; None if it may wrap."""
    bits = int(use.bits) if use is not None and use.bits and not use.pointerDepth else 2 * _OCTET
    return value if value is not None and -(1 << bits - 1) <= value < 1 << bits - 1 else None


def _is_array(variable: ccode.Variable) -> bool:
    return bool(variable.valueType is not None and variable.valueType.arrayDims)


def _is_constant(variable: ccode.Variable) -> bool:
    return bool(variable.valueType is not None and variable.valueType.constant and not variable.valueType.pointerDepth)
