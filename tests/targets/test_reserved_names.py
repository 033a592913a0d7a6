"""Names that a program shares with the core of a board with another microcontroller: they are renamed there, and only there."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

import robosmi
from tests.targets.reserved_names import BOARDS, FOLDER, names_of
from tests.tools import require_tools

PROGRAM = """\
int Serial1 = 3, PORTL;
enum { A9 = 5, PINE, D5 };
void setup1(void) { PORTL = D5; }
int main(void) { PORTL = A9 + PINE; setup1(); while (1) Serial1 += PORTL; }
"""


@pytest.mark.parametrize(
    ("target", "kept", "renamed"),
    [
        ("uno", ["Serial1", "PORTL", "A9", "PINE", "D5", "setup1"], []),
        ("mega", ["D5", "setup1"], ["Serial1", "PORTL", "A9", "PINE"]),
        ("leonardo", ["PORTL", "D5", "setup1"], ["Serial1", "A9", "PINE"]),
        ("pico", ["PORTL", "A9", "PINE"], ["Serial1", "D5", "setup1"]),  # setup1 would run on the second core
    ],
)
def test_names_of_the_board_are_renamed(target: str, kept: list[str], renamed: list[str], tmp_path: Path) -> None:
    program = tmp_path / "names.c"
    program.write_text(PROGRAM)
    made = robosmi.migrate([program], tmp_path / "out", target=target)
    text = (made.sketch / "names.ino").read_text()
    words = set(re.findall(r"\w+", text))
    assert words.issuperset(kept)
    assert words.isdisjoint(renamed)
    assert words.issuperset(f"{name}_" for name in renamed)


@pytest.mark.parametrize("mcu", sorted(BOARDS))
def test_the_names_are_those_of_the_core(mcu: str) -> None:
    require_tools("avr-g++", "arduino-core-avr")
    stored = json.loads((FOLDER / "names" / f"{mcu}.json").read_text())
    assert {kind: stored[kind] for kind in ("declared", "macros")} == names_of(mcu)
