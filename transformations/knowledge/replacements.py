"""The record of a change of text: a range of bytes and the text that takes its place.

Rules return replacements, and a plan stores them as `migration.TextChange`, with the unit, the rule and the reason. Fixes that a
finding offers (`diagnostics.TextEdit`) name lines and columns instead, as editors do.
"""

from __future__ import annotations

from typing import NamedTuple


class Replacement(NamedTuple):
    """A text that takes the place of a range of bytes; an empty range is an insertion.

    Attributes:
        start: offset of the first byte that is replaced.
        end: offset behind the last one.
        text: the new text.
    """

    start: int
    end: int
    text: str


def inserted(offset: int, text: str) -> Replacement:
    """The insertion of a text before the byte at an offset."""
    return Replacement(offset, offset, text)
