"""The names that adapter pieces and their libraries declare at file scope, which a program therefore cannot declare too."""

from __future__ import annotations

import re
from collections.abc import Iterable
from collections.abc import Set as AbstractSet

from robosmi.errors import RobosmiError
from robosmi.metamodels import platform
from robosmi.transformations.knowledge.lexer import KEYWORDS, tokens
from robosmi.transformations.knowledge.library_ranking import library_api

_WORDS = re.compile(r"[A-Za-z_]\w*")
_DEFINED = re.compile(r"#\s*define\s+([A-Za-z_]\w*)")
_OPENING, _CLOSING = frozenset("([{"), frozenset(")]}")


def declared_names(pieces: Iterable[platform.Adapter], among: AbstractSet[str]) -> tuple[frozenset[str], frozenset[str]]:
    """The names of `among` that pieces declare at file scope, and those that they define as macros.

    Args:
        pieces: the pieces.
        among: the names in question, such as a program's; texts without any of them are skipped.
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


def library_names(pieces: Iterable[platform.Adapter], index: str, among: AbstractSet[str]) -> frozenset[str]:
    """The names of `among` that the libraries which pieces include declare.

    Args:
        pieces: the pieces.
        index: the platform whose index of libraries the target uses, empty for none.
        among: the names in question, such as a program's.
    """
    found: set[str] = set()
    for library in sorted({str(name) for piece in pieces for name in piece.libraries}) if index else ():
        try:
            api = library_api(library, index)
        except RobosmiError:
            continue  # a library that comes with the target's tools, which the index does not have
        for header in api.headers:
            found |= {each.name.rpartition("::")[2] for each in header.classes}
            found |= {each.name.rpartition("::")[2] for each in header.functions}
            found |= {*header.constants, *header.enums, *(name for names in header.enums.values() for name in names)}
    return frozenset(found & among)
