"""Which values are texts of the program, or an address within one."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.metamodels import ccode
from robosmi.query import all_of_kind
from robosmi.transformations.m2m.language.written_types import gives_text
from robosmi.transformations.t2m.c_source import read_program


@pytest.mark.parametrize(
    ("value", "is_text"),
    [
        ('"abc"', True),
        ('("abc")', True),
        ('"abc" + 1', True),
        ('2 + "abc"', True),
        ('"abc" - n', True),
        ('&"abc"[1]', True),
        ('n ? "abc" : p', True),
        ('n ? p : "abc"', True),
        ('p ?: "none"', True),
        ('n ? "abc" + 1 : 0', True),
        ("p", False),
        ("p + 1", False),
        ("&p[1]", False),
        ("n ? p : 0", False),
        ('("abc", p)', False),
        ('*"abc"', False),
        ('"abc"[0]', False),
        ('p + ("ab" - "cd")', False),
        ("0", False),
    ],
)
def test_a_value_is_a_text_or_an_address_within_one(value: str, is_text: bool, tmp_path: Path) -> None:
    path = tmp_path / "values.c"
    path.write_text(f"int n;\nconst char *p;\nint main(void) {{ const char *q = {value}; return !q; }}\n")
    program, _ = read_program(path)
    variable = next(each for each in all_of_kind(program, ccode.Variable) if each.name == "q")
    assert gives_text(variable.initializer) is is_text
