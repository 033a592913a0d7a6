"""A source platform that is data alone: a made-up board with eight pins, whose C programs move to an Arduino Uno."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from robosmi.transformations.chains.stages.models import stored_models
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.verification.jobs import job
from robosmi.verify.simulation import DeviceUse, simulate
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.running import run
from tests.tools import require_engine, require_tools

pytestmark = pytest.mark.processes  # adapters that are not built in are compiled before they are used
DATA = Path(__file__).parent / "tiny_platform"


@pytest.fixture
def out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The output of the migration; its program lies beside its project file."""
    monkeypatch.setenv("ROBOSMI_PATH", str(DATA))
    shutil.copytree(DATA / "program", tmp_path / "program")
    program = tmp_path / "program" / "lamp.c"
    outcome = run("migrate", program, "--source-platform", "octo", "--target", "uno", "-o", tmp_path / "out", "--yes", "--json")
    assert outcome.code == 0, outcome.err
    assert not [task for task in outcome.document["tasks"] if task["rule"] in ("RS501", "RS345")]
    return tmp_path / "out"


def test_its_functions_get_adapters_and_its_ports_the_pins_that_a_person_names(out: Path) -> None:
    plan = stored_models(out).plan
    assert all(use.adapter is not None for use in plan.adapterUses)
    assert {str(b.name): str(b.pin.label) for b in plan.portBindings if b.pin} == {
        "BUTTON": "D4",
        "lamps[0]": "D8",
        "lamps[1]": "D9",
    }
    report = (out / "lamp" / "MIGRATION.md").read_text(encoding="utf-8")
    assert "| pin2 | `BUTTON` |" in report
    text = (out / "lamp" / "lamp.ino").read_text(encoding="utf-8")
    assert "#define BUTTON 4" in text
    assert "lamps[2] = {8, 9}" in text
    assert "octo.h" not in text


def test_a_port_that_it_does_not_have_is_no_port(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROBOSMI_PATH", str(DATA))
    words: list[str | Path] = ["--source-platform", "octo", "--target", "uno", "-o", tmp_path, "--yes", "--bind"]
    assert run("migrate", DATA / "program" / "lamp.c", *words, "pin8=D4").code == 2
    assert run("migrate", DATA / "program" / "lamp.c", *words, "P2=D4").code == 2


def test_its_program_runs_on_the_other_board(out: Path, tmp_path: Path) -> None:
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    require_engine("simavr")
    report = compile_sketch(out, keep=tmp_path)
    assert report.ok, report.diagnostics
    assert report.elf is not None
    pressed = DeviceUse("levels", {"pin": "D4"}, {"points": [[0, 0], [500, 1]]})
    trace = simulate(job(report.elf, report.hex, load_board("uno"), 1e6, [pressed]))
    first = [begun for begun, _ in trace.pulses("D8")]
    assert first[0] > 500_000
    assert all(90_000 < width < 110_000 for pin in ("D8", "D9") for _, width in trace.pulses(pin)[:1])
    assert trace.pulses("D9")[0][0] > first[0]
