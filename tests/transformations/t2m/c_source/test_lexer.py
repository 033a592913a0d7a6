"""Tokens with their offsets: nothing is lost, nothing is read twice, and no text takes long."""

from __future__ import annotations

import time

import pytest
from hypothesis import given, strategies as st

from robosmi.transformations.knowledge.lexer import tokens

PARTS = [
    "#",
    '"',
    "'",
    "\\",
    "\n",
    "\r\n",
    "/*",
    "*/",
    "//",
    " ",
    "a",
    "L",
    "0x1e+",
    ".5",
    ".",
    "...",
    "<<=",
    "->",
    "\xef\xbb\xbf",
    "\xe9",
    "define",
]


def kinds(text: str) -> list[tuple[str, str]]:
    """Kinds and texts."""
    return [(kind, found) for kind, _, _, found in tokens(text.encode("latin-1"))]


@given(st.lists(st.sampled_from(PARTS), max_size=20).map("".join))
def test_what_is_no_token_is_space(text: str) -> None:
    behind = 0
    for _, start, end, found in tokens(text.encode("latin-1")):
        assert text[start:end] == found != ""
        assert not text[behind:start].replace("\xef\xbb\xbf", "").replace("\\\r\n", "").replace("\\\n", "").strip(" \t\r\n\f\v")
        behind = end


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a>>=b...", [("name", "a"), ("punct", ">>="), ("name", "b"), ("punct", "...")]),
        ("1e+5 .5 0x1F .", [("number", "1e+5"), ("number", ".5"), ("number", "0x1F"), ("punct", ".")]),
        ("a/b//c\n/*d*/", [("name", "a"), ("punct", "/"), ("name", "b"), ("comment", "//c"), ("comment", "/*d*/")]),
        ("\"a\\\"b\" '\\''", [("string", '"a\\"b"'), ("char", "'\\''")]),
        ('"open\nx', [("string", '"open'), ("name", "x")]),
        ("\xef\xbb\xbfint \xefx", [("name", "int"), ("name", "\xefx")]),
        ("a \\\nb \\c", [("name", "a"), ("name", "b"), ("punct", "\\"), ("name", "c")]),
        ("/* open", [("comment", "/* open")]),
    ],
)
def test_tokens_of(text: str, expected: list[tuple[str, str]]) -> None:
    assert kinds(text) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("#define A 1 /* one\nmore */ 2\nb", [("directive", "#define A 1 /* one\nmore */ 2"), ("name", "b")]),
        ("  /* c */ # if X \\\n  Y\n", [("comment", "/* c */"), ("directive", "# if X \\\n  Y")]),
        ("a # b ## c\n#d", [("name", "a"), ("punct", "#"), ("name", "b"), ("punct", "##"), ("name", "c"), ("directive", "#d")]),
        (
            'a #"x\\"#" # \'y\'\nz',
            [("name", "a"), ("punct", "#"), ("string", '"x\\"#"'), ("punct", "#"), ("char", "'y'"), ("name", "z")],
        ),
    ],
)
def test_only_at_the_start_of_a_line_does_a_hash_open_a_directive(text: str, expected: list[tuple[str, str]]) -> None:
    assert kinds(text) == expected


def test_it_stops_when_there_are_too_many() -> None:
    assert 10 < len(tokens(b"a " * 1000, 10)) < 1000


@pytest.mark.parametrize("part", [b"#", b'#"', b"# ", b"/", b"\\", b'"\\', b"/*", b"'", b"."])
def test_no_text_takes_long(part: bytes) -> None:
    start = time.process_time()
    tokens(b"x " + part * 300_000)
    assert time.process_time() - start < 5
