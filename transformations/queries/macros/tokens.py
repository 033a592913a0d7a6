"""The names in a source text with their places, comments and literals left out, names in directives included.

A name means the same thing under a new name wherever all its tokens are renamed, whatever the parser made of them: text
that was not compiled, bodies of macros, members. Names of headers in include directives are no names.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from robosmi.transformations.knowledge.lexer import tokens

_INCLUDE = re.compile(r"#\s*(include|pragma|error|warning|line)\b")


def name_tokens(data: bytes) -> Iterator[tuple[int, int, str]]:
    """Start, end and text of each name, in text order."""
    for kind, start, end, text in tokens(data):
        if kind == "name":
            yield start, end, text
        elif kind == "directive" and not _INCLUDE.match(text):
            for inner, first, last, word in tokens(data[start + 1 : end]):
                if inner == "name":
                    yield start + 1 + first, start + 1 + last, word


def names_in(text: str) -> set[str]:
    """The names in the body of a macro or in another piece of a source text; suffixes of numbers (`24L`, `1e5f`) are none."""
    return {name for _, _, name in name_tokens(text.encode("latin-1", errors="replace"))}
