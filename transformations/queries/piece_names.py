"""The names that pieces of adapter text declare at file scope, which a program cannot have for itself beside them."""

from __future__ import annotations

import re
from collections.abc import Iterable
from collections.abc import Set as AbstractSet

from robosmi.metamodels import platform
from robosmi.transformations.knowledge.lexer import KEYWORDS, tokens

_WORDS = re.compile(r"[A-Za-z_]\w*")
_DEFINED = re.compile(r"#\s*define\s+([A-Za-z_]\w*)")
_OPENING, _CLOSING = frozenset("([{"), frozenset(")]}")


def declared_names(pieces: Iterable[platform.Adapter], among: AbstractSet[str]) -> tuple[frozenset[str], frozenset[str]]:
    """What pieces declare, and the macros that they define, of the names that a program has.

    Args:
        pieces: the pieces.
        among: the names that are asked for; texts without any of them are not looked into.
    """
    declared: set[str] = set()
    macros: set[str] = set()
    for piece in pieces:
        declared.update(str(port.constant) for port in piece.ports)
        declared.update(str(table.name) for table in piece.tables)
        text = str(piece.text)
        if among.isdisjoint(_WORDS.findall(text)):
            continue
        depth = 0
        for kind, _, _, word in tokens(text.encode()):
            if kind == "directive" and (found := _DEFINED.match(word)) is not None:
                macros.add(found[1])
            elif kind == "name" and depth == 0 and word not in KEYWORDS:
                declared.add(word)
            elif kind == "punct":
                depth += (word in _OPENING) - (word in _CLOSING)
    return frozenset(declared & among), frozenset(macros & among)
