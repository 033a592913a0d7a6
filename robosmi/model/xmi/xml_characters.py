"""Writes texts of models as XML: escapes markup, and characters that XML 1.0 cannot represent.

XML cannot represent most control characters (form feed, NUL), lone surrogates, U+FFFE and U+FFFF, not even as character
references. In an XMI file each is written as the symbol U+241B, Unicode's "symbol for escape", and four hexadecimal digits: a
form feed is `␛000C`. Eclipse and every other tool treats it as ordinary text. A symbol in the text itself is kept, unless it
would read as such an escape: then it is written as `␛241B`. The writer decides which texts of a file are escaped.
"""

from __future__ import annotations

import re
from collections.abc import Callable

_FORBIDDEN = "\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff"  # XML 1.0, production Char
_SYMBOL = "\u241b"
_CODE = "00(?:0[0-8BCEF]|1[0-9A-F])|D[89A-F][0-9A-F]{2}|FFF[EF]|241B"
_BAD = re.compile(f"[{_FORBIDDEN}]")
_TO_ESCAPE = re.compile(f"[{_FORBIDDEN}]|{_SYMBOL}(?={_CODE})")
_ESCAPE = re.compile(f"{_SYMBOL}({_CODE})")
_AS_REFERENCE = re.compile(rb"&#(?:[xX]0*241[bB]|0*9243);")
_OTHER_ENCODING = re.compile(rb"[^>]*encoding\s*=\s*[\"'](?![uU][tT][fF]-?8[\"'])")
_MARKUP = {"&": "&amp;", "<": "&lt;", '"': "&quot;", "\n": "&#xA;", "\t": "&#x9;", "\r": "&#xD;", "]]>": "]]&gt;"}
_IN_ATTRIBUTE = re.compile(f'[&<"\n\t\r{_SYMBOL}{_FORBIDDEN}]')
markup_in_attribute = _IN_ATTRIBUTE.search
"""What a text has that does not stand between the quotes of an attribute as it is, or None."""
_IN_TEXT = re.compile(f'[&<"\r{_SYMBOL}{_FORBIDDEN}]|]]>')


def in_attribute(text: str) -> str:
    """A text as it stands between the quotes of an attribute."""
    return _marked(text, _IN_ATTRIBUTE) if _IN_ATTRIBUTE.search(text) else text


def in_text(text: str) -> str:
    """A text as it stands between tags."""
    return _marked(text, _IN_TEXT) if _IN_TEXT.search(text) else text


def _marked(text: str, pattern: re.Pattern[str]) -> str:
    return pattern.sub(lambda match: _MARKUP.get(match.group(), match.group()), escaped(text))


def refuse_forbidden(text: str) -> str:
    """Return the text unchanged if XML can represent it.

    Raises:
        ValueError: it has a character that XML cannot represent; the message says which and where.
    """
    if bad := _BAD.search(text):
        raise ValueError(f"holds U+{ord(bad.group()):04X} at {bad.start()}, which XML cannot hold")
    return text


def escaped(text: str) -> str:
    """The text with an escape in place of each character that XML cannot hold; `restored` undoes it."""
    return _TO_ESCAPE.sub(lambda match: f"{_SYMBOL}{ord(match.group()):04X}", text)


def restored(text: str) -> str:
    """The text that `escaped` was given. Half surrogates that meet stay two characters, as Python has them."""
    return _ESCAPE.sub(lambda match: chr(int(match[1], 16)), text) if _SYMBOL in text else text


def may_contain_escapes(data: bytes) -> bool:
    """Whether an XML document may contain an escape; a fast check in UTF-8 that avoids examining each text."""
    if data[:2] in (b"\xff\xfe", b"\xfe\xff") or _OTHER_ENCODING.match(data) or _SYMBOL.encode() in data:
        return True
    return b"&#" in data and _AS_REFERENCE.search(data) is not None


def restoring(start: Callable[[str, dict[str, str]], None]) -> Callable[[str, dict[str, str]], None]:
    """A parser's handler of elements with the characters in the attributes that XML cannot hold."""
    return lambda tag, attributes: start(tag, {name: restored(text) for name, text in attributes.items()})
