"""Functions that run before main (`__attribute__((constructor))`): on a target that begins with setup, they run first there.

Before setup the target's core has not started its clock, so that a wait in such a function would never end. Those that main's
file declares before main lose the attribute and are called at the beginning of setup; `refused_forms` tells the others.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping

from robosmi.metamodels import ccode
from robosmi.transformations.m2m.text_change import Change
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import FunctionType
from robosmi.transformations.queries.main_function import main_of
from robosmi.transformations.queries.plan import RUN_IN_SETUP

_WORD = re.compile(rb"\b(?:__)?constructor(?:__)?\b(?:\s*\(\s*(\d+)\s*\))?")
_ALONE = re.compile(rb"__attribute__\s*\(\(\s*(?:__)?constructor(?:__)?\s*(?:\(\s*\d+\s*\)\s*)?\)\)\s*")
_LAST = 65535
"""The priority of a constructor that is given none."""


def early(view: CodeView, data: bytes) -> Iterator[tuple[ccode.Function, int]]:
    """The declarations of a unit that have the attribute, with their priorities: the lowest runs first."""
    if b"constructor" not in data:
        return
    for function in view.of_kind(ccode.Function):
        found = _WORD.search(data, function.startOffset, _head_end(function)) if function.endOffset else None
        if found is not None and b"__attribute__" in data[function.startOffset : found.start()]:
            yield function, int(found[1] or _LAST)


def _head_end(function: ccode.Function) -> int:
    return int(function.body.startOffset if function.body is not None else function.endOffset)


def _callable(view: CodeView, function: ccode.Function, found: Collection[tuple[ccode.Function, int]]) -> bool:
    """Whether setup can call a function: it takes nothing, main's file declares it before main, and their order is the text's."""
    if sorted(found, key=lambda each: (each[1], each[0].startOffset)) != sorted(found, key=lambda each: each[0].startOffset):
        return False
    main = main_of(view.unit)
    declared = [f for f in view.of_kind(ccode.Function) if f.name == function.name and f.endOffset]
    defined = any(f.definition for f in declared)
    return main is not None and not function.parameters and defined and min(f.startOffset for f in declared) < main.startOffset


def run_in_setup(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """The functions that setup calls."""
    found = list(early(view, data))
    for function, _ in found:
        if _callable(view, function, found):
            yield Change(function, RUN_IN_SETUP, "", "the target's clock is started before setup, and not before this")


def left_early(view: CodeView, data: bytes) -> Iterator[ccode.Function]:
    """The functions that stay what they are."""
    found = list(early(view, data))
    return (function for function, _ in found if not _callable(view, function, found))


def without_attribute(function: ccode.Function, data: bytes) -> list[tuple[int, int, str]]:
    """The text of the attribute that goes (first byte, byte behind, new text)."""
    pattern = _ALONE if _ALONE.search(data, function.startOffset, _head_end(function)) else _WORD
    return [(m.start(), m.end(), "") for m in pattern.finditer(data, function.startOffset, _head_end(function))]
