"""Repairs a damaged text for libclang alone: edits of a scratch copy, and the mapping of its offsets to the file's.

In C a statement with a syntax error is lost, often with the next one. So libclang's own fix-its (a missing semicolon) are
applied to a copy of the text, and where it has none, a bracket, brace or comma is inserted where it reports a missing one. An
edit is kept only when fewer errors are left. The errors stay findings; the file and the model's text are never changed. This
module proposes edits, the loop is in `parsing`.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Sequence

from robosmi.transformations.knowledge.lexer import Token
from robosmi.transformations.knowledge.replacements import Replacement, inserted

NESTED = "function definition is not allowed here"
MAX_ROUNDS = 10
"""Attempts to repair a text; each costs one parse."""
_ENDING = re.compile(r"[\s)\]};]*(?://.*)?$")
_HEADS = frozenset(["if", "while", "for", "switch"])
_CLOSERS = {")": "(", "]": "[", "}": "{"}
_EXPECTED = {"expected ')'": ")", "expected ']'": "]", "expected '('": "(", "expected ';'": ";", "expected '}'": "}"}


class Scratch:
    """A copy of a text with edits applied.

    Args:
        source: the bytes of the file.
        edits: in any order; one that overlaps another is left out.
    """

    def __init__(self, source: bytes, edits: Sequence[Replacement] = ()) -> None:
        self.edits: list[Replacement] = []
        behind = -1
        for edit in sorted(set(edits)):
            if edit.start >= behind and edit.end <= len(source):
                self.edits.append(edit)
                behind = max(edit.end, edit.start + 1)
        parts: list[bytes] = []
        self._starts: list[int] = []
        done = length = 0
        for edit in self.edits:
            text = edit.text.encode()
            parts += [source[done : edit.start], text]
            length += edit.start - done
            self._starts.append(length)
            length += len(text)
            done = edit.end
        parts.append(source[done:])
        self.data = b"".join(parts) if self.edits else source

    def source_offset(self, offset: int) -> int:
        """The offset in the file of an offset in the copy; inserted text maps to the place of its insertion."""
        number = bisect_right(self._starts, offset) - 1
        if number < 0:
            return offset
        edit = self.edits[number]
        inside = offset - self._starts[number] - len(edit.text.encode())
        return edit.end + inside if inside >= 0 else edit.start


def guess(message: str, offset: int, tokens: Sequence[Token], earlier: Sequence[int]) -> list[Replacement]:
    """Edits that may repair an error for which libclang has no fix-it; empty if none is known.

    Args:
        message: libclang's message.
        offset: its place in the file.
        tokens: tokens of the file without comments and directives.
        earlier: start offsets of these tokens.
    """
    number = bisect_right(earlier, offset) - 1
    if number >= 0 and tokens[number][2] <= offset:
        number += 1  # the place is behind that token
    at = tokens[number] if 0 <= number < len(tokens) else ("", offset, offset, "")
    if message.startswith(NESTED):
        return [inserted(_statement_start(tokens, number), "}")]
    if message.startswith("expected function body after function declarator"):
        return [inserted(offset, "{")]
    if message.startswith("extraneous closing brace"):
        closing = _closed_too_early(tokens, number)
        return [Replacement(closing, closing + 1, " ")] if closing is not None else []
    if message.startswith("expected expression"):
        return [inserted(at[1], "if(0);" if at[3] == "else" else "0 ")]
    if message.startswith("expected ';' after top level declarator") and number > 0 and tokens[number - 1][3] == ")":
        return [inserted(offset, "{")]
    missing = next((text for words, text in _EXPECTED.items() if message.startswith(words)), "")
    if missing == ")" and at[0] in ("name", "number", "string", "char") and not _of_a_head(tokens, number):
        return [inserted(offset, ",")]
    return [inserted(offset, missing)] if missing else []


def declared_only(offsets: Sequence[int], tokens: Sequence[Token]) -> list[Replacement]:
    """Edits that turn GNU C's nested functions, which libclang does not know, into a declaration and a block.

    Args:
        offsets: the offsets of their opening braces, where libclang reports them.
        tokens: tokens of the file. If its braces do not match, there are no edits: rather a function was not closed.
    """
    depth = sum((text == "{") - (text == "}") for kind, _, _, text in tokens if kind == "punct")
    return [inserted(offset, ";") for offset in offsets] if depth == 0 else []


def opening(offset: int, tokens: Sequence[Token], earlier: Sequence[int]) -> list[Replacement]:
    """An edit that inserts `(` after the name before a place, if the statement closes more parentheses than it opens."""
    number = bisect_right(earlier, offset) - 1
    if number >= 0 and tokens[number][2] > offset:
        number -= 1  # the place is at the token behind the name
    depth = 0
    for i in range(number + 1, len(tokens)):
        text = tokens[i][3]
        depth += (text == "(") - (text == ")")
        if depth < 0 or text in (";", "{", "}"):
            break
    back = number
    while depth < 0 and back >= 0 and tokens[back][3] not in (";", "{", "}", "("):
        if tokens[back][0] == "name" and (back == number or tokens[back][3] in _HEADS):
            return [inserted(tokens[back][2], "(")]
        back -= 1
    return []


def closed_strings(tokens: Sequence[Token]) -> list[Replacement]:
    """Edits that close each unterminated string before the brackets and the semicolon at the end of its line."""
    edits = []
    for kind, start, _, text in tokens:
        if kind in ("string", "char") and (len(text) < 2 or text[-1] != text.lstrip("LuU8")[0]):
            body = text.rstrip()
            ending = _ENDING.search(body)
            edits.append(inserted(start + (ending.start() if ending else len(body)), text.lstrip("LuU8")[:1]))
    return edits


def _statement_start(tokens: Sequence[Token], number: int) -> int:
    """The offset at which the statement that contains a token begins."""
    depth = 0
    i = min(number, len(tokens)) - 1
    while i >= 0:
        text = tokens[i][3]
        depth += (text in (")", "]")) - (text in ("(", "["))
        if depth <= 0 and text in (";", "{", "}"):
            return tokens[i][2]
        i -= 1
    return 0


def _closed_too_early(tokens: Sequence[Token], number: int) -> int | None:
    """The offset of the brace before a surplus one, which ended a function too early; None if no text lies between the two."""
    depth = 0
    last = None
    for kind, start, _, text in tokens[:number]:
        if kind == "punct" and text == "{":
            depth += 1
        elif kind == "punct" and text == "}":
            depth = max(0, depth - 1)
            if depth == 0:
                last = start
    between = next((t for t in tokens[:number] if last is not None and t[1] > last), None)
    return last if between is not None else None


def _of_a_head(tokens: Sequence[Token], number: int) -> bool:
    """Whether the innermost parenthesis open at a token belongs to `if`, `while`, `for` or `switch`."""
    open_: list[str] = []
    for i in range(number - 1, -1, -1):
        text = tokens[i][3]
        if text in _CLOSERS:
            open_.append(_CLOSERS[text])
        elif open_ and text == open_[-1]:
            open_.pop()
        elif text == "(":
            return i > 0 and tokens[i - 1][3] in _HEADS
        elif text in (";", "{", "}"):
            return False
    return False
