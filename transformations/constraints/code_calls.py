"""Constraints on calls: all arguments are passed, also to main, and a function that never returns is not followed by code."""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.diagnostics import Severity
from robosmi.metamodels import ccode
from robosmi.query import all_of_kind
from robosmi.transformations.constraints.code_move import moved, place, the_move, together
from robosmi.transformations.queries.own_headers import unit_of
from robosmi.transformations.queries.programs.main_function import main_of
from robosmi.transformations.queries.programs.unreached import Unreached
from robosmi.validate import Fail

units = moved.context(ccode.SourceUnit)


@units.constraint(id="RS341", severity=Severity.warning, location=place, advice="add the argument to the call")
def GivesItsArguments(unit: ccode.SourceUnit) -> bool | Fail:
    """No function is called with fewer arguments than it has parameters; the value of a missing one is undefined in C."""
    found = [*_short_calls(unit), *_short_calls_of_pointers(unit)]
    said = ", ".join(dict.fromkeys(f"'{name}'" for _, name in found))
    return not found or together(
        f"calls pass fewer arguments than {said} takes: a missing one is undefined on the source and 0 on the target",
        [call for call, _ in found],
    )


def _short_calls(unit: ccode.SourceUnit) -> Iterator[tuple[ccode.Call, str]]:
    for call in the_move().view(unit).of_kind(ccode.Call):
        function = call.callee
        if function is None or not function.definition or call.viaMacro or function.name != call.calleeName:
            continue
        if len(call.arguments) < len(function.parameters):
            yield call, str(function.name)


def _short_calls_of_pointers(unit: ccode.SourceUnit) -> Iterator[tuple[ccode.Call, str]]:
    for kept in the_move().unprototyped if any(c.callee is None for c in the_move().view(unit).calls) else ():
        for call in kept.calls:
            lacking = [function for function in kept.functions if len(function.parameters) > len(call.arguments)]
            if unit_of(call) is unit and lacking:
                yield call, str(lacking[0].name)


@units.constraint(id="RS344", severity=Severity.warning, location=place, advice="assign the value that the program needs")
def GetsNoArguments(unit: ccode.SourceUnit) -> bool | Fail:
    """The main function uses no parameters: nothing on the target passes it arguments."""
    main = main_of(unit)
    used = [parameter for parameter in main.parameters if parameter.references] if main is not None else []
    names = " and ".join(f"'{parameter.name}'" for parameter in used)
    are = "are" if len(used) > 1 else "is"
    return not used or together(f"{names} of main {are} 0 on the target, where main gets no arguments", used)


@units.constraint(id="RS343", severity=Severity.info, location=place, advice="remove it, or let the function return")
def GetsThere(unit: ccode.SourceUnit) -> bool | Fail:
    """No code follows a call of a function that never returns."""
    unreached = Unreached(the_move().program.units)
    found = [(row, before) for row, before in unreached.statements(unit) if not isinstance(before, ccode.Loop)]
    called = (call.callee for _, before in found for call in all_of_kind(before, ccode.Call) if call.callee is not None)
    names = list(dict.fromkeys(f"'{function.name}'" for function in called if id(function) in unreached.endless))
    return not found or together(
        f"this code never runs, on neither platform: {' and '.join(names)} never return{'s' * (len(names) == 1)}",
        [row for row, _ in found],
    )
