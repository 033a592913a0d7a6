"""Independent judges of our texts: libclang's tokens, a CommonMark parser, Python's HTML parser; and hostile texts."""

from __future__ import annotations

import random
import re
import unicodedata
from html.parser import HTMLParser

import clang.cindex
from hypothesis import strategies as st
from markdown_it import MarkdownIt
from markdown_it.token import Token

ATTACKS = (
    "LED\nint evil=42; //", "LED\r\nint evil;", "\\", "a \\ ", "??/", "a??/", "*/ int evil; /*", "/*", "//", "\u2028int evil;",
    "\x0cint evil;", "\x0bint evil;", "\x85x", "\x00", "\udcff", "\ud800", "\x1b[2J\x1b]0;owned\x07", "\u202egnp.exe", "\x9b31m",
    "<script>alert(1)</script>", "<img src=x onerror=alert(1)>", "[x](javascript:alert(1))", "![x](http://evil/p.png)",
    "<javascript:alert(1)>", "[x]: javascript:alert(1)", "&lt;b&gt;", "&#60;script&#62;", "`code`", "``", "a|b", "a\\|b", "**b**",
    "_b_", "~~b~~", "# head", "- item", "1. item", "===", "---", "> quote", "```", "    code", "http://evil", "www.evil.com",
    "a@evil.com", "=HYPERLINK(\"http://evil\")", "+1+cmd|' /C calc'!A0", "-2+3", "@SUM(1)", "\t=1", "'=1",
    '"', "'", '");evil();//',
    "#include <evil.h>", "int", "__attribute__", "_X", "9V", "Ω", "", " ", "a: b", "- x", "no",
    "1e3", "%getenv(\"HOME\")",
    "!include /etc/passwd", "}", "@enduml", "]]>", "-->", "x.h>\nint evil;//", "{{ evil }}", "{% evil %}", "${evil}",
    "\ufeff", "\u200b",
)  # fmt: skip
"""Texts that would be code, markup or commands in some language."""

_ALPHABET = "".join(sorted(set("".join(ATTACKS)))) + "aZ09 _ä灯\U0001f600"


def texts() -> st.SearchStrategy[str]:
    """Any text at all: attacks, attacks in a row, texts of characters that mean something somewhere, and of any others."""
    attack = st.sampled_from(ATTACKS)
    return st.one_of(attack, st.lists(attack, max_size=4).map("".join), st.text(_ALPHABET, max_size=12), st.text(max_size=20))


def any_text(chance: random.Random) -> str:
    """The same for a fuzzer."""
    kind = chance.randrange(3)
    if kind == 0:
        return "".join(chance.choice(ATTACKS) for _ in range(chance.randrange(1, 5)))
    if kind == 1:
        return "".join(chance.choice(_ALPHABET) for _ in range(chance.randrange(16)))
    return "".join(
        chr(chance.choice((chance.randrange(256), chance.randrange(0x3000), chance.randrange(0x110000)))) for _ in range(8)
    )


def tokens(code: str, name: str = "x.c", *options: str) -> list[str]:
    """The tokens of C (or C++, by the name's ending) as libclang reads them, without comments."""
    data = code.encode("utf-8", "surrogateescape")
    assert b"\0" not in data
    index = clang.cindex.Index.create()
    unit = index.parse(name, args=["-fsyntax-only", *options], unsaved_files=[(name, code)])
    return [token.spelling for token in unit.cursor.get_tokens() if token.kind != clang.cindex.TokenKind.COMMENT]


def problems(code: str, name: str, *options: str) -> list[str]:
    """libclang's diagnostics about a code, warnings included."""
    unit = clang.cindex.Index.create().parse(name, args=["-fsyntax-only", *options], unsaved_files=[(name, code)])
    return [diagnostic.spelling for diagnostic in unit.diagnostics]


_PLAIN = {"text", "text_special", "softbreak", "code_inline", "inline"}


def _tokens_of(text: str) -> list[Token]:
    found: list[Token] = []
    for block in MarkdownIt("commonmark", {"html": True}).enable(["table", "strikethrough"]).parse(text):
        found += [block, *(block.children or ())]
    return found


def markdown_kinds(text: str) -> list[str]:
    """The kinds of all tokens of a Markdown text that are more than text."""
    return [token.type for token in _tokens_of(text) if token.type not in _PLAIN]


def markdown_html(text: str) -> list[str]:
    """What a Markdown text has of HTML, in order."""
    return [token.content.strip() for token in _tokens_of(text) if token.type in ("html_block", "html_inline")]


def markdown_text(text: str) -> str:
    """The text that a reader of rendered Markdown sees, with runs of blanks as one."""
    shown = (" " if t.type == "softbreak" else t.content for t in _tokens_of(text) if t.type in _PLAIN and t.type != "inline")
    return " ".join("".join(shown).split())


class Page(HTMLParser):
    """An HTML text as Python's parser reads it.

    Attributes:
        tags: each tag with its attributes.
        text: all that is between tags.
        comments: the comments.
    """

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.text = ""
        self.comments: list[str] = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note a tag."""
        self.tags.append((tag, dict(attrs)))

    def handle_data(self, data: str) -> None:
        """Note a text."""
        self.text += data

    def handle_comment(self, data: str) -> None:
        """Note a comment."""
        self.comments.append(data)


_WRITING = re.compile(
    "[\u0600-\u0605\u06dd\u070f\u0890\u0891\u08e2\u200c\u200d\xad"
    "\U000110bd\U000110cd\U00013430-\U0001343f\U0001bca0-\U0001bca3\U0001d173-\U0001d17a]"
)
"""Format characters that belong to the writing of a script, or join letters."""


def acts_on_terminal(text: str) -> list[str]:
    """The characters that a terminal obeys, or that hide or reorder their neighbours."""
    kinds = ("Cc", "Cf", "Cs", "Zl", "Zp")
    return [c for c in text if c not in "\n\t" and unicodedata.category(c) in kinds and not _WRITING.match(c)]
