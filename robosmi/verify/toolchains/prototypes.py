"""The prototypes that Arduino's builder makes of functions that are used above their definition, before the first function.

A sketch file may call what is defined further down (Arduino: "Sketch build process"). Only such functions get a prototype here;
they stand on the line of the first function, so that lines keep their numbers. Templates, methods, functions in namespaces and
those with default arguments get none, as they need none or the builder makes none that compiles.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

_HIDDEN = re.compile(
    r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])*'|^[ \t]*#(?:\\\n|[^\n])*", re.DOTALL | re.MULTILINE
)
_HEAD = re.compile(r"\s*((?:[\w:<>,*&\s])*?[\w>*&][\s*&]+([A-Za-z_]\w*)\s*\(((?:[^()=]|\([^()]*\))*)\))\s*", re.ASCII)
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
        declared = re.search(rf"\b{one.name}\s*\([^;{{}}]*\)\s*;", outside[: one.start])
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
            head = _HEAD.fullmatch(plain, start, mark.start()) if depth == 0 else None
            if head is not None and _WITHOUT.match(head[1]) is None and "::" not in head[1].partition("(")[0]:
                yield _Definition(head.start(1), head[1], head[2])
            depth += 1
        elif mark[0] == "}":
            depth = max(depth - 1, 0)
        if depth == 0:
            start = mark.end()


def _outside(plain: str) -> str:
    """The text with all that is within braces blank."""
    depth, parts = 0, []
    for piece in re.split(r"([{}])", plain):
        depth = max(depth - (piece == "}"), 0)
        parts.append(" " * len(piece) if depth else piece)
        depth += piece == "{"
    return "".join(parts)
