"""Initializer lists with more values than their array or structure has places: C compilers drop the rest, C++ refuses it.

Only lists without designators (`designated_lists` handles the others) and with a size that the program writes as a number are
considered.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.lexer import Token, tokens
from robosmi.transformations.knowledge.replacements import Replacement
from robosmi.transformations.m2m.language.list_values import (
    UnknownList,
    constants_of,
    index_value,
    is_record,
    is_union,
    members_of,
    values_of,
)
from robosmi.transformations.m2m.language.text_change import Change
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import FunctionType, ValueType, element_type, of_use

RULE = "excess-values"
_SIZE = re.compile(r"\[([^\]]*)\]")


def excess_initialisers(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Find variables whose initializer lists have more values than places."""
    for variable in view.of_kind(ccode.Variable):
        if isinstance(variable.initializer, ccode.InitializerList) and places(variable, data):
            yield Change(variable, RULE, "", "a list in C++ has no more values than there are places for")


def places(variable: ccode.Variable, data: bytes) -> list[Replacement]:
    """The deletions of excess values from a variable's list, as (first byte, byte after the last, new text).

    Args:
        variable: the variable.
        data: the bytes of its unit.
    """
    first, use = variable.initializer, variable.valueType
    if first is None or use is None or not data[first.startOffset : first.endOffset].startswith(b"{"):
        return []
    start = int(first.startOffset)
    found = [(kind, begin + start, end + start, text) for kind, begin, end, text in tokens(data[start : first.endOffset])]
    words = [word for word in found if word[0] not in ("comment", "directive")]
    sizes = _SIZE.findall(str(use.arrayDims or ""))
    try:
        return _excess(words, of_use(use), sizes, constants_of(variable) if any(sizes) else {})
    except UnknownList:
        return []


def _excess(
    words: Sequence[Token], kind: ValueType | None, sizes: Sequence[str], constants: Mapping[str, int]
) -> list[Replacement]:
    values = values_of(words[1:-1])
    if kind is None or any(each.designator for each in values) or words[-1][3] not in ("}", "%>"):
        raise UnknownList
    array = kind.dimensions > 0
    if array and not sizes:
        raise UnknownList  # the size is in the type's name
    inner = element_type(kind) if array else None
    fields = members_of(kind) if not array else ()
    braced = [each.value[0][3] == "{" for each in values]
    whole = is_record(inner) or (inner is not None and inner.dimensions > 0)
    if array and whole and not all(braced):
        raise UnknownList  # inner braces are left out
    for number, each in enumerate(values):
        if number < len(fields) and _whole(fields[number]) and not braced[number] and each.value[0][0] != "string":
            raise UnknownList
    room = len(values)
    if array and sizes[0].strip():
        room = index_value(sizes[0], constants)
    elif not array:
        room = 1 if is_union(kind) or not is_record(kind) else len(fields)
    made = []
    for number, each in enumerate(values):
        if number < room and braced[number]:
            member = fields[number].valueType if fields else None
            dimensions = _SIZE.findall(str(member.arrayDims or "")) if member is not None else sizes[1:]
            made += _excess(each.value, of_use(member) if fields else inner, dimensions, constants)
    if room < len(values) and (array or fields or kind.arithmetic):
        begin = values[room - 1].value[-1][2] if room > 0 else words[0][2]
        made.append(Replacement(begin, words[-1][1], ""))
    return made


def _whole(field: ccode.Field) -> bool:
    """Whether a member is an aggregate, so that the inner braces around its values may be omitted."""
    kind = of_use(field.valueType)
    return kind is not None and (is_record(kind) or kind.dimensions > 0)
