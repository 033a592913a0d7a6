"""Sketches: programs whose main files the platform's tools join to one text, with prototypes of its functions.

The joined files (tabs) stay files here: each is parsed behind those before it, with the prototypes inserted in the parser's copy
alone, so that places are those of the files. Source: Arduino CLI, "Sketch specification" and "Sketch build process".

Limits: there is no prototype of a template, of a member function, and of a function with a default argument or several tokens between
its parameters and its body.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence

from msgspec import Struct

from robosmi.transformations.knowledge.api_data import SketchSettings
from robosmi.transformations.knowledge.lexer import KEYWORDS, Token
from robosmi.transformations.knowledge.replacements import Replacement, inserted

SOURCES = (".c", ".cc", ".cpp", ".cxx")
HEADERS = (".h", ".hh", ".hpp")
_OPENS, _CLOSES = frozenset("({["), frozenset(")}]")
_NO_NAMES = frozenset(["if", "while", "for", "switch", "catch", "return", "sizeof"])
_NO_TYPES = frozenset(["struct", "class", "union", "enum", "namespace", "template", "typedef", "operator", "else", "do", "="])


class Sketch(Struct, frozen=True):
    """The files of a sketch.

    Attributes:
        tabs: the joined files, in their order.
        sources: the other sources that are compiled with them.
        headers: the headers beside them, which are read for what they contain.
    """

    tabs: tuple[str, ...]
    sources: tuple[str, ...]
    headers: tuple[str, ...]

    @property
    def files(self) -> tuple[str, ...]:
        """All files, the tabs first."""
        return (*self.tabs, *self.sources, *self.headers)


def is_tab(path: str, settings: SketchSettings | None) -> bool:
    """Whether a file is one that the platform's tools join to others."""
    return settings is not None and path.lower().endswith(tuple(settings["endings"]))


def sketch_of(path: str, settings: SketchSettings) -> Sketch:
    """The sketch that a tab belongs to: all of its folder, and the sources below its folder `sources`.

    The first tab is the one with the folder's name, else the given one.
    """
    folder = os.path.dirname(path)
    beside = [os.path.join(folder, name) for name in _names(folder)]
    below = [os.path.join(at, name) for at, _, names in os.walk(os.path.join(folder, settings["sources"])) for name in sorted(names)]
    tabs = [file for file in beside if is_tab(file, settings)]
    named = os.path.basename(os.path.abspath(folder))
    main = next((tab for tab in tabs if os.path.splitext(os.path.basename(tab))[0] == named), path)
    own = [*beside, *sorted(below)]
    return Sketch(
        (main, *(tab for tab in tabs if os.path.realpath(tab) != os.path.realpath(main))),
        tuple(file for file in own if file.lower().endswith(SOURCES)),
        tuple(file for file in own if file.lower().endswith(HEADERS)),
    )


def _names(folder: str) -> list[str]:
    """The names of a folder's visible files, in alphabetical order; none if it cannot be read, which the given file will tell."""
    try:
        names = os.listdir(folder or os.curdir)
    except OSError:
        return []
    return sorted(name for name in names if not name.startswith(".") and os.path.isfile(os.path.join(folder, name)))


def prototypes(tokens: Sequence[Token], others: Iterable[Sequence[Token]] = ()) -> list[Replacement]:
    """The prototypes that the platform's tools would add to a tab: one insertion before its first function, or none.

    Args:
        tokens: of the tab.
        others: tokens of the tabs that come behind it.
    """
    own = _plain(tokens)
    heads = list(_heads(own))
    if not heads:
        return []
    declared = {_spelt(own[start:end]) for start, end in _declared(own)}
    texts = [_spelt(own[start:end]) for start, end in heads]
    for more in others:
        plain = _plain(more)
        texts += [_spelt(plain[start:end]) for start, end in _heads(plain)]
    added = [f"{text};" for text in dict.fromkeys(texts) if text not in declared]
    return [inserted(own[heads[0][0]][1], " ".join(added) + " ")] if added else []


def _plain(tokens: Iterable[Token]) -> list[Token]:
    return [token for token in tokens if token[0] not in ("comment", "directive")]


def _spelt(tokens: Iterable[Token]) -> str:
    return " ".join(text for _, _, _, text in tokens)


def _heads(tokens: Sequence[Token]) -> Iterator[tuple[int, int]]:
    """The heads of the functions that a text defines at its top level: index of the first token, index behind the closing bracket."""
    return ((start, end) for start, end in _declarators(tokens) if end < len(tokens) and tokens[end][3] == "{")


def _declared(tokens: Sequence[Token]) -> Iterator[tuple[int, int]]:
    return ((start, end) for start, end in _declarators(tokens) if end < len(tokens) and tokens[end][3] == ";")


def _declarators(tokens: Sequence[Token]) -> Iterator[tuple[int, int]]:
    """Ranges `TYPE NAME(PARAMETERS)` at the top level that may be of a plain function."""
    place = start = 0
    while place < len(tokens):
        text = tokens[place][3]
        if text == "(" and _may_be_function(tokens, start, place):
            end = _behind(tokens, place)
            if not any(inner == "=" for _, _, _, inner in tokens[place:end]):
                yield start, end
            place = end
        elif text in _OPENS:
            place = _behind(tokens, place)
            if text == "{":
                start = place
        else:
            place += 1
            if text == ";":
                start = place


def _may_be_function(tokens: Sequence[Token], start: int, place: int) -> bool:
    before = [text for _, _, _, text in tokens[start:place]]
    return (
        len(before) > 1
        and tokens[place - 1][0] == "name"
        and before[-1] not in KEYWORDS | _NO_NAMES
        and before[-2] not in (":", ".", "->")
        and not _NO_TYPES.intersection(before)
    )


def _behind(tokens: Sequence[Token], place: int) -> int:
    """The index behind the bracket that closes the one at a place."""
    depth = 0
    for number in range(place, len(tokens)):
        text = tokens[number][3]
        depth += (text in _OPENS) - (text in _CLOSES)
        if depth <= 0:
            return number + 1
    return len(tokens)
