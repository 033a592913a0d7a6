"""Plain char has no sign on the source: what a platform function gets of it, and what a condition makes of a character."""

from __future__ import annotations

import re
from pathlib import Path

import robosmi

CASES = Path(__file__).parent / "plain_char"


def sketch(program: Path, tmp_path: Path) -> str:
    made = robosmi.migrate([program], tmp_path / "out")
    return next(data.decode() for name, data in made.contents.items() if name.endswith(f"/{program.stem}.ino"))


def test_a_plain_char_is_read_as_unsigned_where_a_platform_function_takes_a_number(tmp_path: Path) -> None:
    text = sketch(CASES / "arguments.c", tmp_path)
    passed = re.findall(r"pause\(([^;]*)\);", text)
    assert passed == [
        "(uint8_t)c", "(uint8_t)c", "(uint8_t)arr[0]", "(uint8_t)m.t", "(uint8_t)(char)456", "(uint8_t)*q", "(uint8_t)ret()",
        "1 ? (uint8_t)c : 3L", "(uint8_t)c++",
    ]  # fmt: skip
    assert 'print("%d %d %c\\n", c, arr[0], 65);' in text  # which reads it as the source does


def test_a_condition_with_a_character_keeps_the_branch_of_the_source(tmp_path: Path) -> None:
    conditions = re.findall(r"^#if (.*)$", sketch(CASES / "conditions.c", tmp_path), re.MULTILINE)
    assert conditions == [
        "1 /* if K > 0 */", "'a' == 97 && '\\n' == 10 && '\\'' == 39", "0 /* if true */", "1 /* if 'ab' > 0 */",
    ]  # fmt: skip
