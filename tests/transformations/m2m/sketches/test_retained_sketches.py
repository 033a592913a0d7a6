"""Sketches that move to a board with other numbers and registers: the text before, and what the rules make of it.

A case is a folder with the sketch and `expected.ino`. Cases without that file stay as they are.
"""

from __future__ import annotations

from pathlib import Path

import pytest

import robosmi
from tests.tiers import sample

CASES = Path(__file__).parent / "cases"
NAMES = sorted(path.name for path in CASES.iterdir())
TASKS = {
    "kept_ints": [2, 3, 4, 8, 16], "linked_ints": [], "formats": [8, 18, 19, 20], "fan": [], "fan_two": [9],
    "dim_stored": [2, 5, 10, 11], "port_modes": [16], "port_turns": [6, 9, 14], "deep_sleep": [1, 7, 11],
    "late_mode": [2, 3, 4, 9], "timer_servo": [], "fan_registers": [], "sleepy": [], "words_in_flash": [],
    "half_known": [6, 8, 9], "flash_words": [21], "own_names": [], "no_value": [47],
    "stored": [], "sent": [15, 27], "arguments": [32, 33, 35], "port_macros": [6, 6, 7],
    "wide_results": [18, 20, 21],
    "real_numbers": [7, 15, 22, 24, 25, 27], "mixed_signs": [6],
    "board_values": [1, 4, 7, 9, 10, 11, 12],
}  # fmt: skip
"""Case -> the lines that no rule changes and that do something else on the new board."""


@pytest.mark.parametrize("case", NAMES)
def test_a_sketch_keeps_what_it_does_or_has_a_task_at_the_line(case: str, tmp_path: Path) -> None:
    sketch = CASES / case / case / f"{case}.ino"
    outcome = robosmi.migrate([sketch], tmp_path, target="pico", source_board="uno")
    assert not [f for f in outcome.findings if f.rule in ("RS345", "RS349")]  # pins and sizes
    expected = CASES / case / "expected.ino"
    text = (tmp_path / case / f"{case}.ino").read_text()
    assert text == (expected if expected.is_file() else sketch).read_text()
    if case in TASKS:
        places = [task.location for task in outcome.tasks() if task.rule == "RS346"]
        assert [place.line for place in places if place] == TASKS[case]
        report = (tmp_path / case / "MIGRATION.md").read_text()
        assert ("differently" in report.partition("## Write")[0]) == bool(TASKS[case])


@pytest.mark.parametrize("case", sample(NAMES, 12))
def test_nothing_changes_for_a_board_with_the_same_processor(case: str, tmp_path: Path) -> None:
    sketch = CASES / case / case / f"{case}.ino"
    robosmi.migrate([sketch], tmp_path / "out", target="nano", source_board="uno")
    assert (tmp_path / "out" / case / f"{case}.ino").read_text() == sketch.read_text()


def test_the_second_core_of_a_sketch_runs_on_another_board_that_has_one(tmp_path: Path) -> None:
    sketch = CASES / "own_names" / "own_names" / "own_names.ino"
    robosmi.migrate([sketch], tmp_path / "out", target="picow", source_board="pico")
    assert (tmp_path / "out" / "own_names" / "own_names.ino").read_text() == sketch.read_text()


@pytest.mark.parametrize("constants", [40, 1500])
def test_constants_of_constants_are_followed_once_and_not_without_end(constants: int, tmp_path: Path) -> None:
    sums = "".join(f"const float a{n} = a{n - 1} {'+ a' + str(n - 1) if n < 41 else '* 1.0'};\n" for n in range(1, constants + 1))
    sketch = tmp_path / "sums" / "sums.ino"
    sketch.parent.mkdir()
    sketch.write_text(f"const float a0 = 1.5;\n{sums}int sum;\nvoid setup() {{ sum = a20 * 1.0; }}\nvoid loop() {{}}\n")
    robosmi.migrate([sketch], tmp_path / "out", target="pico", source_board="uno")
    assert "int16_t sum;" in (tmp_path / "out" / "sums" / "sums.ino").read_text()
