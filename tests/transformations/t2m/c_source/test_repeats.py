"""Declarations of one name in one scope: hundreds are cut out of the parser's copy, and real programs are left alone."""

from __future__ import annotations

import pytest

from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.t2m.c_source.parsing.bounds import MOST_DECLARED, repeats
from robosmi.transformations.t2m.c_source.parsing.error_recovery import Scratch


def left(text: str) -> str:
    """The text that libclang gets."""
    data = text.encode()
    plain = [token for token in tokens(data) if token[0] not in ("comment", "directive")]
    return Scratch(data, repeats(plain)).data.decode()


@pytest.mark.parametrize(
    "line",
    [
        "void again(int x) { if (x) { x++; } }\n",
        "int again = 1;\n",
        "static int again[3] = {1, 2, 3};\n",
        "struct s *again(void);\n",
        "int again, other;\n",
    ],
)
def test_what_is_beyond_the_limit_goes(line: str) -> None:
    kept = left("int first;\n" + line * (MOST_DECLARED * 2) + "int last;\n")
    assert kept.count("again") == MOST_DECLARED
    assert "int first;" in kept
    assert "int last;" in kept


def test_cuts_that_follow_each_other_are_one() -> None:
    text = "int again = 1;\n" * (MOST_DECLARED * 3)
    assert len(repeats(tokens(text.encode()))) == 1


@pytest.mark.parametrize(
    "text",
    [
        "".join(f"void f{i}(void) {{ for (int i = 0; i < 3; i++) {{ int again = i; }} }}\n" for i in range(MOST_DECLARED * 2)),
        "int x; int main(void) {" + "x = 1; call(x); return x;\n" * (MOST_DECLARED * 2) + "}",
        "struct s { int a; };\n" + "".join(f"struct s v{i};\n" for i in range(MOST_DECLARED * 2)),
        "int again = 1;\n" * MOST_DECLARED,
        "".join(f"int __attribute__((noinline)) f{i}(int x);\n" for i in range(MOST_DECLARED * 2)),
        "".join(f'int g{i}(int x) __asm__("g{i}");\nextern int v{i} asm("v{i}");\n' for i in range(MOST_DECLARED * 2)),
        "void f(int again);\n" + "".join(f"int g{i}(int again);\n" for i in range(MOST_DECLARED * 2)),
    ],
)
def test_names_in_scopes_of_their_own_and_uses_stay(text: str) -> None:
    assert left(text) == text


def test_a_text_that_ends_within_a_declaration_is_cut_to_its_end() -> None:
    kept = left("int again = 1;\n" * (MOST_DECLARED * 2) + "int again = (")
    assert kept.count("again") == MOST_DECLARED
