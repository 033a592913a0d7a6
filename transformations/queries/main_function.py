"""How `main` can be divided into what runs once and what is repeated (paper 4, RQ1: before the loop / its body).

`divide` looks at the statements only and says either where the endless loop is and what must move out of `main` with
it, or why the whole body has to stay in one piece, which is always correct. It decides nothing about a platform.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable
from dataclasses import dataclass

from robosmi.metamodels import ccode
from robosmi.query import all_contents, all_of_kind, ancestor_of_kind
from robosmi.transformations.queries.expression_type import declared_with_others
from robosmi.transformations.queries.main_program import MainStructure, main_structure


@dataclass(frozen=True)
class Division:
    """How main is divided.

    Attributes:
        main: the function.
        loop: its endless loop, or None when everything stays in one piece.
        before: statements that run once.
        hoisted: locals declared before the loop and used in it.
        split: those of `hoisted` whose initial value is not constant, so that it is assigned where it was declared.
        unreachable: statements after the loop that nothing leads to.
        continues: `continue` statements of that loop.
        returns: `return` statements of main.
        reason: why it is so, one sentence.
    """

    main: ccode.Function
    loop: ccode.Loop | None
    before: tuple[ccode.Statement, ...] = ()
    hoisted: tuple[ccode.Variable, ...] = ()
    split: tuple[ccode.Variable, ...] = ()
    unreachable: tuple[ccode.Statement, ...] = ()
    continues: tuple[ccode.Continue, ...] = ()
    returns: tuple[ccode.Return, ...] = ()
    reason: str = ""


def main_of(unit: ccode.SourceUnit) -> ccode.Function | None:
    """The unit's definition of main."""
    return next((d for d in unit.declarations if isinstance(d, ccode.Function) and d.name == "main" and d.definition), None)


def divide(main: ccode.Function, reserved: Collection[str] = ()) -> Division:
    """Divide main at its endless loop if that keeps its meaning.

    Args:
        main: a function with a body.
        reserved: names that nothing at file scope may have.
    """
    unit = ancestor_of_kind(main, ccode.SourceUnit)
    structure = main_structure(unit) if unit is not None else None
    returns = tuple(all_of_kind(main, ccode.Return))
    if structure is None or structure.loop is None:
        statements = tuple(main.body.statements) if main.body else ()
        return Division(main, None, statements, returns=returns, reason="main has no endless loop of its own")
    loop, before, after = structure.loop, structure.before, structure.after
    hoisted = tuple(v for v in _locals(before) if v in structure.hoisted or _outlives(v))
    if reason := _obstacle(structure, hoisted, reserved):
        statements = tuple(main.body.statements) if main.body else ()
        return Division(main, None, statements, returns=returns, reason=f"main stays in one piece: {reason}")
    return Division(
        main,
        loop,
        tuple(before),
        hoisted,
        tuple(v for v in hoisted if v.initializer is not None and not is_constant(v.initializer)),
        tuple(after),
        tuple(c for c in all_of_kind(loop, ccode.Continue) if ancestor_of_kind(c, ccode.Loop) is loop),
        returns,
        "main is divided at its endless loop",
    )


def _locals(statements: Iterable[ccode.Statement]) -> list[ccode.Variable]:
    """The variables that these statements themselves declare."""
    declared = (d for s in statements if isinstance(s, ccode.DeclarationStatement) for d in s.declarations)
    return [d for d in declared if isinstance(d, ccode.Variable)]


def _outlives(variable: ccode.Variable) -> bool:
    """Whether something may point to the variable when setup is over: its address is taken, or it is an array handed on."""
    if variable.storage.name == "staticStorage":
        return False
    array = variable.valueType is not None and bool(variable.valueType.arrayDims)
    for use in variable.references:
        container = use.eContainer()
        if isinstance(container, ccode.Unary) and container.operator == "&":
            return True
        if isinstance(container, (ccode.Index, ccode.Member)) and _address_taken(container):
            return True
        if array and not isinstance(container, (ccode.Index, ccode.SizeOf)):
            return True
    return False


def _address_taken(expression: object) -> bool:
    while isinstance(expression, (ccode.Index, ccode.Member)):
        expression = expression.eContainer()
    return isinstance(expression, ccode.Unary) and expression.operator == "&"


def _obstacle(structure: MainStructure, hoisted: Iterable[ccode.Variable], reserved: Collection[str]) -> str:
    """Why the loop cannot be taken out of main, or an empty text."""
    main, loop = structure.function, structure.loop
    if structure.exits:
        return f"its loop is left in line {structure.exits[0].line}"
    for statement in structure.before:
        for inner in all_contents(statement):
            if isinstance(inner, (ccode.Return, ccode.Goto, ccode.Label)):
                return f"line {inner.line} may leave it before the loop"
    if isinstance(loop, ccode.For) and loop.initial is not None:
        return f"the loop in line {loop.line} has an initial clause"
    if isinstance(loop, ccode.For) and loop.step is not None:
        return f"the loop in line {loop.line} has a step"
    for statement in structure.before:
        if isinstance(statement, ccode.DeclarationStatement) and not all(
            isinstance(d, (ccode.Variable, ccode.Function)) for d in statement.declarations
        ):
            return f"line {statement.line} declares a type"
    unit = ancestor_of_kind(main, ccode.SourceUnit)
    if unit is not None and loop is not None and (line := _torn(unit, main, loop)):
        return f"the conditional directive in line {line} would be torn apart"
    taken = {d.name for d in unit.declarations} | {m.name for m in unit.macros} if unit else set()
    for variable in hoisted:
        if reason := _stays(variable, taken) or _needs_macro(variable, unit, main):
            return reason
        if variable.name in reserved:
            return f"'{variable.name}' at file scope would clash with a name of the target"
    names = {p.name for p in main.parameters if p.references}
    return f"it uses its parameter '{min(names)}'" if names else ""


def _torn(unit: ccode.SourceUnit, main: ccode.Function, loop: ccode.Loop) -> int:
    """Line of a conditional directive in main whose branches would come into different functions, 0 for none."""
    body = main.body
    inner = loop.body if isinstance(loop.body, ccode.Block) else loop
    assert body is not None
    ranges = ((body.startOffset, loop.startOffset), (inner.startOffset, inner.endOffset), (loop.endOffset, body.endOffset))
    for directive in unit.conditionals:
        if body.startOffset <= directive.startOffset < body.endOffset and not any(
            a <= directive.startOffset < b for a, b in ranges
        ):
            return int(directive.line)
    for start, end in ranges:
        depth = 0
        for directive in unit.conditionals:
            if start <= directive.startOffset < end:
                depth += directive.directive in ("if", "ifdef", "ifndef")
                if depth == 0:
                    return int(directive.line)
                depth -= directive.directive == "endif"
        if depth:
            return int(loop.line)
    return 0


def _stays(variable: ccode.Variable, taken: set[str]) -> str:
    """Why a local cannot become a global, or an empty text."""
    use = variable.valueType
    declared = use.declaration if use is not None else None
    if variable.name in taken:
        return f"'{variable.name}' would hide the global of that name"
    if declared_with_others(variable):
        return f"line {variable.line} declares '{variable.name}' together with other names"
    if use is not None and use.arrayDims and not _constant_size(variable):
        return f"the size of '{variable.name}' is not constant"
    if use is not None and use.arrayDims and variable.initializer is not None and not is_constant(variable.initializer):
        return f"the array '{variable.name}' has values that are not constant"
    if declared is not None and ancestor_of_kind(declared, ccode.Function) is not None:
        return f"the type of '{variable.name}' is declared in main"
    return ""


def _needs_macro(variable: ccode.Variable, unit: ccode.SourceUnit | None, main: ccode.Function) -> str:
    """Why a local cannot move in front of main: a macro that is defined only in main is used in it."""
    end = variable.endOffset
    if variable.initializer is not None and not is_constant(variable.initializer):
        end = variable.initializer.startOffset  # that stays where it is
    for use in unit.macroUses if unit is not None else ():
        defined = use.macro
        if defined is not None and main.startOffset <= defined.startOffset and variable.startOffset <= use.startOffset < end:
            return f"line {variable.line} uses the macro '{use.name}', which is defined in main"
    return ""


def _constant_size(variable: ccode.Variable) -> bool:
    """Whether an array's size may be written at file scope: it is made of numbers and of names of no variable."""
    use, unit = variable.valueType, ancestor_of_kind(variable, ccode.SourceUnit)
    assert use is not None
    first, _, rest = use.arrayDims.partition("]")
    if not first.strip("[ ") and variable.initializer is None:
        return False
    names = set(re.findall(r"[A-Za-z_]\w*", use.arrayDims))
    if not names:
        return re.search(r"\[\s*\]", rest) is None
    variables = {
        d.name
        for d in (all_contents(unit) if unit is not None else ())
        if isinstance(d, (ccode.Variable, ccode.Parameter)) and not _constant_name(d)
    }
    return "sizeof" not in names and not names & variables


def is_constant(expression: ccode.Expression) -> bool:
    """Whether an expression may stand as the initial value of a global: literals, constants and operators on them."""
    for inner in all_contents(expression):
        if isinstance(inner, (ccode.Call, ccode.Assignment, ccode.UnknownExpression, ccode.Member, ccode.Index)):
            return False
        if isinstance(inner, ccode.Unary) and inner.operator in ("++", "--", "*"):
            return False
        if isinstance(inner, ccode.NameReference) and not _constant_name(inner.target):
            return False
    return True


def _constant_name(target: ccode.Declaration | None) -> bool:
    """Whether a name stands for the same value everywhere in the file."""
    if isinstance(target, ccode.EnumerationLiteral):
        return True
    if isinstance(target, ccode.Variable) and isinstance(target.eContainer(), ccode.SourceUnit):
        return bool(
            target.valueType and target.valueType.constant and target.initializer is not None and is_constant(target.initializer)
        )
    return False
