"""A part that rests at a high level does nothing before the program drives it, also where a core forgets levels."""

from __future__ import annotations

from pathlib import Path

import pytest

import robosmi
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.verification.jobs import job
from robosmi.verify.simulation import simulate
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.tools import require_engine, require_tools

PROGRAM = '#include "simpletools.h"\nint main()\n{\n  pause(20);\n  low(5);\n  pause(20);\n  high(5);\n}\n'


def moved(target: str, pin: str, folder: Path) -> Path:
    """The sketch of a program that drives a relay, which most modules switch on at a low level."""
    (folder / "pump.c").write_text(PROGRAM)
    (folder / "wiring.csv").write_text(f"pin,part,title\n{pin},Relay Module 5V,pump\n")
    options = {"hardware": folder / "wiring.csv", "bind": {"P5": pin}, "bench": True}
    return robosmi.migrate([folder / "pump.c"], folder / "out", target=target, **options).sketch


@pytest.mark.parametrize(("target", "pin", "times"), [("uno", "D5", 1), ("pico", "GP5", 2), ("esp32", "IO5", 2)])
def test_a_high_level_is_written_again_where_it_may_be_lost(target: str, pin: str, times: int, tmp_path: Path) -> None:
    text = next(moved(target, pin, tmp_path).glob("*.ino")).read_text()
    assert text.count("digitalWrite(pumpWriteP1, HIGH);") == times
    bench = next((tmp_path / "out" / "bench").glob("*/*.ino")).read_text()
    assert bench.count("pinMode(pin, OUTPUT);\n  digitalWrite(pin, off);") == times - 1


def test_a_relay_of_a_pico_rests_until_the_program_drives_it(tmp_path: Path) -> None:
    require_tools("arm-none-eabi-gcc", "arm-none-eabi-g++")
    require_engine("rp2040js")
    report = compile_sketch(moved("pico", "GP5", tmp_path), keep=tmp_path)
    assert report.elf is not None
    trace = simulate(job(report.elf, report.hex, load_board("pico"), 80_000, []))
    lows = [
        (at, later - at)
        for (at, level), (later, _) in zip(trace.levels("GP5"), trace.levels("GP5")[1:], strict=False)
        if level == 0
    ]
    assert [width for _, width in lows if width > 5] == pytest.approx([20_000], rel=0.02)
