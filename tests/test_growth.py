"""The cost of a command grows with its input alone: four times the input may not cost much more than four times as much.

Measured is the processor time of this process, which other work on the machine hardly changes, over that of a tiny input.
Quadratic cost makes sixteen times of four times the input, so the bound of nine is far from both. Large inputs are in
`tests/fuzz/growth.py`.
"""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from tests.growing import FAMILIES, Growing
from tests.new_objects import only_new_objects
from tests.running import run
from tests.tiers import sample

BOUND, NOISE = 9.0, 0.15
"""Times that four times the input may cost, and seconds of a measurement that mean nothing."""
SIZES = {
    "globals of another file: migrate": 150,
    "globals that are ports: migrate": 90,
    "functions that call the next: migrate": 250,
    "ports given to macros: migrate": 120,
    "local variables: migrate": 300,
    "variables of loops beside conditions: migrate": 60,
    "conditions: analyse": 700,
    "definitions of one function: analyse": 1200,
    "definitions of one local variable: analyse": 900,
    "comments: analyse": 3000,
    "functions that hand a port on: migrate": 150,
    "enumerators of enumerators: migrate": 400,
    "ports in an array: migrate": 400,
    "lists within lists: migrate": 4000,
    "spaces behind defined: migrate": 4000,
    "definitions of one structure: migrate": 400,
    "definitions of one enumeration: migrate": 400,
    "tentative definitions of one variable: migrate": 500,
    "parameters: migrate": 600,
    "parameters that are arrays: migrate": 250,
    "arrays of a named size: migrate": 200,
    "enumerations in structures: migrate": 250,
    "functions that nobody knows: migrate": 120,
    "functions that call one another: migrate": 120,
    "values of one variable: migrate": 150,
    "values that go round: migrate": 80,
    "masks of masks: migrate": 120,
    "masks that go round: migrate": 80,
    "calls: generate": 200,
    "functions: generate": 100,
    "globals that are ports: generate": 150,
    "local variables: generate": 120,
    "values of one variable: generate": 150,
    "resistors in a row: svg": 250,
    "resistors in a row: check": 300,
    "lamps on one net: check": 250,
    "parts of one title: check": 250,
    "equal rows: hardware": 700,
    "rows with a pin each: hardware": 500,
    "rows with a driver each: hardware": 400,
    "elements: query": 4000,
    "rows: query": 4000,
    "entries: history import": 500,
    "classes: metamodels generate": 30,
}
"""Families that were once steep or are likely to be, each with a size that takes some tenths of a second."""


def seconds(family: Growing, n: int, folder: Path, monkeypatch: pytest.MonkeyPatch) -> float:
    """Processor time of the family's command."""
    folder.mkdir()
    monkeypatch.setenv("ROBOSMI_HOME", str(folder / "home"))
    words = family.make(folder, n)
    with only_new_objects():  # what the process holds besides would be looked at by each collection of garbage
        start = time.process_time()
        outcome = run(*words)
        taken = time.process_time() - start
    assert outcome.code in (0, 1), outcome.err
    return taken


@pytest.mark.measures
@pytest.mark.parametrize("name", sample(SIZES, 24))
def test_the_cost_grows_with_the_input_alone(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    family, n = next(f for f in FAMILIES if f.name == name), SIZES[name]
    for attempt in range(3):  # a collection of garbage or a busy machine may hit one measurement, not all
        nothing, one, four = (
            seconds(family, size, tmp_path / f"{attempt}-{number}", monkeypatch) for number, size in enumerate((4, n, 4 * n))
        )
        if four - nothing <= BOUND * max(one - nothing, NOISE):
            return
    pytest.fail(f"{name}: {nothing:.2f} s for nothing, {one:.2f} s for {n}, {four:.2f} s for {4 * n}")
