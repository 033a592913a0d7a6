"""Functions that run before main (`__attribute__((constructor))`): on a target whose program begins with setup, setup calls
them.

Before setup the target's core has not started its clock, so a wait in such a function would never end. Those that main's file
declares before main lose the attribute and are called first in setup; `cpp_incompatibilities` reports the others.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.replacements import Replacement
from robosmi.transformations.m2m.language.text_change import Change
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import FunctionType
from robosmi.transformations.queries.plans.plan import RUN_IN_SETUP
from robosmi.transformations.queries.programs.main_function import main_of

_WORD = re.compile(rb"\b(?:__)?constructor(?:__)?\b(?:\s*\(\s*(\d+)\s*\))?")
_ALONE = re.compile(rb"__attribute__\s*\(\(\s*(?:__)?constructor(?:__)?\s*(?:\(\s*\d+\s*\)\s*)?\)\)\s*")
_LAST = 65535
"""The priority of a constructor for which none is given."""


def early(view: CodeView, data: bytes) -> Iterator[tuple[ccode.Function, int]]:
    """The functions of a unit with the constructor attribute, and their priorities: the lowest runs first."""
    if b"constructor" not in data:
        return
    for function in view.of_kind(ccode.Function):
        found = _WORD.search(data, function.startOffset, _head_end(function)) if function.endOffset else None
        if found is not None and b"__attribute__" in data[function.startOffset : found.start()]:
            yield function, int(found[1] or _LAST)


def _head_end(function: ccode.Function) -> int:
    return int(function.body.startOffset if function.body is not None else function.endOffset)


def _callable(view: CodeView, function: ccode.Function, found: Collection[tuple[ccode.Function, int]]) -> bool:
    """Whether setup can call a constructor in place of the run-time system.

    It must take no parameters and be declared before main in main's file, and the priorities must agree with the text's order.
    """
    if sorted(found, key=lambda each: (each[1], each[0].startOffset)) != sorted(found, key=lambda each: each[0].startOffset):
        return False
    main = main_of(view.unit)
    declared = [f for f in view.of_kind(ccode.Function) if f.name == function.name and f.endOffset]
    defined = any(f.definition for f in declared)
    return main is not None and not function.parameters and defined and min(f.startOffset for f in declared) < main.startOffset


def run_in_setup(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Find the constructors that setup is to call."""
    found = list(early(view, data))
    for function, _ in found:
        if _callable(view, function, found):
            yield Change(function, RUN_IN_SETUP, "", "the target's clock is started before setup, and not before this")


def left_early(view: CodeView, data: bytes) -> Iterator[ccode.Function]:
    """The constructors that setup cannot call, which stay as they are."""
    found = list(early(view, data))
    return (function for function, _ in found if not _callable(view, function, found))


def without_attribute(function: ccode.Function, data: bytes) -> list[Replacement]:
    """The deletion of the constructor attribute, as (first byte, byte after the last, new text)."""
    pattern = _ALONE if _ALONE.search(data, function.startOffset, _head_end(function)) else _WORD
    return [Replacement(m.start(), m.end(), "") for m in pattern.finditer(data, function.startOffset, _head_end(function))]
