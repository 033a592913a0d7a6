"""String literals with no room for their zero byte in the array they initialize (C11 6.7.9), which C++ refuses.

Longer literals, which C compilers cut to the array's size, are refused, too. Each becomes a list of characters. Literals that
come from a macro, and those in lists that are written anew as a whole, stay; `cpp_incompatibilities` reports them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from robosmi.metamodels import ccode
from robosmi.query import ancestor_of_kind
from robosmi.transformations.m2m.language.designated_lists import positional
from robosmi.transformations.m2m.language.list_values import UnknownList, constants_of, index_value, members_of
from robosmi.transformations.m2m.language.text_change import Change
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import FunctionType, ValueType, of_use
from robosmi.transformations.queries.initialisers import is_designated, value_in

_PIECE = re.compile(r'"((?:[^"\\]|\\.)*)"', re.DOTALL)
_CHARACTER = re.compile(r"\\(?:x[0-9a-fA-F]+|[0-7]{1,3}|.)|[^\\]", re.DOTALL)
"""A character of a C string literal, or an escape sequence (C17 6.4.4.4)."""
_SIZE = re.compile(r"\[([^\]]*)\]")


def unterminated_literals(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Find string literals that leave no room for their zero byte, to be written as lists of characters."""
    for literal, size in without_zero(view, data):
        if size:
            text = data[literal.startOffset : literal.endOffset].decode("utf-8", errors="surrogateescape")
            yield Change(literal, "replace", _listed(text, size), "the array has no room for the zero byte of its text")


def without_zero(view: CodeView, data: bytes) -> Iterator[tuple[ccode.Expression, int]]:
    """The string literals of a unit without room for their zero byte, each with its array's size; 0 if no list can replace it."""
    for variable in view.of_kind(ccode.Variable):
        if variable.initializer is None or variable.valueType is None:
            continue
        found = list(_within(variable.initializer, variable.valueType, _sizes(variable.valueType), constants_of(variable)))
        anew = [(start, end) for start, end, _ in positional(variable, data) or ()] if found else []
        for literal, size in found:
            start, end = int(literal.startOffset), int(literal.endOffset)
            plain = data[start:end].startswith(b'"') and data[start:end].endswith(b'"')
            yield literal, size if plain and not any(first <= start and end <= last for first, last in anew) else 0


def _sizes(use: ccode.TypeUse) -> list[str]:
    """The sizes of an array as written, including those of a typedef that it uses."""
    made = _SIZE.findall(str(use.arrayDims or ""))
    named = use.declaration.aliased if isinstance(use.declaration, ccode.Typedef) else None
    return made + (_sizes(named) if named is not None else [])


def _within(
    value: ccode.Expression, use: ccode.TypeUse, sizes: Sequence[str], constants: Mapping[str, int]
) -> Iterator[tuple[ccode.Expression, int]]:
    kind = of_use(use)
    if kind is None or kind.depth > kind.dimensions:
        return
    text = _text(value)
    if text:
        size = _known(sizes[0], constants) if len(sizes) == 1 and kind.base.endswith("char") else None
        if size and size <= len(characters(text)):
            yield value, size
    elif isinstance(value, ccode.InitializerList):
        inside = [each for element in value.elements if (each := value_in(element)) is not None]
        if sizes:
            for each in inside:
                yield from _within(each, use, sizes[1:], constants)
            return
        yield from _members(value, kind, constants)


def _members(
    given: ccode.InitializerList, kind: ValueType, constants: Mapping[str, int]
) -> Iterator[tuple[ccode.Expression, int]]:
    """The string literals without room among the values of a structure, which are positional or designated."""
    members = members_of(kind)
    places = {str(member.name): place for place, member in enumerate(members)}
    place = 0
    for element in given.elements:
        left = element.left if isinstance(element, ccode.Assignment) and is_designated(element) else None
        place = places.get(str(left.name), len(members)) if isinstance(left, ccode.Member) else place
        value = value_in(element)
        use = members[place].valueType if place < len(members) else None
        if value is not None and use is not None:
            yield from _within(value, use, _sizes(use), constants)
        place += 1


def _text(value: ccode.Expression) -> str:
    """The string literal that a value is, as written, also if a macro of the program stands for it; empty for any other value."""
    if isinstance(value, ccode.StringLiteral):
        return str(value.text)
    unit = ancestor_of_kind(value, ccode.SourceUnit) if isinstance(value, ccode.NameReference) and value.target is None else None
    units = unit.program.units if unit is not None and unit.program is not None else ()
    bodies = (
        str(m.body or "")
        for each in units
        for m in each.macros
        if isinstance(value, ccode.NameReference) and m.name == value.name
    )
    return next((body for body in bodies if body.startswith('"') and body.endswith('"')), "")


def _known(size: str, constants: Mapping[str, int]) -> int | None:
    try:
        return index_value(size, constants)
    except UnknownList:
        return None


def characters(literal: str) -> list[str]:
    """The bytes of a C string literal as written, without the final zero byte; adjacent literals count as one."""
    made: list[str] = []
    for piece in _PIECE.findall(literal.replace("\\\n", "")):
        for each in _CHARACTER.findall(piece):
            plain = each.isascii()
            made += [each] if plain else [f"\\x{byte:02x}" for byte in each.encode(errors="surrogateescape")]
    return made


def _listed(literal: str, size: int) -> str:
    """The first `size` characters of a string literal as an initializer list."""
    shown = characters(literal)[:size]
    return "{" + ", ".join("'" + {"'": "\\'", '\\"': '"'}.get(each, each) + "'" for each in shown) + "}"
