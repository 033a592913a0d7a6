"""The files of a sketch as one text, with the prototypes that the platform's tools add, in the parser's copies alone.

Each file is parsed behind those before it, so that places are those of the files. Source: Arduino CLI, "Sketch build process".

Limits: there is no prototype of a template, of a member function, and of a function with a default argument or with more than
its parameters before its body.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from msgspec import Struct

from robosmi.transformations.knowledge.lexer import KEYWORDS, Token
from robosmi.transformations.knowledge.replacements import Replacement, inserted
from robosmi.transformations.t2m.c_source.parsing.error_recovery import Scratch
from robosmi.transformations.t2m.c_source.parsing.source import ReadSource

_OPENS, _CLOSES = frozenset("({["), frozenset(")}]")
_NO_NAMES = frozenset(["if", "while", "for", "switch", "catch", "return", "sizeof"])
_NO_TYPES = frozenset(["struct", "class", "union", "enum", "namespace", "template", "typedef", "operator", "else", "do", "="])


class JoinedTabs(Struct, frozen=True):
    """What the tools add to a file: the text before it, and prototypes in it.

    Attributes:
        before: path of each file before it -> its text with prototypes.
        added: insertions of prototypes.
    """

    before: Mapping[str, bytes]
    added: Sequence[Replacement]


NOT_JOINED = JoinedTabs({}, ())
"""Of a file that is a text of its own."""


def joined_text(source: ReadSource, tabs: Sequence[ReadSource]) -> JoinedTabs:
    """What the tools add to a tab.

    Args:
        source: the tab.
        tabs: all of the sketch, in their order.
    """
    number = next(place for place, tab in enumerate(tabs) if tab is source)
    added = [
        prototypes(tab.tokens, [other.tokens for other in tabs[place + 1 :]]) for place, tab in enumerate(tabs[: number + 1])
    ]
    before = zip(tabs[:number], added, strict=False)
    return JoinedTabs({tab.path: Scratch(tab.parsed, edits).data for tab, edits in before}, added[number])


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
    """The heads of the functions defined at the top level: index of the first token, index behind the closing bracket."""
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
