"""Small sketches of an Uno, each with one trap of another board, on a simulated Pico: they do what their own machine code does.

The folder of a sketch has what happens to its inputs (`scenario.toml`).
"""

from __future__ import annotations

from pathlib import Path

import pytest

import robosmi
from robosmi.verify.traces.comparison import SAME
from tests.running import run
from tests.tiers import sample
from tests.tools import require_engine, require_tools

SKETCHES = Path(__file__).parent / "moved_sketches"


@pytest.mark.processes
@pytest.mark.parametrize("name", sample(sorted(path.name for path in SKETCHES.iterdir()), 1))
def test_a_sketch_with_a_trap_does_the_same_on_a_pico(name: str, tmp_path: Path) -> None:
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr", "arm-none-eabi-gcc", "arm-none-eabi-g++")
    for engine in ("simavr", "rp2040js"):
        require_engine(engine)
    robosmi.migrate([SKETCHES / name / f"{name}.ino"], tmp_path, target="pico", source_board="uno")
    outcome = run("verify", tmp_path, "--scenario", SKETCHES / name / "scenario.toml", "--trust-original", "--json")
    assert outcome.code == 0, outcome.out
    [scenario] = outcome.result["scenarios"]
    assert SAME in {channel["status"] for channel in scenario["channels"]}
