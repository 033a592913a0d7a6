"""Processor time of simulating the migrated line follower for 16 seconds on simavr, after compiling.

Its sensors are polled all the time: 124,000 changes of pins. The time is that of the engine's process with its start and of the
trace that it answers with: the best of five runs.
"""

from __future__ import annotations

import os
import resource
import statistics
import tempfile
from collections.abc import Iterator
from pathlib import Path

import robosmi
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.verification.bound_devices.played_devices import played
from robosmi.transformations.verification.bound_devices.port_devices import bound_ports
from robosmi.transformations.verification.jobs import job
from robosmi.verify.scenario import Scenario
from robosmi.verify.simulation import simulate
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.bench.figures import Figure

EXAMPLE = Path(__file__).resolve().parents[2] / "docs" / "examples" / "line_follower"
SIMULATED_S = 16
BOUND_S = 3.0


def processor_seconds() -> float:
    """Processor time of this process's children that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def figures() -> Iterator[Figure]:
    """The processor time of a simulation."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        os.environ["ROBOSMI_HOME"] = str(folder / "home")
        out = folder / "out"
        migrated = robosmi.migrate([EXAMPLE / "line_follower.c"], out, hardware=EXAMPLE / "line_following_robot.fzz")
        ports = bound_ports(migrated.models.plan, out / "models")
        compiled = compile_sketch(out, keep=folder)
        if compiled.elf is None or compiled.hex is None:
            raise RuntimeError("the sketch does not compile")
        devices = played(ports, Scenario("rest", SIMULATED_S * 1000.0), target=True)
        asked = job(compiled.elf, compiled.hex, load_board(compiled.board), SIMULATED_S * 1e6, devices)
        found = []
        for _ in range(5):
            before = processor_seconds()
            trace = simulate(asked, "simavr")
            found.append(processor_seconds() - before)
    note = f"{len(trace.changes):,} changes, median {statistics.median(found):.2f} s"
    yield Figure(f"{SIMULATED_S} s on {trace.engine}, processor time", min(found), "s", BOUND_S, note=note)
