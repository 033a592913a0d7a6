"""Constant propagation through a program: which code stays reachable where values of its variables are known.

The program is traversed once, statement by statement, with the values that variables surely have: a function whose body is
still to be written returns 0, a counter that starts at 0 and never changes stays 0. Loops are iterated to a fixed point. What a
called function of the program does to a variable is not followed: its value is unknown afterwards. Functions with gotos, text
that the model does not know and what nests deeper than `DEPTH` count as reachable whatever their values.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any, TypeGuard

from robosmi.metamodels import ccode
from robosmi.model.strict import Element
from robosmi.query import all_contents
from robosmi.transformations.queries.folded_values import DEPTH, Answer, FoldedValues, Key, ReadProgram, State, join
from robosmi.transformations.queries.live_code import identity

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
                break
        return after

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
