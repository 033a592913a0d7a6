"""What all quoting shares: a text on one line, invisible characters made visible, and the rule for terminals."""

from __future__ import annotations

import re
from collections.abc import Callable

BREAKS = r"\n\r\v\f\x1c-\x1e\x85\u2028\u2029"
"""What ends a line for some reader: C's and Unicode's line breaks, as a character class."""

_BREAK = re.compile(rf"[{BREAKS}]+")
_UNSEEN = re.compile(
    "[\x00-\x08\x0a-\x1f\x7f-\x9f\u034f\u061c\u115f\u1160\u17b4\u17b5\u180e\u200b"
    "\u200e\u200f\u2028-\u202e\u2060-\u206f\u3164\ufeff\uffa0\ufff9-\ufffb\ud800-\udfff\U000e0000-\U000e007f]"
)
"""Control characters but the tab, marks that turn the direction of text, what has no width, and halves of characters. Those that
join letters of a script or an emoji (U+200C, U+200D) are text, and so are those that belong to the letter before them, as accents
and variation selectors do."""


class Quoted(str):
    """A text that is quoted already, or needs no quoting.

    Attributes:
        place: the place that it is quoted for (see `generate.languages`); "" for a text that is printed as it is anywhere.
    """

    __slots__ = ("place",)
    place: str

    def __new__(cls, text: str, place: str = "") -> Quoted:
        """A text for a place."""
        made = super().__new__(cls, text)
        made.place = place
        return made

    def __str__(self) -> str:  # Jinja calls str() on every value; the class must outlive that
        return self


def one_line(text: str) -> str:
    r"""The text with a blank for each run of line breaks.

    >>> one_line("LED\r\nint evil;")
    'LED int evil;'
    """
    return _BREAK.sub(" ", text)


def visible(text: str) -> str:
    r"""The text with escapes for what cannot be seen or acts on its reader: `\x1b`, `\u202e`; the tab stays.

    >>> visible("\x1b[2Jred\u202e")
    '\\x1b[2Jred\\u202e'
    """
    return _UNSEEN.sub(_escape, text)


def replace_unseen(text: str, replacement: Callable[[str], str]) -> str:
    """The text with what `visible` escapes replaced, character by character."""
    return _UNSEEN.sub(lambda found: replacement(found[0]), text)


def _escape(found: re.Match[str]) -> str:
    code = ord(found[0])
    return {"\n": r"\n", "\r": r"\r"}.get(found[0]) or (
        f"\\x{code:02x}" if code < 0x100 else f"\\u{code:04x}" if code < 0x10000 else f"\\U{code:08x}"
    )


def terminal(text: str) -> str:
    r"""A text for a terminal, on one line: no escape sequence, no change of direction, no line of its own.

    >>> terminal("LED\n\x1b]0;title\x07")
    'LED\\n\\x1b]0;title\\x07'
    """
    return visible(text)


def terminal_lines(text: str) -> str:
    """As `terminal`, for a text whose line feeds are meant."""
    return "\n".join(visible(line) for line in text.split("\n"))
