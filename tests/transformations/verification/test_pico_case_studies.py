"""The case studies moved to a Pico, with their parts at the pins of the same numbers: what the sketch does at its pins."""

from __future__ import annotations

import re
import shutil
from itertools import pairwise
from pathlib import Path

import pytest

import robosmi
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.verification.jobs import job
from robosmi.verify.simulation import DeviceUse, PinTrace, simulate
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.tools import require_engine, require_tools

TABLES = Path(__file__).parent / "pico_case_studies"


def moved(study: str, examples: Path, folder: Path) -> Path:
    """The output of the migration of a case study, decided as for the Uno."""
    for path in (*(examples / study).glob("*.c"), TABLES / f"{study}.csv"):
        shutil.copy2(path, folder)
    settings = (examples / study / "robosmi.toml").read_text()
    settings = re.sub(r'hardware = ".*"', f'hardware = "{study}.csv"', settings).replace('"uno"', '"pico"')
    (folder / "robosmi.toml").write_text(re.sub(r'"D(\d+)"', r'"GP\1"', settings))
    robosmi.migrate([folder / f"{study}.c"], folder / "out", target="pico")
    return folder / "out"


def run(out: Path, folder: Path, devices: list[DeviceUse], seconds: float) -> PinTrace:
    require_tools("arm-none-eabi-gcc", "arm-none-eabi-g++")
    require_engine("rp2040js")
    report = compile_sketch(out, keep=folder)
    assert report.ok, "\n".join(str(finding) for finding in report.diagnostics)
    assert report.fits
    assert report.elf is not None
    return simulate(job(report.elf, report.hex, load_board("pico"), seconds * 1e6, devices))


@pytest.mark.parametrize("study", ["line_follower", "environmental_monitoring"])
def test_no_text_calls_a_pin_by_the_name_of_another_board(study: str, examples: Path, tmp_path: Path) -> None:
    out = moved(study, examples, tmp_path)
    names = {f"{path.name}: {line}" for path in (out / study).iterdir() for line in path.read_text().splitlines()}
    assert [line for line in names if re.search(r"\bD\d{1,2}\b|\bUno\b|\bA[0-5]\b", line)] == []


def test_the_line_follower_steers_by_its_two_sensors(examples: Path, tmp_path: Path) -> None:
    decays = {"GP10": 300, "GP11": 2500}
    sensors = [DeviceUse("capacitor", {"pin": pin}, {"points": [[0, decay]]}) for pin, decay in decays.items()]
    trace = run(moved("line_follower", examples, tmp_path), tmp_path, sensors, 1.0)
    assert trace.state == "running"
    for pin in ("GP8", "GP9"):
        begins = [begun for begun, _ in trace.pulses(pin)]
        assert 45 <= len(begins) <= 51
        assert all(abs(later - begun - 20_000) < 200 for begun, later in pairwise(begins[5:]))
        assert all(1_000 <= width <= 2_000 for _, width in trace.pulses(pin))
    assert len(trace.pulses("GP10")) > 20  # each sensor is charged again and again
    assert len(trace.pulses("GP11")) > 20


def test_the_environmental_robot_drives_its_servos_and_infrared_leds(examples: Path, tmp_path: Path) -> None:
    dht = DeviceUse("dht22", {"signal": "GP7"}, {"humidity": [[0, 45.0]], "celsius": [[0, 21.5]]})
    free = [DeviceUse("levels", {"pin": pin}, {"points": [[0, 1]]}) for pin in ("GP2", "GP11")]  # nothing reflects
    trace = run(moved("environmental_monitoring", examples, tmp_path), tmp_path, [dht, *free], 1.5)
    assert trace.state == "running"
    for pin in ("GP8", "GP9"):
        assert all(1_300 < width < 1_700 for _, width in trace.pulses(pin))
        assert len(trace.pulses(pin)) > 40
    assert len(trace.pulses("GP3")) > 500
