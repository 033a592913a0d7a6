"""EOL's operations on texts, with those of Java's String that EOL programs use; each takes the text first.

Indices count from 0; an index outside the text is an error, not a wrap-around. `replace`, `split` and `matches` take regular
expressions, as in the engine. Not here: conversions that any value has (`anything`).
Source: StringOperationContributor of Epsilon and java.lang.String.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from robosmi.query.collections import Q
from robosmi.query.models import literal_named
from robosmi.query.problems import OperandError
from robosmi.query.types import fits_integer

if TYPE_CHECKING:
    from robosmi.query.values import Answer


def _index(value: Any, low: int, high: int, name: str) -> int:
    if not fits_integer(value) or not low <= value <= high:
        raise OperandError(f"{name}: {value!r} is no index from {low} to {high}")
    return int(value)


def _text(value: Answer, name: str) -> str:
    if not isinstance(value, str):
        raise OperandError(f"{name} needs a text, not {value!r}")
    return value


def _pattern(regex: Answer, name: str) -> re.Pattern[str]:
    try:
        return re.compile(_text(regex, name))
    except re.error as error:
        raise OperandError(f"{name}: '{regex}' is no regular expression: {error}") from error


def _replacement(text: str) -> str:
    """Java's `$1` and `\\$` in Python's notation."""
    return re.sub(r"\\(.)|\$(\d)", lambda m: rf"\g<{m[2]}>" if m[2] else "\\\\" if m[1] == "\\" else m[1], text)


def length(text: str) -> int:
    """How many characters the text has."""
    return len(text)


def is_empty(text: str) -> bool:
    """Whether the text has no characters."""
    return not text


def is_blank(text: str) -> bool:
    """Whether the text has nothing but white space."""
    return not text.strip()


def substring(text: str, start: int, end: int | None = None) -> str:
    """The part from an index, up to another that is not included.

    Raises:
        OperandError: an index outside the text.

    >>> substring("robot", 2), substring("robot", 1, 3)
    ('bot', 'ob')
    """
    last = len(text) if end is None else _index(end, 0, len(text), "substring")
    return text[_index(start, 0, last, "substring") : last]


def character_at(text: str, index: int) -> str:
    """The character at an index.

    Raises:
        OperandError: an index outside the text.
    """
    return text[_index(index, 0, len(text) - 1, "characterAt")]


char_at = character_at


def starts_with(text: str, prefix: str, offset: int = 0) -> bool:
    """Whether the text, from an offset, begins with the prefix."""
    return offset >= 0 and text.startswith(_text(prefix, "startsWith"), offset)


def ends_with(text: str, suffix: str) -> bool:
    """Whether the text ends with the suffix."""
    return text.endswith(_text(suffix, "endsWith"))


def index_of(text: str, part: Any, start: int = 0) -> int:
    """Where the part first occurs, from a place on, or -1."""
    return text.find(chr(part) if fits_integer(part) else _text(part, "indexOf"), min(max(start, 0), len(text)))


def last_index_of(text: str, part: Any, start: int | None = None) -> int:
    """Index of the last occurrence of the part that begins at an index or before, or -1."""
    part_text = chr(part) if fits_integer(part) else _text(part, "lastIndexOf")
    if start is not None and start < 0:
        return -1
    return text.rfind(part_text) if start is None else text.rfind(part_text, 0, start + len(part_text))


def contains(text: str, part: str) -> bool:
    """Whether the part occurs in the text."""
    return _text(part, "contains") in text


def is_substring_of(text: str, other: str | None) -> bool:
    """Whether the text occurs in another; False if that is None."""
    return other is not None and text in other


def trim(text: str) -> str:
    """The text without white space and control characters at its ends."""
    return text.strip("".join(chr(code) for code in range(33)))


def strip(text: str) -> str:
    """The text without white space at its ends."""
    return text.strip()


def to_upper_case(text: str) -> str:
    """The text in upper case."""
    return text.upper()


def to_lower_case(text: str) -> str:
    """The text in lower case."""
    return text.lower()


def first_to_upper_case(text: str) -> str:
    """The text with its first character in upper case (EOL also `ftuc`)."""
    return text[:1].upper() + text[1:]


def first_to_lower_case(text: str) -> str:
    """The text with its first character in lower case (EOL also `ftlc`)."""
    return text[:1].lower() + text[1:]


ftuc = first_to_upper_case
ftlc = first_to_lower_case


def concat(text: str, other: str) -> str:
    """Both texts in one."""
    return text + _text(other, "concat")


def repeat(text: str, count: int) -> str:
    """The text so many times."""
    return text * _index(count, 0, 2**31 - 1, "repeat")


def replace(text: str, regex: str, replacement: str) -> str:
    """The text with all matches of a regular expression replaced; `$1` stands for a group.

    >>> replace("a-b", "-", "+"), replace("x1", "([a-z])([0-9])", "$2$1")
    ('a+b', '1x')
    """
    return _replaced(text, regex, replacement, 0, "replace")


def _replaced(text: str, regex: str, replacement: str, count: int, name: str) -> str:
    try:
        return _pattern(regex, name).sub(_replacement(_text(replacement, name)), text, count=count)
    except (re.error, IndexError) as error:
        raise OperandError(f"{name}: '{replacement}' is no replacement for '{regex}': {error}") from error


replace_all = replace


def replace_first(text: str, regex: str, replacement: str) -> str:
    """The text with the first match of a regular expression replaced."""
    return _replaced(text, regex, replacement, 1, "replaceFirst")


def replace_literal(text: str, part: str, replacement: str) -> str:
    """The text with all occurrences of another replaced; nothing is a regular expression."""
    return text.replace(_text(part, "replaceLiteral"), _text(replacement, "replaceLiteral"))


def split(text: str, regex: str, limit: int = 0) -> Q[str]:
    """The parts between matches of a regular expression; empty ones at the end are dropped.

    Args:
        text: the text.
        regex: what separates.
        limit: at most so many parts, the last with all the rest; negative keeps the empty ones at the end.

    >>> split("p;q;;", ";")
    Q(['p', 'q'])
    """
    parts: list[str] = []
    start = 0
    for match in _pattern(regex, "split").finditer(text):
        if limit > 0 and len(parts) == limit - 1:
            break
        if match.end() == 0:
            continue  # Java makes no empty part of an empty match at the beginning
        parts.append(text[start : match.start()])
        start = match.end()
    if not parts:
        return Q([text])
    parts.append(text[start:])
    while limit == 0 and parts and not parts[-1]:
        parts.pop()
    return Q(parts)


def matches(text: str, regex: str) -> bool:
    """Whether the whole text matches a regular expression."""
    return _pattern(regex, "matches").fullmatch(text) is not None


def pad(text: str, width: int, padding: str, right: bool) -> str:
    """The text with padding, on the right or left, until so many have been added as characters were missing."""
    missing = max(_index(width, -(2**31), 2**31 - 1, "pad") - len(text), 0)
    return text + _text(padding, "pad") * missing if right else _text(padding, "pad") * missing + text


def to_char_sequence(text: str) -> Q[str]:
    """The Sequence of the characters, each a text."""
    return Q(text)


def escape_xml(text: str) -> str:
    """The text with `&`, `<` and `>` escaped; quotation marks are left.

    >>> escape_xml('<b>"')
    '&lt;b&gt;"'
    """
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").replace("\r", "&#13;")


def to_enum(text: str) -> Any:
    """The enumeration literal `Genre#fiction` of the current run's models.

    Raises:
        UnknownTypeError: there is none.
    """
    return literal_named(text)


def equals(text: str, other: Answer) -> bool:
    """Whether the other is the same text."""
    return isinstance(other, str) and text == other


def equals_ignore_case(text: str, other: Answer) -> bool:
    """Whether the other is the same text but for upper and lower case."""
    return isinstance(other, str) and text.casefold() == other.casefold()


def compare_to(text: str, other: str) -> int:
    """Negative, 0 or positive, as the text comes before, is, or comes after the other."""
    for a, b in zip(text, _text(other, "compareTo"), strict=False):
        if a != b:
            return ord(a) - ord(b)
    return len(text) - len(other)
