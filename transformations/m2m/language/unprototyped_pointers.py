"""Pointers to functions with unspecified parameters, and calls through them, which C++ refuses.

If all functions stored in such a pointer take the same parameters, its type is given them; a call with more arguments loses the
surplus, and one with fewer is filled up with zeros. `cpp_incompatibilities` reports what cannot be mended so.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from robosmi.metamodels import ccode
from robosmi.transformations.m2m.language.text_change import Change
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import FunctionType
from robosmi.transformations.queries.flows.value_uses import changes_nothing
from robosmi.transformations.queries.own_headers import unit_of
from robosmi.transformations.queries.programs.unprototyped_functions import UnprototypedPointers, concerns, unprototyped_pointers
from robosmi.transformations.queries.signature_text import nothing, split


def pointer_prototypes(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Find pointer types that can be given a parameter list, and calls through them whose number of arguments changes."""
    for kept in unprototyped_pointers(view.program) if concerns(view) else ():
        if kept.parameter_text and not _left(kept):
            for pointer in kept.pointers:
                if unit_of(pointer) is view.unit:
                    yield Change(pointer, "empty-parentheses", kept.parameter_text, "in C++ an empty list means no parameters")
        for call in kept.calls:
            if unit_of(call) is view.unit and not _left(kept):
                yield from _arguments(call, kept)


def value_prototypes(view: CodeView) -> dict[int, str]:
    """The parameter list that such a pointer's type is given, by the `id()` of each value stored in the pointer."""
    groups = unprototyped_pointers(view.program) if concerns(view) else ()
    return {id(value): kept.parameter_text for kept in groups if kept.parameter_text and not _left(kept) for value in kept.values}


def untold_pointers(view: CodeView) -> Iterator[tuple[int, str]]:
    """Pointers of a unit that C++ refuses to call because their parameters are unknown or ambiguous, as (offset, message)."""
    for kept in unprototyped_pointers(view.program) if concerns(view) else ():
        message = _left(kept)
        first = next((pointer for pointer in kept.pointers if unit_of(pointer) is view.unit), None)
        if message and first is not None:
            yield int(first.startOffset), f"'{first.name}' points to functions {message}, and is called with some"


def _left(kept: UnprototypedPointers) -> str:
    """The reason why calls with arguments through a pointer cannot be mended; empty if they can or there are none."""
    if not any(call.arguments for call in kept.calls):
        return ""
    count = kept.count
    if kept.taken is None:
        return "that take different parameters" if len(kept.lists) > 1 else "of which nothing says the parameters"
    if kept.taken and not kept.parameter_text:
        return f"whose parameters ({kept.taken}) have types that are named behind it"
    for call in kept.calls if count is not None else ():
        surplus = [each for number, each in enumerate(call.arguments) if count is not None and number >= count]
        if surplus and (call.viaMacro or not all(changes_nothing(each) for each in surplus)):
            return "that take fewer parameters"
    return ""


def _arguments(call: ccode.Call, kept: UnprototypedPointers) -> Iterator[Change]:
    count = kept.count
    if count is None or call.viaMacro or kept.taken is None:
        return
    if len(call.arguments) > count:
        yield Change(call, "surplus-arguments", str(count), "the functions take fewer arguments")
    elif len(call.arguments) < count:
        lacking = (each for number, each in enumerate(split(kept.taken)) if number >= len(call.arguments))
        values = ", " * bool(call.arguments) + ", ".join(nothing(each) or "0" for each in lacking)
        yield Change(call, "missing-arguments", values, "it is called without arguments that it takes")
