"""What a compiler that sees the whole program keeps of a plan's code, found in two rounds of constant folding.

In the first round, functions whose body is still to be written return 0, and values of local variables are known. In the
second, global variables that nothing changes count as numbers, and variables that nothing reads are left out with the
expressions stored in them. `memory` counts the result.

A call without effect has a known value. A placeholder, whose body is still to be written, returns 0. An adapter that is called
for a port without a pin does nothing and returns 0, or the number that its text returns early with. An adapter whose text does
anything else first is left out.

`FoldedCode` propagates constants: it traverses the program once, statement by statement, with the values that variables surely
have, so that a counter that starts at 0 and never changes stays 0. Loops are iterated to a fixed point. What a called function of
the program does to a variable is not followed: its value is unknown afterwards. Functions with gotos, text that the model does
not know and what nests deeper than `DEPTH` count as reachable whatever their values.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cached_property
from typing import Any, TypeGuard

from msgspec import Struct

from robosmi.metamodels import ccode, migration, platform
from robosmi.model.elements.strict import Element
from robosmi.query import all_contents, all_of_kind
from robosmi.transformations.queries.constants.folded_values import (
    DEPTH,
    PURE,
    Answer,
    FoldedValues,
    Key,
    ReadProgram,
    State,
    join,
)
from robosmi.transformations.queries.flows.pointed_calls import pointed_calls
from robosmi.transformations.queries.names import named_type
from robosmi.transformations.queries.programs.live_code import identity, in_macros, is_global
from robosmi.transformations.queries.values import Values

_COUNTS = ("++", "--")
_VALUE = re.compile(r"^(?:const \w+ \w+ =|#define \w+) (?P<number>-?(?:0x[0-9A-Fa-f]+|0|[1-9]\d*))L?;?$")
"""A definition that gives a name of the platform a number on the target."""


class CompiledCode(Struct, dict=True):
    """What a compiler keeps of a program.

    Attributes:
        elements: the reachable elements of the code model.
        ignored: `id` of each expression whose value the compiler never needs.
        fixed: each variable that nothing changes -> its number, None where that is not known.
        unread: variables that nothing reads.
        answers: `id` of each call without effect -> what it returns.
        arguments: `id` of each call -> the values of its arguments, None for an unknown one.
    """

    elements: list[Element]
    ignored: set[int]
    fixed: dict[Key, int | None] = {}
    unread: set[Key] = set()
    answers: dict[int, int] = {}
    arguments: dict[int, list[int | None]] = {}

    @cached_property
    def pointed(self) -> dict[int, list[ccode.Function]]:
        """The functions that each call through a pointer may reach, by the identity of the call."""
        return pointed_calls(self.elements)


def compiled_code(plan: migration.MigrationPlan, program: ReadProgram, *, pins: bool = True) -> CompiledCode:
    """What a compiler keeps of a plan's program.

    Args:
        plan: the plan, complete.
        program: the facts about the plan's program.
        pins: whether the compiler can see that a port has no pin, and so drops calls for it.
    """
    answers = unwritten_calls(plan) | (calls_at_no_pin(plan) if pins else {})
    ignored = {id(each) for use in plan.adapterUses for each in ignored_arguments(use, answers)} | set(answers)
    moved = {id(v) for d in plan.dispositions if d.hoisted is not None for v in declared_in(d.element)}

    names = _names(plan)

    def answer(call: ccode.Call) -> int | None:
        return answers.get(id(call))

    first = FoldedCode(program, answer, {}, moved, names)
    ignored = _with_unused(first, ignored, moved)
    uses = uses_of(first.elements, ignored)
    named = in_macros(program.units)
    lasting = [v for v in first.elements if isinstance(v, ccode.Variable) and _lasts(v, moved) and str(v.name) not in named]
    fixed: dict[Key, int | None] = {}
    unread: set[Key] = set()
    for variable in lasting:
        references = uses.get(identity(variable), [])
        ways = {way(each) for each in references}
        if is_volatile(variable) or "address" in ways:
            continue
        begins = variable.initializer is not None and id(variable) in moved and not _is_number(variable.initializer)
        if not begins and not ways & {"written", "both"}:
            fixed[identity(variable)] = _first_value(variable, program.values)
        elif not any(id(each) in first.loads for each in references):
            unread.add(identity(variable))
    second = FoldedCode(program, answer, fixed, moved, names)
    for each in second.elements:
        if isinstance(each, ccode.Assignment) and isinstance(each.left, ccode.NameReference):
            target = each.left.target
            if isinstance(target, ccode.Variable) and identity(target) in unread:
                ignored.add(id(each.right))
    return CompiledCode(second.elements, _with_unused(second, ignored, moved), fixed, unread, answers, second.arguments)


def _names(plan: migration.MigrationPlan) -> dict[str, int]:
    """Names of the platform -> the number that each has on the target; names without a plain number are left out."""
    found = {}
    for use in plan.symbolUses:
        text = str(use.placeholder or "") or (str(use.adapter.text) if use.adapter is not None else "")
        if value := _VALUE.search(text):
            found[str(use.name)] = int(value["number"], 0)
    return found


def _lasts(variable: ccode.Variable, moved: set[int]) -> bool:
    return is_global(variable) or id(variable) in moved or variable.storage.name == "staticStorage"


def _first_value(variable: ccode.Variable, values: Values | None) -> int | None:
    """The number that a variable begins with; None for an array and for a number that the text does not give."""
    if variable.valueType is None or variable.valueType.arrayDims or isinstance(variable.valueType.declaration, ccode.Record):
        return None
    if variable.initializer is None:
        return 0
    found = values.of(variable.initializer) if values is not None else []
    return found[0].number if len(found) == 1 else None


def _is_number(initializer: ccode.Expression) -> bool:
    return not any(isinstance(each, (ccode.NameReference, ccode.Call)) for each in (initializer, *initializer.eAllContents()))


def uses_of(elements: Iterable[Element], ignored: set[int]) -> dict[Key, list[ccode.NameReference]]:
    """The references to each variable, except those within expressions that are ignored.

    Args:
        elements: the reachable elements.
        ignored: `id` of each expression whose value the compiler never needs.
    """
    uses: dict[Key, list[ccode.NameReference]] = {}
    for element in elements:
        if not isinstance(element, ccode.NameReference) or is_ignored(element, ignored):
            continue
        if isinstance(element.target, ccode.Variable):
            uses.setdefault(identity(element.target), []).append(element)
    return uses


def _with_unused(code: FoldedCode, ignored: set[int], moved: set[int]) -> set[int]:
    """The ignored expressions, with those added whose values go only to local variables and parameters that nothing reads."""
    found = set(ignored)
    locals_ = [e for e in code.elements if isinstance(e, (ccode.Variable, ccode.Parameter)) and not _stays(e, moved)]
    inside = {id(e) for e in code.elements}
    needed = {  # the references that make a variable needed
        id(each): {id(r) for r in each.references if id(r) in inside and not is_ignored(r, found) and way(r) not in _UNREAD}
        for each in locals_
        if each.valueType is not None and not is_volatile(each)
    }
    waiting = [each for each in locals_ if needed.get(id(each)) == set()]
    while waiting:
        for given in _given(waiting.pop(), inside):
            if given is None or id(given) in found:
                continue
            found.add(id(given))
            for reference in (given, *given.eAllContents()):
                target = reference.target if isinstance(reference, ccode.NameReference) else None
                left = needed.get(id(target), set())
                if id(reference) in left and is_ignored(reference, found):  # type: ignore[arg-type]
                    left.discard(id(reference))
                    if not left:
                        waiting.append(target)  # type: ignore[arg-type]
    return found


_UNREAD = ("written", "size")
"""Ways in which a reference does not read its variable (see `way`)."""


def _stays(declaration: ccode.Variable | ccode.Parameter, moved: set[int]) -> bool:
    return isinstance(declaration, ccode.Variable) and _lasts(declaration, moved)


def _given(declaration: ccode.Variable | ccode.Parameter, inside: set[int]) -> Iterator[ccode.Expression | None]:
    """The expressions that are assigned or passed to a local variable or a parameter."""
    if isinstance(declaration, ccode.Variable):
        if declaration.initializer is not None:
            yield declaration.initializer
    else:
        function = declaration.eContainer()
        if isinstance(function, ccode.Function) and not function.references:
            number = list(function.parameters).index(declaration)
            yield from (call.arguments[number] for call in function.calls if number < len(call.arguments))
    for reference in declaration.references:
        container = reference.eContainer()
        if isinstance(container, ccode.Assignment) and container.left is reference and container.operator == "=":
            yield container.right


def declared_in(element: Element | None) -> Iterable[ccode.Variable]:
    """The variables that an element declares, itself or within it."""
    if isinstance(element, ccode.Variable):
        return [element]
    return all_of_kind(element, ccode.Variable) if element is not None else []


def is_volatile(declaration: ccode.Variable | ccode.Parameter) -> bool:
    """Whether a variable itself is volatile, not only what it points to."""
    spelling = str(declaration.valueType.spelling or "") if declaration.valueType is not None else ""
    return "volatile" in spelling.rpartition("*")[2]


# ---- what is done at a place


def is_ignored(reference: ccode.Expression, ignored: set[int]) -> bool:
    """Whether an expression is only part of an ignored one, with no assignment, counting or impure call in between."""
    element: Element | None = reference
    while isinstance(element, ccode.Expression):
        if id(element) in ignored:
            return True
        changes = isinstance(element, ccode.Assignment) or (isinstance(element, ccode.Unary) and element.operator in _COUNTS)
        if changes or (isinstance(element, ccode.Call) and str(element.calleeName) not in PURE):
            return False
        element = element.eContainer()
    return False


def way(reference: ccode.NameReference) -> str:
    """How a reference uses its variable: "read", "written", "both", "size" (in sizeof), "address" (its address is taken), or
    "any" (an array element is read whose index is not a literal).
    """
    element: Element = reference
    indexed = False
    container = element.eContainer()
    while (isinstance(container, ccode.Index) and container.array is element) or isinstance(container, ccode.Member):
        indexed = indexed or (isinstance(container, ccode.Index) and not isinstance(container.index, ccode.IntegerLiteral))
        element, container = container, container.eContainer()
    if isinstance(container, ccode.SizeOf):
        return "size"
    if isinstance(container, ccode.Unary) and container.operator == "&":
        return "address"
    if isinstance(container, ccode.Unary) and container.operator in _COUNTS:
        return "written" if isinstance(container.eContainer(), (ccode.ExpressionStatement, ccode.For)) else "both"
    if isinstance(container, ccode.Assignment) and container.left is element:
        return "written" if isinstance(container.eContainer(), (ccode.ExpressionStatement, ccode.For)) else "both"
    use = named_type(reference)
    if use is not None and use.arrayDims and element is reference:
        return "address"
    return "any" if indexed else "read"


# ---- calls without effect

_UNUSED = re.compile(r"\(void\)\s*\w+\s*;")
_BEGINNING = (
    r"\{\s*(?:\w+ \w+\(\w+\);\s*)?(?:\w+(?:\(\w+\))?\.(?:drive|set)\([^;]*\);\s*)*"
    r"(?:if \((?>(?>[^;]*?\.wired\(\))[^;]*\) return)(?: (?P<given>-?\d+)| [^;]+)?;|return \w+(?:\(\w+\))?\.\w+\(\);|(?P<end>\}))"
)
"""How a body begins that does nothing when its port has no pin: it returns early, or only reads that pin."""
_CALLED = re.compile(r"\w+(?=\()")
_DEFINED = re.compile(r"\((?>(?P<parameters>[^{;]*)\))[^{;]*\{(?P<body>.*)", re.DOTALL)
"""The rest of a function's definition behind its name."""
_HANDED_ON = re.compile(r"\{\s*(?:return )?(?P<name>\w+)\([^;]*\);\s*\}")


def unwritten_calls(plan: migration.MigrationPlan) -> dict[int, int]:
    """The `id` of each call of a function that has no body yet -> the value that it returns, 0."""
    return {id(call): 0 for use in plan.adapterUses if use.adapter is None for call in use.calls}


def calls_at_no_pin(plan: migration.MigrationPlan) -> dict[int, int]:
    """The `id` of each call that does nothing because its port has no pin -> the value that it returns."""
    found: dict[int, int] = {}
    idle = {id(call) for flow in plan.portFlows if _nowhere(flow) for call in flow.calls}
    idle -= {id(call) for flow in plan.portFlows if not _nowhere(flow) for call in flow.calls}
    for use in plan.adapterUses:
        calls = [call for call in use.calls if id(call) in idle]
        given = _given_without_pin(use.adapter) if calls and use.adapter is not None else None
        if given is not None:
            found |= {id(call): given for call in calls}
    return found


def _nowhere(flow: migration.PortFlow) -> bool:
    """Whether no port of a flow has a pin of the target; False when the flow may carry other numbers too."""
    return flow.choice == "target" and not flow.anything and bool(flow.bindings) and all(_no_pin(b) for b in flow.bindings)


def _no_pin(binding: migration.PortBinding) -> bool:
    return binding.pin is None and (binding.connection is None or binding.connection.pin is None)


def _given_without_pin(piece: platform.Adapter) -> int | None:
    """What an adapter returns when its port has no pin, if it does nothing else then; None if it may do more."""
    name, text = re.escape(str(piece.targetName or piece.name)), str(piece.text)
    found = re.search(rf"\b{name}\([^{{;]*\)\s*{_BEGINNING}", text)
    if found is not None:
        return int(found["given"] or 0)
    handed = re.search(rf"\b{name}\([^{{;]*\)\s*{_HANDED_ON.pattern}", text)
    needed = next((each for each in piece.needs if handed is not None and each.name == handed["name"]), None)
    return _given_without_pin(needed) if needed is not None else None


def ignored_arguments(use: migration.AdapterUse, answers: Mapping[int, int]) -> Iterator[ccode.Expression]:
    """The arguments that an adapter ignores: all of a call without effect, else those whose parameter its text never names.

    Args:
        use: the use of the adapter.
        answers: the `id` of each call without effect -> what it returns.
    """
    names = None if use.adapter is None else _parameters(str(use.adapter.text), str(use.adapter.targetName or use.adapter.name))
    for call in use.calls:
        for number, argument in enumerate(call.arguments):
            if id(call) in answers or names is None or (number < len(names) and not names[number]):
                yield argument


def _parameters(text: str, name: str) -> list[bool]:
    """For each parameter of an adapter, whether its body names it; empty if the text does not define the function."""
    found = next(
        filter(None, (_DEFINED.match(text, word.end()) for word in _CALLED.finditer(text) if word.group() == name)), None
    )
    if found is None:
        return []
    body = set(re.findall(r"\w+", _UNUSED.sub("", found["body"])))
    depth, parts = 0, [""]
    for character in found["parameters"]:
        depth += (character == "(") - (character == ")")
        if character == "," and not depth:
            parts.append("")
        else:
            parts[-1] += character
    return [bool(body & set(re.findall(r"\w+", part))) for part in parts]


# ---- constant propagation

_NESTED = 5
"""Nesting of loops above which a loop is traversed once, with no values known at its head: nested rounds multiply."""
_ROUNDS = 4
"""Rounds of a loop after which no values are taken to be known at its head, if there is no fixed point before."""


class FoldedCode(FoldedValues):
    """The statements of a program that are reachable where some values are known; see `FoldedValues`."""

    def __init__(
        self,
        program: ReadProgram,
        answers: Answer,
        known: Mapping[Key, int | None],
        lasting: Iterable[Key] = (),
        names: Mapping[str, int] | None = None,
    ) -> None:
        super().__init__(program, answers, known, lasting, names)
        self._breaks: list[list[State]] = []
        self._continues: list[list[State]] = []
        while self.pending:
            self._start(self.pending.pop())

    def _start(self, declaration: Element) -> None:
        self.see(declaration)
        if isinstance(declaration, ccode.Function):
            for parameter in declaration.parameters:
                self.see(parameter)
            body = declaration.body
            if body is not None and any(isinstance(e, (ccode.Goto, ccode.Label)) for e in all_contents(body)):
                self.whatever(body)
            elif body is not None:
                self._run(body, {})
        else:
            self.whatever(declaration)

    # ---- statements

    def _run(self, statement: ccode.Statement | None, state: State) -> State | None:
        """Evaluate a statement.

        Returns:
            The values after it; None if control never leaves it at its end.
        """
        if statement is None:  # what the reader could not tell
            return state
        if self.depth > DEPTH:
            self.whatever(statement, state)
            return state
        self.depth += 1
        method = _STATEMENTS.get(type(statement).__name__)
        self.see(statement)
        if method is None:
            self.whatever(statement, state)
            result: State | None = state
        else:
            result = method(self, statement, state)
        self.depth -= 1
        return result

    def _block(self, block: ccode.Block, state: State) -> State | None:
        after: State | None = state
        for statement in block.statements:
            after = self._run(statement, after) if after is not None else None
            if after is None:
                return None
        self._leave_scope(block.statements, after)
        return after

    def _leave_scope(self, statements: Iterable[ccode.Statement | None], state: State | None) -> None:
        """Forget the variables that statements declare in their block, except those that live as long as the program."""
        if state is None:
            return
        for statement in statements:
            for declaration in statement.declarations if isinstance(statement, ccode.DeclarationStatement) else ():
                if isinstance(declaration, ccode.Variable) and not self.lasts(declaration):
                    state.pop(identity(declaration), None)

    def _expression(self, statement: ccode.ExpressionStatement, state: State) -> State:
        self.value(statement.expression, state)
        return state

    def _declared(self, statement: ccode.DeclarationStatement, state: State) -> State:
        for declaration in statement.declarations:
            self.see(declaration)
            if not isinstance(declaration, ccode.Variable):
                self.whatever(declaration)
            elif self.lasts(declaration) and declaration.storage.name == "staticStorage":
                if declaration.initializer is not None:
                    self.whatever(declaration.initializer)
            else:
                value = self.value(declaration.initializer, state) if declaration.initializer is not None else None
                if declaration.initializer is not None:
                    self.set_(declaration, value, state)
        return state

    def _return(self, statement: ccode.Return, state: State) -> None:
        self.value(statement.value, state)

    def _break(self, _: ccode.Break, state: State) -> None:
        if self._breaks:
            self._breaks[-1].append(state)

    def _continue(self, _: ccode.Continue, state: State) -> None:
        if self._continues:
            self._continues[-1].append(state)

    def _if(self, statement: ccode.If, state: State) -> State | None:
        for first in (statement.initial, statement.declaration):
            if first is not None:
                self._run(first, state)
        value = self.value(statement.condition, state)
        taken = self._run(statement.thenBranch, dict(state)) if value is None or value else None
        if value is not None and value:
            return taken
        other = dict(state)
        left = self._run(statement.elseBranch, other) if statement.elseBranch is not None else other
        return join([taken, left])

    def _loop(self, loop: ccode.Loop, state: State) -> State | None:
        if isinstance(loop, ccode.For) and loop.initial is not None:
            self._run(loop.initial, state)
        after = self._rounds(loop, state)
        if isinstance(loop, ccode.For):
            self._leave_scope([loop.initial], after)
        return after

    def _rounds(self, loop: ccode.Loop, state: State) -> State | None:
        """Evaluate the rounds of a loop up to a fixed point: the values where it is left."""
        if loop.declaration is not None or (isinstance(loop, ccode.For) and loop.range is not None):
            self.whatever(loop, state)
            return state
        head = self._at_head(loop, state) if len(self._breaks) < _NESTED else {}
        for number in range(_ROUNDS + 1):
            leaving, again = self._once(loop, dict(head))
            joined = join([head, again])
            if joined is None or joined == head:
                return leaving
            head = joined if number < _ROUNDS - 1 else {}
        return leaving

    def _once(self, loop: ccode.Loop, state: State) -> tuple[State | None, State | None]:
        """Evaluate one round of a loop: the values where the loop is left, and those with which its next round begins."""
        self._breaks.append([])
        self._continues.append([])
        exits: list[State | None] = []
        after: State | None = state
        asks_first = not isinstance(loop, ccode.DoWhile)
        if asks_first:
            after = self._asked(loop, state, exits)
        if after is not None:
            after = join([self._run(loop.body, after) if loop.body is not None else after, *self._continues[-1]])
        if after is not None and isinstance(loop, ccode.For) and loop.step is not None:
            self.value(loop.step, after)
        if after is not None and not asks_first:
            after = self._asked(loop, after, exits)
        self._continues.pop()
        return join([*exits, *self._breaks.pop()]), after

    def _asked(self, loop: ccode.Loop, state: State, exits: list[State | None]) -> State | None:
        """Evaluate a loop's condition.

        Returns:
            The state in which the body is entered, None if it never is; the state in which the loop may end is added to
                `exits`.
        """
        value = self.value(loop.condition, state) if loop.condition is not None else 1
        if not value:
            exits.append(dict(state))
        return None if value == 0 and value is not None else state

    def _at_head(self, loop: ccode.Loop, state: State) -> State:
        """The state at a loop's head, valid in all rounds: without variables in memory that may change in the loop."""
        changed: set[Key] = set()
        for each in all_contents(loop):
            if isinstance(each, ccode.Call) and not self.harmless(each):
                return {key: value for key, value in state.items() if not self.in_memory(key)}
            target = each.left if isinstance(each, ccode.Assignment) else each.operand if _counts(each) else None
            if isinstance(target, ccode.NameReference) and isinstance(target.target, ccode.Variable):
                changed.add(identity(target.target))
        return {key: value for key, value in state.items() if key not in changed or not self.in_memory(key)}

    def _switch(self, switch: ccode.Switch, state: State) -> State | None:
        for first in (switch.initial, switch.declaration):
            if first is not None:
                self._run(first, state)
        chosen = self.value(switch.selector, state)
        body = switch.body
        cases = list(body.statements) if isinstance(body, ccode.Block) else []
        inner = sum(isinstance(e, (ccode.Case, ccode.Default)) for e in all_contents(switch))
        if body is None or not cases or inner != sum(len(_labels(each)) for each in cases):
            self.whatever(switch, state)
            return state
        self.see(body)
        numbers = {
            id(label): self.value(label.constant, {}) for e in cases for label in _labels(e) if isinstance(label, ccode.Case)
        }
        matched = chosen is not None and chosen in numbers.values()
        unsure = chosen is None or None in numbers.values()
        self._breaks.append([])
        after: State | None = None
        default = False
        for each in cases:
            labels = _labels(each)
            for label in labels:
                self.see(label)
                is_default = isinstance(label, ccode.Default)
                default = default or is_default
                if unsure or (is_default and not matched) or (not is_default and numbers[id(label)] == chosen):
                    after = join([after, dict(state)])
            inside = labels[-1].statement if labels else each
            if after is not None and inside is not None:
                after = self._run(inside, after)
        past = None if default or (matched and not unsure) else state
        return join([after, past, *self._breaks.pop()])


_STATEMENTS: dict[str, Callable[[FoldedCode, Any, State], State | None]] = {
    "Block": FoldedCode._block,
    "ExpressionStatement": FoldedCode._expression,
    "DeclarationStatement": FoldedCode._declared,
    "Return": FoldedCode._return,
    "Break": FoldedCode._break,
    "Continue": FoldedCode._continue,
    "If": FoldedCode._if,
    "While": FoldedCode._loop,
    "DoWhile": FoldedCode._loop,
    "For": FoldedCode._loop,
    "Switch": FoldedCode._switch,
    "EmptyStatement": lambda _self, _statement, state: state,
}


def _labels(statement: ccode.Statement | None) -> list[ccode.Case | ccode.Default]:
    """The case labels that a statement begins with, outermost first."""
    found: list[ccode.Case | ccode.Default] = []
    while isinstance(statement, (ccode.Case, ccode.Default)):
        found.append(statement)
        statement = statement.statement
    return found


def _counts(element: Element) -> TypeGuard[ccode.Unary]:
    return isinstance(element, ccode.Unary) and element.operator in ("++", "--")
