"""Reachability: which code of a program may be executed at all, following calls, names of functions and initial values.

Code after what never returns is left out, too, as a compiler does. Which calls happen in fact, and in which order, does not
matter.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import all_contents, all_of_kind
from robosmi.transformations.queries.programs.main_function import main_of
from robosmi.transformations.queries.programs.unreached import Unreached


def live_in(units: Sequence[ccode.SourceUnit]) -> list[Element]:
    """The reachable elements: all in main, in the functions that it reaches, and in initial values of variables used there.

    Args:
        units: of a program.
    """
    defined = what_is_defined(units)
    pending = beginnings(units)
    seen, found = {id(each) for each in pending}, list[Element]()
    unreached = Unreached(units)
    dead = (statement for unit in units for statement in unreached.inside(unit))
    inside = {id(each) for statement in dead for each in (statement, *all_contents(statement))}
    while pending:
        start = pending.pop()
        for element in (start, *all_contents(start)):
            if id(element) in inside:
                continue  # of a declaration within another
            inside.add(id(element))
            found.append(element)
            for led in leads_to(element, defined):
                if id(led) not in seen:
                    seen.add(id(led))
                    pending.append(led)
    return found


def beginnings(units: Sequence[ccode.SourceUnit]) -> list[Element]:
    """The roots of reachability: every main, the variables that bodies of used macros name, and what C++ calls without a call.

    A program without a main is a sketch: its core calls setup, loop and serialEvent (Arduino, "Sketch specification"), and the
    processor its interrupt functions.
    """
    words = in_macros(units)
    pending: list[Element] = [main for unit in units if (main := main_of(unit)) is not None]
    of_core = (d for unit in units for d in unit.declarations if _has_body(d) and _OF_SKETCHES.fullmatch(str(d.name)))
    pending += [] if pending else list(of_core)
    pending += [d for unit in units for d in unit.declarations if isinstance(d, ccode.Variable) and d.name in words]
    return pending + [function for unit in units for function in all_of_kind(unit, ccode.Function) if _is_called_unseen(function)]


_OF_SKETCHES = re.compile(r"setup|loop|serialEvent|\w+_vect")
_UNSEEN = re.compile(r"(?:^|[\s:*&])(?:(\w+)::(?:~?\1\b)|operator\b|~)")
"""Matches the signatures of constructors and destructors that are defined outside of their class, and of operators."""


def _is_called_unseen(function: ccode.Function) -> bool:
    """Whether a function with a body runs without a call of its name: a constructor, a destructor, an operator, a virtual one."""
    record = function.eContainer()
    constructs = isinstance(record, ccode.Record) and function.name == record.name
    unseen = constructs or function.virtual or _UNSEEN.search(str(function.signature).partition("(")[0])
    return function.body is not None and bool(unseen)


def what_is_defined(units: Iterable[ccode.SourceUnit]) -> dict[str, ccode.Declaration]:
    """Name -> the function definition, or the global variable that is neither static nor extern."""
    declared = [d for unit in units for d in unit.declarations]
    defined: dict[str, ccode.Declaration]
    defined = {str(d.name): d for d in declared if isinstance(d, ccode.Function) and d.body is not None}
    return defined | {str(d.name): d for d in declared if isinstance(d, ccode.Variable) and d.storage.name == "unspecified"}


def leads_to(element: Element, defined: Mapping[str, ccode.Declaration]) -> Iterator[Element]:
    """The functions and variables that an element names; of those that several files declare, the definition."""
    if isinstance(element, ccode.Call):
        callee = element.callee if _has_body(element.callee) else defined.get(str(element.calleeName))
        if callee is not None:
            yield callee
    elif isinstance(element, ccode.NameReference):
        target = element.target
        if isinstance(target, ccode.Function):
            yield target if _has_body(target) else defined.get(str(target.name), target)
        elif isinstance(target, ccode.Variable) and is_global(target):
            yield target if target.storage.name == "staticStorage" else defined.get(str(target.name), target)


def _has_body(function: ccode.Declaration | None) -> bool:
    return isinstance(function, ccode.Function) and function.body is not None


def identity(variable: ccode.Variable) -> int | str:
    """The key of a variable: its name if several files may share it, else the `id` of its declaration."""
    return str(variable.name) if is_global(variable) and variable.storage.name != "staticStorage" else id(variable)


def is_global(variable: ccode.Variable) -> bool:
    """Whether a variable is declared at file scope."""
    return isinstance(variable.eContainer(), ccode.SourceUnit)


def in_macros(units: Iterable[ccode.SourceUnit]) -> set[str]:
    """The words in the bodies of used macros: the model does not have the uses of what they name."""
    macros = [macro for unit in units for macro in unit.macros]
    return {word for macro in macros if macro.uses for word in re.findall(r"\w+", str(macro.body or ""))}
