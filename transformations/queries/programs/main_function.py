"""How `main` can be divided into what runs once and what is repeated (paper 5.3, RQ1: before the loop / its body).

`divide` looks at the statements only and says either where the endless loop is and what must move out of `main` with
it, or why the whole body has to stay in one piece, which is always correct. It decides nothing about a platform.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.query import all_contents, all_of_kind, ancestor_of_kind
from robosmi.transformations.queries.block_braces import is_torn
from robosmi.transformations.queries.programs.main_locals import (
    MovedDeclaration,
    Surroundings,
    free_name,
    locals_of,
    moved_declarations,
    outlives,
)
from robosmi.transformations.queries.programs.main_program import MainStructure, loop_exits, main_structure, own_returns


class Division(Struct, frozen=True):
    """How `main` is divided into a setup function, a loop function and what comes after.

    Attributes:
        main: the function.
        loop: its endless loop, or None when everything stays in one piece.
        before: statements that run once.
        moved: declarations before the loop of locals that it or what follows it needs.
        after: statements that run when the loop is left.
        unreachable: statements after the loop that nothing leads to.
        continues: `continue` statements of that loop.
        breaks: `break` statements of that loop.
        returns: `return` statements of main.
        after_name: name of the generated function that contains `after`, empty if there are none.
        end_name: name of the generated function in which the program stays when main has ended, empty if main does not end.
        reason: why main is divided like this, or not at all, in one sentence.
    """

    main: ccode.Function
    loop: ccode.Loop | None
    before: tuple[ccode.Statement, ...] = ()
    moved: tuple[MovedDeclaration, ...] = ()
    after: tuple[ccode.Statement, ...] = ()
    unreachable: tuple[ccode.Statement, ...] = ()
    continues: tuple[ccode.Continue, ...] = ()
    breaks: tuple[ccode.Break, ...] = ()
    returns: tuple[ccode.Return, ...] = ()
    after_name: str = ""
    end_name: str = ""
    reason: str = ""


def main_of(unit: ccode.SourceUnit) -> ccode.Function | None:
    """The unit's definition of main."""
    return next((d for d in unit.declarations if isinstance(d, ccode.Function) and d.name == "main" and d.definition), None)


def divide(main: ccode.Function, reserved: Collection[str] = (), words: Collection[str] = ()) -> Division:
    """Divide main at its endless loop if that keeps its meaning.

    Args:
        main: a function with a body.
        reserved: names that nothing at file scope may have.
        words: all words of the program, which no new name may be.
    """
    unit = ancestor_of_kind(main, ccode.SourceUnit)
    structure = main_structure(unit) if unit is not None else None
    returns = own_returns(main)
    statements = tuple(main.body.statements) if main.body else ()
    if unit is None or structure is None or structure.loop is None:
        return Division(main, None, statements, returns=returns, reason="main has no endless loop")
    loop, before = structure.loop, structure.before
    breaks = tuple(e for e in loop_exits(loop) if isinstance(e, ccode.Break))
    after = tuple(structure.after) if breaks else ()
    hoisted = [v for v in locals_of(before) if v in structure.hoisted or outlives(v) or _used_in(v, after)]
    around = Surroundings(main, unit, reserved, words, _runs_again(before))
    moved, reason = moved_declarations(hoisted, around)
    reason = _obstacle(structure) or reason
    if reason:
        return Division(main, None, statements, returns=returns, reason=f"main stays in one piece: {reason}")
    kept = tuple(r for r in returns if breaks or not _used_in(r, structure.after))
    taken = {*words, *reserved}
    return Division(
        main,
        loop,
        tuple(before),
        moved,
        after,
        () if breaks else tuple(structure.after),
        tuple(c for c in all_of_kind(loop, ccode.Continue) if ancestor_of_kind(c, ccode.Loop) is loop),
        breaks,
        kept,
        free_name("after_loop", taken) if after else "",
        free_name("end_of_main", taken) if breaks or kept else "",
        "main is divided at its endless loop",
    )


def _used_in(element: ccode.Located, statements: Collection[ccode.Statement]) -> bool:
    """Whether a variable is referenced in these statements, or another element lies in them."""
    places = element.references if isinstance(element, ccode.Variable) else (element,)
    return any(s.startOffset <= place.startOffset < s.endOffset for place in places for s in statements)


def _obstacle(structure: MainStructure) -> str:
    """Why the loop cannot be taken out of main, or an empty text."""
    main, loop = structure.function, structure.loop
    unit = ancestor_of_kind(main, ccode.SourceUnit)
    assert unit is not None
    assert loop is not None
    if reason := _jumps(structure):
        return reason
    if isinstance(loop.body, ccode.Block) and is_torn(loop.body):
        return f"a macro writes more than a brace of the loop in line {loop.line}"
    expanded = [(use.startOffset, use.endOffset) for use in unit.macroUses]
    for leaving in (*loop_exits(loop), *own_returns(main), *all_of_kind(loop, ccode.Continue)):
        if any(start <= leaving.startOffset < end for start, end in expanded):
            return f"a macro leaves the loop in line {leaving.line}"
    if isinstance(loop, ccode.For) and loop.initial is not None:
        return f"the loop in line {loop.line} has an initial clause"
    if isinstance(loop, ccode.For) and loop.step is not None:
        return f"the loop in line {loop.line} has a step"
    for statement in structure.before:
        if isinstance(statement, ccode.DeclarationStatement) and not all(
            isinstance(d, (ccode.Variable, ccode.Function)) for d in statement.declarations
        ):
            return f"line {statement.line} declares a type"
    if line := _torn(unit, main, loop):
        return f"the conditional directive in line {line} would be split"
    taken = {d.name for d in unit.declarations} | {m.name for m in unit.macros}
    names = {p.name for p in main.parameters if p.references}
    return f"its parameter '{min(names & taken)}' hides a name at file scope" if names & taken else ""


def _jumps(structure: MainStructure) -> str:
    """Which jump leads from one part of main to another, or an empty text."""
    loop = [structure.loop] if structure.loop is not None else []
    parts: dict[str, list[ccode.Statement]] = {"before": structure.before, "in": [*loop], "behind": structure.after}
    labels = {
        str(inner.name): part
        for part, statements in parts.items()
        for statement in statements
        for inner in (statement, *all_contents(statement))
        if isinstance(inner, ccode.Label)
    }
    for part, statements in parts.items():
        for statement in statements:
            for inner in (statement, *all_contents(statement)):
                if isinstance(inner, ccode.Goto) and labels.get(str(inner.labelName)) != part:
                    return f"line {inner.line} jumps to '{inner.labelName}', which is not {part} its loop"
                if isinstance(inner, ccode.UnknownStatement):
                    return f"line {inner.line} is an unknown statement"
    return ""


def _runs_again(before: Iterable[ccode.Statement]) -> bool:
    """Whether statements may run more than once: a label stands among them."""
    return any(isinstance(inner, ccode.Label) for s in before for inner in (s, *all_contents(s)))


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
