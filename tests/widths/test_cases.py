"""Expressions keep their values: the sketch of `cases.c` gives what a 32-bit machine with unsigned char gives, case by case."""

from __future__ import annotations

from pathlib import Path

from tests.tools import require_engine, require_tools
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
