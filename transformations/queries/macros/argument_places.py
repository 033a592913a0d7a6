"""Places of the arguments of calls and macro uses in a text, found by its tokens.

The parser reports an argument without the parentheses around it, and nothing about what a macro's body passes on. `Holders`
finds the macro definition or use that contains a place.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Mapping, Sequence

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.lexer import Token, tokens

_OPEN, _CLOSE = "([{", ")]}"


class TokenText:
    """The tokens of a text that count for the compiler, comments left out.

    Args:
        data: the text.
        offset: of its first byte in the file.
    """

    def __init__(self, data: bytes, offset: int = 0) -> None:
        self.tokens: list[Token] = [
            (kind, start + offset, end + offset, text) for kind, start, end, text in tokens(data) if kind != "comment"
        ]
        self._starts = [token[1] for token in self.tokens]

    def at(self, offset: int) -> int:
        """Index of the first token that begins at an offset or behind it."""
        return bisect_left(self._starts, offset)

    def arguments(self, index: int) -> list[list[Token]] | None:
        """The tokens of each argument behind the name with this index; None where no parenthesis follows it or none closes."""
        if index + 1 >= len(self.tokens) or self.tokens[index + 1][3] != "(":
            return None
        found: list[list[Token]] = [[]]
        depth = 0
        for token in self.tokens[index + 2 :]:
            text = token[3]
            if depth == 0 and text == ")":
                return found if found != [[]] else []
            if depth == 0 and text == ",":
                found.append([])
                continue
            depth += (text in _OPEN) - (text in _CLOSE)
            found[-1].append(token)
        return None

    def last_arguments(self, end: int) -> list[list[Token]] | None:
        """The tokens of each argument of the call that ends at an offset; None where no parenthesis closes there."""
        last = bisect_left(self._starts, end) - 1
        if last < 0 or self.tokens[last][2] != end or self.tokens[last][3] != ")":
            return None
        depth = 0
        for index in range(last, 0, -1):
            text = self.tokens[index][3]
            depth += (text in _CLOSE) - (text in _OPEN)
            if depth == 0:
                return self.arguments(index - 1)
        return None


def without_parentheses(argument: Sequence[Token]) -> Sequence[Token]:
    """An argument's tokens without parentheses that enclose all of it."""
    while len(argument) > 2 and argument[0][3] == "(" and argument[-1][3] == ")" and _closes_last(argument):
        argument = argument[1:-1]
    return argument


def _closes_last(argument: Sequence[Token]) -> bool:
    """Whether the first parenthesis is closed by the last token."""
    depth = 0
    for i, token in enumerate(argument):
        depth += (token[3] in _OPEN) - (token[3] in _CLOSE)
        if depth == 0:
            return i == len(argument) - 1
    return False


class Holders:
    """Definitions and uses of macros by their places in a unit's text.

    Args:
        elements: the definitions and uses.
    """

    def __init__(self, elements: Sequence[ccode.Located]) -> None:
        self._all: list[tuple[int, int, ccode.Located]] = []
        for each in sorted(elements, key=lambda one: (int(one.startOffset), -int(one.endOffset))):
            if not self._all or each.startOffset >= self._all[-1][1]:  # what is inside another one is left out
                self._all.append((int(each.startOffset), int(each.endOffset), each))

    def at(self, offset: int) -> ccode.Located | None:
        """The outermost macro definition or use that contains a byte offset, None if there is none."""
        index = bisect_right(self._all, offset, key=lambda one: one[0]) - 1
        return self._all[index][2] if index >= 0 and offset < self._all[index][1] else None


def passed_to_macros(
    unit: ccode.SourceUnit, text: TokenText, macros: Mapping[str, ccode.Macro]
) -> Iterator[tuple[tuple[str, int, int], tuple[str, str, int]]]:
    """Each argument of a macro use, as (path, start, end), with the macro's parameter, whose body decides what becomes of it."""
    for use in unit.macroUses:
        macro = use.macro or macros.get(str(use.name))
        if macro is None or not macro.functionLike:
            continue
        for i, argument in enumerate(text.arguments(text.at(int(use.startOffset))) or []):
            if argument:
                yield (str(unit.path), argument[0][1], argument[-1][2]), ("macro parameter", str(macro.name), i)
