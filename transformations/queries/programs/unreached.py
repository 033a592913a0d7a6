"""Statements that can never be reached since the one before them never ends: an endless loop, or a function with one.

Functions that never return are found over the calls of the whole program. Statements from a label on count as reached, since
anything may jump there.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from robosmi.metamodels import ccode
from robosmi.query import all_contents, all_of_kind
from robosmi.transformations.queries.programs.main_program import loop_exits


class Unreached:
    """Finds the unreachable statements of a program.

    Args:
        units: the program's files.

    Attributes:
        endless: the functions that never return, by the `id` of each of their declarations.
    """

    def __init__(self, units: Sequence[ccode.SourceUnit]) -> None:
        self._declared = [d for unit in units for d in unit.declarations if isinstance(d, ccode.Function)]
        defined = [function for function in self._declared if function.body is not None]
        self.endless: dict[int, ccode.Function] = {}
        found = True
        while found:  # a function that calls one that never returns does not return either
            found = False
            for function in defined:
                if id(function) not in self.endless and function.name != "main" and self._never_ends(function.body):
                    found = True
                    for each in self._same(function):
                        self.endless[id(each)] = function

    def statements(self, unit: ccode.SourceUnit) -> Iterator[tuple[ccode.Statement, ccode.Statement]]:
        """For each run of unreachable statements its first statement, and the statement before it that never ends."""
        for rows, number in self._rows(unit):
            yield rows[number + 1], rows[number]

    def inside(self, unit: ccode.SourceUnit) -> Iterator[ccode.Statement]:
        """All unreachable statements, without what is nested in them."""
        for rows, number in self._rows(unit):
            yield from (each for at, each in enumerate(rows) if at > number)

    def _rows(self, unit: ccode.SourceUnit) -> Iterator[tuple[Sequence[ccode.Statement], int]]:
        for block in all_of_kind(unit, ccode.Block):
            rows = list(block.statements)
            for number, statement in enumerate(rows):
                if number + 1 < len(rows) and self._never_ends(statement):
                    behind = (each for at, row in enumerate(rows) if at > number for each in (row, *all_contents(row)))
                    if not any(isinstance(each, (ccode.Label, ccode.Case, ccode.Default)) for each in behind):
                        yield rows, number
                    break

    def _same(self, function: ccode.Function) -> list[ccode.Function]:
        if function.storage.name == "staticStorage":
            unit = function.eContainer()
            return [each for each in self._declared if each.name == function.name and each.eContainer() is unit]
        return [each for each in self._declared if each.name == function.name and each.storage.name != "staticStorage"]

    def _never_ends(self, statement: ccode.Statement | None) -> bool:
        if isinstance(statement, ccode.Block):
            for each in statement.statements:
                if self._never_ends(each):
                    return True
                if _may_leave(each):
                    return False
        if isinstance(statement, ccode.Loop):
            return bool(statement.endless) and not loop_exits(statement)
        if isinstance(statement, ccode.If):
            return self._never_ends(statement.thenBranch) and self._never_ends(statement.elseBranch)
        called = statement.expression if isinstance(statement, ccode.ExpressionStatement) else None
        return isinstance(called, ccode.Call) and called.callee is not None and id(called.callee) in self.endless


_WAYS_OUT = (ccode.Return, ccode.Goto, ccode.Break, ccode.Continue, ccode.UnknownStatement)


def _may_leave(statement: ccode.Statement) -> bool:
    """Whether control may leave a statement other than at its end, by return, goto, break, continue or unknown code."""
    return any(isinstance(each, _WAYS_OUT) for each in (statement, *all_contents(statement)))
