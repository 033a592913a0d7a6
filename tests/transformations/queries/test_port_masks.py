"""The ports of masks: each program says in its first line which its registers and masks reach, `?` where only a run shows it."""

from __future__ import annotations

from pathlib import Path

import pytest

import robosmi

PROGRAMS = sorted((Path(__file__).parent / "masks").glob("*.c*"))


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda path: path.stem)
def test_ports_of_masks(program: Path) -> None:
    wanted = program.read_text().splitlines()[0].removeprefix("// ports ").split()
    plan = robosmi.plan_migration([program]).plan
    unknown = [f for f in plan.findings if f.rule == "RS327"]
    found = sorted(b.sourcePin for b in plan.portBindings)
    assert ["?"] * bool(unknown) + [str(pin) for pin in found] == wanted


def test_a_port_of_a_mask_is_bound_by_its_number() -> None:
    program = next(path for path in PROGRAMS if path.stem == "put_together")
    plan = robosmi.plan_migration([program], bind={"P5": "D8"}).plan
    assert {b.name: b.pin.label if b.pin is not None else None for b in plan.portBindings}["P5"] == "D8"
