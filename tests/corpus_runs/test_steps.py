"""The steps of a corpus run for one program, without a run around them."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from robosmi.corpus.jobs import ProgramWork, Rows
from robosmi.transformations.chains.corpus import analyse_step, migrate_step

HERE = Path(__file__).parent


@pytest.mark.parametrize("step", [analyse_step, migrate_step])
def test_calls_and_pins_of_macros_headers_and_other_files_are_rows(step: Callable[[ProgramWork], Rows], tmp_path: Path) -> None:
    folder = tmp_path / "own_macros"
    shutil.copytree(HERE / "own_macros", folder)
    found = step(ProgramWork("main.c", str(folder / "main.c"), output=str(tmp_path / "out")))
    assert sorted((row["function"], row["line"], Path(row["path"]).name, row["has_body"]) for row in found["calls"]) == [
        ("high", 10, "main.c", True), ("high", 11, "main.c", True), ("high", 11, "main.c", True), ("input", 10, "main.c", True),
        ("low", 3, "other.c", True), ("print", 11, "main.c", True),
    ]  # fmt: skip
    assert sorted((row["pin"], row["function"], row["expression"], Path(row["path"]).name) for row in found["pins"]) == [
        (3, "high", "3", "main.c"), (5, "high", "P", "main.c"), (6, "high", "Q", "main.c"), (7, "input", "7", "main.c"),
        (9, "low", "9", "other.c"), (12, "OUTA", "OUTA", "main.c"),
    ]  # fmt: skip
    assert {row["path"] for row in found["pins"]} == {str(folder / "main.c"), str(folder / "other.c")}
    for plan in found.get("plans", ()):
        assert (plan["call_sites"], plan["with_body"]) == (len(found["calls"]), 6)


def test_calls_of_a_sketch_whose_platform_stays_are_rows(tmp_path: Path) -> None:
    sketch = Path(shutil.copytree(HERE / "sketch", tmp_path / "sketch")) / "sketch.ino"
    found = migrate_step(ProgramWork("sketch", str(sketch), output=str(tmp_path / "out")))
    assert [(row["function"], row["disposition"], row["has_body"], row["path"]) for row in found["calls"]] == [
        ("digitalWrite", "retain", None, str(sketch))
    ]
    assert [(row["pin"], row["function"]) for row in found["pins"]] == [(13, "digitalWrite")]
