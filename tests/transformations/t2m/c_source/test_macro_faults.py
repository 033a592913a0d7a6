"""Faults that only show where a macro is used, and macros that make functions of interrupt handlers."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.api import load_code
from robosmi.metamodels import ccode
from robosmi.query import all_of_kind
from tests.running import run

CASES = Path(__file__).parent / "macro_faults"


@pytest.mark.parametrize("path", sorted(CASES.glob("wrong*.c")), ids=lambda path: path.stem)
def test_a_fault_in_a_macro_is_told_at_its_use(path: Path) -> None:
    done = run("analyse", path, "--json")
    lines = [f["location"]["line"] for f in done.document["findings"] if f["rule"] == "RS101"]
    assert lines
    assert set(lines) == {3}


@pytest.mark.parametrize("path", sorted(CASES.glob("right*.c")), ids=lambda path: path.stem)
def test_a_semicolon_that_ends_a_statement_is_none(path: Path) -> None:
    assert run("analyse", path, "--json").document["findings"] == []


def test_interrupt_handlers_are_functions() -> None:
    done = run("analyse", CASES / "handlers" / "handlers.ino", "--json")
    assert done.code == 0
    assert not {"RS101", "RS102"} & done.rules()
    (unit,) = load_code(CASES / "handlers" / "handlers.ino").units
    found = {function.name for function in all_of_kind(unit, ccode.Function) if function.definition}
    assert found == {"TIMER2_OVF_vect", "PCINT0_vect", "INT0_vect", "WDT_vect", "ADC_vect", "setup", "loop"}
