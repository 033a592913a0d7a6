"""Code of other cores as coroutines on one: which loops must yield, how many coroutines run at once, and their stacks.

A coroutine runs until it waits, so a loop that waits for another coroutine must yield to it. Which functions wait is data of
the platform and of its adapters; the rest is read off the code model. `m2m.partition.platform_dependence` makes the plan's
decisions from this.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Sequence

from robosmi.metamodels import ccode, migration, platform
from robosmi.model.elements.strict import Element
from robosmi.query import all_contents, all_of_kind, ancestor_of_kind
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.flows.call_chains import FRAME, Taken, deepest_chain
from robosmi.transformations.queries.flows.cores import reached, written
from robosmi.transformations.queries.plans.plan_adapters import closure
from robosmi.transformations.queries.programs.main_program import main_function
from robosmi.transformations.queries.values import Values

MOST = 7
"""Cores besides the one of main."""
_WAITS = re.compile(r"\b(?:yield|delay)\s*\(")
_SCALAR, _UNKNOWN = 4, 16
"""Bytes of stack: of a value, of a value of unknown size."""


def giving_way(views: Sequence[CodeView], uses: Iterable[migration.AdapterUse]) -> set[str]:
    """Names of the platform's functions that wait and whose adapters let others get on meanwhile.

    Args:
        views: a view of each unit.
        uses: the adapters of a plan.
    """
    blocking = {name for view in views for name in view.called() if view.api.meaning(name).get("blocking")}
    return {str(use.name) for use in uses if use.adapter is not None and use.name in blocking and waits(use.adapter)}


def waits(adapter: platform.Adapter) -> bool:
    """Whether the text of an adapter, or of a piece it needs, calls `yield` or `delay`, during which other coroutines run."""
    return any(_WAITS.search(str(piece.text)) for piece in closure([adapter]))


class Waiting:
    """Tells which statements are certain to wait on every path, so that other coroutines get to run.

    Args:
        waiting: names of the platform's functions that wait and let other coroutines run meanwhile.
    """

    def __init__(self, waiting: Collection[str]) -> None:
        self._waiting = frozenset(waiting)
        self._known: dict[int, bool] = {}

    def waits(self, statement: ccode.Statement | None) -> bool:
        """Whether a statement has waited at least once on every path by which it completes."""
        if statement is None:
            return False
        if isinstance(statement, ccode.Block):
            for inner in statement.statements:
                if self.waits(inner):
                    return True
                if any(isinstance(e, (ccode.Continue, ccode.Goto)) for e in (inner, *all_contents(inner))):
                    return False
            return False
        if isinstance(statement, ccode.If):
            both = statement.elseBranch is not None and self.waits(statement.thenBranch) and self.waits(statement.elseBranch)
            return both or self.calls(statement.condition)
        if isinstance(statement, ccode.DoWhile):
            return self.waits(statement.body)
        if isinstance(statement, ccode.Loop):
            return self.calls(statement.condition) or (isinstance(statement, ccode.For) and self.calls(statement.initial))
        if isinstance(statement, (ccode.ExpressionStatement, ccode.DeclarationStatement, ccode.Return)):
            return self.calls(statement)
        return False

    def calls(self, element: Element | None) -> bool:
        """Whether an expression contains a call that waits."""
        if element is None:
            return False
        return any(isinstance(e, ccode.Call) and self._call(e) for e in (element, *all_contents(element)))

    def _call(self, call: ccode.Call) -> bool:
        callee = call.callee
        if callee is None or callee.body is None:
            return str(call.calleeName) in self._waiting
        known = self._known.get(id(callee))
        if known is None:
            self._known[id(callee)] = False  # a function that calls itself
            known = self._known[id(callee)] = self.waits(callee.body)
        return known


def gives_way(loop: ccode.Loop, waiting: Waiting) -> bool:
    """Whether a loop lets other coroutines run in each round, or need not: its own code changes what its condition reads."""
    step = loop.step if isinstance(loop, ccode.For) else None
    if waiting.waits(loop.body) or waiting.calls(loop.condition) or waiting.calls(step):
        return True
    if loop.endless or loop.condition is None:
        return False
    inside = reached([loop.condition, loop.body, step])
    changed = written(inside)
    condition = [loop.condition, *all_contents(loop.condition)]
    names = [e.target for e in condition if isinstance(e, ccode.NameReference)]
    return any(isinstance(v, (ccode.Variable, ccode.Parameter)) and _changes(v, inside, changed) for v in names)


def _changes(variable: ccode.Declaration, inside: Iterable[Element], changed: Mapping[int, ccode.Declaration]) -> bool:
    """Whether the elements of a loop assign, count or take the address of a variable of its condition."""
    if id(variable) in changed:
        return True
    for element in inside:
        target = element.left if isinstance(element, ccode.Assignment) else None
        if isinstance(element, ccode.Unary) and element.operator in ("++", "--", "&"):
            target = element.operand
        if isinstance(target, ccode.NameReference) and target.target is variable:
            return True
    return False


def starts_at_once(calls: Sequence[ccode.Call], ends: Collection[str]) -> tuple[int, list[str]]:
    """How many started coroutines may run beside main at once, at most `MOST`, and the reasons for the number.

    Args:
        calls: the calls that start code on another core.
        ends: names of functions that end such code, or wait for its end.
    """
    total, why = 0, []
    counted = set[int]()
    for call in calls:
        count = _times(call, ends, ())
        variable = _ended_before(call, calls, ends)
        if variable is not None:  # of all of these one runs
            count = int(id(variable) not in counted)
            counted.add(id(variable))
        total += count
        if count > 1:
            why.append(f"line {call.line} may start {min(count, MOST)}")
    return max(1, min(total, MOST)), why


def _ended_before(call: ccode.Call, calls: Sequence[ccode.Call], ends: Collection[str]) -> ccode.Variable | None:
    """The variable that keeps what a call starts, if each such start comes after a call that ends what it kept before."""
    kept = _keeper(call)
    if kept is None:
        return None
    names = {each.calleeName for each in calls}
    assigned = (each for r in kept.references if isinstance(each := r.eContainer(), ccode.Assignment) and each.left is r)
    if any(not isinstance(each.right, ccode.Call) or each.right.calleeName not in names for each in assigned):
        return None  # what it keeps may be something else
    return kept if all(_ends_first(each, kept, ends) for each in calls if _keeper(each) is kept) else None


def _keeper(call: ccode.Call) -> ccode.Variable | None:
    """The variable that a plain assignment stores a call's result in, None for any other call."""
    around = call.eContainer()
    target = around.left if isinstance(around, ccode.Assignment) and around.operator == "=" and around.right is call else None
    variable = target.target if isinstance(target, ccode.NameReference) else None
    return variable if isinstance(variable, ccode.Variable) else None


def _ends_first(call: ccode.Call, kept: ccode.Variable, ends: Collection[str]) -> bool:
    """Whether what a variable keeps is ended earlier in the block of a start, with no other start in between."""
    statement = ancestor_of_kind(call, ccode.ExpressionStatement)
    block = statement.eContainer() if statement is not None else None
    ended = False
    for each in block.statements if isinstance(block, ccode.Block) else ():
        if each is statement:
            break
        for inner in all_contents(each):
            if isinstance(inner, ccode.Assignment) and isinstance(inner.left, ccode.NameReference) and inner.left.target is kept:
                ended = False
            if isinstance(inner, ccode.Call) and inner.calleeName in ends and isinstance(each, ccode.ExpressionStatement):
                names = (e for e in all_contents(inner) if isinstance(e, ccode.NameReference))
                ended = ended or any(name.target is kept for name in names)
    return ended


def _times(element: Element, ends: Collection[str], above: tuple[int, ...]) -> int:
    """How many unfinished starts one call may leave: the product of the trip counts of its loops times its callers, at most
    `MOST`. A loop that also ends such code counts once.
    """
    function = ancestor_of_kind(element, ccode.Function)
    count = 1
    loop = ancestor_of_kind(element, ccode.Loop)
    while loop is not None:
        ended = any(isinstance(e, ccode.Call) and e.calleeName in ends for e in reached([loop.body]))
        count *= 1 if ended else _trips(loop) or MOST
        around = loop.eContainer()
        loop = ancestor_of_kind(around, ccode.Loop) if around is not None else None
    if function is None or id(function) in above or function.name == "main":
        return min(count, MOST)
    callers = sum(_times(call, ends, (*above, id(function))) for call in function.calls)
    return min(count * max(callers, 1), MOST)


def _trips(loop: ccode.Loop) -> int:
    """How often a loop with a counter and constant bounds is carried out; 0 where that is not known."""
    if not isinstance(loop, ccode.For) or loop.condition is None:
        return 0
    unit = ancestor_of_kind(loop, ccode.SourceUnit)
    if unit is None or unit.program is None:
        return 0
    references = [e for e in all_contents(loop) if isinstance(e, ccode.NameReference) and isinstance(e.target, ccode.Variable)]
    changed = written([loop.step, *all_contents(loop.step)]) if loop.step is not None else {}
    inside = loop.body
    for reference in references:
        if id(reference.target) in changed and inside is not None and _within(reference, inside):
            values = Values(unit.program, unit).of(reference)
            numbers = {v.number for v in values if v.number is not None}
            return len(numbers) if numbers and all(v.number is not None for v in values) else 0
    return _counted(loop)


def _counted(loop: ccode.For) -> int:
    """The trips of `for (i = A; i < B; i++)` with literals."""
    condition = loop.condition
    literals = [e.value for e in all_of_kind(loop.initial, ccode.IntegerLiteral)] if loop.initial is not None else []
    if not isinstance(condition, ccode.Binary) or condition.operator not in ("<", "<=", "!=") or len(literals) != 1:
        return 0
    if not isinstance(condition.right, ccode.IntegerLiteral):
        return 0
    return max(0, int(condition.right.value) - int(literals[0]) + (condition.operator == "<="))


def _within(element: ccode.Located, container: ccode.Located | None) -> bool:
    return container is not None and bool(container.startOffset <= element.startOffset < container.endOffset)


def stack_bytes(function: ccode.Function, adapters: Mapping[str, int]) -> int:
    """How many bytes of stack a function takes with all that it calls, as far as the model tells.

    Args:
        function: the function.
        adapters: name of a function of the platform -> bytes that its adapter takes.

    What calls itself, directly or through others, is counted once.
    """
    if function.body is None:
        return 0

    def taken_by(at: ccode.Function) -> Taken:
        inside = list(all_contents(at.body)) if at.body is not None else []
        calls = [call for call in inside if isinstance(call, ccode.Call)]
        own = [call.callee for call in calls if call.callee is not None and call.callee.body is not None]
        others = [adapters.get(str(c.calleeName), FRAME) for c in calls if c.callee is None or c.callee.body is None]
        return Taken(FRAME + local_bytes(inside), own, max(others, default=0))

    return deepest_chain(function, taken_by)


def local_bytes(elements: Iterable[Element]) -> int:
    """How many bytes the local variables among some elements take."""
    return sum(_size(e) for e in elements if isinstance(e, ccode.Variable) and e.storage.name != "staticStorage")


def _size(variable: ccode.Variable) -> int:
    use = variable.valueType
    if use is None:
        return _UNKNOWN
    count = 1
    for size in re.findall(r"\[([^\]]*)\]", use.arrayDims or ""):
        count *= int(size) if size.strip().isdecimal() else _UNKNOWN
    if use.pointerDepth:
        return 2 * count
    return count * (max(1, int(use.bits) // 8) if use.bits else _SCALAR)


def loops_of(view: CodeView) -> list[ccode.Loop]:
    """The loops of a unit in its functions, in text order."""
    return sorted(view.of_kind(ccode.Loop), key=lambda loop: int(loop.startOffset))


def main_loop(view: CodeView) -> ccode.Loop | None:
    """The first endless loop directly in the unit's main."""
    main = main_function(view.unit)
    statements = main.body.statements if main is not None and main.body is not None else ()
    return next((s for s in statements if isinstance(s, (ccode.While, ccode.For)) and s.endless), None)
