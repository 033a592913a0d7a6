"""Pointers to functions that say nothing of parameters say what all that is kept in them takes, or are told."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import robosmi

FOLDER = Path(__file__).parent / "unsaid_pointers"
FILES = {"moods.c": "moods.ino", "second.c": "second.cpp", "moods.h": "moods.h"}


def test_types_and_calls_become_what_the_functions_take(tmp_path: Path) -> None:
    made = robosmi.migrate([FOLDER / "moods.c"], tmp_path / "out")
    for source, name in FILES.items():
        sketch = (tmp_path / "out" / "moods" / name).read_text(encoding="utf-8")
        lines = [re.sub(r"\s*//.*", "", line) for line in sketch.splitlines()]
        for line in (FOLDER / source).read_text(encoding="utf-8").splitlines():
            before, mark, wanted = line.partition("  // becomes ")
            indented = before[: len(before) - len(before.lstrip())]
            assert not mark or indented + wanted in lines, wanted
    refused = _marked("refused")
    assert {f.line for f in made.models.plan.findings if f.rule == "RS337"} == refused


def test_what_no_prototype_mends_is_told_where_it_is_declared() -> None:
    plan = robosmi.plan_migration([FOLDER / "moods.c"]).plan
    assert {f.line for f in plan.findings if f.rule == "RS312"} == _marked("told")


@pytest.mark.parametrize(
    ("value", "lines"),
    [("0", []), ("NULL", []), ("(void (*)()) 0", []), ("0x100", [3]), ("(void (*)())0x100", [3]), ("beep", [])],
)
def test_an_address_is_no_function_and_null_is_none(value: str, lines: list[int], tmp_path: Path) -> None:
    path = tmp_path / "boot.c"
    path.write_text(
        f'#include "simpletools.h"\nvoid beep(int n) {{ high(n); }}\nvoid (*boot)() = {value};\n'
        "int main(void) { boot = beep; boot(3); while (1) pause(1); }\n"
    )
    plan = robosmi.plan_migration([path]).plan
    assert [f.line for f in plan.findings if f.rule == "RS312"] == lines


def _marked(word: str) -> set[int]:
    lines = (FOLDER / "moods.c").read_text(encoding="utf-8").splitlines()
    return {number for number, line in enumerate(lines, 1) if line.endswith(f"// {word}")}
