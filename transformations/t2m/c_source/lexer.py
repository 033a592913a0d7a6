"""Tokens of C text with their offsets: identifiers, literals, punctuation, comments, and whole directives.

The parser's own tokens cost ten times as much and leave out what it did not compile. A directive is one token up to the
end of its last line. Spelling only: no keyword, macro or type is known here but the few sets that others share.
"""

from __future__ import annotations

import re
import sys

Token = tuple[str, int, int, str]
"""Kind (name, number, string, char, punct, comment, directive), start, end, text. One character is one byte."""

_STRING = r'"(?:\\(?:\r?\n|.)|[^"\\\n])*"?'
_CHAR = r"'(?:\\(?:\r?\n|.)|[^'\\\n])*'?"
_BLOCK = r"/\*.*?(?:\*/|\Z)"
_LINE = r"//(?:\\\r?\n|[^\n])*"
_TOKEN = re.compile(
    rf"(?P<space>(?:[ \t\r\n\f\v]|\\\r?\n|\xef\xbb\xbf)+)|(?P<comment>{_BLOCK}|{_LINE})"
    r"|(?P<name>[A-Za-z_$\x80-\xff][\w$\x80-\xff]*)"
    rf"|(?P<number>\.?[0-9](?:[eEpP][+-]|[\w.])*)|(?P<string>(?:L|u8?|U)?{_STRING})|(?P<char>{_CHAR})"
    rf"|(?P<directive>\#(?:\\\r?\n|{_BLOCK}|//[^\n]*|{_STRING}|[^\n\\/\"]|\\|/)*)"
    r"|(?P<punct>>>=|<<=|\.\.\.|->|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|##|.)",
    re.DOTALL | re.ASCII,
)

KEYWORDS = frozenset(
    [
        "auto",
        "break",
        "case",
        "char",
        "const",
        "continue",
        "default",
        "do",
        "double",
        "else",
        "enum",
        "extern",
        "float",
        "for",
        "goto",
        "if",
        "inline",
        "int",
        "long",
        "register",
        "restrict",
        "return",
        "short",
        "signed",
        "sizeof",
        "static",
        "struct",
        "switch",
        "typedef",
        "union",
        "unsigned",
        "void",
        "volatile",
        "while",
        "_Bool",
        "_Complex",
        "_Imaginary",
        "__attribute__",
        "__asm__",
        "asm",
        "__asm",
        "typeof",
        "__typeof__",
        "__inline",
        "__inline__",
        "__extension__",
        "__volatile__",
        "__const",
    ]
)
TYPE_WORDS = frozenset(
    [
        "void",
        "char",
        "short",
        "int",
        "long",
        "float",
        "double",
        "signed",
        "unsigned",
        "_Bool",
        "_Complex",
        "__signed__",
        "__int128",
    ]
)
QUALIFIERS = frozenset(["const", "volatile", "restrict", "__const", "__volatile__", "__restrict", "__extension__"])
STORAGE_WORDS_OF_CXX = frozenset(["virtual", "explicit", "constexpr", "friend", "mutable", "thread_local"])
STORAGE_WORDS = frozenset(["extern", "static", "register", "auto", "typedef", "inline", "__inline", "__inline__", "_Noreturn"])


def tokens(data: bytes, limit: int = sys.maxsize) -> list[Token]:
    """All tokens of the text, in text order. Never fails: what is no token of C is punctuation of one character.

    Args:
        data: the text.
        limit: stop when there are more tokens than this.
    """
    text = data.decode("latin-1")
    found: list[Token] = []
    end = 0
    while end < len(text):
        fresh = True  # only at the start of a line does a hash open a directive
        for match in _TOKEN.finditer(text, end):
            kind = match.lastgroup
            end = match.end()
            if kind == "space":
                fresh = fresh or "\n" in match.group()
                if len(found) > limit:
                    break
                continue
            if kind == "directive" and not fresh:
                end = match.start() + 1
                found.append(("punct", match.start(), end, "#"))
                break
            found.append((kind or "punct", match.start(), end, match.group()))
            if kind != "comment":
                fresh = kind == "directive"
        if len(found) > limit:
            break
    return found


_PARTS = re.compile(r"#\s*(?P<word>\w*)\s*(?P<rest>.*)", re.DOTALL)
_COMMENTS = re.compile(rf"(?P<keep>{_STRING}|{_CHAR})|{_BLOCK}|{_LINE}", re.DOTALL)


def directive_parts(text: str) -> tuple[str, str]:
    """A directive's word and the rest of it, without comments and with continued lines joined."""
    joined = re.sub(r"\\\r?\n", " ", text)
    plain = _COMMENTS.sub(lambda m: m.group("keep") or " ", joined) if "/" in joined else joined
    match = _PARTS.match(plain)
    return (match["word"], match["rest"].strip()) if match else ("", "")


def directive_comments(text: str) -> list[tuple[int, int]]:
    """The comments in a directive, as ranges of its text."""
    return [m.span() for m in _COMMENTS.finditer(text) if m["keep"] is None] if "/" in text else []


_DEFINITION = re.compile(r"(?P<name>[A-Za-z_$][\w$]*)(?:\((?P<parameters>[^)]*)\))?\s*(?P<body>.*)", re.DOTALL)


def definition_parts(rest: str) -> tuple[str, list[str] | None, str]:
    """Name, parameters (None for an object-like macro) and body of a `#define`; an empty name when it has none."""
    match = _DEFINITION.match(rest)
    if match is None:
        return "", None, ""
    given = match["parameters"]
    parameters = None if given is None else [p.strip() for p in given.split(",") if p.strip()]
    return match["name"], parameters, match["body"].strip()
