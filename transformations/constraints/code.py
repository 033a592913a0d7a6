"""Constraints on code models: valid source positions, one definition per name, calls that match their function's parameters.

A program that compiles satisfies them; one that is only parsed, or assembled from several files, may not.
"""

from __future__ import annotations

from robosmi.base.quantities import quantity
from robosmi.diagnostics import Location, Severity
from robosmi.metamodels import ccode
from robosmi.query import all_of_kind, ancestor_of_kind, root_of
from robosmi.query.run import ext
from robosmi.validate import EVL, Fail

code = EVL()
"""The constraints on a program; evaluate them on its model."""


def place(element: ccode.Located) -> Location | None:
    """The source location of an element; None if it is in no source file."""
    unit = ancestor_of_kind(element, ccode.SourceUnit)
    return Location(unit.path, element.line or None, element.column or None) if unit is not None else None


located = code.context(ccode.Located)
calls = code.context(ccode.Call)


def has_external_linkage(function: ccode.Function) -> bool:
    """Whether an element is the definition of a function with external linkage."""
    return bool(
        function.definition
        and function.storage is not ccode.Storage.staticStorage
        and isinstance(function.eContainer(), ccode.SourceUnit)
    )


@located.constraint(id="RS711", location=place, advice="read the source again")
def EndsBehindItsStart(x: ccode.Located) -> bool | Fail:
    """The end of an element is not before its start."""
    return x.endOffset >= x.startOffset or Fail(
        f"{type(x).__name__} ends at byte {x.endOffset}, before its start {x.startOffset}"
    )


@calls.constraint(
    id="RS712", severity=Severity.warning, location=place, advice="pass the arguments that the function takes",
    guard=lambda c: c.callee is not None and c.callee.definition and not c.callee.variadic and not c.viaMacro,
)  # fmt: skip
def PassesWhatIsTaken(c: ccode.Call) -> bool | Fail:
    """A call of a function of the program passes as many arguments as the function has parameters."""
    assert c.callee is not None
    given, taken = len(c.arguments), len(c.callee.parameters)
    return given == taken or Fail(f"{c.calleeName} takes {quantity(taken, 'argument')}, but the call passes {given}")


functions = code.context(ccode.Function, guard=has_external_linkage)


@functions.constraint(id="RS713", location=place, advice="rename one of them, or make it static")
def IsDefinedOnce(f: ccode.Function) -> bool | Fail:
    """A name with external linkage has a single definition."""
    program = root_of(f)
    known = ext(program).functions_by_name
    if known is None:
        known = ext(program).functions_by_name = {}
        for one in all_of_kind(program, ccode.Function):
            if has_external_linkage(one):
                known.setdefault(one.name, one)
    first = known.get(f.name, f)
    return first is f or Fail(f"{f.name} is already defined in {_unit(first)}")


def _unit(element: ccode.Located) -> str:
    where = place(element)
    return str(where) if where is not None else "the program"
