"""Definitions of macros as they are written in a text, and tokens of their expansions with the places they come from."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.lexer import Token, tokens

REST = "__VA_ARGS__"
"""The name in a variadic macro's body that stands for the arguments passed for `...`."""


class TextPlace(Struct, frozen=True):
    """A range of a unit's text.

    Attributes:
        unit: path of the unit.
        start, end: byte offsets.
        body: whether it lies in the body of a macro, so that changing it changes every use of the macro.
    """

    unit: str
    start: int
    end: int
    body: bool = False


class Frame(Struct, frozen=True):
    """A step of an expansion path: where a token or a macro use is written, and whether that is in a macro's body."""

    unit: str
    start: int
    end: int
    body: bool


Path = tuple[Frame, ...]
"""Where an expanded token comes from: the macro use in the file, the place in that macro's body, and so on to the token."""


class MacroToken(Struct, frozen=True):
    """A token of an expansion with its path."""

    kind: str
    text: str
    path: Path


class Definition(Struct):
    """A macro: its parameters (None for one without parentheses) and its body's tokens, with their places."""

    name: str
    parameters: list[str] | None
    body: list[Token]
    unit: str
    offset: int
    variadic: bool = False


def definition(unit: str, data: bytes, start: int, end: int) -> Definition | None:
    """The macro that a directive defines.

    Args:
        unit: path of the unit.
        data: its bytes.
        start, end: range of the directive.
    """
    mark = data.find(b"#", start, end)
    behind = mark + 1 if mark >= 0 else start + 2
    words = [t for t in tokens(b" " + data[behind:end]) if t[0] != "comment"]
    if len(words) < 2 or words[0][3] != "define" or words[1][0] != "name":
        return None
    found = [(k, a + behind - 1, b + behind - 1, t) for k, a, b, t in words[1:]]
    name, rest = found[0], found[1:]
    parameters: list[str] | None = None
    variadic = False
    if rest and rest[0][3] == "(" and rest[0][1] == name[2]:
        close = next((i for i, t in enumerate(rest) if t[3] == ")"), None)
        if close is None:
            return None
        parameters = [t[3] for t in rest[1:close] if t[0] == "name"]
        texts = [t[3] for t in rest[1:close]]
        variadic = texts[-1:] == ["..."]
        if variadic and texts[-2:-1] in ([], [","]):  # else its last name is the one of GNU's `args...`
            parameters.append(REST)
        rest = rest[close + 1 :]
    return Definition(name[3], parameters, rest, unit, name[1], variadic)


def macros_of(units: Sequence[ccode.SourceUnit], copies: Mapping[str, bytes]) -> dict[str, list[Definition]]:
    """The macros of a program by name, in the order of its units and lines.

    Args:
        units: of the program.
        copies: path of a unit -> its bytes.
    """
    found: dict[str, list[Definition]] = {}
    for unit in units:
        for macro in unit.macros:
            made = definition(unit.path, copies[unit.path], macro.startOffset, macro.endOffset)
            if made is not None:
                found.setdefault(made.name, []).append(made)
    return found


def definition_of(macro: ccode.Macro) -> Definition | None:
    """The definition of a macro of the model, in a text of its own; None where it cannot be read."""
    parameters = f"({', '.join(macro.parameters)})" if macro.functionLike else ""
    data = f"#define {macro.name}{parameters} {macro.body or ''}".encode("latin-1", "replace")
    return definition("macros", data, 0, len(data))
