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
from typing import NamedTuple

from robosmi.transformations.knowledge.lexer import Token

NESTED = "function definition is not allowed here"
MAX_ROUNDS = 10
"""Attempts to repair a text; each costs one parse."""
_ENDING = re.compile(r"[\s)\]};]*(?://.*)?$")
_HEADS = frozenset(["if", "while", "for", "switch"])
_CLOSERS = {")": "(", "]": "[", "}": "{"}
_EXPECTED = {"expected ')'": ")", "expected ']'": "]", "expected '('": "(", "expected ';'": ";", "expected '}'": "}"}


class Edit(NamedTuple):
    """An edit of the copy: so many bytes at an offset of the file are replaced by a text."""

    offset: int
    removed: int
    text: bytes


class Scratch:
    """A copy of a text with edits applied.

    Args:
        source: the bytes of the file.
        edits: in any order; one that overlaps another is left out.
    """

    def __init__(self, source: bytes, edits: Sequence[Edit] = ()) -> None:
        self.edits: list[Edit] = []
        behind = -1
        for edit in sorted(set(edits)):
            if edit.offset >= behind and edit.offset + edit.removed <= len(source):
                self.edits.append(edit)
                behind = edit.offset + max(edit.removed, 1)
        parts: list[bytes] = []
        self._starts: list[int] = []
        done = length = 0
        for edit in self.edits:
            parts += [source[done : edit.offset], edit.text]
            length += edit.offset - done
            self._starts.append(length)
            length += len(edit.text)
            done = edit.offset + edit.removed
        parts.append(source[done:])
        self.data = b"".join(parts) if self.edits else source

    def source_offset(self, offset: int) -> int:
        """The offset in the file of an offset in the copy; inserted text maps to the place of its insertion."""
        number = bisect_right(self._starts, offset) - 1
        if number < 0:
            return offset
        edit = self.edits[number]
        inside = offset - self._starts[number] - len(edit.text)
        return edit.offset + edit.removed + inside if inside >= 0 else edit.offset


def guess(message: str, offset: int, tokens: Sequence[Token], earlier: Sequence[int]) -> list[Edit]:
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
        return [Edit(_statement_start(tokens, number), 0, b"}")]
    if message.startswith("expected function body after function declarator"):
        return [Edit(offset, 0, b"{")]
    if message.startswith("extraneous closing brace"):
        closing = _closed_too_early(tokens, number)
        return [Edit(closing, 1, b" ")] if closing is not None else []
    if message.startswith("expected expression"):
        return [Edit(at[1], 0, b"if(0);" if at[3] == "else" else b"0 ")]
    if message.startswith("expected ';' after top level declarator") and number > 0 and tokens[number - 1][3] == ")":
        return [Edit(offset, 0, b"{")]
    missing = next((text for words, text in _EXPECTED.items() if message.startswith(words)), "")
    if missing == ")" and at[0] in ("name", "number", "string", "char") and not _of_a_head(tokens, number):
        return [Edit(offset, 0, b",")]
    return [Edit(offset, 0, missing.encode())] if missing else []


def declared_only(offsets: Sequence[int], tokens: Sequence[Token]) -> list[Edit]:
    """Edits that turn GNU C's nested functions, which libclang does not know, into a declaration and a block.

    Args:
        offsets: the offsets of their opening braces, where libclang reports them.
        tokens: tokens of the file. If its braces do not match, there are no edits: rather a function was not closed.
    """
    depth = sum((text == "{") - (text == "}") for kind, _, _, text in tokens if kind == "punct")
    return [Edit(offset, 0, b";") for offset in offsets] if depth == 0 else []


def opening(offset: int, tokens: Sequence[Token], earlier: Sequence[int]) -> list[Edit]:
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
            return [Edit(tokens[back][2], 0, b"(")]
        back -= 1
    return []


def closed_strings(tokens: Sequence[Token]) -> list[Edit]:
    """Edits that close each unterminated string before the brackets and the semicolon at the end of its line."""
    edits = []
    for kind, start, _, text in tokens:
        if kind in ("string", "char") and (len(text) < 2 or text[-1] != text.lstrip("LuU8")[0]):
            body = text.rstrip()
            ending = _ENDING.search(body)
            edits.append(Edit(start + (ending.start() if ending else len(body)), 0, text.lstrip("LuU8")[:1].encode()))
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
