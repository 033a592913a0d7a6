"""Originals that run as their own machine code on a simulator of their board, against sketches for other boards."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.errors import VerificationError
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.engine_original import EngineOriginal, engine_original
from robosmi.transformations.verification.judgement.scenario_verdicts import compare_scenarios
from robosmi.transformations.verification.original_side import run_source, run_varied
from robosmi.transformations.verification.target_side import TargetSide
from robosmi.verify.original import Variation
from robosmi.verify.scenario import Scenario
from robosmi.verify.toolchains.toolchain import compile_sketch
from robosmi.verify.traces.verdict import DIFFERENT_VERDICT, NO_DIFFERENCE
from tests.tools import require_engine, require_tools

SKETCHES = Path(__file__).parent / "originals"
PRESSED = Scenario("pressed", 400.0, {"D2": {"points": ((0, 1), (200, 0))}})


def ports(target: str) -> list[BoundPort]:
    """A button and a lamp, on a target whose pins have the same numbers."""
    return [BoundPort("D2", "D2", f"{target}2", device="levels", pin="pin"), BoundPort("D13", "D13", f"{target}13")]


@pytest.fixture(scope="module")
def phase(tmp_path_factory: pytest.TempPathFactory) -> EngineOriginal:
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    require_engine("simavr")
    text = (SKETCHES / "phase/phase.ino").read_bytes()
    return engine_original({"phase.ino": text}, "phase.ino", "arduino", load_board("uno"), tmp_path_factory.mktemp("original"))


def test_an_original_tells_the_lines_and_the_ways_of_its_jumps_that_a_run_takes(phase: EngineOriginal) -> None:
    if phase.tracer != "avr8js":
        pytest.skip("no quick simulator records instructions")
    low = run_source(phase, ports("D"), Scenario("low", 60.0))
    high = run_source(phase, ports("D"), Scenario("high", 60.0, {"D2": {"points": ((0, 1),)}}))
    assert low.status == high.status == "running"
    lines = {name: {line for (_, line), count in phase.coverage([run.counts]).lines.items() if count} for name, run in
             (("low", low), ("high", high))}  # fmt: skip
    assert 8 in lines["low"] - lines["high"]
    assert 6 in lines["high"] - lines["low"]
    assert phase.coverage([low.counts]).branch_percent < phase.coverage([low.counts, high.counts]).branch_percent
    assert phase.reached(low.counts) != phase.reached(high.counts)


def test_slower_steps_leave_delays_as_they_are(phase: EngineOriginal) -> None:
    own = phase.run(100_000)
    slower = phase.run(100_000, variation=Variation(1, block_factor=2.0, call_factor=2.0))
    began, began_slower = (run.trace.levels("D13")[0][0] for run in (own, slower))
    assert began_slower > 1.5 * began
    changes, others = ([at for at, level in run.trace.levels("D13")] for run in (own, slower))
    assert len(changes) == len(others)


@pytest.mark.parametrize(("sketch", "verdict"), [("phase", DIFFERENT_VERDICT), ("phase_kept", NO_DIFFERENCE)])
def test_a_wrap_that_a_wider_int_loses_is_a_difference(phase: EngineOriginal, sketch: str, verdict: str, tmp_path: Path) -> None:
    require_tools("arm-none-eabi-gcc", "arm-none-eabi-g++")
    require_engine("rp2040js")
    report = compile_sketch(SKETCHES / sketch, "pico", keep=tmp_path)
    assert report.ok, report.diagnostics
    bound = ports("GP")
    runs = run_varied(phase, bound, PRESSED, run_source(phase, bound, PRESSED))
    assert not runs.nondeterministic_channels
    found = compare_scenarios(phase, bound, [(PRESSED, runs)], TargetSide(load_board("pico"), report, bound), True, {})
    assert [each.told.verdict for each in found.kept] == [verdict]


def test_an_original_that_does_not_compile_says_why(tmp_path: Path) -> None:
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    require_engine("simavr")
    text = b"void setup() { nothing(); }\nvoid loop() {}\n"
    with pytest.raises(VerificationError, match="nothing") as error:
        engine_original({"s.ino": text}, "s.ino", "arduino", load_board("uno"), tmp_path)
    assert error.value.location is not None
    assert error.value.location.line == 1
