"""Programs whose files lie in folders, some of one name: each include still means its own file, in the sketch and in `verify`."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.running import run
from tests.tools import require_verification

HERE = Path(__file__).parent


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    """A program with two headers `wheel.h` that give one macro different values."""
    shutil.copytree(HERE / "headers_in_folders", tmp_path / "robot")
    return tmp_path / "robot" / "robot.c"


def test_headers_of_one_name_are_both_in_the_sketch(robot: Path, tmp_path: Path) -> None:
    outcome = run("migrate", robot, "-o", tmp_path / "out", "--bind", "P26=D13", "--json")
    assert outcome.code == 0, outcome.err
    sketch = tmp_path / "out" / "robot"
    included = {
        path.name: [line for line in path.read_text().splitlines() if "wheel.h" in line] for path in sketch.glob("*.[chi]*")
    }
    assert included["robot.ino"] == ['#include "wheel.h"', '#include  "2_wheel.h"']
    assert included["left.cpp"] == included["2_wheel.h"] == ['#include "wheel.h"']
    assert included["right.cpp"] == ['#include "2_wheel.h"']


def test_programs_with_headers_in_folders_are_verified(robot: Path, tmp_path: Path) -> None:
    require_verification("simavr")
    assert run("migrate", robot, "-o", tmp_path / "out", "--bind", "P26=D13").code == 0
    outcome = run("verify", tmp_path / "out", "--json")
    assert outcome.code == 0, outcome.err
    assert outcome.result["verdict"] == "no-difference-found"
    assert outcome.result["source_coverage"]["lines_pct"] == 100.0
    header = tmp_path / "out" / "robot" / "2_wheel.h"
    header.write_text(header.read_text().replace("10", "11"))
    assert run("verify", tmp_path / "out", "--json").result["first_difference"]["channel"] == "console"


def test_what_the_host_has_no_type_for_is_a_reason_and_not_our_bug(tmp_path: Path) -> None:
    require_verification("simavr")
    program = tmp_path / "long_double.c"
    program.write_text('#include "simpletools.h"\nint main() {\n  long double x = 1.5;\n  print("%d\\n", (int)x);\n}\n')
    run("migrate", program, "-o", tmp_path / "out")
    outcome = run("verify", tmp_path / "out", "--json")
    assert outcome.result["verdict"] == "not-decidable"
    (reason,) = outcome.result["reasons"]
    assert "both 'long' and 'float' in declaration specifiers (long_double.c:3)" in reason


def test_headers_named_like_those_of_the_target_get_other_names(tmp_path: Path) -> None:
    require_verification("simavr")
    shutil.copytree(HERE / "headers_of_names", tmp_path / "names")
    outcome = run("migrate", tmp_path / "names" / "names.c", "-o", tmp_path / "out", "--bind", "P16=D9")
    assert outcome.code == 0, outcome.err
    sketch = tmp_path / "out" / "names"
    assert sorted(path.name for path in sketch.glob("*.h")) == [
        "adapters.h", "own_Arduino.h", "own_Print.h", "own_Servo.h", "own_adapters.h"
    ]  # fmt: skip
    outcome = run("simulate", tmp_path / "out", "--seconds", "1")
    assert outcome.code == 0, outcome.err
    assert "3 4 11" in outcome.out
