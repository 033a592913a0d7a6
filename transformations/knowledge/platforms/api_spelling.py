"""Normalizes the spelling of API declarations: parameters, types, names; and recognizes literal values.

Facts from elsewhere and facts read from headers get the same spelling, so that both can be compared: `(const char *name,
uint8_t *data, bool fast=true) const`. `t2m.library_declarations` finds the declarations.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from itertools import zip_longest

from robosmi.transformations.knowledge.lexer import tokens

_WORDS = ("name", "number", "string", "char")
_LITERAL = re.compile(
    r"""(?:\(\s*u?int(?:8|16|32|64)_t\s*\)\s*+)?[-+~]?\s*+(?:
        (?:0[xX][0-9a-fA-F]+|0[bB][01]+|\d+)[uUlL]*|\d*\.\d+(?:[eE][-+]?\d+)?[fFlL]?|\d+\.(?:[eE][-+]?\d+)?[fFlL]?|\d+[eE][-+]?\d+[fFlL]?
        |B[01]{1,8}|A\d{1,2}|NULL|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])+'|true|false)""",
    re.VERBOSE,
)


def tidy(text: str) -> str:
    """Normalize a C signature or type of `api.json`: a blank after each comma, none after an asterisk."""
    text = re.sub(r"\s*,\s*", ", ", " ".join(text.split()))
    return re.sub(r"\*\s+(?=[\w*,)])", "*", text).strip()


def spelled(text: str) -> str:
    """A type, name or parameter list in normalized spelling, without comments."""
    return joined((kind, word) for kind, _, _, word in tokens(text.encode("utf-8")))


def joined(parts: Iterable[tuple[str, str]]) -> str:
    """Join tokens (kind, text) in normalized spelling.

    A blank is put between words, after commas and before pointer and reference signs; nowhere else.
    """
    listed = [part for part in parts if part[0] not in ("comment", "directive")]
    written: list[str] = []
    before = ""
    for (kind, word), (_, following) in zip_longest(listed, listed[1:], fillvalue=("", "")):
        now = "word" if kind in _WORDS else word
        if before and _apart(before, now, following):
            written.append(" ")
        written.append(word)
        before = now
    return "".join(written).encode("latin-1").decode("utf-8", "replace")


def _apart(before: str, now: str, following: str) -> bool:
    if before == ",":
        return True
    if now == "word":
        return before in ("word", ")", ">", ">>", "]")
    return before in ("word", ">", ">>") and (now in ("*", "&", "&&", "*=", "&=") or (now == "(" and following in ("*", "&")))


def literal(text: str) -> str | None:
    """The value of a `#define` if it is a literal, perhaps with a sign, a cast to a fixed width or in brackets; else None."""
    value = text.strip()
    value = value if '"' in value or "'" in value else " ".join(value.split())
    inner = value
    while inner.startswith("(") and inner.endswith(")") and "(" not in inner[1:-1]:
        inner = inner[1:-1].strip()
    if inner.startswith("((") and inner.endswith(")"):
        inner = inner[1:-1].strip()
    return value if _LITERAL.fullmatch(inner) else None
