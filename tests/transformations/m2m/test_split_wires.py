"""A function with one wire (`ping_cm`) on a component with one for each direction: it asks at one, and hears at the other."""

from __future__ import annotations

from pathlib import Path

import pytest

import robosmi
from robosmi.metamodels import migration
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.verification.jobs import job
from robosmi.verify.simulation import DeviceUse, simulate
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.tools import require_engine, require_tools

FOLDER = Path(__file__).parent / "split_wires"
PROGRAM = FOLDER / "program.c"


def ranger_of(plan: migration.MigrationPlan) -> migration.PortBinding:
    """The port that the ranger is on."""
    return next(b for b in plan.portBindings if b.sourcePin == 8)


@pytest.mark.parametrize("said", [{}, {"P8": "D6"}, {"P8": "D7"}])
def test_both_wires_of_a_ranger_are_the_ports(said: dict[str, str]) -> None:
    plan = robosmi.plan_migration([PROGRAM], hardware=FOLDER / "two_wires.csv", bind=said).plan
    bound = ranger_of(plan)
    assert bound.answer is not None
    assert bound.answer.pin is not None
    assert bound.answer.pin.label == "D6"
    assert next(b for b in plan.portBindings if b.sourcePin == 4).open  # the wire that is left is no wire for another port
    assert not [f for f in plan.findings if f.rule == "RS725"]


def test_a_ranger_with_one_wire_has_no_other() -> None:
    plan = robosmi.plan_migration([PROGRAM], hardware=FOLDER / "one_wire.csv").plan
    assert ranger_of(plan).answer is None


@pytest.mark.processes
@pytest.mark.parametrize("said", [{}, {"P8": "D6"}])
def test_it_is_asked_at_one_wire_and_heard_at_the_other(said: dict[str, str], tmp_path: Path) -> None:
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    require_engine("simavr")
    made = robosmi.migrate([PROGRAM], tmp_path / "out", hardware=FOLDER / "two_wires.csv", bind={**said, "P4": "none"})
    (tmp_path / "built").mkdir()
    report = compile_sketch(made.sketch, "uno", keep=tmp_path / "built")
    assert report.ok, report.diagnostics
    assert report.elf is not None
    assert report.hex is not None
    ranger = DeviceUse("two_pin_ranger", {"trigger": "D7", "echo": "D6"}, {"points": [[0, 40.5]]})
    trace = simulate(job(report.elf, report.hex, load_board("uno"), 400_000, [ranger]))
    read = [line.split()[0] for line in trace.text.splitlines() if len(line.split()) == 2]
    assert len(read) >= 4
    assert set(read) == {"40"}
    assert made.models.plan.portBindings
    assert "echo on D6" in (made.sketch / "MIGRATION.md").read_text() or said


@pytest.mark.processes
def test_it_is_so_in_c(tmp_path: Path) -> None:
    require_tools("avr-gcc")
    made = robosmi.migrate([PROGRAM], tmp_path / "out", hardware=FOLDER / "two_wires.csv", bind={"P4": "none"}, target="avr-c")
    assert "split_wires[]" in (made.sketch / "adapters.h").read_text()
    report = compile_sketch(made.sketch, "uno")
    assert report.ok, report.diagnostics
