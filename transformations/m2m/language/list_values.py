"""Parses initializer lists in braces into values and designators.

How a list is written by position is decided in `designated_lists`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from weakref import WeakKeyDictionary

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.lexer import Token
from robosmi.transformations.queries.expression_type import ValueType, is_padding

MOST = 256
"""Limit on consecutive omitted elements that are written out as `{}`."""


class ListValue(Struct, frozen=True):
    """A value of an initializer list: the tokens of its designator (none for most values) and those of the value."""

    designator: Sequence[Token]
    value: Sequence[Token]


class UnknownList(Exception):
    """Raised when a list cannot be written by position."""


def constants_of(variable: ccode.Variable | ccode.Cast) -> Mapping[str, int]:
    """The values of named constants visible at an element: enumerators, and macros that are a number."""
    element = variable.eContainer()
    while element is not None and not isinstance(element, ccode.SourceUnit):
        element = element.eContainer()
    program = element.program if element is not None else None
    if program is None:
        return {}
    if program not in _constants:
        _constants[program] = _constants_in(program)
    return _constants[program]


_constants: WeakKeyDictionary[ccode.Program, Mapping[str, int]] = WeakKeyDictionary()
"""Program, which does not change any more -> its constants: each list asks for them."""


def _constants_in(program: ccode.Program) -> Mapping[str, int]:
    found: dict[str, int] = {}
    for unit in program.units:
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


def is_record(kind: ValueType | None) -> bool:
    """Whether a type is a structure or union, not a pointer to one."""
    return kind is not None and kind.depth == 0 and isinstance(kind.declaration, ccode.Record)


def members_of(kind: ValueType | None) -> Sequence[ccode.Field]:
    """The members of a structure or union that take an initial value, in order; none for any other type."""
    record = kind.declaration if kind is not None and is_record(kind) else None
    fields = record.fields if isinstance(record, ccode.Record) else ()
    return [field for field in fields if field.name or not is_padding(field)]


def is_union(kind: ValueType | None) -> bool:
    """Whether a type is a union, and no pointer to one."""
    record = kind.declaration if kind is not None and is_record(kind) else None
    return isinstance(record, ccode.Record) and record.recordKind is ccode.RecordKind.unionType


_DEEPEST = 180
"""Brackets within one another; the reader cuts out what nests deeper."""


def values_of(words: Sequence[Token]) -> list[ListValue]:
    """Split the tokens between the braces of a list into its values.

    Raises:
        UnknownList: a designator has no value behind it, or the values nest deeper than any parser takes.
    """
    parts: list[list[Token]] = [[]]
    depth = 0
    for word in words:
        depth += (word[3] in ("(", "[", "{")) - (word[3] in (")", "]", "}"))
        if depth > _DEEPEST:
            raise UnknownList
        if word[3] == "," and depth == 0:
            parts.append([])
        else:
            parts[-1].append(word)
    found = []
    for part in parts:
        if not part:
            continue
        behind = _behind_designator(part)
        found.append(ListValue(part[:behind], part[behind:]))
    if any(not each.value for each in found):
        raise UnknownList
    return found


def _behind_designator(part: Sequence[Token]) -> int:
    """The number of tokens of a value's designator, including `=` or GNU C's `:` (`name: value`); 0 if it has none."""
    if part[0][0] == "name" and len(part) > 1 and part[1][3] == ":":
        return 2
    if part[0][3] not in ("[", "."):
        return 0
    equals = next((number for number, word in enumerate(part) if word[3] == "="), 0)
    return equals + 1 if equals else 0


def named_places(designator: Sequence[Token]) -> list[str]:
    """The steps of a designator as a list of words: `.` and a member's name, or `[`, an index and `]`."""
    texts = [word[3] for word in designator[:-1]]
    return [".", *texts] if designator[-1][3] == ":" else texts


def index_value(text: str, constants: Mapping[str, int]) -> int:
    """Evaluate an array index: sums and differences of numbers, named constants and character constants.

    Raises:
        UnknownList: it has something else in it.
    """
    total, sign = 0, 1
    spread = text if "'" in text else text.replace("+", " + ").replace("-", " - ")
    for word in spread.split():
        if word in "+-":
            sign = 1 if word == "+" else -1
            continue
        plain = len(word) == 3 and word[0] == word[2] == "'" and word[1] != "\\"
        value = ord(word[1]) if plain else constants.get(word, _integer(word) if word[0].isdigit() else None)
        if value is None:
            raise UnknownList
        total, sign = total + sign * value, 1
    return total
