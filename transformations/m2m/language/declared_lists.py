"""Finds the bytes to delete when some names leave a declaration of several (`int a, b, a;`)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from robosmi.transformations.knowledge.lexer import Token, tokens
from robosmi.transformations.knowledge.replacements import Replacement

_OPENING, _CLOSING = frozenset("([{"), frozenset(")]}")


class Declarator(NamedTuple):
    """One declarator of a declaration.

    Attributes:
        name: the declared name.
        start, end: its byte range with stars, sizes and initial value, without the types before it and the comma after it.
    """

    name: str
    start: int
    end: int


def declarators(data: bytes, start: int) -> list[Declarator]:
    """The declarators of a declaration, in text order.

    Args:
        data: the bytes of its unit.
        start: the byte where the declaration begins.
    """
    end = data.find(b";", start)
    found: list[Declarator] = []
    chunk: list[Token] = []
    words = [word for word in tokens(data[start : _behind(data, start, end)]) if word[0] not in ("comment", "directive")]
    depth = 0
    for word in words:
        depth += (word[3] in _OPENING) - (word[3] in _CLOSING)
        if word[3] == ";" and not depth:
            break
        if word[3] == "," and not depth:
            found.append(_declarator(chunk, start, first=not found))
            chunk = []
        else:
            chunk.append(word)
    return [*found, _declarator(chunk, start, first=not found)] if chunk else found


def _behind(data: bytes, start: int, end: int) -> int:
    """The byte after the declaration: after the first semicolon outside of braces."""
    while end >= 0 and data.count(b"{", start, end) > data.count(b"}", start, end):
        end = data.find(b";", end + 1)
    return end + 1 if end >= 0 else len(data)


def _declarator(chunk: Sequence[Token], start: int, *, first: bool) -> Declarator:
    depth, named = 0, 0
    for number, (kind, _, _, text) in enumerate(chunk):
        depth += (text in _OPENING) - (text in _CLOSING)
        if text == "=" and not depth:
            break
        if kind == "name" and (not depth or _within_star(chunk, number)) and text not in ("const", "volatile"):
            named = number
    begin = 0
    if first:
        begin = next((n for n, word in enumerate(chunk) if word[3] in ("*", "(") and n <= named), named)
    return Declarator(chunk[named][3], start + chunk[begin][1], start + chunk[-1][2])


def _within_star(chunk: Sequence[Token], number: int) -> bool:
    """Whether a name in parentheses is the declared one, as in `(*name)(int)`."""
    return number > 1 and chunk[number - 1][3] == "*" and chunk[number - 2][3] == "("


def without(data: bytes, start: int, names: Sequence[int]) -> list[Replacement]:
    """The deletions, as (first byte, byte after the last, new text), that remove names from a declaration; one name must stay.

    Args:
        data: the bytes of its unit.
        start: the byte where the declaration begins.
        names: the indices of the declarators to remove, from 0.
    """
    made: list[Replacement] = []
    begin, end, behind, gone = -1, -1, -1, False  # where the names that go begin, and the end of the last one that stays
    for number, each in enumerate(declarators(data, start)):
        if number in names:
            begin, gone = begin if gone else behind if behind >= 0 else each.start, True
            end = each.end
            continue
        if gone:
            made.append(Replacement(begin, end if behind >= 0 else each.start, ""))
        behind, gone = each.end, False
    return [*made, Replacement(begin, end, "")] if gone and behind >= 0 else made
