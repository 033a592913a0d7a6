"""Initial values that name the elements or members they are for (C11 6.7.9), as lists by position, which C++11 has.

Only what is to be changed is: designators go, `{}` comes where elements are left out. A list whose values stand in another order
than their places, or whose indices are not known, stays; `language_gap.remarks` says so. Lists of structures whose members all
come in their order stay, too: the target's compilers take them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.lexer import Token, tokens
from robosmi.transformations.queries.expression_type import ValueType, element_type, of_use

MOST = 256
"""Elements in a row that are left out and still written as `{}`."""


class _Value(NamedTuple):
    """A value of a list: the tokens of its designator (none for most), and those of its own."""

    designator: Sequence[Token]
    value: Sequence[Token]


class _Unknown(Exception):
    """The list cannot be written by position."""


def positional(variable: ccode.Variable, data: bytes) -> list[tuple[int, int, str]] | None:
    """What of a variable's list changes (first byte, byte behind, new text); None where it cannot be written by position.

    Args:
        variable: with an initial value in braces.
        data: the bytes of its unit.
    """
    first = variable.initializer
    if first is None or not data[first.startOffset : first.endOffset].startswith(b"{"):
        return []
    start = int(first.startOffset)
    words = [
        (kind, begin + start, end + start, text)
        for kind, begin, end, text in tokens(data[start : first.endOffset])
        if kind != "comment"
    ]
    try:
        return _list(words, of_use(variable.valueType), _constants(variable), data)
    except _Unknown:
        return None


def _constants(variable: ccode.Variable) -> Mapping[str, int]:
    """Numbers that names stand for: enumerators, and macros that are a number."""
    element = variable.eContainer()
    while element is not None and not isinstance(element, ccode.SourceUnit):
        element = element.eContainer()
    units = element.program.units if element is not None and element.program is not None else ()
    found: dict[str, int] = {}
    for unit in units:
        for declared in unit.declarations:
            if isinstance(declared, ccode.Enumeration):
                found |= {str(literal.name): int(literal.value) for literal in declared.literals}
        for macro in unit.macros:
            value = _integer(str(macro.body or "").strip("() ")) if not macro.functionLike else None
            if value is not None:
                found[str(macro.name)] = value
    return found


def _integer(text: str) -> int | None:
    """The value of an integer literal of C, None for any other text."""
    digits = text.rstrip("uUlL")
    try:
        return int(digits, 8 if digits.isdecimal() and len(digits) > 1 and digits[0] == "0" else 0)
    except ValueError:
        return None


def _list(
    words: Sequence[Token], kind: ValueType | None, constants: Mapping[str, int], data: bytes
) -> list[tuple[int, int, str]]:
    values = _values(words[1:-1])
    fields = list(kind.declaration.fields) if _is_record(kind) else []  # type: ignore[union-attr]
    made: list[tuple[int, int, str]] = []
    inner: list[tuple[int, int, str]] = []
    position, gaps = 0, False
    for each in values:
        last = place = position
        if each.designator:
            place, last = _place(each.designator, fields, constants)
            if place < position or place - position > MOST or last - place > MOST:
                raise _Unknown
            text = data[each.value[0][1] : each.value[-1][2]].decode("utf-8", "replace")
            made.append((each.designator[0][1], each.value[0][1], "{}, " * (place - position) + f"{text}, " * (last - place)))
            gaps |= place > position or each.designator[0][3] == "["
        if each.value and each.value[0][3] == "{":
            within = of_use(fields[place].valueType) if place < len(fields) else element_type(kind)
            inner += _list(each.value, within, constants, data)
        position = last + 1
    if made and not gaps and fields:
        return inner
    if made and kind is not None and _is_record(kind) and kind.declaration.recordKind.name == "union":  # type: ignore[union-attr]
        raise _Unknown
    return [*made, *inner]


def _is_record(kind: ValueType | None) -> bool:
    return kind is not None and kind.depth == 0 and isinstance(kind.declaration, ccode.Record)


def _values(words: Sequence[Token]) -> list[_Value]:
    """The values of a list, from the tokens between its braces."""
    parts: list[list[Token]] = [[]]
    depth = 0
    for word in words:
        depth += (word[3] in ("(", "[", "{")) - (word[3] in (")", "]", "}"))
        if word[3] == "," and depth == 0:
            parts.append([])
        else:
            parts[-1].append(word)
    found = []
    for part in parts:
        if not part:
            continue
        behind = _behind_designator(part)
        found.append(_Value(part[:behind], part[behind:]))
    if any(not each.value for each in found):
        raise _Unknown
    return found


def _behind_designator(part: Sequence[Token]) -> int:
    """How many tokens a designator takes, with its `=`; 0 for a value without one."""
    if part[0][3] not in ("[", "."):
        return 0
    equals = next((number for number, word in enumerate(part) if word[3] == "="), 0)
    return equals + 1 if equals else 0


def _place(designator: Sequence[Token], fields: Sequence[ccode.Field], constants: Mapping[str, int]) -> tuple[int, int]:
    """The first and the last place that a designator names."""
    texts = [word[3] for word in designator[:-1]]
    if texts[0] == "." and len(texts) == 2:
        names = [field.name for field in fields]
        if texts[1] not in names:
            raise _Unknown
        return names.index(texts[1]), names.index(texts[1])
    if texts[0] != "[" or texts.count("[") != 1 or texts[-1] != "]":
        raise _Unknown
    first, dots, last = " ".join(texts[1:-1]).partition("...")
    return _number(first, constants), _number(last if dots else first, constants)


def _number(text: str, constants: Mapping[str, int]) -> int:
    """The value of an index: numbers and names of numbers, added and subtracted."""
    total, sign = 0, 1
    for word in text.replace("+", " + ").replace("-", " - ").split():
        if word in "+-":
            sign = 1 if word == "+" else -1
            continue
        value = constants.get(word, _integer(word) if word[0].isdigit() else None)
        if value is None:
            raise _Unknown
        total, sign = total + sign * value, 1
    return total
