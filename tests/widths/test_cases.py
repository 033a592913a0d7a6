"""Expressions keep their values: the sketch of `cases.c` gives what a 32-bit machine with unsigned char gives, case by case."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import robosmi
from tests.fuzz.widths import compared
from tests.tools import require_engine, require_tools
from tests.widths.expressions import Programs
from tests.widths.judge import failures
from tests.widths.machines import measured, names, truth

CASES = Path(__file__).with_name("cases.c")


def test_every_case_has_the_value_of_the_source(tmp_path: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr", "gcc-32-bits")
    require_engine("simavr")
    wanted, found = truth(CASES, tmp_path), measured(CASES, tmp_path)
    assert len(wanted) == len(names(CASES)) >= 70
    assert {n: v for n, v in found.items() if wanted[n] != v} == {}
    assert set(found) == set(wanted)


def test_the_cases_are_wrong_where_the_text_stays_as_it_is(tmp_path: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr", "gcc-32-bits")
    require_engine("simavr")
    wanted, found = truth(CASES, tmp_path), measured(CASES, tmp_path, "keep")
    assert sum(wanted[n] != v for n, v in found.items()) > 50


def test_random_expressions_have_the_value_of_the_source(tmp_path: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr", "gcc-32-bits")
    require_engine("simavr")
    different, count, _ = compared(Programs(2026).program(50), tmp_path)
    assert different == {}
    assert count >= 40


def own_text(program: Path, folder: Path) -> str:
    """The program's own text in a sketch."""
    made = robosmi.migrate([program], folder / "out")
    text = next(Path(made.sketch).glob("*.ino")).read_text()
    return text[text.index('#include "adapters.h"') : text.index("void setup() {")]


@pytest.mark.parametrize("seed", [None, 5, 6])
def test_every_operator_is_as_wide_as_on_the_source(seed: int | None, tmp_path: Path) -> None:
    program = tmp_path / "program.c"
    text = CASES.read_text() if seed is None else Programs(seed).program(60)
    assert seed is None or "<<=" in text
    spelled = re.sub(r"(\w+) (<<|>>|/|%)= ([^;]*);", r"\1 = \1 \2 (\3);", text)  # narrow ones are spelled out in the sketch
    program.write_text(spelled.replace("int main(void) {}", ""))
    original = program.read_text()
    program.write_text(f"{original}\nint main(void) {{}}\n")
    assert failures(original, own_text(program, tmp_path)) == []


def test_the_judge_finds_what_is_narrower(tmp_path: Path) -> None:
    original = CASES.read_text().replace("int main(void) {}", "")
    assert len(failures(original, original)) > 60
    assert failures("int f(short a) { return a * 2; }", "int32_t f(short a) { return a * 2; }")[0].operator == "*"
