"""Tokenizes C++ headers for reading declarations, and skips what is no declaration.

Comments and directives are dropped and no macro is expanded. All branches of a condition are used; if one contains an
incomplete declaration, only the first non-empty branch. `library_declarations` reads the declarations.
"""

from __future__ import annotations

import re

from msgspec import Struct

from robosmi.transformations.knowledge.api_spelling import literal
from robosmi.transformations.knowledge.lexer import definition_parts, directive_parts, tokens

MOST_TOKENS, MOST_NAMES = 400_000, 4_000

Part = tuple[str, str]
"""Kind and text of a token."""

_MOST_CONDITIONS = 64  # within each other

OPEN, _CLOSE = {"(": ")", "[": "]", "{": "}"}, frozenset(")]}")


class _Condition(Struct):
    """An open `#if`: the tokens before it, its branches so far, and whether the current branch is never compiled."""

    around: list[Part]
    branches: list[list[Part]]
    never: bool


def compiled(data: bytes, constants: dict[str, str]) -> list[Part]:
    """The tokens without comments and directives; constants (name -> value, the last one counts) are noted on the way."""
    parts: list[Part] = []
    opened: list[_Condition] = []
    deeper = 0
    colon = -1  # where the last colon ends: two that touch are one sign
    for kind, start, end, text in tokens(re.sub(rb"\r(?!\n)", b"\n", data), MOST_TOKENS):
        if kind == "comment":
            continue
        if kind != "directive":
            if text == ":" and start == colon and parts and parts[-1][1] == ":":
                parts[-1] = ("punct", "::")
            else:
                parts.append((kind, text))
            colon = end if text == ":" else -1
            continue
        word, rest = directive_parts(text)
        if word == "define":
            if len(constants) < MOST_NAMES and not any(condition.never for condition in opened):
                _constant(rest, constants)
        elif word in ("if", "ifdef", "ifndef"):
            if len(opened) < _MOST_CONDITIONS:
                opened.append(_Condition(parts, [], rest == "0"))
                parts = []
            else:
                deeper += 1
        elif word == "endif" and deeper:
            deeper -= 1
        elif word in ("elif", "else", "elifdef", "elifndef", "endif") and opened and not deeper:
            condition = opened[-1]
            condition.branches += [] if condition.never else [parts]
            condition.never = False
            parts = []
            if word == "endif":
                opened.pop()
                parts = condition.around
                parts += _kept(condition.branches)
    for condition in reversed(opened):  # never closed
        parts = condition.around + _kept([*condition.branches, parts])
    return parts


def _constant(rest: str, constants: dict[str, str]) -> None:
    name, parameters, body = definition_parts(rest)
    if name and parameters is None and (value := literal(body)) is not None:
        constants[name] = value.encode("latin-1").decode("utf-8", "replace")


def _kept(branches: list[list[Part]]) -> list[Part]:
    """All branches of a condition if each consists of whole declarations, else the first non-empty one."""
    if all(_whole(branch) for branch in branches):
        return [part for branch in branches for part in branch]
    return next((branch for branch in branches if branch), [])


def _whole(branch: list[Part]) -> bool:
    depth = 0
    for kind, text in branch:
        if kind == "punct":
            depth += (text in OPEN) - (text in _CLOSE)
            if depth < 0:
                return False
    return depth == 0 and (not branch or branch[-1][1] in (";", "}", ":", ","))


def closing_of(parts: list[Part], at: int) -> int:
    """The index after the bracket that closes the one at this index; the end if it is never closed."""
    depth = 0
    for place in range(at, len(parts)):
        kind, text = parts[place]
        if kind == "punct":
            depth += (text in OPEN) - (text in _CLOSE)
            if depth <= 0:
                return place + 1
    return len(parts)


def behind_angles(parts: list[Part], at: int) -> int:
    """The index after the `<...>` that begins here."""
    depth, place = 0, at
    while place < len(parts):
        text = parts[place][1]
        if text in OPEN:
            place = closing_of(parts, place)
            continue
        if text in (";", "}"):
            return place
        depth += (text == "<") - (text == ">") - 2 * (text == ">>")
        place += 1
        if depth <= 0:
            return place
    return place


def behind_statement(parts: list[Part], at: int) -> int:
    """The index after the `;` of the statement that begins here, or of the `}` that closes its scope."""
    while at < len(parts):
        text = parts[at][1]
        if text == ";":
            return at + 1
        if text == "}":
            return at
        at = closing_of(parts, at) if text in OPEN else at + 1
    return at


def behind_variable(parts: list[Part], at: int) -> int:
    """The index after a variable, or after a body without a head."""
    while at < len(parts):
        text = parts[at][1]
        if text == ";":
            return at + 1
        if text == "}":
            return at
        if text == "{":
            at = closing_of(parts, at)
            if at < len(parts) and parts[at][1] not in (";", ",", "=", "["):
                return at
            continue
        at = closing_of(parts, at) if text in OPEN else at + 1
    return at
