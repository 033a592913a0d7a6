"""What a compiler that sees the whole program keeps of a plan's code, found in two rounds of constant folding.

In the first round, functions whose body is still to be written return 0, and values of local variables are known. In the
second, global variables that nothing changes count as numbers, and variables that nothing reads are left out with the
expressions stored in them. `memory` counts the result; values within the code are computed by `folded_code`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import cached_property

from msgspec import Struct

from robosmi.metamodels import ccode, migration
from robosmi.model.strict import Element
from robosmi.query import all_of_kind
from robosmi.transformations.queries.answered_calls import calls_at_no_pin, ignored_arguments, unwritten_calls
from robosmi.transformations.queries.folded_code import FoldedCode
from robosmi.transformations.queries.folded_values import PURE, Key, ReadProgram
from robosmi.transformations.queries.live_code import identity, in_macros, is_global
from robosmi.transformations.queries.names import named_type
from robosmi.transformations.queries.pointed_calls import pointed_calls
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
    locals_ = [e for e in locals_ if e.valueType is not None and not is_volatile(e)]
    inside = {id(e) for e in code.elements}
    while True:
        before = len(found)
        for each in locals_:
            live = [r for r in each.references if id(r) in inside and not is_ignored(r, found)]
            if all(way(r) in ("written", "size") for r in live):
                found.update(id(given) for given in _given(each, inside))
        if len(found) == before:
            return found


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
