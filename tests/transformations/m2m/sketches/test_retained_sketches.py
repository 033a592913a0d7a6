"""Sketches that move to a board with other numbers and registers: the text before, and what the rules make of it.

A case is a folder with the sketch and `expected.ino`. Cases without that file stay as they are.
"""

from __future__ import annotations

from pathlib import Path

import pytest

import robosmi
from tests.running import run

CASES = Path(__file__).parent / "cases"


@pytest.mark.parametrize("case", sorted(path.name for path in CASES.iterdir()))
def test_a_sketch_keeps_what_it_does(case: str, tmp_path: Path) -> None:
    sketch = CASES / case / case / f"{case}.ino"
    outcome = robosmi.migrate([sketch], tmp_path / "out", target="pico", source_board="uno")
    assert not [f for f in outcome.findings if f.rule in ("RS345", "RS349")]  # pins and sizes
    expected = CASES / case / "expected.ino"
    text = (tmp_path / "out" / case / f"{case}.ino").read_text()
    assert text == (expected if expected.is_file() else sketch).read_text()


@pytest.mark.parametrize(
    ("case", "lines"),
    [
        ("kept_ints", [2, 3, 4, 8, 16]), ("linked_ints", []), ("formats", [8, 18, 19, 20]), ("fan", []), ("fan_two", [9]),
        ("dim_stored", [2, 5, 10, 11]), ("port_modes", [16]), ("port_turns", [6, 9, 14]), ("deep_sleep", [1, 7, 11]),
        ("late_mode", [2, 3, 4, 9]), ("timer_servo", []), ("fan_registers", []), ("sleepy", []), ("words_in_flash", []),
        ("half_known", [6, 8, 9]), ("flash_words", [21]), ("own_names", []), ("no_value", [47]),
        ("stored", []), ("sent", [15, 27]), ("arguments", [32, 33, 35]), ("port_macros", [6, 6, 7]),
        ("wide_results", [18, 20, 21]),
        ("real_numbers", [7, 15, 22, 24, 25, 27]), ("mixed_signs", [6]),
        ("board_values", [1, 4, 7, 9, 10, 11, 12]),
    ],
)  # fmt: skip
def test_what_no_rule_changes_is_a_task_at_its_line(case: str, lines: list[int], tmp_path: Path) -> None:
    sketch = CASES / case / case / f"{case}.ino"
    outcome = run("migrate", sketch, "--from", "uno", "--target", "pico", "-o", tmp_path, "--yes", "--json")
    tasks = [task for task in outcome.document["tasks"] if task["rule"] == "RS346"]
    assert [task["location"]["line"] for task in tasks] == lines
    report = (tmp_path / case / "MIGRATION.md").read_text()
    assert ("differently" in report.partition("## Write")[0]) == bool(lines)


@pytest.mark.parametrize("case", sorted(path.name for path in CASES.iterdir()))
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
