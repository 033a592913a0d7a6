"""Computed pins: what a program calculates with stays a number of the source, and its sketch uses the pins of the same ports."""

from __future__ import annotations

from pathlib import Path

import pytest

import robosmi
from tests.fuzz.pin_programs import program
from tests.fuzz.pins import compared
from tests.tools import require_tools

PROGRAM = Path(__file__).parent / "computed_pins" / "macro_compares.c"


def test_a_number_that_a_macro_compares_stays(tmp_path: Path) -> None:
    made = robosmi.migrate([PROGRAM], tmp_path, target="uno", bind={"P17": "D9", "P18": "D8"}, dry_run=True)
    sketch = next(text.decode() for name, text in made.contents.items() if name.endswith(".ino"))
    assert "pin = MAX(18, 17)" in sketch
    assert "high(port(pin))" in sketch


@pytest.mark.exhaustive
@pytest.mark.processes
@pytest.mark.parametrize("seed", range(1, 9))
def test_random_programs_use_their_pins(seed: int, tmp_path: Path) -> None:
    require_tools("gcc")
    text, ending = program(seed)
    assert compared(text, ending, tmp_path).verdict in ("same", "run time", "unsure", "told", "without meaning")
