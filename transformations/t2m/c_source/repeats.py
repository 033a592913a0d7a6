"""Limits how often one name is declared in one scope: libclang compares each declaration with all before it.

C allows a name one definition, and a text with hundreds was made by a tool; parsing it would take minutes. So those beyond
`MOST_DECLARED` are cut out of the copy that is parsed, as is what nests too deep (`bounds`), and are reported in the same way.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from robosmi.transformations.knowledge.lexer import Token
from robosmi.transformations.t2m.c_source.mending import Edit

MOST_DECLARED = 400
"""Declarations of one name in one scope, each alternative of `#if` and `#else` counted."""

_BEHIND = frozenset("=;,[(")
_NO_TYPE = frozenset(["return", "goto", "else", "case", "do", "sizeof", "typeof", "__typeof__", "__extension__", "default"])

_NO_NAME = frozenset(["__attribute__", "__attribute", "__declspec", "asm", "__asm", "__asm__", "_Alignas"])
"""Words that stand before parentheses within a declaration without being the declared name."""


def repeats(tokens: Sequence[Token]) -> list[Edit]:
    """Edits that remove the declarations beyond the limit.

    Args:
        tokens: tokens of a file without comments and directives.
    """
    often = _often(tokens)
    return _cuts(tokens, often) if often else []


def _often(tokens: Sequence[Token]) -> set[str]:
    """The names that may be declared more often than the limit, judged over the whole file."""
    if len(tokens) < 3 * MOST_DECLARED:
        return set()
    names = Counter(text for kind, _, _, text in tokens if kind == "name")
    many = {name for name, count in names.items() if count > MOST_DECLARED}
    if not many:
        return set()
    declared = Counter(
        token[3]
        for before, token, behind in zip(tokens, tokens[1:], tokens[2:], strict=False)
        if token[3] in many and _declares(before, token, behind)
    )
    return {name for name, count in declared.items() if count > MOST_DECLARED}


def _declares(before: Token, token: Token, behind: Token) -> bool:
    of_type = (before[0] == "name" and before[3] not in _NO_TYPE) or before[3] == "*"
    return token[0] == "name" and token[3] not in _NO_NAME and of_type and behind[3] in _BEHIND


def _cuts(tokens: Sequence[Token], often: set[str]) -> list[Edit]:
    scopes: list[Counter[str]] = [Counter()]
    edits: list[Edit] = []
    first, round_, i = 0, 0, 0  # of the declaration, and round brackets that are open
    while i < len(tokens):
        text = tokens[i][3]
        if text == "{":
            scopes.append(Counter())
            first = i + 1
        elif text == "}":
            if len(scopes) > 1:
                scopes.pop()
            first, round_ = i + 1, 0
        elif text == ";" and not round_:
            first = i + 1
        elif text in "()":
            round_ = max(0, round_ + (1 if text == "(" else -1))
        elif text in often and not round_ and 0 < i < len(tokens) - 1 and _declares(tokens[i - 1], tokens[i], tokens[i + 1]):
            scopes[-1][text] += 1
            if scopes[-1][text] > MOST_DECLARED:
                i = _end(tokens, i)
                _take_out(edits, tokens[first][1], tokens[i][2], tokens[first - 1][2] if first else 0)
                first = i + 1
        i += 1
    return edits


def _end(tokens: Sequence[Token], number: int) -> int:
    """The index of a declaration's last token: its semicolon, or the brace that closes the body of a function."""
    depth = 0
    for i in range(number, len(tokens)):
        text = tokens[i][3]
        depth += (text in ("(", "[", "{")) - (text in (")", "]", "}"))
        if depth < 0:
            return i - 1
        if depth == 0 and (text == ";" or (text == "}" and (i + 1 == len(tokens) or tokens[i + 1][3] not in (",", ";")))):
            return i
    return len(tokens) - 1


def _take_out(edits: list[Edit], start: int, end: int, behind: int) -> None:
    """Add a cut, merged with the previous one if it directly follows it, so that both are reported as one."""
    if edits and edits[-1].offset + edits[-1].removed == behind:
        start = edits.pop().offset
    edits.append(Edit(start, end - start, b" "))
