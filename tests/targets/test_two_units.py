"""Programs of several files whose adapters have state and handle interrupts: each is there once."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

import robosmi
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.tools import require_tools

PROGRAM = sorted((Path(__file__).parent / "two_units").glob("*.c"))


@pytest.mark.parametrize("target", ["uno", "avr-c"])
def test_adapters_are_there_once_in_programs_of_several_files(target: str, tmp_path: Path) -> None:
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    robosmi.migrate(PROGRAM, tmp_path / "out", target=target)
    report = compile_sketch(tmp_path / "out", keep=tmp_path)
    assert report.ok
    assert [d.message for d in report.diagnostics if d.severity.name != "info"] == []
    listed = subprocess.run(["avr-nm", str(report.elf)], capture_output=True, text=True, check=True).stdout
    names = [line.split()[-1] for line in listed.splitlines()]
    assert names.count("servo_slots") == 1
    assert next(line for line in listed.splitlines() if line.endswith(" __vector_11")).split()[1] == "T"
