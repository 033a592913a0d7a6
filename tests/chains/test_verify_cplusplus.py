"""`verify` of originals in C++: the host model's headers are C, and C++ needs memory, virtual tables and constructors."""

from __future__ import annotations

from pathlib import Path

import pytest

import robosmi
from tests.running import run
from tests.tiers import sample
from tests.tools import require_engine, require_tools

CASES = Path(__file__).parent / "cpp_pins"


@pytest.mark.processes
@pytest.mark.parametrize("name", sample(["virtual.cpp", "new.cpp", "header_class", "lambda_capture.cpp"], 2))
def test_a_program_in_cplusplus_is_compared(name: str, tmp_path: Path) -> None:
    require_tools("gcc", "avr-gcc", "arduino-core-avr")
    require_engine("simavr")
    case = CASES / name
    files = sorted(case.glob("*.cpp")) if case.is_dir() else [case]
    robosmi.migrate(files, tmp_path / "out", bind={"P8": "D12"})
    outcome = run("verify", tmp_path / "out", "--json")
    assert outcome.result["verdict"] == "no-difference-found", outcome.err
    assert not outcome.result["partial"]
    assert outcome.result["compared"] == {"outputs": 1, "of": 1, "lines_pct": 100.0}
