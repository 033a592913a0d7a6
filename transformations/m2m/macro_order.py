"""Whether a conversion that is written in the body of a macro leaves it to every use what is calculated first.

`#define SCALE(v, k) v * k` used as `SCALE(a + 1, 2)` is `a + 1 * 2`. A conversion of `v` needs parentheses, which would make it
`(a + 1) * 2`. So there all uses have to give one operand for it, as far as their text tells.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from robosmi.transformations.knowledge.lexer import Token, tokens
from robosmi.transformations.queries.expansion import Definition, TextPlace, definition

_SIGNS = frozenset("-+!~*&")
_OPEN = {"(": ")", "[": "]", "{": "}"}
_BEFORE = frozenset(["(", "[", "{", "}", ",", ";", "=", "return"])
_BEHIND = frozenset([")", "]", "}", ",", ";"])


@dataclass
class MacroOrder:
    """The macros of a program and their uses.

    Attributes:
        texts: path of a unit -> its bytes.
    """

    texts: Mapping[str, bytes]

    def stays(self, place: TextPlace) -> bool:
        """Whether parentheses around a place of a macro's body change nothing for any use."""
        macro = next((each for each in self._macros if each.unit == place.unit and _within(each.body, place)), None)
        if macro is None:
            return True
        inside = _within(macro.body, place)
        known, others = macro.parameters or (), self._by_name
        open_ = {
            number for number, name in enumerate(known)
            for at, word in enumerate(macro.body) if word in inside and word[3] == name and not _alone(macro.body, at, others)
        }  # fmt: skip
        whole = len(inside) == len(macro.body) and not _operand(inside, (), {})
        return all(
            all(number < len(given) and _operand(given[number], names, self._by_name) for number in open_)
            and not (whole and not (before in _BEFORE and behind in _BEHIND))
            for given, names, before, behind in self._uses(macro)
        )

    def _uses(self, macro: Definition) -> Iterator[tuple[list[list[Token]], Collection[str], str, str]]:
        """The uses of a macro: arguments, the parameters of the macro that they stand in, and the words before and behind."""
        for words, names in self._streams:
            for at, word in enumerate(words):
                if word[3] != macro.name or word[0] != "name":
                    continue
                behind = at + 1
                given: list[list[Token]] = []
                if macro.parameters is not None:
                    if behind >= len(words) or words[behind][3] != "(":
                        continue
                    end = _closing(words, behind)
                    given = _split(words[behind + 1 : end])
                    behind = end + 1
                yield given, names, words[at - 1][3] if at else "(", words[behind][3] if behind < len(words) else ")"

    @cached_property
    def _macros(self) -> list[Definition]:
        found = []
        for unit, data in self.texts.items():
            for kind, start, end, _ in tokens(data):
                made = definition(unit, data, start, end) if kind == "directive" else None
                found += [made] if made is not None else []
        return found

    @cached_property
    def _by_name(self) -> dict[str, Definition]:
        return {each.name: each for each in self._macros}

    @cached_property
    def _streams(self) -> list[tuple[Sequence[Token], Collection[str]]]:
        """The texts of the units without directives, and the bodies of macros with their parameters."""
        plain = ([word for word in tokens(data) if word[0] not in ("directive", "comment")] for data in self.texts.values())
        return [*((words, ()) for words in plain), *((each.body, each.parameters or ()) for each in self._macros)]


def _within(words: Sequence[Token], place: TextPlace) -> list[Token]:
    return [word for word in words if place.start <= word[1] and word[2] <= place.end]


def _alone(words: Sequence[Token], at: int, macros: Collection[str]) -> bool:
    """Whether a word has parentheses of its own, which are not those of a macro's arguments."""
    inside = 0 < at < len(words) - 1 and words[at - 1][3] == "(" and words[at + 1][3] == ")"
    return inside and (at < 2 or words[at - 2][3] not in macros)


def _closing(words: Sequence[Token], opening: int) -> int:
    """The number of the bracket that closes another; the last word's where none does."""
    depth = 0
    for number in range(opening, len(words)):
        depth += (words[number][3] in _OPEN) - (words[number][3] in _OPEN.values())
        if depth == 0:
            return number
    return len(words) - 1


def _split(words: Sequence[Token]) -> list[list[Token]]:
    parts: list[list[Token]] = [[]]
    depth = 0
    for word in words:
        depth += (word[3] in _OPEN) - (word[3] in _OPEN.values())
        if word[3] == "," and depth == 0:
            parts.append([])
        else:
            parts[-1].append(word)
    return parts


def _operand(words: Sequence[Token], names: Collection[str], macros: Mapping[str, Definition]) -> bool:
    """Whether words are one operand, whatever stands beside them; what a parameter stands for is not known."""
    at = 0
    while at < len(words) - 1 and words[at][3] in _SIGNS:
        at += 1
    if at >= len(words):
        return True
    first = words[at]
    if first[3] in names:
        return False
    macro = macros.get(first[3])
    if macro is not None and not _operand(
        macro.body, macro.parameters or (), {n: m for n, m in macros.items() if n != macro.name}
    ):
        return False
    at = _closing(words, at) + 1 if first[3] == "(" else at + 1
    while at < len(words):
        if words[at][3] in ("(", "["):
            at = _closing(words, at) + 1
        elif words[at][3] in (".", "->"):
            at += 2
        else:
            return False
    return True
