"""Rewrites designated initializers (C11 6.7.9) as positional ones, the only kind that C++11 has.

Only what has to change does: designators are removed, and `{}` is inserted for elements left out. Lists of structures whose
members all come in order stay: the target's compilers accept them. So does a list with unknown indices, which
`cpp_incompatibilities` reports.

A list whose values are not in the order of their places is written anew as a whole, with nested designators (`.at.x`, `[1][0]`),
places initialized twice (the last counts), and comments beside values. Such a list is refused if it has computations or calls,
because changes within them would be lost, or is for a union member other than the first.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.lexer import Token, tokens
from robosmi.transformations.knowledge.replacements import Replacement
from robosmi.transformations.m2m.language.list_values import (
    MOST,
    ListValue,
    UnknownList,
    constants_of,
    index_value,
    is_record,
    is_union,
    members_of,
    named_places,
    values_of,
)
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import ValueType, element_type, of_use


def list_holders(view: CodeView) -> Iterator[ccode.Variable | ccode.Cast]:
    """The elements that may have an initializer list: variables with an initial value, and compound literals."""
    yield from (variable for variable in view.of_kind(ccode.Variable) if variable.initializer is not None)
    yield from (cast for cast in view.of_kind(ccode.Cast) if isinstance(cast.operand, ccode.InitializerList))


def positional(holder: ccode.Variable | ccode.Cast, data: bytes, within: Sequence[Replacement] = ()) -> list[Replacement] | None:
    """The changes, as (first byte, byte after the last, new text), that make a list positional; None if impossible.

    Args:
        holder: a variable with an initial value in braces, or a compound literal.
        data: the bytes of its unit.
        within: changes of the values, which none of the others overlaps: where a value is written anew, it has them.
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
            return _list(plain, of_use(use), constants, _Text(data, within))
        except UnknownList:
            return [Replacement(start, int(first.endOffset), reordered(words, of_use(use), constants, _Text(data, within)))]
    except UnknownList:
        return None


class _Text(Struct):
    """The bytes of a unit with changes within values.

    Attributes:
        data: the bytes.
        within: the changes, in text order.
    """

    data: bytes
    within: Sequence[Replacement] = ()

    def of(self, words: Sequence[Token]) -> str:
        """The text of some tokens, with the changes within them."""
        start, end = words[0][1], words[-1][2]
        parts: list[bytes] = []
        for change in self.within:
            if start <= change.start and change.end <= end:
                parts += [self.data[start : change.start], change.text.encode()]
                start = change.end
        return b"".join([*parts, self.data[start:end]]).decode("utf-8", "replace")


def _list(words: Sequence[Token], kind: ValueType | None, constants: Mapping[str, int], shown: _Text) -> list[Replacement]:
    values = values_of(words[1:-1])
    fields = members_of(kind)
    made: list[Replacement] = []
    inner: list[Replacement] = []
    position, gaps, texts = 0, False, False
    for each in values:
        last = place = position
        if each.designator:
            place, last = _place(each.designator, fields, constants)
            if place < position or place - position > MOST or last - place > MOST:
                raise UnknownList
            text = shown.of(each.value)
            made.append(
                Replacement(each.designator[0][1], each.value[0][1], "{}, " * (place - position) + f"{text}, " * (last - place))
            )
            gaps |= place > position or each.designator[0][3] == "["
        if each.value and each.value[0][3] == "{":
            within = of_use(fields[place].valueType) if place < len(fields) else element_type(kind)
            inner += _list(each.value, within, constants, shown)
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


# ---- lists that are written anew

_SIGNS = frozenset(["-", "&"])
_PLAIN = frozenset(["{", "}", "(", ")", ",", ".", "[", "]", "=", ":", "..."])
_BEFORE_A_SIGN = frozenset(["=", ",", "{", "("])


class _Slot(Struct):
    """The content of one place: a text, or the places inside it."""

    text: str = ""
    inner: dict[int, _Slot] | None = None
    comments: list[str] = []

    def shown(self) -> str:
        """The value as C text."""
        value = self.text or ("{}" if self.inner is None else "{" + ", ".join(_in_order(self.inner)) + "}")
        return " ".join([value, *self.comments])


def _in_order(slots: Mapping[int, _Slot]) -> Iterator[str]:
    places = range(max(slots, default=-1) + 1)
    return (slots[place].shown() if place in slots else "{}" for place in places)


def reordered(words: Sequence[Token], kind: ValueType | None, constants: Mapping[str, int], shown: _Text) -> str:
    """Write an initializer list by position.

    Args:
        words: its tokens including both braces, and the comments.
        kind: the type that it initializes.
        constants: values of named constants.
        shown: the text of its unit.

    Raises:
        UnknownList: it cannot be written by position.
    """
    plain = [word for word in words if word[0] != "comment"]
    _calculates_nothing(plain)
    data = shown.data
    filled = _Filler(constants, shown, [word for word in words if word[0] == "comment"])
    slots = filled.places_of(plain, kind)
    between = data[plain[0][2] : plain[1][1]].decode("latin-1")
    if "\n" not in between:
        return "{ " + ", ".join(_in_order(slots)) + " }"
    indent = between[between.rindex("\n") :]
    behind = data[plain[-2][2] : plain[-1][1]].decode("latin-1")
    return "{" + indent + f",{indent}".join(_in_order(slots)) + (behind[behind.rindex("\n") :] if "\n" in behind else " ") + "}"


def _calculates_nothing(words: Sequence[Token]) -> None:
    """Raise `UnknownList` if a list contains computations or calls, which may need changes of their own to keep widths."""
    inside = 0  # of a designator
    for place, (kind, _, _, text) in enumerate(words):
        before = words[place - 1] if place else words[0]
        inside += (text == "[") - (text == "]")
        sign = text in _SIGNS and before[3] in _BEFORE_A_SIGN
        called = text == "(" and before[0] == "name" and before[3] != "sizeof"
        if not inside and (called or (kind == "punct" and text not in _PLAIN and not sign)):
            raise UnknownList


class _Filler(Struct):
    """Assigns the values of a list to their places."""

    constants: Mapping[str, int]
    shown: _Text
    comments: list[Token]

    def places_of(self, words: Sequence[Token], kind: ValueType | None) -> dict[int, _Slot]:
        """The content of each place of a list, given its tokens including both braces."""
        slots: dict[int, _Slot] = {}
        position, chained = 0, False
        for each in values_of(words[1:-1]):
            if not each.designator:
                if chained:
                    raise UnknownList
                steps = [(position, position)]
            else:
                steps = list(self._steps(each.designator, kind))
                chained = len(steps) > 1
            self._put(slots, steps, kind, each)
            position = steps[0][1] + 1
        return slots

    def _put(self, slots: dict[int, _Slot], steps: Sequence[tuple[int, int]], kind: ValueType | None, each: ListValue) -> None:
        first, last = steps[0]
        if first < 0 or last - first > MOST or first - max(slots, default=-1) > MOST:
            raise UnknownList
        for place in range(first, last + 1):
            within = _part(kind, place)
            if len(steps) > 1:
                slot = slots.setdefault(place, _Slot(inner={}))
                if slot.inner is None:
                    raise UnknownList
                self._put(slot.inner, steps[1:], within, each)
            elif each.value[0][3] == "{":
                slots[place] = _Slot(inner=self.places_of(each.value, within), comments=self._beside(each))
            else:
                if _has_parts(within) and each.value[0][3] != "(" and not each.value[0][3].startswith('"'):
                    raise UnknownList  # braces may have been left out
                slots[place] = _Slot(self.shown.of(each.value), comments=self._beside(each))

    def _beside(self, each: ListValue) -> list[str]:
        """The comments after a value on its line."""
        found = []
        for comment in self.comments:
            between = self.shown.data[each.value[-1][2] : comment[1]]
            if comment[1] >= each.value[-1][2] and b"\n" not in between and not between.strip(b" \t,"):
                text = comment[3].removeprefix("//") if comment[3].startswith("//") else comment[3][2:-2]
                found.append(f"/* {text.strip()} */")
        return found

    def _steps(self, designator: Sequence[Token], kind: ValueType | None) -> Iterator[tuple[int, int]]:
        """The first and last index that each part of a designator stands for, from the outermost part."""
        texts = named_places(designator)
        while texts:
            if texts[0] == ".":
                names = [member.name for member in members_of(kind)]
                if texts[1] not in names:
                    raise UnknownList
                first = last = names.index(texts[1])
                texts = texts[2:]
            else:
                close = texts.index("]") if "]" in texts else 0
                low, dots, high = " ".join(texts[1:close]).partition("...")
                first = index_value(low, self.constants)
                last = index_value(high, self.constants) if dots else first
                texts = texts[close + 1 :]
            yield first, last
            kind = _part(kind, first)


def _part(kind: ValueType | None, place: int) -> ValueType | None:
    """The type of a place within an aggregate; `UnknownList` is raised for members of a union other than the first."""
    if not is_record(kind):
        return element_type(kind)
    members = members_of(kind)
    if place >= len(members) or (place and is_union(kind)):
        raise UnknownList
    return of_use(members[place].valueType)


def _has_parts(kind: ValueType | None) -> bool:
    return kind is None or is_record(kind) or bool(kind.dimensions)
