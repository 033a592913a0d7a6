"""The structure of `main`: its endless loop, the statements before and after it, the locals that the loop needs.

Platforms whose programs have a setup and a loop function instead of main need these facts (paper 3.4). The plan decides what is
done with them.
"""

from __future__ import annotations

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.query import all_contents, all_of_kind


class LoopExit(Struct):
    """A way out of the loop: break, return or goto, and its line."""

    kind: str
    line: int


class MainStructure(Struct):
    """The parts of `main`.

    Attributes:
        function: main itself.
        loop: the first endless while or for directly in main's body, or None.
        before, after: main's statements before and after the loop; without a loop all are in `before`.
        hoisted: locals declared before the loop and used in it.
        exits: ways out of the loop.
    """

    function: ccode.Function
    loop: ccode.Loop | None = None
    before: list[ccode.Statement] = []
    after: list[ccode.Statement] = []
    hoisted: list[ccode.Variable] = []
    exits: list[LoopExit] = []

    @property
    def loop_kind(self) -> str | None:
        """while, for, or None without a loop."""
        if self.loop is None:
            return None
        return "while" if isinstance(self.loop, ccode.While) else "for"


def main_function(unit: ccode.SourceUnit) -> ccode.Function | None:
    """The unit's definition of main, or None."""
    return next((d for d in unit.declarations if isinstance(d, ccode.Function) and d.definition and d.name == "main"), None)


def main_structure(unit: ccode.SourceUnit) -> MainStructure | None:
    """The structure of the unit's main, None where it has none."""
    function = main_function(unit)
    if function is None:
        return None
    body = function.body
    statements = list(body.statements) if body is not None else []
    endless = ((i, s) for i, s in enumerate(statements) if isinstance(s, (ccode.While, ccode.For)) and s.endless)
    number, loop = next(endless, (0, None))
    if loop is None:
        return MainStructure(function, before=statements)
    before = statements[:number]
    locals_ = [
        v for s in before if isinstance(s, ccode.DeclarationStatement) for v in s.declarations if isinstance(v, ccode.Variable)
    ]
    hoisted = [v for v in locals_ if any(_inside(loop, r) for r in v.references) or _in_macro(unit, loop, v)]
    return MainStructure(function, loop, before, statements[number + 1 :], hoisted, exits(loop))


def _inside(loop: ccode.Located, reference: ccode.Located) -> bool:
    return bool(loop.startOffset <= reference.startOffset < loop.endOffset)


def _in_macro(unit: ccode.SourceUnit, loop: ccode.Loop, variable: ccode.Variable) -> bool:
    """Whether a macro that is used in the loop names the variable in its body."""
    import re

    word = re.compile(rf"\b{re.escape(str(variable.name))}\b")
    return any(
        use.macro is not None and _inside(loop, use) and word.search(str(use.macro.body or "")) is not None
        for use in unit.macroUses
    )


def own_returns(function: ccode.Function) -> tuple[ccode.Return, ...]:
    """The `return` statements of a function, without those of lambdas and of the methods of classes in its body."""
    return tuple(each for each in all_of_kind(function, ccode.Return) if _around(each) is function)


def _around(statement: ccode.Statement) -> object:
    """The function or lambda that a statement is in."""
    around = statement.eContainer()
    while around is not None and not isinstance(around, (ccode.Function, ccode.Lambda)):
        around = around.eContainer()
    return around


def exits(loop: ccode.Loop) -> list[LoopExit]:
    """The breaks, returns and gotos that leave a loop, in text order."""
    return sorted((LoopExit(_KINDS[e.__class__], int(e.line)) for e in loop_exits(loop)), key=lambda e: e.line)


_KINDS: dict[type, str] = {ccode.Break: "break", ccode.Return: "return", ccode.Goto: "goto"}


def loop_exits(loop: ccode.Loop) -> list[ccode.Statement]:
    """The statements in a loop that leave it, in text order."""
    found: list[ccode.Statement] = []
    labels = {str(e.name) for e in all_contents(loop) if isinstance(e, ccode.Label)}
    pending: list[tuple[ccode.Located, bool]] = [(loop.body, True)] if loop.body is not None else []
    while pending:
        element, own = pending.pop()
        if isinstance(element, ccode.Break):
            if own:
                found.append(element)
        elif isinstance(element, ccode.Return) or (isinstance(element, ccode.Goto) and str(element.labelName) not in labels):
            found.append(element)
        elif isinstance(element, ccode.Statement):
            inner = own and not isinstance(element, (ccode.Loop, ccode.Switch))
            pending.extend((child, inner) for child in element.eContents if isinstance(child, ccode.Statement))
    return sorted(found, key=lambda e: int(e.startOffset))
