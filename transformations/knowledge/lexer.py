"""A lexer for C text with offsets: identifiers, literals, punctuation, comments, and whole directives.

The parser's own tokens take ten times as long and omit what it did not compile. A directive is one token up to the end of its
last line. Only spelling is considered: no keyword, macro or type is known here, except for the few sets that other modules
share.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from functools import cache

Token = tuple[str, int, int, str]
"""(kind, start, end, text); the kinds are name, number, string, char, punct, comment, directive. A character is one byte."""

_STRING = r'"(?:\\(?:\r?\n|.)|[^"\\\n])*"?'
_CHAR = r"'(?:\\(?:\r?\n|.)|[^'\\\n])*'?"
_BLOCK = r"/\*.*?(?:\*/|\Z)"
_LINE = r"//(?:\\\r?\n|[^\n])*"
_SPACE = r"(?:[ \t\r\n\f\v]|\\\r?\n|\xef\xbb\xbf)+"
_WORD = r"[A-Za-z_$\x80-\xff][\w$\x80-\xff]*|\.?[0-9](?:[eEpP][+-]|[\w.])*"
_BEFORE = rf"{_SPACE}|{_BLOCK}|{_LINE}|{_WORD}|{_STRING}|{_CHAR}"
_DIRECTIVE = rf"(?:\#|%:)(?:\\\r?\n|{_BLOCK}|//[^\n]*|{_STRING}|[^\n\\/\"]|\\|/)*"
_DIGRAPH = "<%|%>|<:(?!:[^:>])|:>"
_BEHIND = rf">>=|<<=|\.\.\.|->|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|##|{_DIGRAPH}|."
_PIECES = re.compile(f"{_BEFORE}|{_DIRECTIVE}|{_BEHIND}", re.DOTALL | re.ASCII)
_KINDS = (
    dict.fromkeys("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_$", "name")
    | dict.fromkeys((chr(code) for code in range(128, 256)), "name")
    | dict.fromkeys("0123456789", "number")
    | dict.fromkeys(" \t\r\n\x0c\x0b", "space")
    | {'"': "string", "'": "char", "#": "directive"}
)
"""Kind of a token by its first character, except punctuation; some need further inspection."""
_SECOND_LOOK = frozenset("/\\.\xef%")

_DIGRAPHS = {"<%": "{", "%>": "}", "<:": "[", ":>": "]"}
_HAS_DIGRAPH = re.compile(_DIGRAPH)

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
    """All tokens of a text, in order.

    It never fails: a character that is in no C token counts as punctuation. The digraphs `<%`, `%>`, `<:` and `:>` have the
    text of the characters that they stand for.

    Args:
        data: the text.
        limit: stop when there are more tokens than this.
    """
    text = data.decode("latin-1")
    found: list[Token] = []
    end = 0
    fresh = True  # only at the start of a line does a hash open a directive
    for piece in _PIECES.findall(text):  # they leave nothing out, so their lengths give their places
        start, end = end, end + len(piece)
        first = piece[0]
        kind = _second_look(piece) if first in _SECOND_LOOK else _KINDS.get(first, "punct")
        if kind == "space":
            fresh = fresh or "\n" in piece
            continue
        if kind == "directive" and not fresh:
            found += _in_line(piece, start)
        else:
            found.append((kind, start, end, piece))
            if kind != "comment":
                fresh = kind == "directive"
        if len(found) > limit:
            break
    if _HAS_DIGRAPH.search(text):
        found = [(k, a, b, _DIGRAPHS.get(piece, piece) if k == "punct" else piece) for k, a, b, piece in found]
    return found


@cache
def _pieces_of_a_line() -> re.Pattern[str]:  # few programs have a hash within a line, and compiling takes milliseconds
    return re.compile(f"{_BEFORE}|{_BEHIND}", re.DOTALL | re.ASCII)


def _in_line(text: str, place: int) -> list[Token]:
    """The tokens from a `#` inside a line to the line's end."""
    found: list[Token] = []
    for piece in _pieces_of_a_line().findall(text):
        first = piece[0]
        kind = _second_look(piece) if first in _SECOND_LOOK else _KINDS.get(first, "punct")
        if kind != "space":
            found.append(("punct" if kind == "directive" else kind, place, place + len(piece), piece))
        place += len(piece)
    return found


def _second_look(piece: str) -> str:
    """The kind of a token whose first character does not determine it."""
    first, second = piece[0], piece[1:2]
    if first == "/":
        return "comment" if second == "/" or piece.startswith("/*") else "punct"
    if first == "%":
        return "directive" if second == ":" else "punct"
    if first == "\\":
        return "space" if second else "punct"
    if first == ".":
        return "number" if "0" <= second <= "9" else "punct"
    return "space" if piece.startswith("\xef\xbb\xbf") else "name"


_PARTS = re.compile(r"(?:#|%:)\s*(?P<word>\w*)\s*(?P<rest>.*)", re.DOTALL)
_CONTINUED, _IN_A_WORD = re.compile(r"\\\r?\n"), re.compile(r"(?<=\w)(?:\\\r?\n)+(?=\w)")
_COMMENTS = re.compile(rf"(?P<keep>{_STRING}|{_CHAR})|{_BLOCK}|{_LINE}", re.DOTALL)


def directive_parts(text: str) -> tuple[str, str]:
    """A directive's word and the rest of it, without comments and with continued lines joined."""
    joined = _CONTINUED.sub(" ", _IN_A_WORD.sub("", text))
    plain = _COMMENTS.sub(lambda m: m.group("keep") or " ", joined) if "/" in joined else joined
    match = _PARTS.match(plain)
    return (match["word"], match["rest"].strip()) if match else ("", "")


def directive_comments(text: str) -> list[tuple[int, int]]:
    """The comments in a directive, as ranges of its text."""
    return [m.span() for m in _COMMENTS.finditer(text) if m["keep"] is None] if "/" in text else []


def closing(words: Sequence[Token], opening: int) -> int:
    """The index of the token that closes the bracket at an index; the number of tokens if it is never closed."""
    depth = 0
    for number in range(opening, len(words)):
        depth += (words[number][3] in _OPENING) - (words[number][3] in _CLOSING)
        if depth == 0:
            return number
    return len(words)


_OPENING, _CLOSING = frozenset("([{"), frozenset(")]}")
_DEFINITION = re.compile(r"(?P<name>(?![0-9])(?:[\w$]|[^\x00-\x7f])+)(?:\((?P<parameters>[^)]*)\))?\s*(?P<body>.*)", re.DOTALL)


def definition_parts(rest: str) -> tuple[str, list[str] | None, str]:
    """Name, parameters (None for an object-like macro) and body of a `#define`; an empty name when it has none."""
    match = _DEFINITION.match(rest)
    if match is None:
        return "", None, ""
    given = match["parameters"]
    parameters = None if given is None else [p.strip() for p in given.split(",") if p.strip()]
    return match["name"], parameters, match["body"].strip()
