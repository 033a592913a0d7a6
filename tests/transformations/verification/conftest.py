"""Sketches compiled once a session, and run on every engine."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path

import pytest

from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.verification.jobs import job
from robosmi.verify.simulation import DeviceUse, Job
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.tools import require_engine, require_tools

SKETCHES = Path(__file__).parent / "sketches"
Run = Callable[[str, float, Sequence[DeviceUse]], Job]


@pytest.fixture(params=["simavr", "avr8js"])
def engine(request: pytest.FixtureRequest) -> str:
    """The name of an engine that is installed."""
    name: str = request.param
    require_engine(name)
    return name


@pytest.fixture(scope="session")
def built(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], tuple[Path, Path]]:
    """The program of a sketch: `.elf` and `.hex`."""
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")

    @cache
    def build(name: str) -> tuple[Path, Path]:
        report = compile_sketch(SKETCHES / name, "uno", keep=tmp_path_factory.mktemp(name))
        assert report.ok, report.diagnostics
        assert report.elf is not None
        assert report.hex is not None
        return report.elf, report.hex

    return build


@pytest.fixture
def job_of(built: Callable[[str], tuple[Path, Path]]) -> Run:
    """The job of running a sketch on an Uno for some milliseconds with these devices."""

    def made(name: str, milliseconds: float, devices: Sequence[DeviceUse]) -> Job:
        return job(*built(name), load_board("uno"), milliseconds * 1000, devices)

    return made
