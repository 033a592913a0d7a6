"""Declared types whose width differs on the target: which words of a text are replaced, and by what.

Only `int` and `unsigned` alone are concerned; short, char, long and long long have the same width on all supported platforms,
or are wider on the target. Words in comments, strings and names of headers are left alone. Expressions are handled in
`m2m.widths.width_rules`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from robosmi.transformations.knowledge.lexer import QUALIFIERS, STORAGE_WORDS, Token, tokens
from robosmi.transformations.knowledge.replacements import Replacement

_SIZES = frozenset(["short", "char", "long", "double", "float", "_Complex", "__int128"])
_INTS = frozenset(["int", "unsigned", "signed", "__signed__"])
_DEFINE = re.compile(r"(?:#|%:)[ \t]*define\b")
_BETWEEN = QUALIFIERS | STORAGE_WORDS
_NONE: Mapping[str, str] = {}

_AFTER = re.compile(rb"\boperator\s*(?:\+\+|--)\s*\((?:[^(),]*,)?\s*(int)\b[^(),]*\)")
"""The `int` that tells `pin++` from `++pin`, which C++ fixes."""


def retyped_words(data: bytes, bits: int = 32, names: Mapping[str, str] = _NONE) -> list[Replacement]:
    """The words of declared types that are to be changed, in text order.

    Args:
        data: a text in C.
        bits: the width that int has on the source.
        names: types of the standard library with int members -> their wider replacements; others are ignored.
    """
    found = list(_plain(data))
    types = [
        Replacement(start, end, names[text])
        for kind, start, end, text in found
        if kind == "name" and text.endswith("_t") and text in names
    ]
    fixed = {match.start(1) for match in _AFTER.finditer(data)} if b"operator" in data else ()
    runs = _runs(iter(found))
    return sorted([*types, *(word for run in runs for word in _written(run, bits) if word.start not in fixed)])


def retyped(text: str, bits: int = 32, names: Mapping[str, str] = _NONE) -> str:
    """A text, such as a type, with its types replaced by those for the target."""
    data = text.encode("utf-8")
    done, parts = 0, []
    for start, end, new in retyped_words(data, bits, names):
        parts += [data[done:start].decode("utf-8", "replace"), new]
        done = end
    return "".join([*parts, data[done:].decode("utf-8", "replace")])


def _plain(data: bytes) -> Iterator[Token]:
    """The tokens of a text, those in bodies of macro definitions included, other directives left out."""
    for kind, start, end, text in tokens(data):
        if kind == "directive":
            found = _DEFINE.match(text)
            body = start + found.end() if found else end
            for inner, first, behind, word in tokens(b" " + data[body:end]):
                yield inner, first + body - 1, behind + body - 1, word
            yield "directive", end, end, ""
        else:
            yield kind, start, end, text


def _runs(found: Iterator[Token]) -> Iterator[list[Token]]:
    """Runs of tokens that are the type specifiers of one declaration."""
    run: list[Token] = []
    for token in found:
        kind, _, _, text = token
        if kind == "name" and (text in _INTS or text in _SIZES or (run and text in _BETWEEN)):
            run.append(token)
        elif kind != "comment":
            if run:
                yield run
            run = []
    if run:
        yield run


def _written(run: Sequence[Token], bits: int) -> Iterator[Replacement]:
    words = [t for t in run if t[3] in _INTS or t[3] in _SIZES]
    if any(t[3] in _SIZES for t in words) or not words:
        return
    new = f"{'u' if any(t[3] == 'unsigned' for t in words) else ''}int{bits}_t"
    first, last = run.index(words[0]), run.index(words[-1])
    if last - first == len(words) - 1:
        yield Replacement(words[0][1], words[-1][2], new)
        return
    yield Replacement(words[0][1], words[0][2], new)
    for _, start, end, _text in words[1:]:
        yield Replacement(start, end, "")
