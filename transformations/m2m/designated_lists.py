"""Rewrites designated initializers (C11 6.7.9) as positional ones, the only kind that C++11 has.

Only what has to change does: designators are removed, and `{}` is inserted for elements left out. A list whose values are not
in the order of their places is written anew (`reordered_lists`); one with unknown indices stays, and `refused_forms.remarks`
reports it. Lists of structures whose members all come in order stay, too: the target's compilers accept them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.lexer import Token, tokens
from robosmi.transformations.m2m.list_values import (
    MOST,
    UnknownList,
    constants_of,
    index_value,
    is_union,
    members_of,
    named_places,
    values_of,
)
from robosmi.transformations.m2m.reordered_lists import reordered
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import ValueType, element_type, of_use


def list_holders(view: CodeView) -> Iterator[ccode.Variable | ccode.Cast]:
    """The elements that may have an initializer list: variables with an initial value, and compound literals."""
    yield from (variable for variable in view.of_kind(ccode.Variable) if variable.initializer is not None)
    yield from (cast for cast in view.of_kind(ccode.Cast) if isinstance(cast.operand, ccode.InitializerList))


def positional(holder: ccode.Variable | ccode.Cast, data: bytes) -> list[tuple[int, int, str]] | None:
    """The changes, as (first byte, byte after the last, new text), that make a list positional; None if impossible.

    Args:
        holder: a variable with an initial value in braces, or a compound literal.
        data: the bytes of its unit.
    """
    first, use = (holder.operand, holder.target) if isinstance(holder, ccode.Cast) else (holder.initializer, holder.valueType)
    if first is None or not data[first.startOffset : first.endOffset].startswith(b"{"):
        return []
    start = int(first.startOffset)
    words = [(kind, begin + start, end + start, text) for kind, begin, end, text in tokens(data[start : first.endOffset])]
    plain = [word for word in words if word[0] != "comment"]
    constants = constants_of(holder)
    try:
        try:
            return _list(plain, of_use(use), constants, data)
        except UnknownList:
            return [(start, int(first.endOffset), reordered(words, of_use(use), constants, data))]
    except UnknownList:
        return None


def _list(
    words: Sequence[Token], kind: ValueType | None, constants: Mapping[str, int], data: bytes
) -> list[tuple[int, int, str]]:
    values = values_of(words[1:-1])
    fields = members_of(kind)
    made: list[tuple[int, int, str]] = []
    inner: list[tuple[int, int, str]] = []
    position, gaps, texts = 0, False, False
    for each in values:
        last = place = position
        if each.designator:
            place, last = _place(each.designator, fields, constants)
            if place < position or place - position > MOST or last - place > MOST:
                raise UnknownList
            text = data[each.value[0][1] : each.value[-1][2]].decode("utf-8", "replace")
            made.append((each.designator[0][1], each.value[0][1], "{}, " * (place - position) + f"{text}, " * (last - place)))
            gaps |= place > position or each.designator[0][3] == "["
        if each.value and each.value[0][3] == "{":
            within = of_use(fields[place].valueType) if place < len(fields) else element_type(kind)
            inner += _list(each.value, within, constants, data)
        member = fields[place].valueType if place < len(fields) else None
        texts |= member is not None and bool(member.arrayDims) and each.value[0][3].startswith('"')
        position = last + 1
    union = is_union(kind)
    if union and made and len(values) > 1:
        raise UnknownList
    if made and fields and (union or not (gaps or texts)):
        return inner  # the target's compilers know members of unions by their names, but none whose value is a text
    return [*made, *inner]


def _place(designator: Sequence[Token], fields: Sequence[ccode.Field], constants: Mapping[str, int]) -> tuple[int, int]:
    """The indices of the first and the last element that a designator stands for; they differ for the range `[a ... b]` of GNU
    C.
    """
    texts = named_places(designator)
    if texts[0] == "." and len(texts) == 2:
        names = [field.name for field in fields]
        if texts[1] not in names:
            raise UnknownList
        return names.index(texts[1]), names.index(texts[1])
    if texts[0] != "[" or texts.count("[") != 1 or texts[-1] != "]":
        raise UnknownList
    first, dots, last = " ".join(texts[1:-1]).partition("...")
    return index_value(first, constants), index_value(last if dots else first, constants)
