"""Takes out the attributes that put variables and functions into sections of the source's linker script.

A section means something to one linker script only. The target's linker places one that it does not know where it likes: data
lie on top of other data, and start-up does not fill them. Without the attribute the object lies where all others do. Other
attributes of the same list stay.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.replacements import Replacement
from robosmi.transformations.m2m.language.text_change import Change
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import FunctionType

RULE = "linker-section"
_SECTION = rb'(?:__section__|section)\s*\(\s*(?:"(?:[^"\\\n]|\\.)*"\s*)+\)'
_ALONE = re.compile(rb"__attribute(?:__)?\s*\(\s*\(\s*" + _SECTION + rb"\s*\)\s*\)\s*")
_IN_LIST = re.compile(rb",\s*" + _SECTION + rb"|\b" + _SECTION + rb"\s*,?\s*")


def linker_sections(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Find the declarations and macros with such an attribute; of several declarators of one declaration the first."""
    if b"section" not in data:
        return
    seen: set[int] = set()
    for element in (*view.of_kind(ccode.Variable), *view.of_kind(ccode.Function), *view.unit.macros):
        places = {each.start for each in without_section(element, data)} - seen if element.endOffset else set()
        if places:
            seen |= places
            yield Change(element, RULE, "", "the section is one of the source's linker script, which the target does not have")


def without_section(element: ccode.Located, data: bytes) -> list[Replacement]:
    """The deletion of the attributes, as (first byte, byte after the last, new text)."""
    body = element.body if isinstance(element, ccode.Function) else None
    head = data[element.startOffset : body.startOffset if body is not None else element.endOffset]
    if b"__attribute" not in head:
        return []
    found = [*_ALONE.finditer(head)]
    found += [each for each in _IN_LIST.finditer(head) if not any(one.start() <= each.start() < one.end() for one in found)]
    start = int(element.startOffset)
    return [Replacement(start + each.start(), start + each.end(), "") for each in sorted(found, key=lambda each: each.start())]
