"""The prototypes that a platform's builder makes of functions that a sketch uses above their definition.

Such builders put them before the first function; a toolchain's data say whether it has such a builder. Only
functions that need one get one, on the line of the first function, so that lines keep their numbers. Templates, methods,
functions in namespaces and those with default arguments get none, as they need none or no prototype of them would compile.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

_HIDDEN = re.compile(
    r"//[^\n]*|/\*.*?(?:\*/|\Z)|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])*'|^[ \t]*#(?:\\\n|[^\n])*", re.DOTALL | re.MULTILINE
)
_HEAD = re.compile(r"([^()=]*+)\((?:[^()=]++|\([^()]*+\))*+\)\s*+")
"""Matches what precedes a body: type and name, and parameters without default values."""
_TYPE = re.compile(r"[\w:<>,*&\s]++", re.ASCII)
_WITHOUT = re.compile(r"\s*(?:template|typedef|using|namespace|extern)\b")


class _Definition(NamedTuple):
    start: int
    head: str
    name: str


def with_prototypes(text: str) -> str:
    """The text of a sketch with the prototypes that it lacks."""
    plain = _HIDDEN.sub(lambda hidden: re.sub(r"[^\n]", " ", hidden[0]), text)
    found = list(_definitions(plain))
    outside = _outside(plain)
    lacking: dict[str, str] = {}
    for one in found:
        used = re.search(rf"\b{one.name}\b", plain[: one.start])
        # a type stands in front of a declared name, and `=` in front of a call that gives a variable its first value
        declared = re.search(rf"(?:\A|[;{{}}])\s*[\w:][\w:<>,*&\s]*[*&\s]{one.name}\s*\([^;{{}}]*\)\s*;", outside[: one.start])
        if used is not None and declared is None:
            lacking.setdefault(one.name, f"{' '.join(one.head.split())}; ")
    if not lacking:
        return text
    place = found[0].start
    return f"{text[:place]}{''.join(lacking.values())}{text[place:]}"


def _definitions(plain: str) -> Iterator[_Definition]:
    """The functions that are defined at file scope, in order."""
    depth = start = 0
    for mark in re.finditer(r"[{};]", plain):
        if mark[0] == "{":
            head = _head(plain[start : mark.start()]) if depth == 0 else None
            if head is not None:
                yield head._replace(start=start + head.start)
            depth += 1
        elif mark[0] == "}":
            depth = max(depth - 1, 0)
        if depth == 0:
            start = mark.end()


def _head(piece: str) -> _Definition | None:
    """The function whose body follows a piece of text, if a prototype can be made of it."""
    found = _HEAD.fullmatch(piece)
    if found is None or _WITHOUT.match(piece) is not None or "::" in found[1]:
        return None
    before = found[1].strip()
    name = re.split(r"\W+", before, flags=re.ASCII)[-1]
    kind = before.removesuffix(name).rstrip()
    if not name or name[0].isdigit() or _TYPE.fullmatch(kind) is None or kind[-1] in ":,<":
        return None
    return _Definition(len(piece) - len(piece.lstrip()), piece.strip(), name)


def _outside(plain: str) -> str:
    """The text with all that is within braces blank."""
    depth, parts = 0, []
    for piece in re.split(r"([{}])", plain):
        depth = max(depth - (piece == "}"), 0)
        parts.append(" " * len(piece) if depth else piece)
        depth += piece == "{"
    return "".join(parts)
